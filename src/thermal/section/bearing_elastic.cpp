#include "thermal/section/bearing_elastic.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

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

std::vector<Observable> housing_fit_observables(const std::string& path, const std::string& bearing) {
  return {{path + "housing_fit_pressure",
           "Pa",
           "pressure of the outer ring's fit in its housing: mean, and lowest of a node",
           2,
           {"mean", "lowest"}},
          {path + "housing_fit_open",
           "1",
           "part of that fit's area that is open, or would have to pull",
           1,
           {},
           Observed::housing_fit_open,
           bearing}};
}

Observable row_growth_observable(const std::string& path, std::size_t n_rows) {
  Observable o{path + "row_growth",
               "m",
               "what each row's inner contact points move more than the outer ones by heat, by elasticity",
               2 * n_rows,
               {}};
  for (std::size_t row = 1; row <= n_rows; ++row)
    for (const char* way : {"radial", "axial"}) o.columns.push_back("row " + std::to_string(row) + " " + way);
  return o;
}

ElasticProblem bearing_elastic_problem(const HeatConductionProblem& heat, const SectionMesh& mesh,
                                       const BearingElasticData& d) {
  ElasticProblem p;
  p.mesh = mesh;
  p.numerics = heat.numerics;
  p.reference_temperature = heat.initial_temperature;
  for (const auto& body : heat.bodies) {
    const auto& m = body.name.starts_with("shaft") ? d.shaft : d.ring;
    p.bodies.push_back({body.name, body.x, body.r, m.density, m.E, m.nu, PropertyTable(m.expansion),
                        body.name == "inner_ring" ? 1. : 0.});
  }
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
    : elastic_(elastic), zero_(heat.initial_temperature), width_(races.width) {
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
    if (surface == &Expansion::row_difference) {
      terms = row_difference_terms();
    } else if (surface == &Expansion::inner_width || surface == &Expansion::outer_width) {
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
  const auto keep = [&](std::size_t race, std::size_t width, Strips& strips) {
    for (const auto& [k, factor] : sums_[race].terms) {
      strips.radial.push_back(influences[k].weights);
      for (double& w : strips.radial.back()) w *= factor * static_cast<double>(sums_[race].terms.size());
    }
    for (const auto& term : sums_[width].terms) strips.axial.push_back(influences[term.output].weights);
    strips.width = weights_[width];
  };
  keep(2, 5, strips_[0]);
  keep(3, 6, strips_[1]);
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

// Of the raceways' strips, last less first; their factors give means over the rows.
std::vector<ElasticGrowth::Sum::Term> ElasticGrowth::row_difference_terms() const {
  std::vector<Sum::Term> difference;
  for (const auto& [race, sign] : {std::pair{2, 1.}, std::pair{3, -1.}}) {
    const auto& strips = sums_.at(static_cast<std::size_t>(race)).terms;
    if (strips.size() < 2) return {};
    const auto n = static_cast<double>(strips.size());
    difference.push_back({strips.back().output, sign * n * strips.back().factor});
    difference.push_back({strips.front().output, -sign * n * strips.front().factor});
  }
  return difference;
}

Expansion ElasticGrowth::linear(std::span<const double> T) const {
  Expansion growth;
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) growth.*growth_surfaces[s] = weighted(weights_[s], T, zero_);
  return growth;
}

std::vector<ElasticGrowth::RowWeights> ElasticGrowth::row_weights(std::span<const RowStrips> places) const {
  const std::size_t n = places.size();
  for (const auto& ring : strips_)
    if (ring.radial.size() != n || (n > 1 && ring.axial.size() != n)) return {};
  std::vector<RowWeights> rows(n);
  for (std::size_t ring = 0; ring < strips_.size(); ++ring) {
    const Strips& strips = strips_.at(ring);
    const double sign = ring == 0 ? 1. : -1.;
    const auto position = [&](std::size_t row) { return ring == 0 ? places[row].inner : places[row].outer; };
    double middle = 0.;
    for (std::size_t row = 0; row < n; ++row) middle += position(row) / static_cast<double>(n);
    for (std::size_t row = 0; row < n; ++row) {
      auto& [radial, axial] = rows[row];
      radial.resize(strips.width.size());
      axial.resize(strips.width.size());
      const auto add = [sign](std::vector<double>& to, double factor, const std::vector<double>& weights) {
        for (std::size_t i = 0; i < weights.size(); ++i) to[i] += sign * factor * weights[i];
      };
      add(radial, 1., strips.radial[row]);
      // The strips' mean stands where the width's growth has it.
      add(axial, (n > 1 ? middle : position(row)) / width_, strips.width);
      if (n < 2) continue;
      add(axial, 1., strips.axial[row]);
      for (const auto& other : strips.axial) add(axial, -1. / static_cast<double>(n), other);
    }
  }
  return rows;
}

void ElasticGrowth::find_openings() {
  has_asked_ = true;
  const FitOpenings openings = elastic_.openings(0);
  if (openings.share.empty() || openings.share.size() != housing_fit_.node.size()) return;
  opening_.emplace(openings);
  pressures_.resize(openings.share.size());
  sizes_.resize(openings.share.size());
  for (const ElasticInfluence& node : housing_fit_.node) {
    double sum = 0.;
    for (const double weight : node.weights) sum += std::fabs(weight);
    per_rise_.push_back(sum);
  }
}

Expansion ElasticGrowth::solved(std::span<const double> T) {
  if (!has_asked_) find_openings();
  if (opening_) {
    double largest_rise = 0.;
    for (const double one : T) largest_rise = std::max(largest_rise, std::fabs(one - zero_));
    for (std::size_t i = 0; i < pressures_.size(); ++i) {
      const ElasticInfluence& node = housing_fit_.node[i];
      pressures_[i] = node.at_rest + weighted(node.weights, T, zero_);
      sizes_[i] = std::fabs(node.at_rest) + per_rise_[i] * largest_rise;
    }
    opening_->solve(pressures_, sizes_);
  } else {
    elastic_.solve(T, 0.);
  }
  Expansion growth;
  for (std::size_t s = 0; s < growth_surfaces.size(); ++s) {
    const bool is_linear = sums_[s].terms.empty();  // a lump
    double sum = is_linear || opening_ ? weighted(weights_[s], T, zero_) : -sums_[s].at_rest;
    for (const auto& [k, factor] : sums_[s].terms) sum += factor * (opening_ ? opening_->added(k) : elastic_.output(k));
    growth.*growth_surfaces[s] = sum;
  }
  return growth;
}

}  // namespace rotordrop
