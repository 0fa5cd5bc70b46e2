#include "study/drop/fe_summary.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Mean, lowest and highest temperature of a surface over time: its largest local rise, and the end.
FeSummary::Surface surface_scalars(const std::string& name, const std::vector<double>& v,
                                   const std::vector<double>& times, double zero) {
  const std::size_t n = std::min(v.size() / 3, times.size());
  if (n == 0) return {.name = name};
  std::size_t hottest = 0;
  double highest_mean = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    if (v[3 * i + 2] > v[3 * hottest + 2]) hottest = i;
    highest_mean = std::max(highest_mean, v[3 * i]);
  }
  return {name, true, v[3 * (n - 1)] - zero, highest_mean - zero, v[3 * hottest + 2] - zero, times[hottest]};
}

void add_fit_scalars(const std::string& name, const std::vector<double>& v, FeSummary::HousingFit& to) {
  if (name == "housing_fit_open") {
    to.largest_open = *std::max_element(v.begin(), v.end());
    return;
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < v.size(); i += 2) lowest = std::min(lowest, v[i]);
  to.mean_pressure_end = v[v.size() - 2];
  to.lowest_pressure = lowest;
}

Json surface_json(const FeSummary::Surface& s) {
  if (!s.has_rows) return nullptr;
  return {{"mean_end", s.mean_end},
          {"highest_mean", s.highest_mean},
          {"highest", s.highest},
          {"highest_time", s.highest_time}};
}

Json range_json(const SurfaceRange& range) {
  return {{"mean", range.mean}, {"lowest", range.lowest}, {"highest", range.highest}};
}

/// Mean displacement of every strip of a raceway.
std::vector<AxialRadial> displacements(const ElasticSolver& solver, const HeatPort& raceway) {
  std::vector<AxialRadial> u;
  for (const auto& strip : raceway.boundaries) u.push_back(solver.mean_displacement({strip}));
  return u;
}

}  // namespace

ElasticState elastic_state(const FiniteElements::Section& s, std::span<const double> temperatures, double speed) {
  ElasticSolver& solver = *s.elastic_solver;
  const auto& ports = s.problem.ports;
  const auto growth_from = [&](const HeatPort& raceway, const std::vector<AxialRadial>& before) {
    auto growth = displacements(solver, raceway);
    for (std::size_t row = 0; row < growth.size(); ++row)
      for (std::size_t k = 0; k < 2; ++k) growth[row][k] -= before[row][k];
    return growth;
  };
  solver.solve({}, 0.);  // joined, cold and standing: growth counts from there
  const auto inner_before = displacements(solver, ports.at(inner_raceway_port)),
             outer_before = displacements(solver, ports.at(outer_raceway_port));
  solver.solve(temperatures, speed);
  const auto stress = [&](const char* body, HeatSide side) {
    return solver.hoop_stress({body_index(s.problem.bodies, body), side});
  };
  ElasticState state;
  state.ring_speed = speed;
  state.inner_ring_bore = stress("inner_ring", HeatSide::inner);
  state.outer_ring_outside = stress("outer_ring", HeatSide::outer);
  state.housing_bore = stress("housing", HeatSide::inner);
  state.inner_raceway_growth = growth_from(ports.at(inner_raceway_port), inner_before);
  state.outer_raceway_growth = growth_from(ports.at(outer_raceway_port), outer_before);
  state.fit = solver.fit(0);
  return state;
}

Json elastic_state_json(const ElasticState& state) {
  Json j;
  j["ring_speed"] = state.ring_speed;
  j["hoop_stress"] = {{"inner_ring_bore", range_json(state.inner_ring_bore)},
                      {"outer_ring_outside", range_json(state.outer_ring_outside)},
                      {"housing_bore", range_json(state.housing_bore)}};
  for (const auto& [raceway, growth] :
       {std::pair{"inner", &state.inner_raceway_growth}, std::pair{"outer", &state.outer_raceway_growth}})
    for (const auto& strip : *growth)
      j["raceway_growth"][raceway].push_back({{"axial", strip[0]}, {"radial", strip[1]}});
  j["fit_pressure"] = {{"mean", state.fit.mean_pressure},
                       {"lowest", state.fit.lowest_pressure},
                       {"highest", state.fit.highest_pressure},
                       {"open", state.fit.open_fraction}};
  return j;
}

