// Derivatives of a loop at a state: its gain, its eigenvalues, and Newton's method with them.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/preload/preload_criterion.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Gradients by the growth of each surface.
struct Gradients {
  Expansion heat;     ///< [W/m]
  Expansion preload;  ///< [N/m]
};

Gradients gradients_at(const RunningBearing& bearing, const Expansion& growth) {
  constexpr double step =
      2e-8;  // [m]: far below the balls' approach of some micrometres, far above the equilibrium's tolerance
  Gradients g;
  for (auto surface : growth_surfaces) {
    std::array<RunningState, 4> at;
    const std::array<double, 4> places = {-2., -1., 1., 2.};
    for (std::size_t i = 0; i < 4; ++i) {
      Expansion moved = growth;
      moved.*surface += places[i] * step;
      at[i] = bearing.at(moved);
    }
    const auto derivative = [&](double RunningState::*value) {
      return (8. * (at[2].*value - at[1].*value) - (at[3].*value - at[0].*value)) / (12. * step);
    };
    g.heat.*surface = derivative(&RunningState::heat);
    g.preload.*surface = derivative(&RunningState::preload);
  }
  return g;
}

/// J, b, c of preload_criterion.h.
struct Derivatives {
  Matrix J;
  Eigen::VectorXd b, c, preload_by_T;
  std::vector<Expansion> growth_by_T;
  [[nodiscard]] Eigen::MatrixXd closed() const { return J + b * c.transpose(); }
};

Derivatives derivatives_at(const PreloadLoop& loop, std::span<const double> T, double heat) {
  const std::size_t n = loop.size();
  const auto rows = static_cast<Eigen::Index>(n);
  Derivatives d{Matrix(rows, rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows),
                std::vector<Expansion>(n)};
  const auto J_values = loop.jacobian(T, heat);
  d.J = Eigen::Map<const Matrix>(J_values.data(), rows, rows);
  Eigen::VectorXd with(rows);
  loop.rates(T, heat, {d.b.data(), n});
  loop.rates(T, heat + 1., {with.data(), n});
  d.b = with - d.b;

  const Expansion growth = loop.growth(T);
  const Gradients gradients = gradients_at(loop.bearing(), growth);
  std::vector<double> warmer(T.begin(), T.end());
  for (std::size_t k = 0; k < n; ++k) {
    warmer[k] += 1.;
    d.growth_by_T[k] = combined(1., loop.growth(warmer), -1., growth);
    warmer[k] = T[k];
    d.c[static_cast<Eigen::Index>(k)] = gradients.heat.dot(d.growth_by_T[k]);
    d.preload_by_T[static_cast<Eigen::Index>(k)] = gradients.preload.dot(d.growth_by_T[k]);
  }
  return d;
}

std::complex<double> largest_eigenvalue(const Eigen::MatrixXd& A) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  return *std::max_element(values.begin(), values.end(),
                           [](const auto& x, const auto& y) { return x.real() < y.real(); });
}

}  // namespace

LoopResponse response_at(const PreloadLoop& loop, std::span<const double> T) {
  const std::size_t n = loop.size();
  const auto rows = static_cast<Eigen::Index>(n);
  const auto [J, b, c, preload_by_T, growth_by_T] = derivatives_at(loop, T, loop.state(T).heat);

  LoopResponse r;
  const Eigen::VectorXd T_by_heat = -J.partialPivLu().solve(b);
  r.gain = c.dot(T_by_heat);
  r.preload_per_heat = preload_by_T.dot(T_by_heat);
  if (r.preload_per_heat != 0.) r.heat_per_preload = r.gain / r.preload_per_heat;
  for (std::size_t k = 0; k < n; ++k)
    r.growth_per_heat = combined(1., r.growth_per_heat, T_by_heat[static_cast<Eigen::Index>(k)], growth_by_T[k]);

  r.eigenvalue = largest_eigenvalue(J + b * c.transpose());
  r.eigenvalue_of_held_heat = largest_eigenvalue(J);
  r.largest_gain = r.gain;
  if (r.is_folded()) {
    r.largest_gain = NAN;  // it has a pole at the eigenvalue of J
    return r;
  }
  constexpr int n_rates = 220;  // from 1e-8 to 1e3 1/s
  for (int k = 0; k <= n_rates; ++k) {
    const double s = std::pow(10., -8. + 0.05 * k);
    const double gain = c.dot((s * Matrix::Identity(rows, rows) - J).partialPivLu().solve(b));
    if (gain > r.largest_gain) {
      r.largest_gain = gain;
      r.largest_gain_time = 1. / s;
    }
  }
  return r;
}

std::optional<std::vector<double>> rest_near(const PreloadLoop& loop, std::span<const double> start) {
  constexpr int most_steps = 12;
  const double ambient = loop.cold()[0];
  std::vector<double> T(start.begin(), start.end());
  Eigen::VectorXd F(static_cast<Eigen::Index>(loop.size()));
  double before = HUGE_VAL;
  try {
    for (int i = 0; i < most_steps; ++i) {
      const double heat = loop.state(T).heat;
      const double rise = std::fabs(T[0] - ambient);
      loop.rates(T, heat, {F.data(), loop.size()});
      const Eigen::VectorXd step = derivatives_at(loop, T, heat).closed().partialPivLu().solve(F);
      double way = 0.;
      for (std::size_t k = 0; k < T.size(); ++k) {
        T[k] -= step[static_cast<Eigen::Index>(k)];
        way = std::max(way, std::fabs(T[k] - start[k]));
      }
      // Another rest is none of this start; NaN neither.
      if (!(way < 0.05 * (1. + rise))) return {};
      // To the end, or to the roundoff of the bearing's equilibrium.
      const double size = step.lpNorm<Eigen::Infinity>() / (1. + rise);
      if (size < 1e-10 || (size < 1e-7 && size > 0.1 * before)) return T;
      before = size;
    }
  } catch (const SolverError&) {  // no equilibrium of the bearing on the way
  }
  return {};
}

}  // namespace rotordrop
