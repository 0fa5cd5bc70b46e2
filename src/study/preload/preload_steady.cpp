#include "study/preload/preload_steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "analysis/preload/build_preload.h"
#include "base/errors.h"
#include "case/modules/fe_module.h"
#include "machine/build_machine.h"
#include "machine/heat/make_sections.h"
#include "study/preload/preload_course.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(LimitMet limit) {
  switch (limit) {
    case LimitMet::temperature:
      return "temperature_limit";
    case LimitMet::pressure:
      return "pressure_limit";
    case LimitMet::no_state:
      return "no_steady_state";
    default:
      return "none";
  }
}

Json state_json(const RunningState& s) {
  return {{"heat", s.heat},
          {"preload", s.preload},
          {"largest_ball_load", s.largest_ball_load},
          {"largest_pressure", s.largest_pressure},
          {"static_safety", std::isfinite(s.static_safety) ? Json(s.static_safety) : Json(nullptr)},
          {"axial_stiffness", s.axial_stiffness},
          {"radial_stiffness", {s.radial_stiffness_y, s.radial_stiffness_z}},
          {"radial_clearance", s.radial_clearance},
          {"load_torque", s.load_torque},
          {"drag_torque", s.drag_torque},
          {"spin_torque", s.spin_torque},
          {"centrifugal_over_load", s.centrifugal_over_load},
          {"neglects_centrifugal", s.neglects_centrifugal},
          {"floating", s.is_floating}};
}

Json temperatures_json(const PreloadLoop& loop, std::span<const double> T, double heat) {
  Json j = Json::object();
  const auto values = loop.node_temperatures(T, heat);
  for (std::size_t i = 0; i < values.size(); ++i) j[loop.nodes()[i].name] = values[i];
  return j;
}

Json point_json(const PreloadLoop& loop, const OperatingPoint& p) {
  const auto& r = p.response;
  Json j = state_json(p.state);
  j["temperatures"] = temperatures_json(loop, p.T, p.heat);
  j["growth"] = p.growth.inner_race - p.growth.outer_race;
  j["loop_gain"] = r.gain;
  j["heat_per_preload"] = r.heat_per_preload;
  j["preload_per_heat"] = r.preload_per_heat;
  j["growth_per_heat"] = r.growth_per_heat.inner_race - r.growth_per_heat.outer_race;
  j["ball_growth_per_heat"] = r.growth_per_heat.ball;
  j["eigenvalue"] = {r.eigenvalue.real(), r.eigenvalue.imag()};
  j["eigenvalue_of_held_heat"] = {r.eigenvalue_of_held_heat.real(), r.eigenvalue_of_held_heat.imag()};
  j["largest_gain"] = std::isfinite(r.largest_gain) ? Json(r.largest_gain) : Json(nullptr);
  j["largest_gain_time"] = r.largest_gain_time;
  j["stable"] = r.is_stable();
  return j;
}

Json ending_json(const PreloadLoop& loop, const PreloadCourse& end) {
  const std::span<const double> T(end.y.data(), loop.size());
  const auto state = loop.state(T);
  Json j = {{"settled", end.is_settled}, {"limit", name_of(end.limit)}, {"time", end.time}};
  j["state"] = state_json(state);
  j["temperatures"] = temperatures_json(loop, T, state.heat);
  const auto growth = loop.growth(T);
  j["growth"] = growth.inner_race - growth.outer_race;
  j["largest_preload"] = end.largest_preload;
  j["largest_preload_time"] = end.largest_preload_time;
  const double made = end.y[loop.size()], lost = end.y[loop.size() + 1], stored = loop.stored_energy(T);
  j["energy"] = {{"made", made}, {"lost", lost}, {"stored", stored}, {"residual", made - lost - stored}};
  return j;
}

Json critical_json(const std::optional<CriticalFactor>& c, double value) {
  if (!c) return nullptr;
  return {{"factor", c->factor},
          {"value", c->factor * value},
          {"loop_gain", c->gain},
          {"by", c->by == CriticalFactor::By::loop    ? "loop gain"
                 : c->by == CriticalFactor::By::limit ? "limit"
                                                      : "no steady state"}};
}

