#include "thermal/fe/elastic_solver.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "thermal/fe/solvers/cholesky_solver.h"

namespace rotordrop {
namespace {

constexpr int most_iterations = 60, patient_iterations = 15;
// Of forces at a node and of displacements, as parts of what adds up there: roundoff.
constexpr double force_roundoff = 1e-11, gap_roundoff = 1e-11;

/// The unknowns' direction along the outward normal of a side, and its sign.
struct Normal {
  unsigned int part = 0;
  double sign = 1.;
};
Normal normal_of(const ElasticFit& fit) {
  switch (fit.first.side) {
    case HeatSide::left:
      return {0, -1.};
    case HeatSide::right:
      return {0, 1.};
    case HeatSide::inner:
      return {1, -1.};
    case HeatSide::outer:
      return {1, 1.};
    case HeatSide::raceway:
    case HeatSide::strip:
      break;
  }
  throw SolverError("the fit \"" + fit.name + "\" is on a raceway: fits are on cylinders and end faces.");
}

}  // namespace

ElasticStatics::ElasticStatics(const ElasticProblem& problem) : operator_(problem) {
  find_held();
  find_pairs();
  for (const auto& output : problem.outputs) {
    const Vector mean = operator_.mean_weights(output.boundaries);
    Vector j(operator_.size());
    for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
      for (unsigned int c = 0; c < 2; ++c) j(2 * i + c) = output.direction[c] * mean(i);
    outputs_.push_back(std::move(j));
  }
  for (auto* v : {&u_, &load_, &residual_}) v->reinit(operator_.size());
  solve({}, 0.);
}

void ElasticStatics::find_held() {
  is_held_.assign(operator_.size(), false);
  held_at_.assign(operator_.size(), 0.);
  double extent = 0.;
  for (unsigned int i = 0; i < operator_.n_nodes(); ++i) extent = std::max(extent, operator_.node(i)[1]);
  for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
    if (operator_.node(i)[1] < 1e-12 * extent) is_held_[2 * i + 1] = true;  // the axis
  for (const auto& hold : operator_.problem().holds)
    for (const auto& face : operator_.mesh().faces_of(hold.boundary))
      for (const unsigned int i : operator_.nodes_of(face)) {
        const auto& p = operator_.node(i);
        const AxialRadial at =
            hold.displacement ? hold.displacement(hold.boundary.body, p[0], p[1]) : AxialRadial{0., 0.};
        const std::array<bool, 2> is_held = {hold.axial, hold.radial};
        for (unsigned int c = 0; c < 2; ++c)
          if (is_held[c]) {
            is_held_[2 * i + c] = true;
            held_at_[2 * i + c] = at[c];
          }
      }
}

void ElasticStatics::find_pairs() {
  const auto& problem = operator_.problem();
  std::vector<int> fit_of(operator_.size(), -1);
  for (std::size_t k = 0; k < problem.fits.size(); ++k) {
    const auto& fit = problem.fits[k];
    const Normal n = normal_of(fit);
    Fit made;
    std::vector<HeatMesh::Face> faces;
    for (const auto& [first, second] : operator_.mesh().pairs_of(fit.first, fit.second)) {
      made.faces.push_back(first);
      const double near = 1e-3 * first.cell->face(first.number)->measure();
      const auto others = operator_.nodes_of(second);
      for (const unsigned int a : operator_.nodes_of(first)) {
        if (std::find(made.nodes.begin(), made.nodes.end(), a) != made.nodes.end()) continue;
        const auto b = std::find_if(others.begin(), others.end(), [&](unsigned int j) {
          return operator_.node(a).distance(operator_.node(j)) < near;
        });
        if (b == others.end())
          throw SolverError("the meshes on the two sides of the fit \"" + fit.name + "\" do not meet node on node.");
        made.nodes.push_back(a);
        made.pairs.push_back(pairs_.size());
        pairs_.push_back({k, 2 * a + n.part, 2 * *b + n.part, n.sign, true, true});
        pairs_.back().is_closed = fit.kind == FitKind::bonded || fit.interference >= 0.;
        if (fit.kind == FitKind::bonded)
          pairs_.push_back({k, 2 * a + 1 - n.part, 2 * *b + 1 - n.part, n.sign, false, true});
      }
    }
    if (made.faces.empty())
      throw SolverError("the two sides of the fit \"" + fit.name + "\" do not lie on each other.");
    made.share = operator_.integral_over(made.faces);
    made.area = std::accumulate(made.share.begin(), made.share.end(), 0.);
    fits_.push_back(std::move(made));
  }
  for (const auto& pair : pairs_)
    for (const unsigned int i : {pair.first, pair.second}) {
      if (fit_of[i] >= 0)
        throw SolverError(fmt::format("three bodies meet in one point, in the fits \"{}\" and \"{}\".",
                                      problem.fits[static_cast<std::size_t>(fit_of[i])].name,
                                      problem.fits[pair.fit].name));
      fit_of[i] = static_cast<int>(pair.fit);
    }
}

std::vector<double> ElasticStatics::interpolate(const std::function<double(std::size_t, double, double)>& f) const {
  std::vector<double> values(operator_.n_nodes());
  for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
    values[i] = f(operator_.body_of_node(i), operator_.node(i)[0], operator_.node(i)[1]);
  return values;
}

// ------------------------------------------------------------------------------------------------------------------ joining

double ElasticStatics::offset_of(const Pair& pair) const {
  return pair.is_normal ? pair.sign * operator_.problem().fits[pair.fit].interference : 0.;
}

double ElasticStatics::gap(const Pair& pair) const {
  return pair.sign * (u_(pair.second) - u_(pair.first) - offset_of(pair));
}

// The residual is what the fit does to each side; a held side takes part of it itself.
double ElasticStatics::press(const Pair& pair, const Vector& residual) const {
  return is_held_[pair.first] ? pair.sign * residual(pair.second) : -pair.sign * residual(pair.first);
}

void ElasticStatics::join() {
  constexpr int unset = -2;
  links_.assign(operator_.size(), {unset, 0.});
  for (unsigned int i = 0; i < operator_.size(); ++i)
    if (is_held_[i]) links_[i] = {-1, held_at_[i]};

  // Bodies that no hold and no fit keeps from moving along the axis.
  const std::size_t n_bodies = operator_.problem().bodies.size();
  std::vector<std::size_t> group(n_bodies);
  std::iota(group.begin(), group.end(), std::size_t{0});
  std::vector<bool> is_fixed(n_bodies, false);
  for (unsigned int i = 0; i < operator_.size(); i += 2)
    if (is_held_[i]) is_fixed[operator_.body_of_node(i / 2)] = true;
  std::vector<int> partner(operator_.size(), -1);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto& pair = pairs_[k];
    if (!pair.is_closed) continue;
    partner[pair.second] = static_cast<int>(k);
    if (is_held_[pair.second] && !is_held_[pair.first])
      links_[pair.first] = {-1, held_at_[pair.second] - offset_of(pair)};
    if (pair.first % 2 != 0) continue;
    const std::size_t a = group[operator_.body_of_node(pair.first / 2)],
                      b = group[operator_.body_of_node(pair.second / 2)];
    std::replace(group.begin(), group.end(), b, a);
  }
  free_groups_.clear();
  for (std::size_t g = 0; g < n_bodies; ++g) {
    std::vector<std::size_t> members;
    bool is_free = true;
    for (std::size_t b = 0; b < n_bodies; ++b)
      if (group[b] == g) {
        members.push_back(b);
        is_free = is_free && !is_fixed[b];
      }
    if (members.empty() || !is_free) continue;
    // One node of it is pinned: nothing pulls at it. centre() takes the arbitrary displacement out again.
    for (unsigned int i = 0; i < operator_.size(); i += 2)
      if (operator_.body_of_node(i / 2) == members.front() && partner[i] < 0) {
        links_[i] = {-1, 0.};
        break;
      }
    free_groups_.push_back(std::move(members));
  }

