#include "thermal/fe/reduction.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/errors.h"
#include "thermal/fe/modal_responses.h"
#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector = HeatOperator::Vector;
using Matrix = HeatOperator::Matrix;

constexpr int shifts_per_decade = 2;
constexpr std::size_t check_every = 4;  // shifts
constexpr double dependent = 1e-7;      // what is left of a vector that the others span

VectorXd times(const Matrix& A, const VectorXd& v) {
  Vector in(v.begin(), v.end()), out(in.size());
  A.vmult(out, in);
  return Eigen::Map<const VectorXd>(out.begin(), v.size());
}
VectorXd dense(const Vector& v) { return Eigen::Map<const VectorXd>(v.begin(), static_cast<Index>(v.size())); }

/// Vectors v_i with v_i C v_j = 1 if i = j, else 0.
class Basis {
 public:
  explicit Basis(const Matrix& C) : C_(C) {}
  void add(VectorXd v) {
    const double before = std::sqrt(v.dot(times(C_, v)));
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t i = 0; i < v_.size(); ++i) v -= Cv_[i].dot(v) * v_[i];
    VectorXd Cv = times(C_, v);
    const double left = std::sqrt(v.dot(Cv));
    if (!(left > dependent * before)) return;
    v_.emplace_back(v / left);
    Cv_.emplace_back(Cv / left);
  }
  [[nodiscard]] MatrixXd matrix() const {
    MatrixXd V(v_.front().size(), static_cast<Index>(v_.size()));
    for (std::size_t i = 0; i < v_.size(); ++i) V.col(static_cast<Index>(i)) = v_[i];
    return V;
  }

 private:
  const Matrix& C_;
  std::vector<VectorXd> v_, Cv_;
};

MatrixXd times(const Matrix& A, const MatrixXd& V) {
  MatrixXd out(V.rows(), V.cols());
  for (Index i = 0; i < V.cols(); ++i) out.col(i) = times(A, VectorXd(V.col(i)));
  return out;
}
MatrixXd symmetric(const MatrixXd& A) { return 0.5 * (A + A.transpose()); }

/// Indicators of bodies and nodes: uniform temperatures.
std::vector<VectorXd> uniform_fields(const HeatOperator& problem) {
  std::vector<VectorXd> fields;
  for (std::size_t b = 0; b < problem.problem().bodies.size(); ++b) {
    VectorXd v = VectorXd::Zero(problem.size());
    for (unsigned int i = 0; i < problem.n_field(); ++i)
      if (problem.body_of_unknown(i) == b) v(i) = 1.;
    fields.push_back(v);
  }
  for (std::size_t k = 0; k < problem.problem().nodes.size(); ++k) {
    VectorXd v = VectorXd::Zero(problem.size());
    v(problem.index_of_node(k)) = 1.;
    fields.push_back(v);
  }
  return fields;
}

struct Space {
  MatrixXd modes;  ///< orthonormal by capacity [n][n_modes]
  VectorXd rate;
  // Of modes that are few: what they leave of each port's answer, and the errors.
  VectorXd at_once;
  MatrixXd residues;  ///< [n][n_ports]
  ResponseErrors errors;
};

MatrixXd dense(const Matrix& A) {
  MatrixXd out = MatrixXd::Zero(A.m(), A.n());
  for (unsigned int row = 0; row < A.m(); ++row)
    for (auto entry = A.begin(row); entry != A.end(row); ++entry) out(row, entry->column()) = entry->value();
  return out;
}

Space all_modes(const HeatOperator& problem) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(symmetric(dense(problem.conductance())),
                                                                 symmetric(dense(problem.capacity())));
  return {eigen.eigenvectors(), eigen.eigenvalues(), {}, {}, {}};
}

/// Loads of all ports, and weights of the means of bodies and nodes, as columns.
struct Loads {
  MatrixXd ports, means;
};
Loads loads_of(const HeatOperator& problem) {
  const auto& p = problem.problem();
  const auto n_bodies = static_cast<Index>(p.bodies.size());
  Loads loads{MatrixXd(problem.size(), static_cast<Index>(p.ports.size())),
              MatrixXd::Zero(problem.size(), n_bodies + static_cast<Index>(p.nodes.size()))};
  for (std::size_t k = 0; k < p.ports.size(); ++k)
    loads.ports.col(static_cast<Index>(k)) = dense(problem.port_weights(k));
  for (std::size_t b = 0; b < p.bodies.size(); ++b)
    loads.means.col(static_cast<Index>(b)) = dense(problem.body_weights(b));
  for (std::size_t k = 0; k < p.nodes.size(); ++k)
    loads.means(problem.index_of_node(k), n_bodies + static_cast<Index>(k)) = 1.;
  return loads;
}

