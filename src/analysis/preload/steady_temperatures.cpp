// Steady temperatures under a given heat: what balls conduct follows from growth, and growth from temperatures.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/preload/preload_loop.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double sum_of(const BallConduction& b) { return b.inner_to_ball + b.outer_to_ball + b.inner_to_outer; }

class Search {
 public:
  Search(const PreloadLoop& loop, double heat)
      : loop_(loop), heat_(heat), n_(static_cast<Eigen::Index>(loop.size())), F_(n_) {}

  std::vector<double> from(std::span<const double> start) {
    std::vector<double> T(start.begin(), start.end());
    // Balls that conduct better are warmer and more loaded: with conductances of the step before, steps fall (or rise) towards the nearest state without passing it, slowly where
    // a loaded state is about to vanish. There Newton's method helps; just beyond, steps creep past for long. Balls that conduct better may also be less loaded: then steps pass the
    // state to and fro, and it lies between them.
    for (const int n_steps : {25, 200, 600}) {
      if (creeps_to_rest(T, n_steps)) return T;
      auto near = T;
      if (newton(near)) return near;
    }
    // As near to where it vanishes as can be told: within 1e-5 of the heat.
    if (last_.lpNorm<Eigen::Infinity>() < 1e-2 * (1. + rise(T))) return T;
    throw SolverError(
        fmt::format("no steady temperatures under {:.6g} W were found: with what the balls carry there, they conduct "
                    "another heat.",
                    heat_));
  }

 private:
  using Lu = Eigen::PartialPivLU<Matrix>;

  [[nodiscard]] double rise(const std::vector<double>& T) const { return std::fabs(T[0] - loop_.cold()[0]); }
  [[nodiscard]] Lu inverse(const std::vector<double>& J) const {
    return Eigen::Map<const Matrix>(J.data(), n_, n_).partialPivLu();
  }
  Eigen::VectorXd step(const Lu& J, const std::vector<double>& T, const BallConduction& held) {
    loop_.rates(T, heat_, held, {F_.data(), loop_.size()});
    return J.solve(F_);
  }
  static void subtract(const Eigen::VectorXd& step, std::vector<double>& T) {
    for (std::size_t k = 0; k < T.size(); ++k) T[k] -= step[static_cast<Eigen::Index>(k)];
  }

  /// Temperatures while the balls conduct what they are told: Newton's method, until the next step would be `accuracy` times the way so far or less. From cold the film of the
  /// housing has hardly any slope, and one step alone leads thousands of kelvin too far.
  void relax(const BallConduction& held, double accuracy, std::vector<double>& T) {
    constexpr int most_steps = 100;
    const auto start = T;
    for (int i = 0; i < most_steps; ++i) {
      const Lu J = inverse(loop_.jacobian_of_held_balls(T, heat_, held));
      subtract(step(J, T, held), T);
      const double way = difference(T, start).lpNorm<Eigen::Infinity>();
      if (!std::isfinite(way)) break;
      const double next = step(J, T, held).lpNorm<Eigen::Infinity>();
      if (next <= std::max(accuracy * way, 1e-10 * (1. + rise(T)))) return;
    }
    throw SolverError(
        fmt::format("no steady temperatures under {:.6g} W were found: does every part of the bearing have a heat path "
                    "to ambient?",
                    heat_));
  }

  bool creeps_to_rest(std::vector<double>& T, int n_steps) {
    for (int i = 0; i < n_steps; ++i) {
      const auto before = T;
      relax(loop_.balls(T), 0.1, T);
      const Eigen::VectorXd moved = difference(T, before);
      const double size = moved.lpNorm<Eigen::Infinity>();
      if (size < 1e-9 * (1. + rise(T))) return true;
      const bool turns = last_.size() == n_ && moved.dot(last_) < 0. && size > 0.5 * last_.lpNorm<Eigen::Infinity>();
      last_ = moved;
      if (turns && between(before, T)) return true;
    }
    return false;
  }
  Eigen::VectorXd difference(const std::vector<double>& a, const std::vector<double>& b) const {
    return Eigen::Map<const Eigen::VectorXd>(a.data(), n_) - Eigen::Map<const Eigen::VectorXd>(b.data(), n_);
  }

  bool newton(std::vector<double>& T) {
    for (int i = 0; i < 20; ++i) {
      loop_.rates(T, heat_, {F_.data(), loop_.size()});
      const Eigen::VectorXd now = inverse(loop_.jacobian(T, heat_, true)).solve(F_);
      const double size = now.lpNorm<Eigen::Infinity>();
      // Newton's way with balls that lose their load leads anywhere.
      if (!std::isfinite(size) || size > 100.) return false;
      subtract(now, T);
      if (size < 1e-9 * (1. + rise(T))) return true;
    }
    return false;
  }

  /// By how much the balls conduct better per growth of each surface, as a direction of length 1; nothing without load.
  std::optional<Expansion> closing(const std::vector<double>& T) const {
    constexpr double step = 1e-7;  // [m]
    const Expansion growth = loop_.growth(T);
    Expansion c;
    for (const auto surface : growth_surfaces) {
      Expansion more = growth, less = growth;
      more.*surface += step;
      less.*surface -= step;
      c.*surface = sum_of(loop_.bearing().at(more).balls) - sum_of(loop_.bearing().at(less).balls);
    }
    const double length = std::sqrt(c.dot(c));
    if (length == 0.) return {};
    return combined(1. / length, c, 0., c);
  }

  /// A state between two others, the second of which follows from what the balls conduct in the first, and leads back. How far the balls are closed is one number, s: what they
  /// conduct follows from it, and from that the temperatures, which close them again. Its root is bracketed, however steep: balls that just touch conduct with the cube root of a load.
  bool between(const std::vector<double>& a, std::vector<double>& b) {
    const auto c = closing(sum_of(loop_.balls(a)) > sum_of(loop_.balls(b)) ? a : b);
    if (!c) return false;
    std::vector<double> T = a;
    for (int pass = 0; pass < 20; ++pass) {
      const auto before = T;
      if (!close(*c, loop_.growth(before), T)) return false;
      if (difference(T, before).lpNorm<Eigen::Infinity>() > 1e-7 * (1. + rise(T))) continue;
      b = T;
      return true;
    }
    return false;
  }
  bool close(const Expansion& c, const Expansion& from, std::vector<double>& T) {
    const auto excess = [&](double s) {
      relax(loop_.bearing().at(combined(1., from, s, c)).balls, 1e-9, T);
      return c.dot(loop_.growth(T)) - c.dot(from) - s;
    };
    double a = 0., f_a = excess(0.), b = f_a, f_b = excess(b);
    if (f_a == 0.) return true;
    if ((f_a > 0.) == (f_b > 0.)) return false;
    for (int i = 0; i < 200 && std::fabs(b - a) > 1e-19; ++i) {
      // False position as Illinois takes it, and halving in turns.
      const double m = i % 3 == 2 ? 0.5 * (a + b) : b - f_b * (b - a) / (f_b - f_a), f = excess(m);
      if (std::fabs(f) < 1e-16) break;
      if ((f > 0.) != (f_b > 0.)) {
        a = b;
        f_a = f_b;
      } else {
        f_a *= 0.5;
      }
      b = m;
      f_b = f;
    }
    return true;
  }

  const PreloadLoop& loop_;
  double heat_;
  Eigen::Index n_;
  Eigen::VectorXd F_, last_;
};

}  // namespace

std::vector<double> PreloadLoop::steady(double heat, std::span<const double> start) const {
  return Search(*this, heat).from(start);
}

}  // namespace rotordrop
