#include "thermal/bearing_elastic.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace rotordrop {
namespace {

constexpr AxialRadial along = {1., 0.}, outwards = {0., 1.};

/// Radial displacement of a ring's raceway, one output for every strip or for a plain side; axial ones of the strips, or of the end faces where
/// fewer than two strips would say nothing of a width.
void add_ring(ElasticProblem& p, const std::string& ring, std::size_t body, const std::vector<HeatBoundary>& strips) {
  for (const auto& strip : strips) p.outputs.push_back({ring + " race", {strip}, outwards});
  const std::vector<HeatBoundary> faces = {{body, HeatSide::left}, {body, HeatSide::right}};
  for (const auto& place : strips.size() < 2 ? faces : strips) p.outputs.push_back({ring + " width", {place}, along});
}

double weighted(const std::vector<double>& weights, std::span<const double> T, double zero) {
  double sum = 0.;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * (T[i] - zero);
  return sum;
}

}  // namespace

std::vector<Observable> housing_fit_observables(const std::string& path) {
  return {{path + "housing_fit_pressure",
           "Pa",
           "pressure of the outer ring's fit in its housing: mean, and lowest of a node",
           2,
           {"mean", "lowest"}},
          {path + "housing_fit_open", "1", "part of that fit's area that is open, or would have to pull", 1, {}}};
}

ElasticProblem bearing_elastic_problem(const HeatConductionProblem& heat, const SectionMesh& mesh,
                                       const BearingElasticData& d) {
  ElasticProblem p;
  p.mesh = mesh;
  p.numerics = heat.numerics;
  p.reference_temperature = heat.initial_temperature;
  for (const auto& body : heat.bodies)
    p.bodies.push_back({body.name, body.x, body.r, d.density, d.E, d.nu, PropertyTable(d.expansion),
                        body.name == "inner_ring" ? 1. : 0.});
  const std::size_t inner = body_index(heat.bodies, "inner_ring"), outer = body_index(heat.bodies, "outer_ring"),
                    housing = body_index(heat.bodies, "housing"), shaft = body_index(heat.bodies, "shaft");
  p.fits = {{"outer ring in housing",
             {outer, HeatSide::outer},
             {housing, HeatSide::inner},
             d.housing_interference,
             d.housing_fit}};
  p.outputs = {{"bore", {{inner, HeatSide::inner}}}};
  add_ring(p, "inner", inner, heat.ports.at(inner_raceway_port).boundaries);
  add_ring(p, "outer", outer, heat.ports.at(outer_raceway_port).boundaries);
  if (shaft < heat.bodies.size()) p.outputs.push_back({"shaft", {{shaft, HeatSide::outer}}});
  return p;
}

ElasticGrowth::ElasticGrowth(ElasticSolver& elastic, const ElasticProblem& problem, const HeatConductionProblem& heat,
                             const GrowthPerRise& formula, const RaceSurfaces& races, std::size_t n_unknowns)
    : elastic_(elastic), zero_(heat.initial_temperature) {
  for (auto& weights : weights_) weights.assign(n_unknowns, 0.);
  std::vector<ElasticInfluence> influences;
  std::vector<double> position;  // of each output's mean along its direction; of axial ones but for a common shift
  for (std::size_t k = 0; k < problem.outputs.size(); ++k) {
    influences.push_back(elastic.influence(k));
    const auto& weights = influences.back().weights;
    const double alpha = problem.bodies.at(problem.outputs[k].boundaries.front().body).expansion.value(zero_);
    position.push_back(alpha > 0. ? std::accumulate(weights.begin(), weights.end(), 0.) / alpha : 0.);
    const auto found = std::find(growth_surface_names.begin(), growth_surface_names.end(), problem.outputs[k].name);
    if (found == growth_surface_names.end())
      throw std::invalid_argument("no surface grows by the name of " + problem.outputs[k].name);
    sums_.at(static_cast<std::size_t>(found - growth_surface_names.begin())).terms.push_back({k, 1.});
  }
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) {
    auto& terms = sums_[s].terms;
    const auto n = static_cast<double>(terms.size());
    const auto surface = growth_surfaces[s];
    if (surface == &Expansion::inner_width || surface == &Expansion::outer_width) {
      double middle = 0., square = 0.;
      for (const auto& term : terms) middle += position[term.output] / n;
      for (const auto& term : terms) square += (position[term.output] - middle) * (position[term.output] - middle);
      for (auto& term : terms) term.factor = square > 0. ? races.width * (position[term.output] - middle) / square : 0.;
    } else {
      const double radius = surface == &Expansion::inner_race   ? races.inner
                            : surface == &Expansion::outer_race ? races.outer
                                                                : 0.;
      for (auto& term : terms) {
        const double there = position[term.output];
        term.factor = (radius > 0. && there > 0. ? radius / there : 1.) / n;
      }
    }
    for (const auto& [k, factor] : terms) {
      const ElasticInfluence& g = influences[k];
      sums_[s].at_rest += factor * g.at_rest;
      per_speed_squared_.*surface += factor * g.per_speed_squared;
      for (std::size_t i = 0; i < g.weights.size(); ++i) weights_[s][i] += factor * g.weights[i];
    }
  }
  // Nodes of the heat problem stand after the mesh's unknowns.
  const auto lump = [&](std::size_t surface, std::size_t node, double growth) {
    weights_[surface].at(elastic.n_nodes() + node) = growth;
  };
  lump(4, 0, formula.ball);
  if (sums_[0].terms.empty()) lump(0, 1, formula.shaft);

  housing_fit_.node = elastic.node_pressure_influences(0);
  housing_fit_.mean = elastic.pressure_influence(0);
  for (auto& node : housing_fit_.node) node.weights.resize(n_unknowns, 0.);
  housing_fit_.mean.weights.resize(n_unknowns, 0.);
  housing_fit_.share = elastic.node_shares(0);
}

Expansion ElasticGrowth::linear(std::span<const double> T) const {
  Expansion growth;
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) growth.*growth_surfaces[s] = weighted(weights_[s], T, zero_);
  return growth;
}

Expansion ElasticGrowth::solved(std::span<const double> T) {
  elastic_.solve(T, 0.);
  Expansion growth;
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) {
    if (sums_[s].terms.empty()) {
      growth.*growth_surfaces[s] = weighted(weights_[s], T, zero_);
      continue;
    }
    double sum = 0.;
    for (const auto& [k, factor] : sums_[s].terms) sum += factor * elastic_.output(k);
    growth.*growth_surfaces[s] = sum - sums_[s].at_rest;
  }
  return growth;
}

}  // namespace rotordrop
