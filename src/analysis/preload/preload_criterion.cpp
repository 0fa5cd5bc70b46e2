#include "analysis/preload/preload_criterion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

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

struct Sample {
  double heat = 0, made = 0;
  std::vector<double> T;
  LimitMet met = LimitMet::none;
  [[nodiscard]] double excess() const { return made - heat; }
  [[nodiscard]] bool has_state() const { return met != LimitMet::no_state; }
};

/// T(Q), Phi(Q), from the sample before. Rolling balls may have several steady states under one heat, with and without load: under a heat no less than the sample
/// before both ways end in the same one, otherwise the way is from cold, as the bearing's own.
class Samples {
 public:
  Samples(const PreloadLoop& loop, const PreloadLimits& limits) : loop_(loop), limits_(limits), start_(loop.cold()) {}
  Sample operator()(double heat) {
    Sample s;
    s.heat = heat;
    if (heat == 0. || (loop_.bearing().balls_roll() && heat < start_heat_)) {
      start_ = loop_.cold();
      start_heat_ = 0.;
    }
    RunningState state;
    try {
      if (heat > 0.) approach(heat, 6);
      state = loop_.state(start_);
    } catch (const SolverError&) {
      if (heat == 0.) throw;
      s.made = NAN;
      s.met = LimitMet::no_state;
      return s;
    }
    s.T = start_;
    s.made = state.heat;
    s.met = limit_met(loop_, limits_, s.T, state);
    return s;
  }

 private:
  /// From the sample before, by way of heats between where one step is too long.
  void approach(double heat, int n_halvings) {
    std::vector<double> T;
    try {
      T = loop_.steady(heat, start_);
    } catch (const SolverError&) {
      if (n_halvings == 0) throw;
      approach(0.5 * (start_heat_ + heat), n_halvings - 1);
      T = loop_.steady(heat, start_);
    }
    start_ = std::move(T);
    start_heat_ = heat;
  }

  const PreloadLoop& loop_;
  const PreloadLimits& limits_;
  std::vector<double> start_;
  double start_heat_ = 0;
};

/// Largest heat within the limits that has a steady state [W].
double largest_heat(Samples& sample, double first, LimitMet& met) {
  double inside = 0., outside = std::max(first, 1e-3);
  for (int i = 0; i < 60; ++i) {
    met = sample(outside).met;
    if (met != LimitMet::none) break;
    inside = outside;
    outside *= 2.;
  }
  if (met == LimitMet::none) return inside;
  while (outside - inside > 1e-6 * outside && outside > 1e-9) {
    const double middle = 0.5 * (inside + outside);
    const LimitMet there = sample(middle).met;
    if (there != LimitMet::none) met = there;
    (there == LimitMet::none ? inside : outside) = middle;
  }
  return inside;
}

/// Phi(Q) - Q changes its sign between a and b. Nothing where it jumps: balls of a steady state may lose their load, and with it their heat conduction, all at once.
std::optional<Sample> crossing(Samples& sample, Sample a, Sample b) {
  while (b.heat - a.heat > 1e-12 * b.heat) {
    const double middle = 0.5 * (a.heat + b.heat);
    if (middle <= a.heat || middle >= b.heat) break;
    Sample m = sample(middle);
    if (!m.has_state()) return {};
    ((m.excess() > 0.) == (a.excess() > 0.) ? a : b) = std::move(m);
  }
  if (std::fabs(b.excess()) > 1e-5 * b.heat) return {};
  return b;
}

