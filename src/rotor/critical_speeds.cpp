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

bool is_oscillating(const std::complex<double>& lambda) {
  return lambda.imag() > barely_oscillating * std::abs(lambda);
}

/// The frequency of a motion that oscillates; of others less, falling to 0 without a jump. Double real eigenvalues, which
/// isotropic dampers give, have imaginary parts by rounding that may be larger than a low spin.
double counted_frequency(const std::complex<double>& lambda) {
  if (is_oscillating(lambda) || lambda.imag() <= 0.) return std::max(lambda.imag(), 0.);
  const double part = lambda.imag() / (barely_oscillating * std::abs(lambda));
  return lambda.imag() * part * part;
}

/// Eigenvalues of all coordinates by falling counted frequency. The k-th of these is a continuous function of the spin,
/// also where modes cross and where they begin to oscillate.
struct Spectrum {
  double spin = 0;  ///< magnitude [rad/s]
  std::vector<std::complex<double>> falling;

  /// By how much the k-th frequency is above the spin [rad/s].
  [[nodiscard]] double excess(std::size_t k) const { return counted_frequency(falling[k]) - spin; }
};
using SpectrumAt = std::function<Spectrum(double)>;

/// A stretch of speeds in which the k-th frequency meets the spin once.
struct Crossing {
  Spectrum from, to;
  std::size_t k;
};

/// Stretches with one crossing each, found by halving.
///
/// How far frequencies stray from straight lines between the ends of a stretch is judged from its neighbour of the same
/// parent: from the chord over both, the place between them is off by d. A bend (two modes that cross or veer) or a
/// curvature then lets the frequency leave the stretch's own chord by at most d times the parent's length over the
/// neighbour's.
class CrossingSearch {
 public:
  explicit CrossingSearch(SpectrumAt spectrum) : spectrum_(std::move(spectrum)) {}

  [[nodiscard]] std::vector<Crossing> between(const Spectrum& a, const Spectrum& b) {
    found_.clear();
    divide(a, b, std::vector<double>(a.falling.size(), 0.));
    return found_;
  }

 private:
  void divide(const Spectrum& a, const Spectrum& b, const std::vector<double>& d_before) {
    const Spectrum middle = spectrum_(b.spin > 2. * a.spin ? std::sqrt(a.spin * b.spin) : 0.5 * (a.spin + b.spin));
    const double part = (middle.spin - a.spin) / (b.spin - a.spin);
    std::vector<double> d(d_before.size());
    // A quarter of the parent's, as of a parabola: a change of curvature may hide at one place, but not at two.
    for (std::size_t k = 0; k < d.size(); ++k)
      d[k] = std::max(std::abs(middle.excess(k) - (1. - part) * a.excess(k) - part * b.excess(k)), 0.25 * d_before[k]);
    close_or_divide(a, middle, d, 1. / (1. - part));
    close_or_divide(middle, b, d, 1. / part);
  }

  void close_or_divide(const Spectrum& a, const Spectrum& b, const std::vector<double>& d, double stretching) {
    const auto crosses = [&](std::size_t k) { return (a.excess(k) > 0.) != (b.excess(k) > 0.); };
    // A rotor with Ip = Id that nothing holds whirls with the spin at every speed: rounding gives the signs.
    const auto is_flat = [&](std::size_t k) {
      return std::max({std::abs(a.excess(k)), std::abs(b.excess(k)), d[k]}) <= 1e-9 * b.spin;
    };
    const auto is_clear = [&](std::size_t k) {
      const double stray = stretching * d[k], f_a = std::abs(a.excess(k)), f_b = std::abs(b.excess(k));
      return crosses(k) ? f_a + f_b > 2. * stray : std::min(f_a, f_b) > stray;
    };
    constexpr double narrowest = 1e-6;  // of the speed: closer pairs of crossings only touch the spin
    bool is_divided = false;
    for (std::size_t k = 0; k < d.size() && !is_divided; ++k)
      is_divided = b.spin - a.spin > narrowest * b.spin && !is_flat(k) && !is_clear(k);
    if (is_divided) {
      divide(a, b, d);
      return;
    }
    for (std::size_t k = 0; k < d.size(); ++k)
      if (crosses(k) && !is_flat(k)) found_.push_back({a, b, k});
  }

