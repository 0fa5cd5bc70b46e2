#include <cmath>

#include "study/drop/drop_summary.h"

// What the lines on the screen need, read back from summary.json.
namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>() : std::nan("");
}

NamedValues rises_in(const Json& j) {
  NamedValues rises;
  if (j.contains("temperature_rise_end"))
    for (const auto& [node, rise] : j.at("temperature_rise_end").items()) rises.emplace_back(node, rise.get<double>());
  return rises;
}

FeSummary section_of(const Json& j) {
  FeSummary fe;
  fe.rises = rises_in(j);
  const Json surfaces = j.value("surface_rise", Json::object());
  for (const auto& [name, s] : surfaces.items())
    fe.surfaces.push_back({name, s.is_object(), number(s, "mean_end"), number(s, "highest_mean"), number(s, "highest"),
                           number(s, "highest_time")});
  if (j.contains("worst_response")) {
    FeSummary::Reduction r;
    r.modes = j.at("modes").get<std::size_t>();
    r.largest_error = number(j, "largest_response_error");
    r.worst = j.at("worst_response").get<std::string>();
    fe.reduction = r;
  }
  return fe;
}

LocalSummary local_of(const Json& local, const Json& wear) {
  LocalSummary s;
  s.rub.stated.bore = number(local, "bore_rise");
  s.rub.stated.rotor = number(local, "rotor_rise");
  s.rub.stated.time = number(local, "bore_rise_time");
  s.rub.bore_rise_low = number(local, "bore_rise_low");
  s.rub.bore_rise_high = number(local, "bore_rise_high");
  s.rub.wear.bore_depth = number(wear, "bore_depth");
  s.rub.wear.rotor_depth = number(wear, "rotor_depth");
  s.depth_limit = number(wear, "depth_limit");
  return s;
}

ShoulderReport shoulder_of(const Json& j) {
  ShoulderReport report;
  report.stiffness = number(j, "stiffness");
  report.is_given = j.at("stiffness_from") == "given";
  report.rotor_stiffness = number(j, "rotor_stiffness");
  report.ring_stiffness = number(j, "ring_stiffness");
  for (const auto& side : j.at("sides")) {
    const Json& force = side.at("force_by_energy");
    report.sides.push_back(
        {side.at("push") == "+x" ? 1. : -1.,
         number(side, "gap"),
         number(side, "thrust"),
         number(side, "approach_speed"),
         {number(force, "half_stiffness"), number(force, "stiffness"), number(force, "double_stiffness")}});
  }
  return report;
}

SupportSummary support_of(const Json& j) {
  SupportSummary s;
  s.type = j.at("type").get<std::string>();
  s.largest_travel = number(j, "largest_travel");
  s.loss = number(j, "loss");
  if (j.contains("largest_stored_energy")) s.largest_stored_energy = number(j, "largest_stored_energy");
  if (j.contains("meets_stop")) s.meets_stop = j.at("meets_stop").get<bool>();
  return s;
}

WhirlSummary whirl_of(const Json& j) {
  WhirlSummary w;
  if (j.at("largest_backward_speed").is_number()) w.largest_backward_speed = number(j, "largest_backward_speed");
  w.contact_time = number(j, "contact_time");
  w.backward_whirl_time = number(j, "backward_whirl_share") * w.contact_time;
  w.has_full_rub = j.at("full_rub") == "yes";
  return w;
}

BearingSummary bearing_of(const std::string& name, const Json& j) {
  BearingSummary b;
  b.name = name;
  b.scalars.first_contact_time = number(j, "first_contact_time");
  b.scalars.contact_force.value = number(j, "peak_contact_force");
  b.scalars.friction_heat_rate.value = number(j, "peak_friction_heat_rate");
  b.scalars.ring_speed_end = number(j, "ring_speed_end");
  b.scalars.catch_up_time = number(j, "catch_up_time");
  b.friction_heat = number(j, "friction_heat");
  for (const ThermalKind* kind : thermal_kinds()) {
    const Json of = kind->is_unmarked ? j : j.value(kind->name, Json::object());
    if (!of.contains("temperature_rise_end")) continue;
    if (kind->meshes_sections)
      b.section = {kind, section_of(of)};
    else
      b.rises.push_back({kind, rises_in(of)});
  }
  if (j.contains("local")) b.local = local_of(j.at("local"), j.at("wear"));
  if (j.contains("damage")) b.damage = j.at("damage");
  b.is_free = j.contains("axial");
  if (b.is_free) {
    b.scalars.axial_force.smallest = number(j.at("axial").at("force"), "smallest");
    b.scalars.axial_force.largest = number(j.at("axial").at("force"), "largest");
    b.scalars.first_shoulder_contact_time = number(j.at("axial"), "first_shoulder_contact_time");
  }
  if (j.contains("shoulder")) b.shoulder = shoulder_of(j.at("shoulder"));
  if (j.contains("support") && j.at("support").is_object()) b.support = support_of(j.at("support"));
  if (j.contains("whirl")) b.whirl = whirl_of(j["whirl"]);  // supports of others have none
  return b;
}