const FeSummary::Surface* FeSummary::surface(const std::string& surface_name) const {
  for (const auto& s : surfaces)
    if (s.name == surface_name) return &s;
  return nullptr;
}

FeSummary fe_summary(const FiniteElements::Section& s, const ThermalKind& kind, FeCoupling coupling,
                     const RecordedDrop& drop) {
  const std::string prefix = drop.node_path(kind, s.name, "");
  const double zero = s.problem.initial_temperature;
  FeSummary fe;
  fe.coupling = coupling;
  fe.unknowns = s.solver->statistics().unknowns;
  fe.cells = s.solver->statistics().cells;
  if (coupling != FeCoupling::windowed) {
    auto& reduction = *(fe.reduction = FeSummary::Reduction{});
    reduction.modes = s.reduced.n_modes();
    for (const auto& port : s.reduced.ports) reduction.port_errors.emplace_back(port.name, port.response_error);
    for (const auto* outputs : {&s.reduced.bodies, &s.reduced.nodes})
      for (const auto& output : *outputs) reduction.mean_errors.emplace_back(output.name, output.response_error);
    reduction.largest_error = s.reduced.response_error;
    reduction.worst = s.reduced.worst_response;
  }
  fe.inner_capacity = s.adiabatic.inner_capacity;
  fe.outer_capacity = s.adiabatic.outer_capacity;
  for (const auto& path : drop.datasets()) {
    if (!path.starts_with(prefix)) continue;
    const std::string name = path.substr(prefix.size());
    const auto& series = drop.table(path);
    if (series.values.empty() || name.ends_with("growth")) continue;
    if (name.starts_with("housing_fit")) {
      if (!fe.housing_fit) fe.housing_fit.emplace();
      add_fit_scalars(name, series.values, *fe.housing_fit);
    } else if (series.n_columns == 1) {
      fe.rises.emplace_back(name, series.values.back() - zero);
    } else {
      fe.surfaces.push_back(surface_scalars(name, series.values, drop.table(series.meaning.time_path).values, zero));
    }
  }
  return fe;
}

Json fe_json(const FeSummary& fe) {
  Json j;
  j["coupling"] = fe.coupling == FeCoupling::reduced    ? "reduced"
                  : fe.coupling == FeCoupling::windowed ? "windowed"
                                                        : "monolithic";
  j["unknowns"] = fe.unknowns;
  j["cells"] = fe.cells;
  if (const auto& r = fe.reduction) {
    j["modes"] = r->modes;
    for (const auto& [port, error] : r->port_errors) j["response_error"][port] = error;
    for (const auto& [mean, error] : r->mean_errors) j["mean_response_error"][mean] = error;
    j["largest_response_error"] = r->largest_error;
    j["worst_response"] = r->worst;
  }
  j["heat_capacity"] = {{"inner_ring", fe.inner_capacity}, {"outer_ring_and_housing", fe.outer_capacity}};
  j["temperature_rise_end"] = Json::object();
  j["surface_rise"] = Json::object();
  for (const auto& [name, rise] : fe.rises) j["temperature_rise_end"][name] = rise;
  for (const auto& surface : fe.surfaces) j["surface_rise"][surface.name] = surface_json(surface);
  if (const auto& fit = fe.housing_fit) {
    Json& to = j["housing_fit"];
    if (fit->largest_open) to["largest_open"] = *fit->largest_open;
    if (fit->mean_pressure_end) to["mean_pressure_end"] = *fit->mean_pressure_end;
    if (fit->lowest_pressure) to["lowest_pressure"] = *fit->lowest_pressure;
  }
  if (fe.elastic_end) j["elastic_end"] = elastic_state_json(*fe.elastic_end);
  return j;
}

Json windows_json(const WindowedSections::Report& r, const HeatEnergy& energy) {
  return {{"count", r.windows},
          {"shortest", r.shortest},
          {"longest", r.longest},
          {"mean", r.mean},
          {"tolerance", r.tolerance},
          {"beyond_tolerance", r.beyond_tolerance},
          {"largest_growth_error", r.largest_error},
          {"largest_growth_error_time", r.largest_error_time},
          {"largest_growth", r.largest_growth},
          {"cpu_time", r.cpu_time},
          {"heat_input", energy.input},
          {"heat_stored", energy.stored},
          {"heat_lost", energy.lost},
          {"heat_residual", energy.residual()}};
}

}  // namespace rotordrop
