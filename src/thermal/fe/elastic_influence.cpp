#include "thermal/fe/elastic_solver.h"

// How the outputs and pressures of an elastic section depend on temperatures, by adjoints.
namespace rotordrop {

// With p . (K u - f) for the presses and u = C v + d:  J = j . u + p . (K u - f) = e . u - p . f,  e = j + K p;
// with K_joined z = C^T e and c = C z:  J = (c - p) . f + d . (e - K c).
ElasticInfluence ElasticStatics::adjoint(const Vector& j, const std::vector<std::pair<std::size_t, double>>& q) const {
  const auto& K = operator_.stiffness();
  Vector p(operator_.size()), e = j, product(operator_.size()), known(operator_.size());
  centre_functional(e);
  for (const auto& [k, factor] : q) {
    const auto& pair = pairs_[k];
    if (is_held_[pair.first])
      p(pair.second) += factor * pair.sign;
    else
      p(pair.first) -= factor * pair.sign;
  }
  K.vmult(product, p);
  e += product;
  Vector w = solve_joined(e);
  K.vmult(product, w);
  product.sadd(-1., e);
  for (unsigned int i = 0; i < known.size(); ++i) known(i) = links_[i].offset;
  w -= p;
  return {w * operator_.external_load() + known * product, w * operator_.centrifugal_load(),
          operator_.transposed_thermal_load(w)};
}

ElasticInfluence ElasticStatics::influence(std::size_t output) const { return adjoint(outputs_.at(output), {}); }

ElasticInfluence ElasticStatics::pressure_influence(std::size_t k) const {
  std::vector<std::pair<std::size_t, double>> q;
  for (const std::size_t pair : fits_.at(k).pairs)
    if (pairs_[pair].is_closed) q.emplace_back(pair, 1. / fits_[k].area);
  return adjoint(Vector(operator_.size()), q);
}

std::vector<ElasticInfluence> ElasticStatics::node_pressure_influences(std::size_t k) const {
  const Fit& fit = fits_.at(k);
  std::vector<ElasticInfluence> list;
  for (std::size_t i = 0; i < fit.nodes.size(); ++i)
    if (pairs_[fit.pairs[i]].is_closed)
      list.push_back(adjoint(Vector(operator_.size()), {{fit.pairs[i], 1. / fit.share(fit.nodes[i])}}));
  return list;
}

// With a gap g of a pair, u = C v + d + g E; E moves the second side alone, and the first follows by C v = -K_joined^-1 C^T K E g.
FitOpenings ElasticStatics::openings(std::size_t k) const {
  const Fit& fit = fits_.at(k);
  for (const std::size_t at : fit.pairs) {
    const Pair& pair = pairs_[at];
    const bool is_axial = pair.first % 2 == 0;  // then a body may come free
    if (!pair.is_closed || is_axial || is_held_[pair.first] || is_held_[pair.second] ||
        operator_.problem().fits[k].kind == FitKind::bonded)
      return {};
  }
  const std::size_t n = fit.nodes.size();
  const std::vector<double> none(n, 0.);
  FitOpenings found{{n, none}, {outputs_.size(), none}, {n, none}, {}};
  Vector u(operator_.size()), forces(operator_.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Pair& opened = pairs_[fit.pairs[i]];
    u = 0.;
    u(opened.second) = opened.sign;
    operator_.stiffness().vmult(forces, u);
    forces *= -1.;
    u += solve_joined(forces);
    operator_.stiffness().vmult(forces, u);
    centre(u);
    for (std::size_t j = 0; j < n; ++j) found.force[j][i] = press(pairs_[fit.pairs[j]], forces);
    for (std::size_t o = 0; o < outputs_.size(); ++o) found.output[o][i] = outputs_[o] * u;
    found.share.push_back(fit.share(fit.nodes[i]));
  }
  std::vector<std::size_t> place(operator_.n_nodes(), n);
  for (std::size_t i = 0; i < n; ++i) place[fit.nodes[i]] = i;
  for (const auto& entry : operator_.face_mass(fit.faces))
    if (place[entry.i] < n && place[entry.j] < n) found.mass[place[entry.i]][place[entry.j]] += entry.value;
  return found;
}

std::vector<double> ElasticStatics::node_shares(std::size_t k) const {
  const Fit& fit = fits_.at(k);
  std::vector<double> shares;
  for (std::size_t i = 0; i < fit.nodes.size(); ++i)
    if (pairs_[fit.pairs[i]].is_closed) shares.push_back(fit.share(fit.nodes[i]) / fit.area);
  return shares;
}

}  // namespace rotordrop
