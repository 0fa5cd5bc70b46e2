#include "analysis/preload/folded_rests.h"

#include <algorithm>
#include <cmath>

#include "analysis/preload/turning_point.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

/// A place along s.
struct Place {
  double s = 0, height = 0;  ///< s and h(s) [m]
  std::vector<double> T;
};

class Line {
 public:
  Line(const PreloadLoop& loop, const Expansion& c, std::span<const double> start)
      : loop_(loop), c_(c), T_(start.begin(), start.end()) {}

  [[nodiscard]] double along(std::span<const double> T) const { return c_.dot(loop_.growth(T)); }
  /// T(s) from the place before. @throws SolverError
  Place operator()(double s) {
    constexpr int most_passes = 30;
    Expansion growth = at(s);
    for (int pass = 0; pass < most_passes; ++pass) {
      const RunningState state = loop_.bearing().at(growth);
      loop_.relax(state.heat, state.balls, 1e-9, T_);
      const Expansion next = at(s), change = combined(1., next, -1., growth);
      growth = next;
      if (std::sqrt(change.dot(change)) < 1e-15) break;
    }
    return {s, along(T_) - s, T_};
  }
  bool is_loaded(double s) {
    (*this)(s);
    return sum_of(loop_.bearing().at(at(s)).balls) > 0.;
  }

 private:
  /// Growth of the temperatures at hand, but for s.
  [[nodiscard]] Expansion at(double s) const {
    const Expansion growth = loop_.growth(T_);
    return combined(1., growth, s - c_.dot(growth), c_);
  }

  const PreloadLoop& loop_;
  Expansion c_;
  std::vector<double> T_;
};

bool differ(const Place& a, const Place& b) { return (a.height > 0.) != (b.height > 0.); }

/// Bracketed, as steep as balls conduct that just touch. False position as Illinois takes it, and halving in turns.
Place root_of(Line& line, Place a, Place b) {
  double height_a = a.height;
  for (int i = 0; i < 200 && std::fabs(b.s - a.s) > 1e-19 && b.height != 0.; ++i) {
    const double m = i % 3 == 2 ? 0.5 * (a.s + b.s) : b.s - b.height * (b.s - a.s) / (b.height - height_a);
    Place next = line(m);
    if (differ(next, b)) {
      a = std::move(b);
      height_a = a.height;
    } else {
      height_a *= 0.5;
    }
    b = std::move(next);
    if (std::fabs(b.height) < 1e-16) break;
  }
  return b;
}

/// Two roots may lie between places: where |h| turns back before it is zero, its least value is looked for by golden section.
void add_turning_points(Line& line, std::vector<Place>& places) {
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const double sign = places[i].height > 0. ? 1. : -1.;
    const auto distance = [&](const Place& p) { return sign * p.height; };
    if (differ(places[i - 1], places[i]) || differ(places[i], places[i + 1])) continue;
    if (distance(places[i]) > std::min(distance(places[i - 1]), distance(places[i + 1]))) continue;
    const double low = places[i - 1].s, high = places[i + 1].s;
    Place turn = turning_point(
        line, [](const Place& p) { return p.s; }, distance, low, high, 1e-6 * (high - low));
    if (distance(turn) > 0.) continue;
    places.insert(places.begin() + static_cast<std::ptrdiff_t>(turn.s < places[i].s ? i : i + 1), std::move(turn));
    ++i;
  }
}

}  // namespace

std::optional<Expansion> closing_direction(const PreloadLoop& loop, std::span<const double> T) {
  constexpr double step = 1e-7;  // [m]
  const Expansion growth = loop.growth(T);
  Expansion c;
  for (const auto surface : growth_surfaces) {
    Expansion more = growth, less = growth;
    more.*surface += step;
    less.*surface -= step;
    c.*surface = sum_of(loop.bearing().at(more).balls) - sum_of(loop.bearing().at(less).balls);
  }
  const double length = std::sqrt(c.dot(c));
  if (length == 0.) return {};
  return combined(1. / length, c, 0., c);
}

std::vector<std::vector<double>> rests_between(const PreloadLoop& loop, std::span<const double> a,
                                               std::span<const double> b) {
  constexpr int n_places = 100;
  std::vector<std::vector<double>> found;
  const bool a_is_more = sum_of(loop.balls(a)) > sum_of(loop.balls(b));
  const auto more = a_is_more ? a : b, less = a_is_more ? b : a;
  try {
    const auto c = closing_direction(loop, more);
    if (!c) return found;
    Line line(loop, *c, less);
    const double low = line.along(less), high = line.along(more);
    if (!(low < high)) return found;
    // Balls without load conduct and rub the same whatever the gap: h is a straight line there. Where they begin to touch, places lie the closer.
    double touch = low;
    if (!line.is_loaded(low)) {
      double loaded = high;
      while (loaded - touch > 1e-6 * (high - low)) {
        const double middle = 0.5 * (touch + loaded);
        (line.is_loaded(middle) ? loaded : touch) = middle;
      }
    }
    std::vector<Place> places = {line(low)};
    if (touch > low) places.push_back(line(touch));
    for (int i = 1; i <= n_places; ++i) {
      const double part = i / static_cast<double>(n_places);
      places.push_back(line(touch + part * part * (high - touch)));
    }
    add_turning_points(line, places);
    for (std::size_t i = 1; i < places.size(); ++i)
      if (differ(places[i - 1], places[i])) found.push_back(root_of(line, places[i - 1], places[i]).T);
  } catch (const SolverError&) {  // no equilibrium of the bearing, or no temperatures: what was found counts
  }
  if (a_is_more) std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace rotordrop
