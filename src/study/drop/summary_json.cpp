#include <nlohmann/json.hpp>

#include "base/version.h"
#include "study/drop/drop_summary.h"
#include "study/drop/warning_summary.h"
#include "study/json_number.h"
#include "study/result_limits.h"
#include "study/statics/shoulder_words.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

Json range(const FollowedRange& r) {
  return {{"start", json_number(r.first)},
          {"smallest", json_number(r.smallest)},
          {"smallest_time", json_number(r.smallest_time)},
          {"largest", json_number(r.largest)},
          {"largest_time", json_number(r.largest_time)},
          {"end", json_number(r.last)}};
}

Json demand(const FollowedDemand& d) {
  return {{"largest_demand", d.largest},
          {"largest_demand_time", json_number(d.largest_time)},
          {"time_beyond", d.time_beyond},
          {"longest_beyond", d.longest_beyond}};
}

Json bearing_json(const BearingSummary& b) {
  const BearingScalars& s = b.scalars;
  Json j;
  j["first_touch_time"] = json_number(first_touch_time(s));
  j["first_contact_time"] = json_number(s.first_contact_time);
  j["first_contact_end"] = json_number(s.first_contact_end);
  j["ends_in_first_contact"] = ends_in_first_contact(s);
  j["second_contact_time"] = json_number(s.second_contact_time);
  j["peak_contact_force"] = json_number(s.contact_force.value);
  j["peak_contact_force_time"] = json_number(s.contact_force.time);
  j["first_bounce_apex"] = b.is_up_along_y ? json_number(first_bounce_apex(s)) : Json(nullptr);
  j["peak_friction_heat_rate"] = json_number(s.friction_heat_rate.value);
  j["friction_heat"] = b.friction_heat;
  j["inner_heat"] = b.inner_heat;
  j["outer_heat"] = b.outer_heat;
  j["catch_up_time"] = json_number(s.catch_up_time);
  j["ring_speed_end"] = json_number(s.ring_speed_end);
  j["mean_contact_force_end"] = json_number(b.mean_contact_force_end);
  j["load_torque_peak"] = json_number(s.load_torque.value);
  j["spin_torque_peak"] = json_number(s.spin_torque.value);
  j["inner_heat_rate_max"] = json_number(s.inner_heat_rate.value);
  j["outer_heat_rate_max"] = json_number(s.outer_heat_rate.value);
  j["largest_ball_force"] = json_number(s.ball_force.value);
  j["largest_contact_pressure"] = json_number(s.contact_pressure.value);
  j["largest_contact_pressure_time"] = json_number(s.contact_pressure.time);
  j["static_safety"] = json_number(static_safety(s.contact_pressure.value));
  for (std::size_t row = 0; row < b.n_rows; ++row)
    j["rows"].push_back({{"largest_contact_pressure", s.row_pressure[row].value},
                         {"largest_contact_pressure_time", json_number(s.row_pressure[row].time)},
                         {"static_safety", json_number(static_safety(s.row_pressure[row].value))},
                         {"truncation", s.row_truncation[row].largest},
                         {"truncation_time", json_number(s.row_truncation[row].largest_time)},
                         {"time_truncated", s.row_truncation[row].time_truncated},
                         {"loaded_share", s.row_centrifugal[row].loaded_share()},
                         {"centrifugal_over_load", s.row_centrifugal[row].over_load()}});
  j["centrifugal_force"] = s.row_centrifugal[0].largest;
  j["ball_model"] = b.is_inertial ? "inertial" : "quasi-static";
  if (b.n_rows > 1) j["preload"] = range(s.preload);
  const SkidVerdict skid = skid_verdict(s, b.n_rows);
  j["skid"] = demand(skid.demand);
  j["skid"]["speed_change"] = skid.demand.speed_change;
  j["skid"]["speed_change_beyond"] = skid.demand.speed_change_beyond;
  j["skid"]["row"] = skid.row ? Json(*skid.row + 1) : Json(nullptr);
  j["gyroscopic"] = demand(s.gyroscopic);
  j["clearance"] = range(s.clearance);
  for (std::size_t k = 0; k < growth_surfaces.size(); ++k) j["growth"][growth_surface_keys[k]] = range(s.growth[k]);
  if (b.is_free) j["axial"] = {{"force", range(s.axial_force)}, {"rotor_position", range(s.axial_position)}};
  if (b.shoulder) {
    j["axial"]["shoulder_force"] = range(s.shoulder_force);
    j["axial"]["first_shoulder_contact_time"] = json_number(s.first_shoulder_contact_time);
  }
  for (const auto& rises : b.rises)
    for (const auto& [node, rise] : rises.values)
      (rises.kind->is_unmarked ? j : j[rises.kind->name])["temperature_rise_end"][node] = rise;
  if (b.section) j[b.section->kind->name] = fe_json(b.section->fe);
  if (b.local) {
    j["local"] = local_json(*b.local);
    j["wear"] = wear_json(*b.local);
  }
  if (b.damage) j["damage"] = *b.damage;
  if (b.shoulder) j["shoulder"] = shoulder_json(*b.shoulder);
  if (b.whirl) j["whirl"] = whirl_json(*b.whirl);
  j["support"] = support_json(b.support);
  j["spin_up"] =
      b.spin_up ? Json{{"slip_energy", b.spin_up->slip_energy}, {"residual", b.spin_up->residual}} : Json(nullptr);
  return j;
}