  int n = 0;
  const auto number = [&](unsigned int i) {
    if (links_[i].reduced == unset) links_[i].reduced = n++;
  };
  for (unsigned int i = 0; i < operator_.size(); ++i) {
    if (partner[i] < 0) {
      number(i);
      continue;
    }
    const auto& pair = pairs_[static_cast<std::size_t>(partner[i])];
    if (is_held_[pair.second]) continue;
    number(pair.first);
    links_[i] = {links_[pair.first].reduced, links_[pair.first].offset + offset_of(pair)};
  }
  dealii::DynamicSparsityPattern pattern(static_cast<unsigned int>(n));
  const auto& K = operator_.stiffness();
  for (unsigned int i = 0; i < K.m(); ++i)
    for (auto entry = K.begin(i); entry != K.end(i); ++entry)
      if (const auto& link = links_[entry->column()]; links_[i].reduced >= 0 && link.reduced >= 0)
        pattern.add(static_cast<unsigned int>(links_[i].reduced), static_cast<unsigned int>(link.reduced));
  joined_.clear();
  pattern_.copy_from(pattern);
  joined_.reinit(pattern_);
  for (unsigned int i = 0; i < K.m(); ++i)
    for (auto entry = K.begin(i); entry != K.end(i); ++entry)
      if (const auto& link = links_[entry->column()]; links_[i].reduced >= 0 && link.reduced >= 0)
        joined_.add(static_cast<unsigned int>(links_[i].reduced), static_cast<unsigned int>(link.reduced),
                    entry->value());
  inverse_ = std::make_unique<CholeskySolver>();
  inverse_->set_matrix(joined_);
  is_joined_ = true;
}

