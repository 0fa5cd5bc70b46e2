#include "study/drop/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/facts/rotor_report.h"
#include "analysis/section_coupling.h"
#include "analysis/statics/statics.h"
#include "study/drop/elastic_state.h"
#include "study/drop/fe_summary.h"
#include "study/drop/local_report.h"
#include "study/drop/probe_summary.h"
#include "study/drop/support_summary.h"
#include "study/drop/warning_summary.h"
#include "study/drop/whirl.h"
#include "study/json_number.h"
#include "study/opinion/second_opinion.h"
#include "study/recorded_drop.h"
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

Json ended_by(const RunParameters& run, const DropResult& result) {
  if (!result.completed) return "interruption";
  if (result.condition_met) return name_of(run.until);
  return run.until_time ? "until" : "end_time";
}

Json safety(double pressure) { return json_number(std::pow(static_pressure_limit / pressure, 3)); }

Json bearing_summary(const Machine& machine, const DropScalars& scalars, std::size_t i, std::span<const double> y,
                     double mean_force_end) {
  const BearingScalars& s = scalars.of(i);
  const std::size_t support = scalars.support(i);
  const auto ledger = [&](const char* name) { return machine.ledger(support, name, y); };
  Json j;
  j["first_contact_time"] = json_number(s.first_contact_time);
  j["first_contact_end"] = json_number(s.first_contact_end);
  j["second_contact_time"] = json_number(s.second_contact_time);
  j["peak_contact_force"] = json_number(s.contact_force.value);
  j["peak_contact_force_time"] = json_number(s.contact_force.time);
  j["first_bounce_apex"] = json_number(s.first_bounce_apex);
  j["peak_friction_heat_rate"] = json_number(s.friction_heat_rate.value);
  j["friction_heat"] = ledger("rub heat");
  j["inner_heat"] = ledger("inner heat");
  j["outer_heat"] = ledger("outer heat");
  j["catch_up_time"] = json_number(s.catch_up_time);
  j["ring_speed_end"] = json_number(s.ring_speed_end);
  j["mean_contact_force_end"] = json_number(mean_force_end);
  j["load_torque_peak"] = json_number(s.load_torque.value);
  j["spin_torque_peak"] = json_number(s.spin_torque.value);
  j["inner_heat_rate_max"] = json_number(s.inner_heat_rate.value);
  j["outer_heat_rate_max"] = json_number(s.outer_heat_rate.value);
  j["largest_ball_force"] = json_number(s.ball_force.value);
  j["largest_contact_pressure"] = json_number(s.contact_pressure.value);
  j["largest_contact_pressure_time"] = json_number(s.contact_pressure.time);
  j["static_safety"] = safety(s.contact_pressure.value);
  for (std::size_t row = 0; row < scalars.n_rows(i); ++row)
    j["rows"].push_back({{"largest_contact_pressure", s.row_pressure[row].value},
                         {"largest_contact_pressure_time", json_number(s.row_pressure[row].time)},
                         {"static_safety", safety(s.row_pressure[row].value)},
                         {"truncation", s.row_truncation[row].largest},
                         {"truncation_time", json_number(s.row_truncation[row].largest_time)},
                         {"time_truncated", s.row_truncation[row].time_truncated},
                         {"loaded_share", s.row_centrifugal[row].loaded_share()},
                         {"centrifugal_over_load", s.row_centrifugal[row].over_load()}});
  j["centrifugal_force"] = s.row_centrifugal[0].largest;
  const auto* touchdown = dynamic_cast<const TouchdownBearing*>(&machine.support(support));
  j["ball_model"] = touchdown && touchdown->data().ball_model == BallModel::inertial ? "inertial" : "quasi-static";
  if (scalars.n_rows(i) > 1) j["preload"] = range(s.preload);
  const SkidVerdict skid = skid_verdict(s, scalars.n_rows(i));
  j["skid"] = demand(skid.demand);
  j["skid"]["speed_change"] = skid.demand.speed_change;
  j["skid"]["speed_change_beyond"] = skid.demand.speed_change_beyond;
  j["skid"]["row"] = skid.row ? Json(*skid.row + 1) : Json(nullptr);
  j["gyroscopic"] = demand(s.gyroscopic);
  j["clearance"] = range(s.clearance);
  for (std::size_t k = 0; k < growth_surfaces.size(); ++k) j["growth"][growth_surface_keys[k]] = range(s.growth[k]);
  if (scalars.is_free(i)) j["axial"] = {{"force", range(s.axial_force)}, {"rotor_position", range(s.axial_position)}};
  return j;
}