ProbeSummary probe_of(const std::string& name, const Json& j) {
  ProbeSummary p;
  p.name = name;
  p.node = j.at("node").get<int>();
  p.clearance = number(j, "clearance");
  p.scalars.overlap.value = -number(j, "smallest_clearance");
  p.scalars.overlap.time = number(j, "smallest_clearance_time");
  p.scalars.first_touch_time = number(j, "first_touch_time");
  if (j.contains("contact")) {
    p.contact = {number(j.at("contact"), "friction_heat"), number(j.at("contact"), "damping")};
    p.scalars.contact_force.value = number(j.at("contact"), "peak_contact_force");
  }
  return p;
}

DropSummary::Windows windows_of(const Json& j) {
  DropSummary::Windows w;
  w.report.windows = j.at("count").get<long>();
  w.report.shortest = number(j, "shortest");
  w.report.longest = number(j, "longest");
  w.report.largest_error = number(j, "largest_growth_error");
  w.report.largest_growth = number(j, "largest_growth");
  w.energy = {number(j, "heat_input"), number(j, "heat_stored"), number(j, "heat_lost")};
  return w;
}

RunWarning warning_of(const Json& j) {
  return {find_warning_kind(j.at("code").get<std::string>()),
          j.at("place").get<std::string>(),
          j.at("part").get<std::string>(),
          j.at("count").get<long>(),
          number(j, "worst"),
          number(j, "limit"),
          number(j, "time"),
          number(j, "first_time"),
          number(j, "duration")};
}

}  // namespace

DropSummary recorded_summary(const Json& j) {
  DropSummary s;
  s.case_name = j.value("case", "");
  s.title = j.value("title", "");
  s.note = j.value("note", "");
  for (const auto& [name, b] : j.at("bearings").items()) s.bearings.push_back(bearing_of(name, b));
  const Json probes = j.value("probes", Json::object());
  for (const auto& [name, probe] : probes.items()) s.probes.push_back(probe_of(name, probe));
  s.rotor_speed_end = number(j, "rotor_speed_end");
  const Json& energy = j.at("energy");
  s.energy.dissipated = number(energy, "dissipated");
  s.energy.residual = number(energy, "residual");
  s.energy.heat_deposited = number(energy, "heat_deposited");
  s.has_windage = energy.contains("windage");
  if (s.has_windage) s.energy.windage = number(energy, "windage");
  for (const ThermalKind* kind : thermal_kinds())
    if (const std::string key = kind->prefix() + "heat_residual"; energy.contains(key)) {
      s.heat_models.push_back(kind);
      s.heat_prefixes.push_back(kind->prefix());
      s.energy.heat.emplace_back().residual = number(energy, key.c_str());
    }
  if (j.contains("windows")) s.windows = windows_of(j.at("windows"));
  const Json& run = j.at("run");
  s.completed = run.at("completed").get<bool>();
  s.end_time = number(run, "end_time");
  s.ambient = run.value("ambient", 0.);
  s.until = run.at("until").get<std::string>();
  s.ended_by = run.at("ended_by").get<std::string>();
  for (const auto& warning : j.value("warnings", Json::array()))
    if (const RunWarning w = warning_of(warning); w.kind) s.warnings.push_back(w);
  if (j.contains("limits")) s.limits = j.at("limits");
  if (j.contains("second_opinion")) s.second_opinion = j.at("second_opinion");
  return s;
}

}  // namespace rotordrop