ElasticStatics::Vector ElasticStatics::solve_joined(const Vector& load) const {
  const auto& K = operator_.stiffness();
  Vector v(joined_.m()), u(operator_.size()), left = load, Ku(operator_.size());
  for (int pass = 0; pass < 2; ++pass) {  // the second one refines
    v = 0.;
    for (unsigned int i = 0; i < left.size(); ++i)
      if (links_[i].reduced >= 0) v(static_cast<unsigned int>(links_[i].reduced)) += left(i);
    inverse_->solve(v);
    for (unsigned int i = 0; i < u.size(); ++i)
      if (links_[i].reduced >= 0) u(i) += v(static_cast<unsigned int>(links_[i].reduced));
    K.vmult(Ku, u);
    left = load;
    left -= Ku;
  }
  return u;
}

void ElasticStatics::centre(Vector& u) const {
  const auto& volume = operator_.volume_weights();
  for (const auto& group : free_groups_) {
    const auto belongs = [&](unsigned int i) {
      return std::find(group.begin(), group.end(), operator_.body_of_node(i)) != group.end();
    };
    double sum = 0., whole = 0.;
    for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
      if (belongs(i)) {
        sum += volume(i) * u(2 * i);
        whole += volume(i);
      }
    for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
      if (belongs(i)) u(2 * i) -= sum / whole;
  }
}

void ElasticStatics::centre_functional(Vector& j) const {
  const auto& volume = operator_.volume_weights();
  for (const auto& group : free_groups_) {
    const auto belongs = [&](unsigned int i) {
      return std::find(group.begin(), group.end(), operator_.body_of_node(i)) != group.end();
    };
    double sum = 0., whole = 0.;
    for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
      if (belongs(i)) {
        sum += j(2 * i);
        whole += volume(i);
      }
    for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
      if (belongs(i)) j(2 * i) -= volume(i) / whole * sum;
  }
}

// ------------------------------------------------------------------------------------------------------------------ solving

bool ElasticStatics::update_pairs(double force_slack) {
  const double gap_slack = std::max(gap_roundoff * u_.linfty_norm(), 1e-18);
  bool has_changed = false;
  for (auto& pair : pairs_) {
    if (operator_.problem().fits[pair.fit].kind == FitKind::bonded) continue;
    if (is_held_[pair.first] && is_held_[pair.second]) continue;
    const bool is_wrong = pair.is_closed ? press(pair, residual_) < -force_slack : gap(pair) < -gap_slack;
    if (!is_wrong) continue;
    pair.is_closed = !pair.is_closed;
    has_changed = true;
  }
  return has_changed;
}

