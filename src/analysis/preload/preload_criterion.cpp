#include "analysis/preload/preload_criterion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "analysis/preload/folded_rests.h"
#include "analysis/preload/turning_point.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

struct Sample {
  double heat = 0, made = 0;
  std::vector<double> T;
  LimitMet met = LimitMet::none;
  [[nodiscard]] double excess() const { return made - heat; }
  [[nodiscard]] bool has_state() const { return met != LimitMet::no_state; }
};

/// T(Q), Phi(Q) on the way of steady states that begins cold. Rolling balls may have several under one heat, with and without load: each is found from the nearest
/// known one under no more heat, where the way up and the one from cold end in the same.
class Samples {
 public:
  Samples(const PreloadLoop& loop, const PreloadLimits& limits)
      : loop_(loop), limits_(limits), known_{{0., loop.cold()}} {}
  Sample operator()(double heat) {
    Sample s;
    s.heat = heat;
    RunningState state;
    try {
      s.T = steady(heat, 6);
      state = loop_.state(s.T);
    } catch (const SolverError&) {
      if (heat == 0.) throw;
      s.made = NAN;
      s.met = LimitMet::no_state;
      return s;
    }
    s.made = state.heat;
    s.met = limit_met(loop_, limits_, s.T, state);
    return s;
  }

 private:
  /// By way of heats between where one step is too long.
  const std::vector<double>& steady(double heat, int n_halvings) {
    const auto& [before, start] = *std::prev(known_.upper_bound(heat));
    if (before == heat) return start;
    try {
      return known_[heat] = loop_.steady(heat, start);
    } catch (const SolverError&) {
      if (n_halvings == 0) throw;
      return known_[heat] = loop_.steady(heat, steady(0.5 * (before + heat), n_halvings - 1));
    }
  }

  const PreloadLoop& loop_;
  const PreloadLimits& limits_;
  std::map<double, std::vector<double>> known_;  // T by Q
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

/// Where Phi(Q) - Q changes its sign between a and b, by halving; nothing where it jumps, or no steady state is found: then a and b stand on both sides of that.
std::optional<Sample> crossing(Samples& sample, Sample& a, Sample& b) {
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

/// Whether T(Q) jumps between a and b, because balls lose their load, or find it, all at once; then a and b stand on both sides of that.
bool find_jump(Samples& sample, const PreloadLoop& loop, Sample& a, Sample& b) {
  if (!loop.bearing().balls_roll()) return false;
  constexpr double change = 0.3;  // of what balls conduct: neighbours on one branch differ by some hundredths
  const auto conduct = [&](const Sample& s) { return sum_of(loop.balls(s.T)); };
  double of_a = conduct(a), of_b = conduct(b);
  const double at_first = std::fabs(of_b - of_a);
  if (at_first <= change * std::max(of_a, of_b)) return false;
  while (b.heat - a.heat > 1e-5 * b.heat) {
    Sample m = sample(0.5 * (a.heat + b.heat));
    if (!m.has_state()) return true;
    const double of_m = conduct(m);
    if (std::fabs(of_m - of_a) > std::fabs(of_b - of_m)) {
      b = std::move(m);
      of_b = of_m;
    } else {
      a = std::move(m);
      of_a = of_m;
    }
    // Balls that just touch conduct with the cube root of a load: steep, but no jump.
    if (std::fabs(of_b - of_a) < 0.3 * at_first) return false;
  }
  return true;
}

/// Two operating points may lie between neighbouring samples: where Phi(Q) - Q turns back towards zero without reaching it, the turning
/// point is looked for by golden section, and added.
std::vector<Sample> with_turning_points(Samples& sample, std::vector<Sample> line) {
  std::vector<Sample> all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    all.push_back(line[i]);
    if (i == 0 || i + 1 >= line.size()) continue;
    const double sign = line[i].excess() > 0. ? 1. : -1.;
    const auto height = [&](const Sample& s) { return sign * s.excess(); };
    if (height(line[i]) > height(line[i - 1]) || height(line[i]) > height(line[i + 1])) continue;
    if (height(line[i - 1]) <= 0. || height(line[i + 1]) <= 0.) continue;
    const double high = line[i + 1].heat;
    Sample turn = turning_point(
        sample, [](const Sample& p) { return p.heat; }, height, line[i - 1].heat, high, 1e-7 * high);
    if (!turn.has_state() || height(turn) >= height(line[i])) continue;
    if (turn.heat < all.back().heat)
      all.insert(all.end() - 1, std::move(turn));
    else
      all.push_back(std::move(turn));
  }
  return all;
}

OperatingPoint point_of(const PreloadLoop& loop, std::span<const double> T, double heat) {
  OperatingPoint p;
  p.heat = heat;
  p.T.assign(T.begin(), T.end());
  p.highest_temperature = loop.highest_temperature(T, heat);
  p.state = loop.state(T);
  p.growth = loop.growth(T);
  p.response = response_at(loop, T);
  return p;
}

double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0.;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return largest;
}

/// The operating point in a place, if it is among them.
std::optional<std::size_t> point_at(const std::vector<OperatingPoint>& points, std::span<const double> T,
                                    double tolerance) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distance(points[i].T, T) < tolerance) return i;
  return {};
}

/// Two that are found in two ways are one if they are as near as this, per kelvin of rise: between what both ways leave (1e-9) and what is left between two points about to meet.
constexpr double same_point = 1e-5;