  SpectrumAt spectrum_;
  std::vector<Crossing> found_;
};

/// Ends of the stretches that are searched, behind the first place: eight of equal length, and at low speeds each four
/// times the one before.
std::vector<double> starting_places(double first, double last) {
  constexpr int n = 8;
  std::vector<double> places;
  for (double place = last / n; place > 2. * first; place /= 4.) places.insert(places.begin(), place);
  for (int k = places.empty() ? 1 : 2; k <= n; ++k)
    if (const double place = last * k / n; place > first) places.push_back(place);
  return places;
}

/// The spectrum at a crossing, where |excess| < 1e-7 spin: Illinois' form of regula falsi, with halving in case that is
/// slow.
Spectrum spectrum_at(const Crossing& crossing, const SpectrumAt& spectrum) {
  double a = crossing.from.spin, f_a = crossing.from.excess(crossing.k);
  Spectrum at = crossing.to;
  double f_b = at.excess(crossing.k);
  for (int step = 0; step < 200 && std::abs(at.spin - a) > 1e-7 * at.spin; ++step) {
    const double b = at.spin;
    double x = step % 5 == 4 ? 0.5 * (a + b) : (a * f_b - b * f_a) / (f_b - f_a);
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    at = spectrum(x);
    const double f_x = at.excess(crossing.k);
    if (std::abs(f_x) < 1e-7 * x) break;
    if ((f_x > 0.) == (f_b > 0.)) {
      f_a *= 0.5;
    } else {
      a = b;
      f_a = f_b;
    }
    f_b = f_x;
  }
  return at;
}

/// The k-th eigenvalue, or another of the same frequency if that is among the roots already. Forward and backward whirl
/// with cross-coupled stiffness may have one frequency but different damping; their order is then rounding's.
std::complex<double> one_not_among(const std::vector<std::complex<double>>& roots, const Spectrum& at, std::size_t k) {
  const auto is_known = [&](const std::complex<double>& lambda) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const auto& root) { return std::abs(root - lambda) < 1e-6 * std::abs(lambda); });
  };
  if (is_known(at.falling[k]))
    for (std::size_t j = 0; j < at.falling.size(); ++j)
      if (std::abs(at.excess(j) - at.excess(k)) < 1e-6 * at.spin && !is_known(at.falling[j])) return at.falling[j];
  return at.falling[k];
}

/// One eigenvalue without the rounding errors of the largest: B(lambda) q = (lambda^2 + lambda D + K) q = 0 by inverse
/// iteration (Guettel & Tisseur 2017, The nonlinear eigenvalue problem, algorithm 4.2).
std::complex<double> refined_eigenvalue(const std::complex<double>& start, const LinearSystem& system) {
  std::complex<double> lambda = start;
  Eigen::VectorXcd q = Eigen::VectorXcd::LinSpaced(system.stiffness.rows(), 1., 2.).normalized();
  for (int step = 0; step < 5; ++step) {
    Eigen::MatrixXcd slope = system.damping.cast<std::complex<double>>();
    Eigen::MatrixXcd B = lambda * slope + system.stiffness;
    B.diagonal().array() += lambda * lambda;
    slope.diagonal().array() += 2. * lambda;
    const Eigen::VectorXcd next = B.partialPivLu().solve(slope * q);
    const std::complex<double> correction = 1. / q.dot(next);
    if (!next.allFinite() || !std::isfinite(std::abs(correction))) break;  // B is singular: nothing is left to correct
    if (step > 1) lambda -= correction;                                    // first the vector
    q = next.normalized();
  }
  return std::abs(lambda - start) < 1e-3 * std::abs(start) ? lambda : start;
}