/// Solutions of (K + s C) v = load.
class Answers {
 public:
  explicit Answers(const HeatOperator& problem)
      : problem_(problem),
        shifted_(problem.pattern()),
        solver_(make_linear_solver(chosen_solver(problem.problem().numerics.solver, problem.size()), true)) {}
  void set_shift(double s) {
    shifted_.copy_from(problem_.conductance());
    shifted_.add(s, problem_.capacity());
    solver_->set_matrix(shifted_);
  }
  [[nodiscard]] VectorXd to(const VectorXd& load) const {
    Vector v(static_cast<unsigned int>(load.size()));
    std::copy(load.begin(), load.end(), v.begin());
    solver_->solve(v);
    return dense(v);
  }

 private:
  const HeatOperator& problem_;
  Matrix shifted_;
  std::unique_ptr<LinearSolver> solver_;
};

/// Largest error of the answers within the space of all shifts, at shifts between those that made it: what the space itself leaves out.
double error_of_space(const ModalHeat& wide, const Loads& loads, const std::vector<double>& shifts,
                      const std::vector<double>& port_times, Answers& answers) {
  double worst = 0.;
  for (std::size_t k = 0; k + 1 < shifts.size(); k += check_every) {
    const double s = std::sqrt(shifts[k] * shifts[k + 1]);
    answers.set_shift(s);
    for (Index p = 0; p < loads.ports.cols(); ++p) {
      if (s * port_times[static_cast<std::size_t>(p)] > 1.) continue;
      const VectorXd exact = answers.to(loads.ports.col(p)), b = wide.in.col(p);
      const VectorXd z = b.array() / (wide.rate.array() + s);
      worst = std::max(worst, std::fabs(b.dot(z) / loads.ports.col(p).dot(exact) - 1.));
      const VectorXd means = loads.means.transpose() * exact, found = wide.out.transpose() * z;
      const double least = mean_floor * means.cwiseAbs().maxCoeff();
      worst = std::max(worst, ((found - means).array().abs() / (means.array().abs() + least)).maxCoeff());
    }
  }
  return worst;
}

Space few_modes(const HeatOperator& problem, const ReductionSettings& settings) {
  const Loads loads = loads_of(problem);
  Basis basis(problem.capacity());
  const auto uniform = uniform_fields(problem);
  for (const auto& v : uniform) basis.add(v);
  const double slowest = 0.1 / settings.longest_time, fastest = 3. / settings.shortest_time;
  const int n_shifts = 1 + static_cast<int>(std::ceil(shifts_per_decade * std::log10(fastest / slowest)));
  std::vector<double> shifts;
  Answers answers(problem);
  for (int k = 0; k < n_shifts; ++k) {
    shifts.push_back(slowest * std::pow(fastest / slowest, static_cast<double>(k) / std::max(1, n_shifts - 1)));
    answers.set_shift(shifts.back());
    for (const auto* loaded : {&loads.ports, &loads.means})
      for (Index i = 0; i < loaded->cols(); ++i) basis.add(answers.to(loaded->col(i)));
  }
  const MatrixXd V = basis.matrix();
  const EigenModes all = modes_of(symmetric(V.transpose() * times(problem.conductance(), V)));
  const MatrixXd modes = V * all.vectors;
  const ModalHeat wide{all.rate, modes.transpose() * loads.ports, modes.transpose() * loads.means,
                       VectorXd::Zero(loads.ports.cols())};
  PortTimes from;
  for (const auto& port : problem.problem().ports) from.push_back(std::max(settings.shortest_time, port.steady_for));
  const double space_error = error_of_space(wide, loads, shifts, from, answers);

  MatrixXd fields(problem.size(), static_cast<Index>(uniform.size()));
  for (std::size_t i = 0; i < uniform.size(); ++i) fields.col(static_cast<Index>(i)) = uniform[i];
  const ModalResponses responses(wide, settings, from);
  ReductionSettings chosen = settings;  // the space's own error adds to that of few modes in it
  chosen.response_tolerance = std::max(settings.response_tolerance - space_error, 0.1 * settings.response_tolerance);
  FewModes few = choose_modes(responses, times(problem.capacity(), modes).transpose() * fields, chosen);
  few.errors.ports.array() += space_error;
  few.errors.means.array() += space_error;
  few.errors.largest += space_error;

  // What the modes leave of a port's response where it is nearly static.
  MatrixXd residues(wide.rate.size(), loads.ports.cols());
  for (Index p = 0; p < residues.cols(); ++p)
    residues.col(p) = VectorXd(wide.in.col(p).array() / (wide.rate.array() + shift_of_residue)) -
                      few.modes * VectorXd(few.heat.in.col(p).array() / (few.heat.rate.array() + shift_of_residue));
  return {modes * few.modes, few.heat.rate, few.heat.at_once, modes * residues, few.errors};
}

