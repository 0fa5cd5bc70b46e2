#include "laws/support/maxwell_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rotation.h"
#include "laws/contact.h"

namespace rotordrop {
namespace {

/// x >= 0 with the least |A x - b|; starts from nothing.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<bool> is_passive(static_cast<std::size_t>(n), false), is_barred = is_passive;
  const auto solve = [&] {
    std::vector<Eigen::Index> used;
    for (Eigen::Index j = 0; j < n; ++j)
      if (is_passive[static_cast<std::size_t>(j)]) used.push_back(j);
    Eigen::VectorXd s = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd part = A(Eigen::all, used).colPivHouseholderQr().solve(b);
    for (std::size_t k = 0; k < used.size(); ++k) s[used[k]] = part[static_cast<Eigen::Index>(k)];
    return s;
  };
  for (Eigen::Index round = 0; round < 10 * n; ++round) {
    const Eigen::VectorXd w = A.transpose() * (b - A * x);
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (!is_passive[k] && !is_barred[k] && (best < 0 || w[j] > w[best])) best = j;
    }
    if (best < 0 || w[best] <= 1e-15 * b.norm()) break;
    is_passive[static_cast<std::size_t>(best)] = true;
    Eigen::VectorXd s = solve();
    if (s[best] <= 0.) {  // rounding: it would not help
      is_passive[static_cast<std::size_t>(best)] = false;
      is_barred[static_cast<std::size_t>(best)] = true;
      continue;
    }
    for (Eigen::Index inner = 0; inner <= n; ++inner) {
      double step = 1.;
      for (Eigen::Index j = 0; j < n; ++j)
        if (is_passive[static_cast<std::size_t>(j)] && s[j] <= 0.) step = std::min(step, x[j] / (x[j] - s[j]));
      if (step >= 1.) break;
      x += step * (s - x);
      for (Eigen::Index j = 0; j < n; ++j)
        if (is_passive[static_cast<std::size_t>(j)] && x[j] <= 1e-15 * x.maxCoeff()) {
          x[j] = 0.;
          is_passive[static_cast<std::size_t>(j)] = false;
        }
      s = solve();
    }
    x = s.cwiseMax(0.);
    std::fill(is_barred.begin(), is_barred.end(), false);
  }
  return x;
}

MaxwellFit judged(MaxwellModel model, const std::vector<DynamicStiffness>& table) {
  MaxwellFit fit{std::move(model), 0., table.front().frequency};
  for (const auto& row : table) {
    const auto [storage, loss] = fit.model.dynamic_stiffness(two_pi * row.frequency);
    const double error = std::hypot(storage - row.storage, loss - row.loss) / std::hypot(row.storage, row.loss);
    if (error > fit.largest_error) {
      fit.largest_error = error;
      fit.worst_frequency = row.frequency;
    }
  }
  return fit;
}

}  // namespace

MaxwellFit fit_maxwell(const std::vector<DynamicStiffness>& table) {
  const auto n_rows = static_cast<Eigen::Index>(table.size());
  const double highest = two_pi * table.back().frequency, lowest = two_pi * table.front().frequency;
  constexpr double per_decade = 8.;
  const double first = std::log10(0.1 / highest), last = std::log10(10. / lowest);
  std::vector<double> coarse;
  const int n_coarse = static_cast<int>(std::ceil((last - first) * per_decade));
  for (int k = 0; k <= n_coarse; ++k) coarse.push_back(first + (last - first) * k / n_coarse);
  std::vector<double> grid = coarse;
  double spacing = (last - first) / n_coarse;
  MaxwellFit best;
  best.largest_error = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 24; ++round) {
    const auto n = static_cast<Eigen::Index>(grid.size());
    Eigen::MatrixXd A(2 * n_rows, n + 2);
    Eigen::VectorXd b(2 * n_rows);
    for (Eigen::Index i = 0; i < n_rows; ++i) {
      const auto& row = table[static_cast<std::size_t>(i)];
      const double w = two_pi * row.frequency, weight = 1. / std::hypot(row.storage, row.loss);
      b[2 * i] = weight * row.storage;
      b[2 * i + 1] = weight * row.loss;
      for (Eigen::Index j = 0; j < n; ++j) {
        const double s = w * std::pow(10., grid[static_cast<std::size_t>(j)]);
        A(2 * i, j) = weight * s * s / (1. + s * s);
        A(2 * i + 1, j) = weight * s / (1. + s * s);
      }
      A(2 * i, n) = weight;
      A(2 * i + 1, n) = 0.;
      A(2 * i, n + 1) = 0.;
      A(2 * i + 1, n + 1) = weight * w;
    }
    Eigen::VectorXd scale(n + 2);
    for (Eigen::Index j = 0; j < n + 2; ++j) scale[j] = A.col(j).norm();
    const Eigen::VectorXd x = non_negative_least_squares(A * scale.cwiseInverse().asDiagonal(), b).cwiseQuotient(scale);
    MaxwellModel model;
    model.stiffness = x[n];
    model.damping = x[n + 1];
    std::vector<double> used;
    for (Eigen::Index j = 0; j < n; ++j)
      if (x[j] > 0.) {
        used.push_back(grid[static_cast<std::size_t>(j)]);
        model.elements.push_back({x[j], std::pow(10., used.back())});
      }
    MaxwellFit fit = judged(std::move(model), table);
    if (fit.largest_error < best.largest_error) best = std::move(fit);
    if (best.largest_error < 1e-11) break;
    // Finer about the times in use, beside the coarse grid.
    spacing *= 0.5;
    grid = coarse;
    for (const double t : used)
      for (const double shift : {-1., -0.5, 0., 0.5, 1.}) grid.push_back(std::clamp(t + shift * spacing, first, last));
    std::sort(grid.begin(), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end(), [](double a, double c) { return c - a < 1e-12; }), grid.end());
  }
  return best;
}

MaxwellModel kelvin_voigt(const std::vector<DynamicStiffness>& table, double frequency) {
  std::vector<std::array<double, 2>> storage, loss;
  for (const auto& row : table) {
    storage.push_back({row.frequency, row.storage});
    loss.push_back({row.frequency, row.loss});
  }
  return {table_value(storage, frequency), table_value(loss, frequency) / (two_pi * frequency), {}};
}

}  // namespace rotordrop