/// Two operating points may lie between neighbouring samples: where Phi(Q) - Q turns back towards zero without reaching it, the turning
/// point is looked for by golden section, and added.
std::vector<Sample> with_turning_points(Samples& sample, std::vector<Sample> line) {
  constexpr double golden = 0.3819660112501051;
  std::vector<Sample> all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    all.push_back(line[i]);
    if (i == 0 || i + 1 >= line.size()) continue;
    const double sign = line[i].excess() > 0. ? 1. : -1.;
    const auto height = [&](const Sample& s) { return sign * s.excess(); };
    if (height(line[i]) > height(line[i - 1]) || height(line[i]) > height(line[i + 1])) continue;
    if (height(line[i - 1]) <= 0. || height(line[i + 1]) <= 0.) continue;
    double low = line[i - 1].heat, high = line[i + 1].heat;
    Sample a = sample(low + golden * (high - low)), b = sample(high - golden * (high - low));
    while (height(a) > 0. && height(b) > 0. && high - low > 1e-7 * high) {
      if (height(a) < height(b)) {
        high = b.heat;
        b = a;
        a = sample(low + golden * (high - low));
      } else {
        low = a.heat;
        a = b;
        b = sample(high - golden * (high - low));
      }
    }
    Sample& turn = height(a) < height(b) ? a : b;
    if (!turn.has_state() || height(turn) >= height(line[i])) continue;
    if (turn.heat < all.back().heat)
      all.insert(all.end() - 1, std::move(turn));
    else
      all.push_back(std::move(turn));
  }
  return all;
}

OperatingPoint point_of(const PreloadLoop& loop, const Sample& s) {
  OperatingPoint p;
  p.heat = s.heat;
  p.T = s.T;
  p.highest_temperature = loop.highest_temperature(s.T, s.heat);
  p.state = loop.state(s.T);
  p.growth = loop.growth(s.T);
  p.response = response_at(loop, s.T);
  return p;
}

}  // namespace

LimitMet limit_met(const PreloadLoop& loop, const PreloadLimits& limits, std::span<const double> T,
                   const RunningState& state) {
  if (state.largest_pressure > limits.pressure) return LimitMet::pressure;
  if (loop.highest_temperature(T, state.heat) > limits.temperature) return LimitMet::temperature;
  return LimitMet::none;
}