Json energy_json(const DropSummary& s) {
  const EnergyBalance& e = s.energy;
  Json j = {{"mechanical_initial", s.mechanical_initial},
            {"mechanical_final", e.mechanical},
            {"dissipated", e.dissipated},
            {"growth_work", e.growth_work},
            {"prescribed_work", e.prescribed_work},
            {"unbalance_work", e.unbalance_work},
            {"drive_work", e.drive_work},
            {"residual", e.residual},
            {"heat_deposited", e.heat_deposited}};
  if (s.has_windage) j["windage"] = e.windage;
  for (std::size_t k = 0; k < e.heat.size(); ++k) {
    j[s.heat_prefixes[k] + "heat_stored"] = e.heat[k].stored;
    j[s.heat_prefixes[k] + "heat_lost"] = e.heat[k].lost;
    j[s.heat_prefixes[k] + "heat_residual"] = e.heat[k].residual;
  }
  return j;
}

}  // namespace

Json summary_json(const DropSummary& s) {
  Json j;
  j["program"] = program_name();
  j["case"] = s.case_name;
  if (!s.title.empty()) j["title"] = s.title;
  if (!s.note.empty()) j["note"] = s.note;
  j["rotor"] = {{"mass", s.rotor.body.mass},
                {"polar_inertia", s.rotor.body.Ip},
                {"diametral_inertia", s.rotor.body.Id},
                {"centre_of_gravity", s.rotor.body.centre_of_gravity},
                {"free_free_frequencies", s.rotor.free_free_frequencies}};
  j["bearings"] = Json::object();
  for (const auto& b : s.bearings) j["bearings"][b.name] = bearing_json(b);
  if (!s.probes.empty()) j["probes"] = probes_json(s.probes);
  j["rotor_speed_end"] = s.rotor_speed_end;
  j["energy"] = energy_json(s);
  if (s.windows) j["windows"] = windows_json(s.windows->report, s.windows->energy);
  j["run"] = {{"completed", s.completed},
              {"end_time", s.end_time},
              {"ambient", s.ambient},
              {"ended_by", s.ended_by},
              {"until", s.until},
              {"wall_time", s.wall_time},
              {"cpu_time", s.cpu_time},
              {"steps", s.statistics.steps},
              {"rhs_evaluations", s.statistics.rhs_evaluations},
              {"rejected_steps", s.statistics.rejected_steps},
              {"warnings", s.warnings.size()}};
  j["input_warnings"] = Json::array();
  for (const auto& warning : s.input_warnings)
    j["input_warnings"].push_back(
        {{"where", to_string(warning.where)}, {"message", warning.message}, {"advice", warning.advice}});
  j["warnings"] = warnings_json(s.warnings);
  if (s.limits) {
    j["limits"] = *s.limits;
    j["accepted"] = accepted(*s.limits);
  }
  if (s.second_opinion) j["second_opinion"] = *s.second_opinion;
  return j;
}

}  // namespace rotordrop