void ElasticStatics::solve(std::span<const double> temperatures, double speed) {
  const auto& K = operator_.stiffness();
  T_.assign(temperatures.begin(),
            temperatures.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(temperatures.size()),
                                                            static_cast<std::ptrdiff_t>(operator_.n_nodes())));
  load_ = operator_.external_load();
  load_.add(speed * speed, operator_.centrifugal_load());
  if (!T_.empty()) load_ += operator_.thermal_load(T_);
  fits_changed_ = false;
  double slack_factor = 1.;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!is_joined_) join();
    Vector known(operator_.size()), left(operator_.size());
    for (unsigned int i = 0; i < known.size(); ++i) known(i) = links_[i].offset;
    K.vmult(left, known);
    left.sadd(-1., load_);
    u_ = solve_joined(left);
    u_ += known;
    K.vmult(residual_, u_);
    residual_ -= load_;
    double largest = 0.;
    for (unsigned int i = 0; i < K.m(); ++i) {
      double sum = std::fabs(load_(i));
      for (auto entry = K.begin(i); entry != K.end(i); ++entry) sum += std::fabs(entry->value() * u_(entry->column()));
      largest = std::max(largest, sum);
    }
    // A node on the verge may go to and fro for roundoff's sake: patience ends.
    if (iteration > patient_iterations) slack_factor *= 2.;
    if (!update_pairs(slack_factor * force_roundoff * largest)) {
      centre(u_);
      return;
    }
    fits_changed_ = true;
    is_joined_ = false;
  }
  throw SolverError("no state of the fits is found in which none pulls and none overlaps.");
}

AxialRadial ElasticStatics::mean_displacement(const std::vector<HeatBoundary>& boundaries) const {
  const Vector mean = operator_.mean_weights(boundaries);
  AxialRadial sum = {0., 0.};
  for (unsigned int i = 0; i < operator_.n_nodes(); ++i)
    for (unsigned int c = 0; c < 2; ++c) sum[c] += mean(i) * u_(2 * i + c);
  return sum;
}

FitState ElasticStatics::fit(std::size_t k) const {
  const Fit& fit = fits_.at(k);
  FitState state;
  state.area = fit.area;
  std::vector<Eigen::Index> row(operator_.n_nodes(), -1);
  std::vector<double> force;
  for (std::size_t i = 0; i < fit.nodes.size(); ++i) {
    const auto& pair = pairs_[fit.pairs[i]];
    const auto& p = operator_.node(fit.nodes[i]);
    state.points.push_back({p[0], p[1], 0., pair.is_closed ? 0. : gap(pair), pair.is_closed});
    if (!pair.is_closed) {
      state.open_fraction += fit.share(fit.nodes[i]) / fit.area;
      continue;
    }
    row[fit.nodes[i]] = static_cast<Eigen::Index>(force.size());
    force.push_back(press(pair, residual_));
    state.mean_pressure += force.back() / fit.area;
  }
  if (force.empty()) return state;
  const auto n = static_cast<Eigen::Index>(force.size());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  for (const auto& entry : operator_.face_mass(fit.faces))
    if (row[entry.i] >= 0 && row[entry.j] >= 0) mass(row[entry.i], row[entry.j]) += entry.value;
  const Eigen::VectorXd pressure = mass.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(force.data(), n));
  for (std::size_t i = 0; i < fit.nodes.size(); ++i)
    if (row[fit.nodes[i]] >= 0) state.points[i].pressure = pressure(row[fit.nodes[i]]);
  state.lowest_pressure = pressure.minCoeff();
  state.highest_pressure = pressure.maxCoeff();
  return state;
}
}  // namespace rotordrop

extern "C" __attribute__((visibility("default"))) rotordrop::ElasticSolver* rotordrop_make_elastic_solver(
    const rotordrop::ElasticProblem& problem) {
  dealii::MultithreadInfo::set_thread_limit(1);
  return new rotordrop::ElasticStatics(problem);
}