using LoopWith = std::function<std::unique_ptr<PreloadLoop>(const PreloadVariation&)>;

/// One bearing's section by finite elements, if the case wants that.
std::shared_ptr<const ThermalModel> section_of(const Case& c, const std::string& bearing) {
  const auto& p = c.parameters;
  const ThermalKind& kind = *thermal_kind(p.preload.model);
  if (!kind.meshes_sections) return nullptr;
  const std::string model = fmt::format("preload.model = \"{}\"", kind.name),
                    circuit = fmt::format("preload.model = \"{}\"", preload_section().defaults().model);
  if (!p.thermal.nodes.empty() || !p.thermal.resistors.empty())
    throw InputError(position_of(c.tree, "preload"),
                     model + " cannot include what thermal.node and thermal.resistor add to the circuit.",
                     "Leave them out, or take " + circuit + ".");
  const auto depends = [](const auto& table) { return table && !PropertyTable(*table).is_constant(); };
  for (const auto& name : meshed_materials(p, touchdown_of(p, bearing)))
    if (const auto& material = material_of(p, name); depends(material.k_table) || depends(material.c_table))
      throw InputError(position_of(c.tree, "preload"),
                       fmt::format("{} uses the modes of a linear problem, but k_table or c_table of materials.{} "
                                   "makes properties depend on temperature.",
                                   model, name),
                       "Take constant k and c, or " + circuit + ".");
  if (touchdown_of(p, bearing).housing_fit < 0. && p.thermal.expansion == GrowthSource::elastic)
    throw InputError(position_of(c.tree, "preload"),
                     fmt::format("{} takes the fit of {} in its housing as closed, and its housing_fit is a clearance.",
                                 model, bearing),
                     "Give an interference, thermal.expansion = \"formula\", or " + circuit + ".");
  FiniteElements elements = finite_elements_of(c);
  const std::lock_guard guard(section_lock());
  return reduced_fe_model(with_single_bearing(p, bearing), elements, p.preload.end_time);
}