// docs/theory/model.md, section 8: the rub heat from the spin-up alone, whatever friction, bounces and waves:
//   E_slip = (r_r/r_b) integral omega_r (J omega_i' + M) dt - J omega_i^2/2 - integral M omega_i dt + integral F_t v_t dt.
Json spin_up_balance(const Machine& machine, std::size_t support, std::span<const double> y, double ring_speed) {
  const auto* bearing = dynamic_cast<const TouchdownBearing*>(&machine.support(support));
  if (!bearing) return nullptr;
  const auto& d = bearing->data();
  const double balance =
      d.rotor_radius / d.bore_radius * machine.ledger(support, "spin-up drive", y) -
      0.5 * d.ring_spin_inertia * ring_speed * ring_speed -
      (machine.ledger(support, "inner heat", y) + machine.ledger(support, "outer heat", y)) / d.heat_over_work +
      machine.ledger(support, "spin-up centres", y);
  return {{"slip_energy", balance}, {"residual", machine.ledger(support, "rub heat", y) - balance}};
}

std::string rises_text(const Json& rise) {
  return fmt::format("{:.2f} K inner ring, {:.2f} K shaft, {:.2f} K balls", rise["inner_ring"].get<double>(),
                     rise["shaft"].get<double>(), rise["ball"].get<double>());
}

}  // namespace