std::vector<double> weighted(const MatrixXd& modes, const Vector& weights) {
  const VectorXd sum = modes.transpose() * dense(weights);
  return {sum.begin(), sum.end()};
}

/// The response that is furthest off, in words.
std::string worst_response(const HeatOperator& problem, const ResponseErrors& e) {
  const auto& p = problem.problem();
  const std::string& port = problem.port_name(e.port);
  if (!e.is_mean) return fmt::format("the {}'s own rise under heat at {:.2g} s", port, e.time);
  const std::string& mean = e.mean < p.bodies.size() ? p.bodies[e.mean].name : p.nodes[e.mean - p.bodies.size()].name;
  return fmt::format("the mean of {} under heat into {} at {:.2g} s", mean, port, e.time);
}

}  // namespace

Reduction reduce_heat(const HeatOperator& problem, const ReductionSettings& settings) {
  for (const auto& law : problem.problem().convections)
    if (law.exponent != 0.)
      throw SolverError(
          "the heat conduction cannot be reduced: its convection is not a linear function of temperature.");
  if (!problem.held().empty())
    throw SolverError("the heat conduction cannot be reduced: a boundary is held at a temperature.");
  for (const auto& body : problem.problem().bodies)
    if (!body.conductivity.is_constant() || !body.heat_capacity.is_constant())
      throw SolverError("the heat conduction of body \"" + body.name +
                        "\" cannot be reduced: its properties depend on temperature.");
  Space space = settings.modes == 0 ? all_modes(problem) : few_modes(problem, settings);

  Reduction r;
  auto& d = r.data;
  const auto& p = problem.problem();
  for (std::size_t b = 0; b < p.bodies.size(); ++b) d.capacity += problem.body_capacity(b);
  for (const auto& node : p.nodes) d.capacity += node.capacity;
  // Of the two directions of a mode the one in which most of the section warms.
  const MatrixXd C_modes = times(problem.capacity(), space.modes);
  for (Index i = 0; i < space.modes.cols(); ++i)
    if (C_modes.col(i).sum() < 0.) space.modes.col(i) *= -1.;
  space.modes *= std::sqrt(d.capacity);

  for (const double rate : space.rate) d.rate.push_back(std::max(rate, 0.));
  for (std::size_t k = 0; k < p.ports.size(); ++k) {
    d.ports.push_back(
        {problem.port_name(k), weighted(space.modes, problem.port_weights(k)), 0., problem.port_area(k), {}, 0., {}});
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (problem.port_weights(k)(i) != 0.)
        for (const double shape : space.modes.row(i)) d.ports.back().points.push_back(shape);
  }
  for (std::size_t b = 0; b < p.bodies.size(); ++b)
    d.bodies.push_back(
        {p.bodies[b].name, weighted(space.modes, problem.body_weights(b)), problem.body_capacity(b), 0., {}, 0., {}});
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    const VectorXd row = space.modes.row(problem.index_of_node(k));
    d.nodes.push_back({p.nodes[k].name, {row.begin(), row.end()}, p.nodes[k].capacity, 0., {}, 0., {}});
  }
  d.loss = weighted(space.modes, problem.loss_weights());
  for (Index i = 0; i < space.modes.cols(); ++i) {
    Vector field(problem.size());
    std::copy(space.modes.col(i).begin(), space.modes.col(i).end(), field.begin());
    r.fields.push_back(std::move(field));
  }
  if (space.residues.cols() == 0) return r;
  for (std::size_t k = 0; k < p.ports.size(); ++k) {
    const auto column = static_cast<Index>(k);
    Vector residue(problem.size());
    std::copy(space.residues.col(column).begin(), space.residues.col(column).end(), residue.begin());
    auto& port = d.ports[k];
    port.at_once = space.at_once(column);
    port.response_error = space.errors.ports(column);
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (problem.port_weights(k)(i) != 0.) port.points_at_once.push_back(residue(i));
    r.residues.push_back(std::move(residue));
  }
  Index mean = 0;
  for (auto* outputs : {&d.bodies, &d.nodes})
    for (auto& output : *outputs) output.response_error = space.errors.means(mean++);
  d.response_error = space.errors.largest;
  d.worst_response = worst_response(problem, space.errors);
  return r;
}

}  // namespace rotordrop