/// Operating points over speed: two columns, the lower point and the next one.
PreloadTable points_over_speed(const Case& c, const std::string& bearing, const LoopWith& with,
                               const std::optional<CriticalFactor>& critical) {
  constexpr int n_speeds = 40;
  const std::string prefix = fmt::format("/{}/operating_points/", bearing);
  const std::vector<std::string> columns = {"lower", "upper"};
  PreloadTable table;
  table.group = {prefix + "speed",
                 {{prefix + "preload", "N", "smaller axial force of opposed rows", 2, columns},
                  {prefix + "heat_rate", "W", "friction heat of the bearing", 2, columns},
                  {prefix + "highest_temperature", "K", "of all nodes", 2, columns},
                  {prefix + "loop_gain", "1", "dPhi/dQ; growth_rate tells whether the point is stable", 2, columns},
                  {prefix + "growth_rate", "1/s", "real part of the largest eigenvalue", 2, columns}},
                 "rad/s",
                 "speed of the inner ring"};
  const auto limits = preload_limits(c.parameters.preload);
  const double speed = preload_speed(c.parameters);
  for (int i = 1; i <= n_speeds; ++i) {
    // Up to the critical speed, denser towards it: there both points meet.
    const double left = 1. - i / static_cast<double>(n_speeds);
    const double factor = critical ? critical->factor * (1. - left * left) : 1.5 * (1. - left);
    OperatingPoints found;
    try {
      found = find_operating_points(*with({.speed = factor}), limits);
    } catch (const SolverError&) {
      // No rest of the bearing at this speed, not even a cold one.
    }
    std::vector<std::array<double, 2>> values(5, {NAN, NAN});
    for (std::size_t k = 0; k < std::min<std::size_t>(2, found.points.size()); ++k) {
      const auto& point = found.points[k];
      values[0][k] = point.state.preload;
      values[1][k] = point.heat;
      values[2][k] = point.highest_temperature;
      values[3][k] = point.response.gain;
      values[4][k] = point.response.eigenvalue.real();
    }
    std::vector<double> row;
    for (const auto& pair : values) row.insert(row.end(), pair.begin(), pair.end());
    table.axis.push_back(factor * speed);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string verdict_of(const PreloadCourse& end, const OperatingPoints& points, std::optional<std::size_t> settled) {
  const bool has_stable = points.first_stable() != nullptr;
  if (end.limit != LimitMet::none && end.time == 0.) return "seized-from-the-start";
  if (end.limit != LimitMet::none) return has_stable ? "runs-away-on-the-way" : "runs-away";
  if (end.is_settled && settled && points.points[*settled].response.is_stable()) return "stable";
  return "undecided";
}

Json run_preload_loop(const Case& c, const std::string& bearing, std::vector<PreloadTable>& tables, const Look& look) {
  const auto& p = c.parameters;
  const auto find = rest_finder(bearing, look);
  const auto section = section_of(c, bearing);
  const LoopWith with = [&](const PreloadVariation& v) {
    return build_preload_loop(p, c.tree, bearing, find, v, section);
  };
  const auto limits = preload_limits(p.preload);
  const auto loop = with({});
  const double speed = preload_speed(p);
  const auto& b = touchdown_of(p, bearing);

  PreloadCourse end = follow_preload(*loop, p.preload, fmt::format("/{}/running/", bearing));
  auto points = find_operating_points(*loop, limits);
  std::optional<std::size_t> settled;
  if (end.is_settled && end.limit == LimitMet::none) settled = add_settled(*loop, {end.y.data(), loop->size()}, points);

  Json j;
  j["verdict"] = verdict_of(end, points, settled);
  j["speed"] = speed;
  j["model"] = p.preload.model;
  j["force"] = p.preload.force;
  j["moment"] = p.preload.moment;
  j["mounted_preload"] = b.preload;
  j["cold"] = state_json(loop->state(loop->cold()));
  j["limits"] = {{"temperature", limits.temperature}, {"pressure", limits.pressure}};
  j["end"] = ending_json(*loop, end);
  j["end"]["operating_point"] = settled ? Json(*settled) : Json(nullptr);
  j["operating_points"] = Json::array();
  for (const auto& point : points.points) j["operating_points"].push_back(point_json(*loop, point));
  j["search"] = {{"largest_heat", points.heat.back()},
                 {"ended_by", name_of(points.ended_by)},
                 {"without_steady_state", points.n_without_state}};

  Json critical = Json::object();
  std::optional<CriticalFactor> critical_speed;
  if (speed > 0. && p.preload.critical_values) {
    critical_speed = find_critical_factor([&](double f) { return with({.speed = f}); }, 2., limits);
    critical["speed"] = critical_json(critical_speed, speed);
    critical["preload"] =
        b.preload > 0.
            ? critical_json(find_critical_factor([&](double f) { return with({.preload = f}); }, 2., limits), b.preload)
            : Json(nullptr);
    critical["cooling"] =
        section ? Json(nullptr)
                : critical_json(find_critical_factor([&](double f) { return with({.cooling = f}); }, 0.5, limits), 1.);
  }
  j["critical"] = std::move(critical);
  // Even interference all round is no radial resultant: the load law does not see it.
  j["load_law_sees_preload"] = b.contact_angle != 0.;

  tables.push_back(std::move(end.table));
  PreloadTable search;
  const std::string prefix = fmt::format("/{}/balance/", bearing);
  search.group = {
      prefix + "heat",
      {{prefix + "made", "W", "heat of friction in the steady state that the heat on the axis makes", 1, {}}},
      "W",
      "steady heat into the bearing"};
  search.axis = points.heat;
  for (const double made : points.made) search.rows.push_back({made});
  tables.push_back(std::move(search));
  if (speed > 0. && p.preload.critical_values) tables.push_back(points_over_speed(c, bearing, with, critical_speed));
  return j;
}

}  // namespace rotordrop
