#include "study/many/search/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rotordrop {
namespace {

using Vector = Eigen::VectorXd;

double cost_of(const Vector& r) {
  return r.size() > 0 && r.allFinite() ? r.squaredNorm() : std::numeric_limits<double>::infinity();
}

/// Forward differences, backward ones near the upper face.
std::vector<std::vector<double>> shifted(const std::vector<double>& at, double h) {
  std::vector<std::vector<double>> places;
  for (std::size_t i = 0; i < at.size(); ++i) {
    places.push_back(at);
    places.back()[i] += at[i] + h <= 1. ? h : -h;
  }
  return places;
}

/// Step of damping lambda from the normal equations, with Marquardt's scaling; 0 for parameters that are held.
std::vector<double> stepped(const std::vector<double>& at, const Eigen::MatrixXd& J, const Vector& r, double lambda) {
  const auto d = static_cast<Eigen::Index>(at.size());
  const Vector g = J.transpose() * r;
  Eigen::MatrixXd A = J.transpose() * J;
  const double floor = 1e-12 * A.diagonal().maxCoeff();
  Vector b = -g;
  for (Eigen::Index i = 0; i < d; ++i) {
    const double x = at[static_cast<std::size_t>(i)];
    const bool is_held = (x <= 0. && g[i] > 0.) || (x >= 1. && g[i] < 0.);
    A(i, i) += lambda * std::max(A(i, i), floor);
    if (!is_held) continue;
    A.row(i).setZero();
    A.col(i).setZero();
    A(i, i) = 1.;
    b[i] = 0.;
  }
  const Vector step = A.ldlt().solve(b);
  std::vector<double> to = at;
  for (Eigen::Index i = 0; i < d; ++i) {
    double& x = to[static_cast<std::size_t>(i)];
    x = std::isfinite(step[i]) ? std::clamp(x + step[i], 0., 1.) : x;
  }
  return to;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

}  // namespace

std::vector<double> least_squares(const LeastSquaresSettings& settings, std::vector<double> at,
                                  const ResidualsAt& residuals_at) {
  const std::size_t d = at.size();
  int left = settings.evaluations - 1;
  Vector r = residuals_at({at}).front();
  double lambda = 1e-3;
  constexpr double largest_damping = 1e9;
  while (std::isfinite(cost_of(r)) && left >= static_cast<int>(d)) {
    const auto places = shifted(at, settings.difference);
    const auto near = residuals_at(places);
    left -= static_cast<int>(d);
    Eigen::MatrixXd J(r.size(), static_cast<Eigen::Index>(d));
    for (std::size_t i = 0; i < d; ++i) {
      // Where a drop fails nothing is known of the slope; the parameter rests until others have moved.
      const auto column = static_cast<Eigen::Index>(i);
      if (std::isfinite(cost_of(near[i])))
        J.col(column) = (near[i] - r) / (places[i][i] - at[i]);
      else
        J.col(column).setZero();
    }
    if (!(J.squaredNorm() > 0.)) return at;
    for (;;) {
      if (left < 3) return at;
      std::vector<std::vector<double>> trials;
      for (const double factor : {0.1, 1., 10.}) trials.push_back(stepped(at, J, r, factor * lambda));
      const auto found = residuals_at(trials);
      left -= 3;
      std::size_t best = 0;
      for (std::size_t k = 1; k < found.size(); ++k)
        if (cost_of(found[k]) < cost_of(found[best])) best = k;
      const double moved = distance(trials[best], at);
      if (cost_of(found[best]) < cost_of(r)) {
        const double gain = cost_of(r) - cost_of(found[best]);
        at = trials[best];
        r = found[best];
        lambda = std::max(1e-12, lambda * std::pow(10., static_cast<double>(best) - 1.));
        // Roundoff of the sum of squares: no step finds less.
        if (moved < settings.tolerance || gain < 1e-14 * cost_of(r)) return at;
        break;
      }
      if (distance(trials.front(), at) < settings.tolerance || lambda > largest_damping) return at;
      lambda *= 100.;
    }
  }
  return at;
}

std::vector<std::vector<double>> difference_places(const std::vector<double>& at, double h) {
  std::vector<std::vector<double>> places;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (const double side : {-1., 1.}) {
      places.push_back(at);
      places.back()[i] = std::clamp(at[i] + side * h, 0., 1.);
    }
  return places;
}

Eigen::MatrixXd derivatives(const std::vector<std::vector<double>>& places, const std::vector<Vector>& residuals) {
  const std::size_t d = places.size() / 2;
  for (const auto& r : residuals)
    if (!std::isfinite(cost_of(r))) return {};
  Eigen::MatrixXd J(residuals.front().size(), static_cast<Eigen::Index>(d));
  for (std::size_t i = 0; i < d; ++i)
    J.col(static_cast<Eigen::Index>(i)) =
        (residuals[2 * i + 1] - residuals[2 * i]) / (places[2 * i + 1][i] - places[2 * i][i]);
  return J;
}

}  // namespace rotordrop