Json summarise(const Case& drop_case, const Machine& machine, const DropScalars& scalars, const DropResult& result,
               FiniteElements* elements, const RecordedDrop& recorded) {
  const std::span<const double> y = result.state;
  Json j;
  j["case"] = drop_case.name;
  const RotorReport rotor = rotor_report(drop_case.parameters.rotor);
  j["rotor"] = {{"mass", rotor.body.mass},
                {"polar_inertia", rotor.body.Ip},
                {"diametral_inertia", rotor.body.Id},
                {"centre_of_gravity", rotor.body.centre_of_gravity},
                {"free_free_frequencies", rotor.free_free_frequencies}};
  std::vector<double> observed(observed_size(machine.state_observables()));
  Evaluation found;
  found.growth_in_force = result.growth_in_force ? &*result.growth_in_force : nullptr;
  machine.evaluate(result.end_time, y, found);
  machine.observe_state(y, found, observed);

  const bool is_elastic = elements && drop_case.parameters.thermal.expansion == GrowthSource::elastic;
  if (is_elastic && elements->coupling != FeCoupling::windowed) lift_sections(*elements, machine, y, found);
  j["bearings"] = Json::object();
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    const std::size_t support = scalars.support(i);
    const std::string name = machine.support(support).name();
    const auto& s = scalars.of(i);
    const double mean = (machine.ledger(support, "contact impulse", y) - result.impulse_before_end[i]) /
                        (result.end_time - result.averaging_start);
    Json bearing = bearing_summary(machine, scalars, i, y, mean);
    std::size_t at = 0;
    const std::string prefix = "/thermal/" + name + "/";
    for (const auto& o : machine.state_observables()) {
      if (o.name.starts_with(prefix))
        bearing["temperature_rise_end"][o.name.substr(prefix.size())] = observed[at] - drop_case.parameters.run.ambient;
      at += o.size;
    }
    if (elements)
      for (const auto& section : elements->sections)
        if (section.name == name) {
          bearing["fe"] = fe_summary(section, elements->coupling, recorded);
          if (is_elastic)
            bearing["fe"]["elastic_end"] = elastic_state(section, section.solver->field(), s.ring_speed_end);
        }
    for (const auto& entry : drop_case.parameters.bearings)
      if (const auto* touchdown = entry.touchdown(); touchdown && entry.name == name)
        add_local_report(recorded, name, *touchdown, bearing);
    if (scalars.is_free(i))
      if (auto shoulder = shoulder_json(drop_case.parameters, name); !shoulder.is_null())
        bearing["shoulder"] = std::move(shoulder);
    bearing["whirl"] = whirl_summary(recorded, name);
    bearing["support"] = support_summary(scalars.supports(), machine, drop_case.parameters, name, y);
    bearing["spin_up"] = spin_up_balance(machine, support, y, s.ring_speed_end);
    j["bearings"][name] = std::move(bearing);
  }
  if (scalars.probes().size() > 0) j["probes"] = probe_summary(machine, scalars.probes(), y);
  j["rotor_speed_end"] = machine.spin(y).speed;
  const EnergyBalance e = machine.energy_balance(result.end_time, y, found.growth_in_force);
  j["energy"] = {{"mechanical_initial", machine.initial_mechanical_energy()},
                 {"mechanical_final", e.mechanical},
                 {"dissipated", e.dissipated},
                 {"growth_work", e.growth_work},
                 {"prescribed_work", e.prescribed_work},
                 {"unbalance_work", e.unbalance_work},
                 {"drive_work", e.drive_work},
                 {"residual", e.residual},
                 {"heat_deposited", e.heat_deposited}};
  if (machine.rotor().has_windage()) j["energy"]["windage"] = e.windage;
  for (std::size_t k = 0; k < e.heat.size(); ++k) {
    const std::string prefix = machine.thermal_name(k) == "lumped" ? "" : machine.thermal_name(k) + "_";
    j["energy"][prefix + "heat_stored"] = e.heat[k].stored;
    j["energy"][prefix + "heat_lost"] = e.heat[k].lost;
    j["energy"][prefix + "heat_residual"] = e.heat[k].residual;
  }
  if (result.windows) j["windows"] = windows_summary(*result.windows, result.windows_energy);
  j["run"] = {{"completed", result.completed},
              {"end_time", result.end_time},
              {"ended_by", ended_by(drop_case.parameters.run, result)},
              {"until", name_of(drop_case.parameters.run.until)},
              {"wall_time", result.wall_time},
              {"cpu_time", result.cpu_time},
              {"steps", result.statistics.steps},
              {"rhs_evaluations", result.statistics.rhs_evaluations},
              {"rejected_steps", result.statistics.rejected_steps}};
  return j;
}

namespace {

/// How far the modes of reduced finite elements are off.
std::string reduction_text(const Json& j) {
  std::string text;
  if (!j.contains("bearings")) return text;
  for (const auto& [name, b] : j["bearings"].items()) {
    if (!b.contains("fe") || b["fe"].value("worst_response", "").empty()) continue;
    text += fmt::format("{} {}: {} modes follow heat within {:.2g} % (worst: {})\n",
                        text.empty() ? "Finite elements," : "                 ", name, b["fe"]["modes"].get<long>(),
                        100. * b["fe"]["largest_response_error"].get<double>(),
                        b["fe"]["worst_response"].get<std::string>());
  }
  return text;
}

}  // namespace