/// Limits so much higher that a point which has just passed one is within them, as the search for a critical factor ends within 1e-4.
PreloadLimits limits_beyond(const PreloadLimits& limits, double ambient) {
  constexpr double more = 0.01;
  return {limits.temperature + more * (limits.temperature - ambient), (1. + more) * limits.pressure};
}

}  // namespace

LimitMet limit_met(const PreloadLoop& loop, const PreloadLimits& limits, std::span<const double> T,
                   const RunningState& state) {
  if (state.largest_pressure > limits.pressure) return LimitMet::pressure;
  if (loop.highest_temperature(T, state.heat) > limits.temperature) return LimitMet::temperature;
  return LimitMet::none;
}

const OperatingPoint* OperatingPoints::first_stable() const {
  const auto found = std::find_if(points.begin(), points.end(), [](const auto& p) { return p.response.is_stable(); });
  return found == points.end() ? nullptr : &*found;
}

OperatingPoints find_operating_points(const PreloadLoop& loop, const PreloadLimits& limits, Wanted wanted) {
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
    bool has_jumped = false;  // from then on a point may be found in two ways
    const auto add = [&](std::span<const double> T, double heat) {
      const double rise = std::fabs(T[0] - line.front().T[0]);
      if (has_jumped && point_at(found.points, T, same_point * (1. + rise))) return;
      try {
        found.points.push_back(point_of(loop, T, heat));
      } catch (const SolverError&) {  // no state just beside it, and so no response
        ++found.n_without_state;
      }
    };
    if (line.front().excess() == 0.) add(line.front().T, 0.);  // it makes no heat at all
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (wanted == Wanted::up_to_stable && found.first_stable()) break;
      Sample a = line[i - 1], b = line[i];
      const bool changes_sign = a.excess() != 0. && (b.excess() > 0.) != (a.excess() > 0.);
      const auto at = changes_sign ? crossing(sample, a, b) : std::nullopt;
      if (at) {
        add(at->T, at->heat);
      } else if (changes_sign || find_jump(sample, loop, a, b)) {
        has_jumped = true;
        for (const auto& T : rests_between(loop, a.T, b.T)) {
          const RunningState state = loop.state(T);
          if (limit_met(loop, limits, T, state) == LimitMet::none) add(T, state.heat);
        }
      }
    }
  }
  for (const auto& s : line) {
    found.heat.push_back(s.heat);
    found.made.push_back(s.made);
  }
  return found;
}

std::optional<std::size_t> add_settled(const PreloadLoop& loop, std::span<const double> T, OperatingPoints& points) {
  constexpr double near = 0.05;  // of the rise: what is left of the slowest mode
  const double rise = std::fabs(T[0] - loop.cold()[0]);
  try {
    if (const auto rest = rest_near(loop, T)) {
      if (const auto known = point_at(points.points, *rest, same_point * (1. + rise))) return known;
      points.points.push_back(point_of(loop, *rest, loop.state(*rest).heat));
      return points.points.size() - 1;
    }
    // Balls that touch by picometres have no slope for Newton's method.
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < points.points.size(); ++i)
      if (distance(points.points[i].T, T) < (nearest ? distance(points.points[*nearest].T, T) : near * (1. + rise)))
        nearest = i;
    return nearest;
  } catch (const SolverError&) {
    return {};
  }
}

std::optional<CriticalFactor> find_critical_factor(
    const std::function<std::unique_ptr<PreloadLoop>(double factor)>& loop_with, double towards,
    const PreloadLimits& limits) {
  const auto points_at = [&](double factor, const PreloadLimits& within) {
    try {
      return find_operating_points(*loop_with(factor), within, Wanted::up_to_stable);
    } catch (const SolverError&) {  // no rest of the bearing, not even a cold one
      OperatingPoints none;
      none.ended_by = LimitMet::no_state;
      return none;
    }
  };
  const auto is_good = [](const OperatingPoints& p) { return p.first_stable() != nullptr; };
  double good = 1., bad = 1.;
  OperatingPoints last_good = points_at(1., limits), first_bad = last_good;
  const bool starts_good = is_good(last_good);
  for (int i = 0; i < 6; ++i) {
    const double next = starts_good ? good * towards : bad / towards;
    auto points = points_at(next, limits);
    const bool fine = is_good(points);
    (fine ? good : bad) = next;
    (fine ? last_good : first_bad) = std::move(points);
    if (fine != starts_good) break;
  }
  if (!is_good(last_good) || is_good(first_bad)) return {};
  while (std::fabs(good - bad) > 1e-4 * good) {
    const double middle = std::sqrt(good * bad);
    auto points = points_at(middle, limits);
    const bool fine = is_good(points);
    (fine ? good : bad) = middle;
    (fine ? last_good : first_bad) = std::move(points);
  }
  CriticalFactor critical;
  critical.factor = good;
  critical.gain = last_good.first_stable()->response.gain;
  // Just beyond, a stable point is there still if limits alone ended it.
  const PreloadLimits wider = limits_beyond(limits, loop_with(bad)->cold()[0]);
  if (is_good(points_at(bad, wider)))
    critical.by = CriticalFactor::By::limit;
  else if (first_bad.points.empty() && first_bad.ended_by == LimitMet::no_state)
    critical.by = CriticalFactor::By::no_state;
  return critical;
}

}  // namespace rotordrop
