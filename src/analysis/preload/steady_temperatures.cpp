// Steady temperatures under a given heat: what balls conduct follows from growth, and growth from temperatures.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analysis/preload/folded_rests.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::PartialPivLU<Matrix> inverse(const std::vector<double>& J, Eigen::Index n) {
  return Eigen::Map<const Matrix>(J.data(), n, n).partialPivLu();
}

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
  [[nodiscard]] double rise(const std::vector<double>& T) const { return std::fabs(T[0] - loop_.cold()[0]); }
  static void subtract(const Eigen::VectorXd& step, std::vector<double>& T) {
    for (std::size_t k = 0; k < T.size(); ++k) T[k] -= step[static_cast<Eigen::Index>(k)];
  }

  bool creeps_to_rest(std::vector<double>& T, int n_steps) {
    for (int i = 0; i < n_steps; ++i) {
      const auto before = T;
      loop_.relax(heat_, loop_.balls(T), 0.1, T);
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
      const Eigen::VectorXd now = inverse(loop_.jacobian(T, heat_, true), n_).solve(F_);
      const double size = now.lpNorm<Eigen::Infinity>();
      // Newton's way with balls that lose their load leads anywhere.
      if (!std::isfinite(size) || size > 100.) return false;
      subtract(now, T);
      if (size < 1e-9 * (1. + rise(T))) return true;
    }
    return false;
  }

  /// A state between two others, the second of which follows from what the balls conduct in the first, and leads back. How far the balls are closed is one number, s: what they
  /// conduct follows from it, and from that the temperatures, which close them again. Its root is bracketed, however steep: balls that just touch conduct with the cube root of a load.
  bool between(const std::vector<double>& a, std::vector<double>& b) {
    const auto c = closing_direction(loop_, sum_of(loop_.balls(a)) > sum_of(loop_.balls(b)) ? a : b);
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
      loop_.relax(heat_, loop_.bearing().at(combined(1., from, s, c)).balls, 1e-9, T);
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

void PreloadLoop::relax(double heat, const BallConduction& held, double accuracy, std::vector<double>& T) const {
  constexpr int most_steps = 100;
  const auto n = static_cast<Eigen::Index>(size());
  const double ambient = cold()[0];
  const auto start = T;
  Eigen::VectorXd F(n);
  for (int i = 0; i < most_steps; ++i) {
    const auto J = inverse(jacobian_of_held_balls(T, heat, held), n);
    const auto step = [&]() -> Eigen::VectorXd {
      rates(T, heat, held, {F.data(), size()});
      return J.solve(F);
    };
    const Eigen::VectorXd now = step();
    double way = 0.;
    for (std::size_t k = 0; k < T.size(); ++k) {
      T[k] -= now[static_cast<Eigen::Index>(k)];
      way = std::max(way, std::fabs(T[k] - start[k]));
    }
    if (!std::isfinite(way)) break;
    const double next = step().lpNorm<Eigen::Infinity>();
    if (next <= std::max(accuracy * way, 1e-10 * (1. + std::fabs(T[0] - ambient)))) return;
  }
  throw SolverError(
      fmt::format("no steady temperatures under {:.6g} W were found: does every part of the bearing have a heat path "
                  "to ambient?",
                  heat));
}

std::vector<double> PreloadLoop::steady(double heat, std::span<const double> start) const {
  return Search(*this, heat).from(start);
}

}  // namespace rotordrop
