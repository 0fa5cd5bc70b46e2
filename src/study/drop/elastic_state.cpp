#include "study/drop/elastic_state.h"

#include <nlohmann/json.hpp>

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

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

Json elastic_state(const FiniteElements::Section& s, std::span<const double> temperatures, double speed) {
  ElasticSolver& solver = *s.elastic_solver;
  const auto& ports = s.problem.ports;
  const std::array raceways{std::pair{"inner", &ports.at(inner_raceway_port)},
                            std::pair{"outer", &ports.at(outer_raceway_port)}};
  Json j;
  solver.solve({}, 0.);  // joined, cold and standing: growth counts from there
  std::array<std::vector<AxialRadial>, 2> before;
  for (std::size_t k = 0; k < raceways.size(); ++k) before[k] = displacements(solver, *raceways[k].second);
  solver.solve(temperatures, speed);
  j["ring_speed"] = speed;
  const std::size_t inner = body_index(s.problem.bodies, "inner_ring"),
                    outer = body_index(s.problem.bodies, "outer_ring"),
                    housing = body_index(s.problem.bodies, "housing");
  j["hoop_stress"] = {{"inner_ring_bore", range_json(solver.hoop_stress({inner, HeatSide::inner}))},
                      {"outer_ring_outside", range_json(solver.hoop_stress({outer, HeatSide::outer}))},
                      {"housing_bore", range_json(solver.hoop_stress({housing, HeatSide::inner}))}};
  for (std::size_t k = 0; k < raceways.size(); ++k) {
    const auto after = displacements(solver, *raceways[k].second);
    for (std::size_t row = 0; row < after.size(); ++row)
      j["raceway_growth"][raceways[k].first].push_back(
          {{"axial", after[row][0] - before[k][row][0]}, {"radial", after[row][1] - before[k][row][1]}});
  }
  const FitState fit = solver.fit(0);
  j["fit_pressure"] = {{"mean", fit.mean_pressure},
                       {"lowest", fit.lowest_pressure},
                       {"highest", fit.highest_pressure},
                       {"open", fit.open_fraction}};
  return j;
}

}  // namespace rotordrop