/// Root near a speed, by secants.
double refined_crossing(double speed, const std::function<double(double)>& excess) {
  double before = speed, f_before = excess(speed), now = speed + f_before;
  for (int step = 0; step < 6; ++step) {
    const double f = excess(now), next = now - f * (now - before) / (f - f_before);
    if (std::abs(f) < 1e-11 * now || !(std::abs(next / speed - 1.) < 1e-5)) break;
    before = now;
    f_before = f;
    now = next;
  }
  return now;
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

std::vector<std::complex<double>> ModalAnalysis::falling_eigenvalues(
    double spin_speed, const std::vector<LinearSupportAtNode>& supports) const {
  const FirstOrder system = first_order(*basis_, linear_system(*basis_, options_, spin_speed, supports));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.A, false);
  if (solver.info() != Eigen::Success)
    throw SolverError("the eigenvalues of the rotor on its supports did not converge");
  std::vector<std::complex<double>> falling;
  for (const auto& lambda : solver.eigenvalues())
    if (counted_frequency(lambda) > 0.) falling.push_back(lambda);
  std::sort(falling.begin(), falling.end(),
            [](const auto& a, const auto& b) { return counted_frequency(a) > counted_frequency(b); });
  falling.resize(static_cast<std::size_t>(2 * basis_->n_modes()), 0.);
  return falling;
}

std::vector<CriticalSpeed> ModalAnalysis::critical_speeds(double up_to,
                                                          const std::vector<LinearSupportAtNode>& supports,
                                                          double sense) const {
  const auto require_certain = [](const char* what, double speed, double uncertainty) {
    if (!(uncertainty <= 1e-6))
      throw SolverError(fmt::format(
          "{} {:.5g} rpm cannot be told to better than {:.2g} of it: supports are so much stiffer than the rotor that "
          "its own stiffness is lost in rounding. Make them softer, by so much that speeds do not change yet.",
          what, speed * 30. / std::numbers::pi, uncertainty));
  };
  // What rounding leaves of the sum of both stiffnesses, as a square of a speed.
  const double rounded = std::numeric_limits<double>::epsilon() *
                         linear_system(*basis_, options_, 0., supports).stiffness.lpNorm<Eigen::Infinity>();
  if (!(rounded <= up_to * up_to)) require_certain("critical speeds up to", up_to, 0.5 * rounded / (up_to * up_to));

  const SpectrumAt spectrum = [&](double spin) {
    return Spectrum{spin, falling_eigenvalues(std::copysign(spin, sense), supports)};
  };
  CrossingSearch search(spectrum);
  std::vector<CriticalSpeed> found;
  std::vector<std::complex<double>> roots;
  Spectrum before = spectrum(std::min(slow, 0.5 * up_to));
  for (const double place : starting_places(before.spin, up_to)) {
    const Spectrum after = spectrum(place);
    for (const Crossing& crossing : search.between(before, after)) {
      const Spectrum at = spectrum_at(crossing, spectrum);
      const std::complex<double> lambda = one_not_among(roots, at, crossing.k);
      if (!is_oscillating(lambda)) continue;
      roots.push_back(lambda);
      const auto refined = [&](double spin) {
        return refined_eigenvalue(lambda, linear_system(*basis_, options_, std::copysign(spin, sense), supports));
      };
      const double speed = refined_crossing(at.spin, [&](double spin) { return refined(spin).imag() - spin; });
      const std::complex<double> root = refined(speed);
      const WhirlModes all = whirl_modes(std::copysign(speed, sense), supports);
      const auto distance = [&](const WhirlMode& mode) { return std::abs(mode.eigenvalue() - root); };
      const auto mode = std::min_element(all.modes.begin(), all.modes.end(),
                                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
      // Eigenvalues of all modes at once scatter ten times as much and more.
      const double off = mode == all.modes.end() ? 1. : std::abs(mode->eigenvalue().imag() / speed - 1.);
      require_certain("the critical speed at", speed, std::max(0.1 * off, std::abs(root.imag() / speed - 1.)));
      found.push_back({speed, mode->whirl, -root.real() / std::abs(root)});
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
