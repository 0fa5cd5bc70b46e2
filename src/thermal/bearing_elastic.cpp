#include "thermal/bearing_elastic.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace rotordrop {
namespace {

/// One output for every row, or for a plain side.
void add_race(ElasticProblem& p, const std::string& name, const std::vector<HeatBoundary>& strips,
              const std::vector<double>& axial_share) {
  for (const auto& strip : strips) {
    const auto row = static_cast<std::size_t>(strip.row);
    const bool leans = strip.side == HeatSide::strip && row < axial_share.size();
    p.outputs.push_back({name, {strip}, {leans ? axial_share[row] : 0., 1.}});
  }
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
  add_race(p, "inner race", heat.ports.at(inner_raceway_port).boundaries, d.axial_share);
  add_race(p, "outer race", heat.ports.at(outer_raceway_port).boundaries, d.axial_share);
  if (shaft < heat.bodies.size()) p.outputs.push_back({"shaft", {{shaft, HeatSide::outer}}});
  return p;
}

ElasticGrowth::ElasticGrowth(ElasticSolver& elastic, const ElasticProblem& problem, const HeatConductionProblem& heat,
                             const SectionGrowth& formula, std::size_t n_unknowns)
    : elastic_(elastic), zero_(heat.initial_temperature) {
  for (auto& weights : weights_) weights.assign(n_unknowns, 0.);
  for (std::size_t k = 0; k < problem.outputs.size(); ++k) {
    const auto found = std::find(growth_surface_names.begin(), growth_surface_names.end(), problem.outputs[k].name);
    if (found == growth_surface_names.end())
      throw std::invalid_argument("no surface grows by the name of " + problem.outputs[k].name);
    means_.at(static_cast<std::size_t>(found - growth_surface_names.begin())).outputs.push_back(k);
  }
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) {
    const auto n = static_cast<double>(means_[s].outputs.size());
    for (const std::size_t k : means_[s].outputs) {
      const ElasticInfluence g = elastic.influence(k);
      means_[s].at_rest += g.at_rest / n;
      per_speed_squared_.*growth_surfaces[s] += g.per_speed_squared / n;
      for (std::size_t i = 0; i < g.weights.size(); ++i) weights_[s][i] += g.weights[i] / n;
    }
  }
  // Nodes of the heat problem stand after the mesh's unknowns.
  const auto lump = [&](std::size_t surface, std::size_t node, double growth) {
    weights_[surface].at(elastic.n_nodes() + node) = growth;
  };
  lump(4, 0, formula.ball);
  if (means_[0].outputs.empty()) lump(0, 1, formula.shaft);

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
    if (means_[s].outputs.empty()) {
      growth.*growth_surfaces[s] = weighted(weights_[s], T, zero_);
      continue;
    }
    double sum = 0.;
    for (const std::size_t k : means_[s].outputs) sum += elastic_.output(k);
    growth.*growth_surfaces[s] = sum / static_cast<double>(means_[s].outputs.size()) - means_[s].at_rest;
  }
  return growth;
}

}  // namespace rotordrop
