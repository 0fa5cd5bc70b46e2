#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

#include "base/errors.h"
#include "rotor/linear_system.h"
#include "rotor/modal_analysis.h"

namespace rotordrop {
namespace {

constexpr double slow = 0.01 * 2 * std::numbers::pi;  // as whirl_modes() tells rigid-body motions from modes [rad/s]

/// Frequency at a root over the spin, less 1: more is no root but a jump.
constexpr double most_scatter = 0.01;

/// A root between two places of different sign, where |f| < 1e-10 |x|: Illinois' form of regula falsi, with halving in
/// case that is slow. Eigenvalues carry errors of about 1e-12.
double root_between(const std::function<double(double)>& f, double a, double f_a, double b, double f_b) {
  for (int step = 0; step < 200 && std::abs(b - a) > 1e-10 * std::abs(b); ++step) {
    double x = step % 5 == 4 ? 0.5 * (a + b) : (a * f_b - b * f_a) / (f_b - f_a);
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    const double f_x = f(x);
    if (std::abs(f_x) < 1e-10 * std::abs(x)) return x;
    if ((f_x > 0.) == (f_b > 0.)) {
      f_a *= 0.5;
    } else {
      a = b;
      f_a = f_b;
    }
    b = x;
    f_b = f_x;
  }
  return b;
}

}  // namespace

std::vector<double> ModalAnalysis::undamped_critical_speeds(const std::vector<LinearSupportAtNode>& supports) const {
  // With q = q0 exp(i omega t): (K - omega^2 (1 - i G)) q0 = 0, G the antisymmetric gyroscopic matrix for unit spin. Both
  // are Hermitian; K, lifted by far less than the slowest mode, is positive definite.
  const Eigen::Index n = basis_->n_modes(), N = 2 * n;
  ModalAnalysisOptions undamped = options_;
  undamped.modal_damping = undamped.mass_proportional_alpha = 0;
  auto springs = supports;
  for (auto& spring : springs) spring.damping = {};
  const LinearSystem system = linear_system(*basis_, undamped, 1., springs);
  Eigen::MatrixXcd inertia = std::complex<double>(0, -1) * system.damping.cast<std::complex<double>>();
  inertia.diagonal().array() += 1.;
  Eigen::MatrixXcd stiffness = (0.5 * (system.stiffness + system.stiffness.transpose())).cast<std::complex<double>>();
  stiffness.diagonal().array() += 1e-6 * slow * slow;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> solver(inertia, stiffness, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success)
    throw SolverError(
        "the critical speeds of the undamped rotor cannot be computed: a support's stiffness is negative, or so large "
        "that the rotor's own is lost in rounding");
  std::vector<double> speeds;
  for (Eigen::Index k = 0; k < N; ++k)
    if (solver.eigenvalues()(k) > 0. && solver.eigenvalues()(k) < 1 / (slow * slow))
      speeds.push_back(1 / std::sqrt(solver.eigenvalues()(k)));
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

std::vector<double> ModalAnalysis::falling_frequencies(double spin_speed,
                                                       const std::vector<LinearSupportAtNode>& supports) const {
  const FirstOrder system = first_order(*basis_, linear_system(*basis_, options_, spin_speed, supports));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.A, false);
  if (solver.info() != Eigen::Success)
    throw SolverError("the eigenvalues of the rotor on its supports did not converge");
  std::vector<double> frequencies;
  for (const auto& lambda : solver.eigenvalues())
    if (lambda.imag() > 1e-9 * std::abs(lambda) && std::abs(lambda) >= slow) frequencies.push_back(lambda.imag());
  std::sort(frequencies.rbegin(), frequencies.rend());
  frequencies.resize(static_cast<std::size_t>(2 * basis_->n_modes()), 0.);
  return frequencies;
}

std::vector<CriticalSpeed> ModalAnalysis::critical_speeds(double up_to,
                                                          const std::vector<LinearSupportAtNode>& supports) const {
  const auto require_certain = [](const char* what, double speed, double uncertainty) {
    if (!(uncertainty <= 1e-6))
      throw SolverError(fmt::format(
          "{} {:.5g} rpm cannot be told to better than {:.2g} of it: supports are so much stiffer than the rotor that "
          "its own stiffness is lost in rounding. Make them softer, by so much that speeds do not change yet.",
          what, speed * 30. / std::numbers::pi, uncertainty));
  };
  // The k-th highest frequency is a continuous function of the spin, also where modes cross, so each change of the sign
  // of (frequency - spin) encloses a critical speed. Places between those of the undamped rotor separate them.
  std::vector<double> places = {slow, up_to};
  std::vector<double> undamped;
  // What rounding leaves of the sum of both stiffnesses, as a square of a speed.
  const double rounded = std::numeric_limits<double>::epsilon() *
                         linear_system(*basis_, options_, 0., supports).stiffness.lpNorm<Eigen::Infinity>();
  if (!(rounded <= up_to * up_to)) require_certain("critical speeds up to", up_to, 0.5 * rounded / (up_to * up_to));
  for (const double speed : undamped_critical_speeds(supports))
    if (speed < 2 * up_to && (undamped.empty() || speed > undamped.back() * (1 + 1e-6))) undamped.push_back(speed);
  for (std::size_t k = 0; k < undamped.size(); ++k) {
    const double next = k + 1 < undamped.size() ? undamped[k + 1] : up_to;
    for (const double part : {0.25, 0.5, 0.75})
      if (const double place = undamped[k] + part * (next - undamped[k]); place > slow && place < up_to)
        places.push_back(place);
  }
  std::sort(places.begin(), places.end());

  std::vector<CriticalSpeed> found;
  std::vector<double> before = falling_frequencies(places[0], supports);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double a = places[i - 1], b = places[i];
    if (!(b > a)) continue;
    const auto after = falling_frequencies(b, supports);
    for (std::size_t k = 0; k < after.size(); ++k) {
      // A zero stands for a motion that does not oscillate: it passes below the spin without a critical speed.
      if ((before[k] > a) == (after[k] > b)) continue;
      const auto excess = [&](double spin) { return falling_frequencies(spin, supports)[k] - spin; };
      const double speed = root_between(excess, a, before[k] - a, b, after[k] - b);
      const auto modes = whirl_modes(speed, supports).modes;
      if (k >= modes.size()) continue;
      const auto& mode = modes[modes.size() - 1 - k];
      const double off = std::abs(mode.frequency * 2 * std::numbers::pi / speed - 1.);
      if (off > most_scatter) continue;  // where a motion ceases to oscillate its frequency jumps past the spin
      require_certain("the critical speed at", speed, off);
      found.push_back({speed, mode.whirl, mode.damping_ratio});
    }
    before = after;
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.speed < y.speed; });
  std::vector<CriticalSpeed> distinct;
  for (const auto& one : found) {
    const bool is_again = !distinct.empty() && one.whirl == Whirl::planar && distinct.back().whirl == Whirl::planar &&
                          one.speed - distinct.back().speed < 1e-7 * one.speed;
    if (!is_again) distinct.push_back(one);
  }
  return distinct;
}

}  // namespace rotordrop