LoopResponse response_at(const PreloadLoop& loop, std::span<const double> T) {
  const std::size_t n = loop.size();
  const auto rows = static_cast<Eigen::Index>(n);
  const double heat = loop.state(T).heat;
  const auto J_values = loop.jacobian(T, heat);
  const Eigen::Map<const Matrix> J(J_values.data(), rows, rows);
  Eigen::VectorXd b(rows), with(rows), c(rows), preload_by_T(rows);
  loop.rates(T, heat, {b.data(), n});
  loop.rates(T, heat + 1., {with.data(), n});
  b = with - b;

  const Expansion growth = loop.growth(T);
  const Gradients gradients = gradients_at(loop.bearing(), growth);
  std::vector<Expansion> growth_by_T(n);
  std::vector<double> warmer(T.begin(), T.end());
  for (std::size_t k = 0; k < n; ++k) {
    warmer[k] += 1.;
    growth_by_T[k] = combined(1., loop.growth(warmer), -1., growth);
    warmer[k] = T[k];
    c[static_cast<Eigen::Index>(k)] = gradients.heat.dot(growth_by_T[k]);
    preload_by_T[static_cast<Eigen::Index>(k)] = gradients.preload.dot(growth_by_T[k]);
  }

  LoopResponse r;
  const Eigen::VectorXd T_by_heat = -J.partialPivLu().solve(b);
  r.gain = c.dot(T_by_heat);
  r.preload_per_heat = preload_by_T.dot(T_by_heat);
  if (r.preload_per_heat != 0.) r.heat_per_preload = r.gain / r.preload_per_heat;
  for (std::size_t k = 0; k < n; ++k)
    r.growth_per_heat = combined(1., r.growth_per_heat, T_by_heat[static_cast<Eigen::Index>(k)], growth_by_T[k]);

  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(J + b * c.transpose(), false).eigenvalues();
  r.eigenvalue =
      *std::max_element(values.begin(), values.end(), [](const auto& x, const auto& y) { return x.real() < y.real(); });
  r.largest_gain = r.gain;
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

const OperatingPoint* OperatingPoints::first_stable() const {
  const auto found = std::find_if(points.begin(), points.end(), [](const auto& p) { return p.response.is_stable(); });
  return found == points.end() ? nullptr : &*found;
}

OperatingPoints find_operating_points(const PreloadLoop& loop, const PreloadLimits& limits) {
  constexpr int n_samples = 120;
  OperatingPoints found;
  Samples sample(loop, limits);
  std::vector<Sample> line = {sample(0.)};
  found.ended_by = line.front().met;
  if (found.ended_by == LimitMet::none) {
    const double end = largest_heat(sample, line.front().made, found.ended_by);
    for (int i = 1; i <= n_samples && end > 0.; ++i) {
      Sample s = sample(end * std::pow(i / static_cast<double>(n_samples), 1.5));
      if (s.has_state())
        line.push_back(std::move(s));
      else
        ++found.n_without_state;
    }
    line = with_turning_points(sample, std::move(line));
    const auto add = [&](const Sample& s) {
      try {
        found.points.push_back(point_of(loop, s));
      } catch (const SolverError&) {  // no state just beside it, and so no response
        ++found.n_without_state;
      }
    };
    if (line.front().excess() == 0.) add(line.front());  // it makes no heat at all
    for (std::size_t i = 1; i < line.size(); ++i)
      if (line[i - 1].excess() != 0. && (line[i].excess() > 0.) != (line[i - 1].excess() > 0.))
        if (const auto at = crossing(sample, line[i - 1], line[i])) add(*at);
  }
  for (const auto& s : line) {
    found.heat.push_back(s.heat);
    found.made.push_back(s.made);
  }
  return found;
}

std::optional<CriticalFactor> find_critical_factor(
    const std::function<std::unique_ptr<PreloadLoop>(double factor)>& loop_with, double towards,
    const PreloadLimits& limits) {
  const auto points_at = [&](double factor) {
    try {
      return find_operating_points(*loop_with(factor), limits);
    } catch (const SolverError&) {  // no rest of the bearing, not even a cold one
      OperatingPoints none;
      none.ended_by = LimitMet::no_state;
      return none;
    }
  };
  const auto is_good = [](const OperatingPoints& p) { return p.first_stable() != nullptr; };
  double good = 1., bad = 1.;
  OperatingPoints last_good = points_at(1.), first_bad = last_good;
  const bool starts_good = is_good(last_good);
  for (int i = 0; i < 6; ++i) {
    const double next = starts_good ? good * towards : bad / towards;
    auto points = points_at(next);
    const bool fine = is_good(points);
    (fine ? good : bad) = next;
    (fine ? last_good : first_bad) = std::move(points);
    if (fine != starts_good) break;
  }
  if (!is_good(last_good) || is_good(first_bad)) return {};
  while (std::fabs(good - bad) > 1e-4 * good) {
    const double middle = std::sqrt(good * bad);
    auto points = points_at(middle);
    const bool fine = is_good(points);
    (fine ? good : bad) = middle;
    (fine ? last_good : first_bad) = std::move(points);
  }
  CriticalFactor critical;
  critical.factor = good;
  critical.gain = last_good.first_stable()->response.gain;
  // Just beyond, heat made comes closest to heat in balance at the limit, or before it (the loop's doing).
  double least = HUGE_VAL;
  std::size_t at = 0;
  for (std::size_t i = 0; i < first_bad.heat.size(); ++i)
    if (const double excess = first_bad.made[i] - first_bad.heat[i]; excess < least) {
      least = excess;
      at = i;
    }
  if (first_bad.points.empty() && (first_bad.heat.empty() || at + 1 == first_bad.heat.size()))
    critical.by = first_bad.ended_by == LimitMet::no_state ? CriticalFactor::By::no_state : CriticalFactor::By::limit;
  return critical;
}

}  // namespace rotordrop
