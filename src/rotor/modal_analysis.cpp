#include "rotor/modal_analysis.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "base/rotation.h"
#include "rotor/linear_system.h"
#include "rotor/modal_basis.h"

namespace rotordrop {

namespace {

using Complex = std::complex<double>;

/// Deflections of all nodes in both planes: [2 n_nodes], y first.
Eigen::VectorXcd node_deflections(const ModalBasis& basis, const Eigen::VectorXcd& q) {
  const Eigen::Index n = basis.n_modes(), n_nodes = basis.shape.rows() / 2;
  const Eigen::MatrixXd deflection = basis.shape(Eigen::seqN(0, n_nodes, 2), Eigen::all);
  Eigen::VectorXcd result(2 * n_nodes);
  result << deflection * q.head(n), deflection * q.tail(n);
  return result;
}

Whirl whirl_of(const Eigen::VectorXcd& shape, double spin_speed) {
  // Point k moves on an ellipse of area pi Im(V W*), positive from +y towards +z, which is with the spin if that is positive. Areas, not their ratio to the
  // amplitude, are summed: the sense of a node that hardly moves is noise.
  const Eigen::Index n_nodes = shape.size() / 2;
  double with_spin = 0, against = 0, size = 0;
  for (Eigen::Index k = 0; k < n_nodes; ++k) {
    const Complex V = shape(k), W = shape(n_nodes + k);
    const double area = (spin_speed < 0 ? -2 : 2) * std::imag(V * std::conj(W));
    (area > 0 ? with_spin : against) += std::abs(area);
    size += std::norm(V) + std::norm(W);
  }
  if (with_spin + against < 1e-3 * size) return Whirl::planar;
  if (std::min(with_spin, against) > 1e-2 * std::max(with_spin, against)) return Whirl::mixed;
  return with_spin > against ? Whirl::forward : Whirl::backward;
}

/// Two modes of the same eigenvalue may be combined freely. If that yields one vibration along y and one along z of the
/// same form (an isotropic rotor without gyroscopic effect), takes these and returns true; otherwise leaves the shapes
/// alone.
bool separate_planes(Eigen::VectorXcd& a, Eigen::VectorXcd& b) {
  const Eigen::Index n_nodes = a.size() / 2;
  Eigen::Index k = 0;
  (a.head(n_nodes).cwiseAbs2() + a.tail(n_nodes).cwiseAbs2()).maxCoeff(&k);
  Eigen::Matrix2cd at_node;
  at_node << a(k), b(k), a(n_nodes + k), b(n_nodes + k);
  const double size = at_node.norm();
  if (std::abs(at_node.determinant()) < 1e-6 * size * size) return false;
  Eigen::MatrixXcd both(a.size(), 2);
  both << a, b;
  const Eigen::MatrixXcd separate = both * at_node.inverse();
  const double off_plane = separate.col(0).tail(n_nodes).norm() + separate.col(1).head(n_nodes).norm();
  if (off_plane > 1e-4 * separate.norm()) return false;
  a = separate.col(0);
  b = separate.col(1);
  return true;
}

}  // namespace

std::string_view to_string(Whirl whirl) {
  switch (whirl) {
    case Whirl::forward:
      return "forward";
    case Whirl::backward:
      return "backward";
    case Whirl::planar:
      return "planar";
    case Whirl::mixed:
      return "mixed";
  }
  return "";
}

Complex WhirlMode::eigenvalue() const { return two_pi * Complex(-damping_ratio * natural_frequency, frequency); }

ModalAnalysis::ModalAnalysis(const RotorGeometry& geometry, const ModalAnalysisOptions& options)
    : basis_(std::make_unique<const ModalBasis>(
          free_free_modes(geometry, options.cut_off_frequency, options.attachment_nodes))),
      options_(options) {}
ModalAnalysis::~ModalAnalysis() = default;
ModalAnalysis::ModalAnalysis(ModalAnalysis&&) noexcept = default;
ModalAnalysis& ModalAnalysis::operator=(ModalAnalysis&&) noexcept = default;

WhirlModes ModalAnalysis::whirl_modes(double spin_speed, const std::vector<LinearSupportAtNode>& supports) const {
  const FirstOrder system = first_order(*basis_, linear_system(*basis_, options_, spin_speed, supports));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.A);
  if (solver.info() != Eigen::Success)
    throw SolverError("the eigenvalues of the rotor on its supports did not converge");
  const Eigen::VectorXcd& lambda = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const Eigen::Index N = 2 * basis_->n_modes();

  constexpr double slow = 0.01 * two_pi;
  WhirlModes result;
  std::vector<Eigen::Index> oscillating;
  // Coordinates that nothing holds were left out together with one zero eigenvalue each.
  int n_zero = static_cast<int>(N) - static_cast<int>(system.held.size());
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    const bool only_damped_by_alpha = std::abs(lambda(k) + options_.mass_proportional_alpha) < slow;
    if (std::abs(lambda(k)) < slow || (only_damped_by_alpha && static_cast<Eigen::Index>(system.held.size()) < N))
      ++n_zero;
    else if (std::abs(lambda(k).imag()) <= barely_oscillating * std::abs(lambda(k))) {
      ++(lambda(k).real() > 0. ? result.n_diverging : result.n_overdamped);
      result.divergence_rate = std::max(result.divergence_rate, lambda(k).real());
    } else if (lambda(k).imag() > 0)
      oscillating.push_back(k);
  }
  result.n_rigid_body_modes = n_zero / 2;
  std::sort(oscillating.begin(), oscillating.end(),
            [&](Eigen::Index a, Eigen::Index b) { return lambda(a).imag() < lambda(b).imag(); });

  std::vector<Eigen::VectorXcd> shapes;
  std::vector<bool> is_planar(oscillating.size(), false);
  for (const Eigen::Index k : oscillating)
    shapes.push_back(node_deflections(*basis_, vectors.col(k).tail(N) / lambda(k)));
  for (std::size_t k = 0; k + 1 < shapes.size(); ++k) {
    const Complex a = lambda(oscillating[k]), b = lambda(oscillating[k + 1]);
    if (!is_planar[k] && std::abs(a - b) < 1e-7 * std::abs(a))
      is_planar[k] = is_planar[k + 1] = separate_planes(shapes[k], shapes[k + 1]);
  }

  const Eigen::Index n_nodes = basis_->shape.rows() / 2;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Complex eigenvalue = lambda(oscillating[k]);
    Eigen::Index largest = 0;
    shapes[k].cwiseAbs2().maxCoeff(&largest);
    const Eigen::VectorXcd shape = shapes[k] / shapes[k](largest);
    WhirlMode mode;
    mode.frequency = eigenvalue.imag() / two_pi;
    mode.natural_frequency = std::abs(eigenvalue) / two_pi;
    mode.damping_ratio = -eigenvalue.real() / std::abs(eigenvalue);
    mode.whirl = is_planar[k] ? Whirl::planar : whirl_of(shape, spin_speed);
    mode.v.assign(shape.data(), shape.data() + n_nodes);
    mode.w.assign(shape.data() + n_nodes, shape.data() + 2 * n_nodes);
    result.modes.push_back(std::move(mode));
  }
  return result;
}

}  // namespace rotordrop
