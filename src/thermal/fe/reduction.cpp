#include "thermal/fe/reduction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "thermal/fe/linear_solver.h"

namespace rotordrop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector = HeatOperator::Vector;
using Matrix = HeatOperator::Matrix;

constexpr int shifts_per_decade = 2;
constexpr double dependent = 1e-7;  // what is left of a vector that the others span

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
    v_.push_back(v / left);
    Cv_.push_back(Cv / left);
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
    VectorXd v = dense(problem.body_weights(b));
    for (double& value : v) value = value != 0. ? 1. : 0.;
    fields.push_back(v);
  }
  for (std::size_t k = 0; k < problem.problem().nodes.size(); ++k) {
    VectorXd v = VectorXd::Zero(problem.size());
    v(problem.index_of_node(k)) = 1.;
    fields.push_back(v);
  }
  return fields;
}

/// A port's answer to a watt of its own, exp(st) with real s: what the mesh says.
struct Response {
  double s;
  std::size_t port;
  double value;
  Vector field;
};
constexpr double shift_of_residue = 1e3;  // [1/s]: modes left out are far faster

struct Space {
  MatrixXd modes;  ///< orthonormal by capacity [n][n_modes]
  VectorXd rate;
  std::vector<Response> responses;
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
  return {eigen.eigenvectors(), eigen.eigenvalues(), {}};
}

Space krylov_modes(const HeatOperator& problem, const ReductionSettings& settings) {
  const std::size_t n_ports = problem.problem().ports.size();
  Space space;
  Basis basis(problem.capacity());
  const auto uniform = uniform_fields(problem);
  for (const auto& v : uniform) basis.add(v);
  const double slowest = 1. / settings.longest_time, fastest = 3. / settings.shortest_time;
  const int n_shifts = 1 + static_cast<int>(std::ceil(shifts_per_decade * std::log10(fastest / slowest)));
  Matrix shifted(problem.pattern());
  const auto solver = make_linear_solver(problem.problem().numerics.solver, true);
  for (int k = 0; k < n_shifts; ++k) {
    const double s = slowest * std::pow(fastest / slowest, static_cast<double>(k) / std::max(1, n_shifts - 1));
    shifted.copy_from(problem.conductance());
    shifted.add(s, problem.capacity());
    solver->set_matrix(shifted);
    for (std::size_t p = 0; p < n_ports; ++p) {
      Vector v = problem.port_weights(p);
      solver->solve(v);
      space.responses.push_back({s, p, v * problem.port_weights(p), v});
      basis.add(dense(v));
    }
  }
  const MatrixXd V = basis.matrix();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> all(symmetric(V.transpose() * times(problem.conductance(), V)));
  const MatrixXd modes = V * all.eigenvectors();
  const VectorXd rate = all.eigenvalues().cwiseMax(0.);

  // Gramian of the modes over about the longest time, every port by its importance.
  MatrixXd gramian = MatrixXd::Zero(rate.size(), rate.size());
  for (std::size_t p = 0; p < n_ports; ++p) {
    const VectorXd b = modes.transpose() * dense(problem.port_weights(p));
    MatrixXd own(rate.size(), rate.size());
    for (Index i = 0; i < rate.size(); ++i)
      for (Index j = 0; j < rate.size(); ++j) own(i, j) = b(i) * b(j) / (rate(i) + rate(j) + 2. * slowest);
    const double importance = problem.problem().ports[p].importance;
    gramian += importance * importance / own.trace() * own;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> balanced(gramian);

  // The uniform fields first, then the strongest directions, all in coordinates of the modes.
  const MatrixXd C_modes = times(problem.capacity(), modes);
  MatrixXd chosen(rate.size(), 0);
  const auto choose = [&](VectorXd v) {
    const double before = v.norm();
    for (int pass = 0; pass < 2; ++pass) v -= chosen * (chosen.transpose() * v);
    if (v.norm() <= dependent * before) return;
    chosen.conservativeResize(Eigen::NoChange, chosen.cols() + 1);
    chosen.rightCols(1) = v.normalized();
  };
  for (const auto& v : uniform) choose(C_modes.transpose() * v);
  const auto most = static_cast<Index>(settings.modes);
  for (Index i = rate.size(); i-- > 0 && chosen.cols() < most;) choose(balanced.eigenvectors().col(i));

  const Eigen::SelfAdjointEigenSolver<MatrixXd> few(symmetric(chosen.transpose() * rate.asDiagonal() * chosen));
  Index n = few.eigenvalues().size();
  while (n > static_cast<Index>(uniform.size()) && few.eigenvalues()(n - 1) > settings.fastest) --n;
  space.modes = modes * (chosen * few.eigenvectors().leftCols(n));
  space.rate = few.eigenvalues().head(n);
  return space;
}

std::vector<double> weighted(const MatrixXd& modes, const Vector& weights) {
  const VectorXd sum = modes.transpose() * dense(weights);
  return {sum.begin(), sum.end()};
}

/// Rise of a port per watt into it, in the reduced problem.
double reduced_response(const ReducedHeat& d, std::size_t port, double s) {
  const auto& shape = d.ports[port].shape;
  double sum = d.ports[port].at_once;
  for (std::size_t i = 0; i < d.n_modes(); ++i) sum += shape[i] * shape[i] / (d.capacity * (d.rate[i] + s));
  return sum;
}

}  // namespace

Reduction reduce_heat(const HeatOperator& problem, const ReductionSettings& settings) {
  for (const auto& law : problem.problem().convections)
    if (law.exponent != 0.)
      throw SolverError("the heat conduction cannot be reduced: its convection is no linear function of temperature.");
  if (!problem.held().empty())
    throw SolverError("the heat conduction cannot be reduced: a boundary is held at a temperature.");
  for (const auto& body : problem.problem().bodies)
    if (!body.conductivity.is_constant() || !body.heat_capacity.is_constant())
      throw SolverError("the heat conduction of body \"" + body.name +
                        "\" cannot be reduced: its properties depend on temperature.");
  Space space = settings.modes == 0 ? all_modes(problem) : krylov_modes(problem, settings);

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
  // What the modes leave of a port's response where it is nearly static.
  for (std::size_t k = 0; k < p.ports.size() && !space.responses.empty(); ++k) {
    const Response* nearest = nullptr;
    const auto distance = [](const Response& x) { return std::fabs(std::log(x.s / shift_of_residue)); };
    for (const auto& response : space.responses)
      if (response.port == k && (!nearest || distance(response) < distance(*nearest))) nearest = &response;
    Vector residue = nearest->field;
    for (std::size_t i = 0; i < d.n_modes(); ++i)
      residue.add(-d.ports[k].shape[i] / (d.capacity * (d.rate[i] + nearest->s)), r.fields[i]);
    auto& port = d.ports[k];
    port.at_once = residue * problem.port_weights(k);
    for (unsigned int i = 0; i < problem.size(); ++i)
      if (problem.port_weights(k)(i) != 0.) port.points_at_once.push_back(residue(i));
    r.residues.push_back(std::move(residue));
  }
  for (const auto& response : space.responses) {
    if (response.s > 1. / settings.shortest_time) continue;
    double& error = d.ports[response.port].response_error;
    error = std::max(error, std::fabs(reduced_response(d, response.port, response.s) / response.value - 1.));
  }
  return r;
}

}  // namespace rotordrop