std::string summary_text(const Json& j) {
  std::string text;
  const auto time = [](const Json& v, double unit, const char* name) {
    return v.is_null() ? std::string("never") : fmt::format("{:.4g} {}", v.get<double>() * unit, name);
  };
  const double rpm = 30. / std::numbers::pi;
  if (j.contains("bearings"))
    for (const auto& [name, b] : j["bearings"].items()) {
      text += fmt::format("{}: first contact {}, peak contact force {:.2f} kN, rub heat {:.1f} J (peak {:.1f} kW)\n",
                          name, time(b["first_contact_time"], 1e3, "ms"), b["peak_contact_force"].get<double>() * 1e-3,
                          b["friction_heat"].get<double>(), b["peak_friction_heat_rate"].get<double>() * 1e-3);
      text += fmt::format("{:{}}ring speed {:.0f} rpm at the end, spin-up complete: {}; ", "", name.size() + 2,
                          b["ring_speed_end"].get<double>() * rpm, time(b["catch_up_time"], 1e3, "ms"));
      text += "mean temperature rise ";
      const char* separator = "";
      if (b.contains("temperature_rise_end")) {
        text += rises_text(b["temperature_rise_end"]);
        separator = "; finite elements ";
      }
      if (b.contains("fe"))
        text += separator + rises_text(b["fe"]["temperature_rise_end"]) +
                fmt::format(", bore {:.1f} K at {}", b["fe"]["surface_rise"]["bore"]["highest"].get<double>(),
                            time(b["fe"]["surface_rise"]["bore"]["highest_time"], 1e3, "ms"));
      text += "\n";
      text += local_text(name, b);
      if (b.contains("axial"))
        text += fmt::format("{:{}}axial force on the ring {:.2f} to {:.2f} kN\n", "", name.size() + 2,
                            b["axial"]["force"]["smallest"].get<double>() * 1e-3,
                            b["axial"]["force"]["largest"].get<double>() * 1e-3);
      if (b.contains("shoulder")) text += shoulder_text(b["shoulder"], name.size() + 2);
      if (b.contains("support")) text += support_text(name, b["support"]);
      if (b.contains("whirl")) text += whirl_text(name, b["whirl"]);
    }
  if (j.contains("probes")) text += probe_text(j["probes"]);
  text += reduction_text(j);
  const auto& e = j["energy"];
  const auto& run = j["run"];
  if (const std::string until = run.value("until", ""); !until.empty())
    text += run["ended_by"] == until
                ? fmt::format("Ended by run.until = \"{}\" at t = {:.6g} s, at {:.4g} rpm\n", until,
                              run["end_time"].get<double>(), j["rotor_speed_end"].get<double>() * rpm)
                : fmt::format("run.until = \"{}\" was not met by t = {:.6g} s; raise run.end_time\n", until,
                              run["end_time"].get<double>());
  text += fmt::format("Energy: {:.2f} J dissipated", e["dissipated"].get<double>());
  if (e.contains("windage")) text += fmt::format(" ({:.2f} J by windage)", e["windage"].get<double>());
  text += fmt::format(", residual {:.1e} J; heat {:.2f} J deposited", e["residual"].get<double>(),
                      e["heat_deposited"].get<double>());
  if (e.contains("heat_residual")) text += fmt::format(", residual {:.1e} J", e["heat_residual"].get<double>());
  if (e.contains("fe_heat_residual"))
    text += fmt::format(", finite-element residual {:.1e} J", e["fe_heat_residual"].get<double>());
  if (j.contains("windows"))
    text += fmt::format(
        ", of the finite elements {:.1e} J\nWindows: {} of {:.3g} to {:.3g} ms; growth error up to {:.2g} nm of {:.0f} "
        "nm",
        j["windows"]["heat_residual"].get<double>(), j["windows"]["count"].get<long>(),
        j["windows"]["shortest"].get<double>() * 1e3, j["windows"]["longest"].get<double>() * 1e3,
        j["windows"]["largest_growth_error"].get<double>() * 1e9, j["windows"]["largest_growth"].get<double>() * 1e9);
  text += "\n" + warnings_text(j) + second_opinion_text(j) + limits_text(j);
  return text;
}

}  // namespace rotordrop
