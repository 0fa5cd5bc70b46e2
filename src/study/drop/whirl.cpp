#include "study/drop/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "study/recorded_drop.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
constexpr double turn = 2. * std::numbers::pi;

/// Sums over the intervals between samples, from the first one on [n].
struct Sums {
  std::vector<double> area;     ///< twice the area swept in contact [m^2]
  std::vector<double> inertia;  ///< integral of r^2 dt in contact [m^2 s]
  std::vector<double> contact;  ///< time in contact [s]
  std::vector<double> angle;    ///< travelled, flights included [rad]
};

Sums sums_of(const ContactOrbit& o) {
  const std::size_t n = o.time.size();
  Sums s;
  for (auto* v : {&s.area, &s.inertia, &s.contact, &s.angle}) v->assign(n, 0.);
  for (std::size_t k = 1; k < n; ++k) {
    const double dt = o.time[k] - o.time[k - 1];
    const double cross = o.y[k - 1] * o.z[k] - o.z[k - 1] * o.y[k];
    const double dot = o.y[k - 1] * o.y[k] + o.z[k - 1] * o.z[k];
    const bool touches = o.penetration[k - 1] > 0. && o.penetration[k] > 0.;
    // The angle from the cross product's arc, not its sine: exact on a circle however few the samples.
    const double angle = std::atan2(cross, dot);
    const double r2 = 0.5 * (o.y[k - 1] * o.y[k - 1] + o.z[k - 1] * o.z[k - 1] + o.y[k] * o.y[k] + o.z[k] * o.z[k]);
    s.area[k] = s.area[k - 1] + (touches ? angle * r2 : 0.);
    s.inertia[k] = s.inertia[k - 1] + (touches ? r2 * dt : 0.);
    s.contact[k] = s.contact[k - 1] + (touches ? dt : 0.);
    s.angle[k] = s.angle[k - 1] + angle;
  }
  return s;
}

std::vector<double> window_speeds(const ContactOrbit& o, const Sums& s, double window) {
  const std::size_t n = o.time.size();
  std::vector<double> speed(n, std::numeric_limits<double>::quiet_NaN());
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < n; ++k) {
    while (o.time[first] < o.time[k] - 0.5 * window) ++first;
    while (last + 1 < n && o.time[last + 1] <= o.time[k] + 0.5 * window) ++last;
    const double inertia = s.inertia[last] - s.inertia[first];
    if (s.contact[last] > s.contact[first] && inertia > 0.) speed[k] = (s.area[last] - s.area[first]) / inertia;
  }
  return speed;
}

WhirlDirection direction_of(double speed, double spin, double slowest) {
  if (!(std::fabs(speed) > slowest) || spin == 0.) return WhirlDirection::none;
  return speed * spin > 0. ? WhirlDirection::forward : WhirlDirection::backward;
}

/// Largest mean speed over one whole turn between samples `from` and `to`, and whether contact held through one.
void look_at_turns(const ContactOrbit& o, const Sums& s, std::size_t from, std::size_t to, WhirlStretch& stretch) {
  const double sign = s.angle[to] > s.angle[from] ? 1. : -1.;
  // The farthest so far: it never runs back, as the angle itself may for a moment.
  std::vector<double> reached(to - from + 1);
  reached[0] = 0.;
  for (std::size_t i = 1; i < reached.size(); ++i)
    reached[i] = std::max(reached[i - 1], sign * (s.angle[from + i] - s.angle[from]));
  std::size_t k = 1;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    while (k < reached.size() && reached[k] - reached[i] < turn) ++k;
    if (k == reached.size()) return;
    const double part = (reached[i] + turn - reached[k - 1]) / (reached[k] - reached[k - 1]);
    const double begin = o.time[from + i], before = o.time[from + k - 1], after = o.time[from + k];
    stretch.fastest = std::max(stretch.fastest, turn / (before + part * (after - before) - begin));
    // Sums of the same intervals, apart from rounding.
    stretch.is_full_rub |= s.contact[from + k] - s.contact[from + i] >= (1. - 1e-9) * (after - begin);
  }
}

std::optional<WhirlStretch> stretch_of(const ContactOrbit& o, const Sums& s, std::size_t from, std::size_t to,
                                       WhirlDirection direction) {
  // The window sees a contact half its length ahead and behind: a whirl begins and ends in contact, never in the flight before or after.
  while (from < to && !(o.penetration[from] > 0.)) ++from;
  while (to > from && !(o.penetration[to] > 0.)) --to;
  const double angle = s.angle[to] - s.angle[from];
  const bool is_that_way = (angle * o.spin_speed[from] > 0.) == (direction == WhirlDirection::forward);
  if (!is_that_way || std::fabs(angle) < turn) return std::nullopt;
  WhirlStretch stretch{direction, o.time[from], o.time[to], std::fabs(angle) / turn, s.contact[to] - s.contact[from]};
  look_at_turns(o, s, from, to, stretch);
  return stretch;
}

template <class Better>
const WhirlStretch* best_of(const std::vector<WhirlStretch>& stretches, Better better) {
  const WhirlStretch* best = nullptr;
  for (const auto& s : stretches)
    if (better(s, best)) best = &s;
  return best;
}

/// Nine digits: rows within a step are interpolated, and a resumed run's differ from an uninterrupted one's by roundoff.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

}  // namespace

std::string to_string(WhirlDirection direction) {
  return direction == WhirlDirection::forward ? "forward" : direction == WhirlDirection::backward ? "backward" : "none";
}

const WhirlStretch* ContactWhirl::longest() const {
  return best_of(stretches, [](const auto& s, const auto* best) { return !best || s.turns > best->turns; });
}

const WhirlStretch* ContactWhirl::fastest_backward() const {
  return best_of(stretches, [](const auto& s, const auto* best) {
    return s.direction == WhirlDirection::backward && (!best || s.fastest > best->fastest);
  });
}

bool ContactWhirl::has_full_backward_rub() const {
  return std::any_of(stretches.begin(), stretches.end(),
                     [](const auto& s) { return s.direction == WhirlDirection::backward && s.is_full_rub; });
}

ContactWhirl find_whirl(const ContactOrbit& o, const WhirlOptions& options) {
  const std::size_t n = o.time.size();
  for (const auto& v : {o.y, o.z, o.penetration, o.spin_speed})
    if (v.size() != n) throw std::invalid_argument("find_whirl: series of different lengths");
  ContactWhirl whirl;
  if (n < 2) return whirl;
  const Sums s = sums_of(o);
  whirl.speed = window_speeds(o, s, options.window);
  whirl.contact_time = s.contact.back();
  double longest_step = 0.;
  for (std::size_t k = 1; k < n; ++k) longest_step = std::max(longest_step, o.time[k] - o.time[k - 1]);
  whirl.fastest_resolved = 0.25 * turn / options.row_interval.value_or(longest_step);

  std::size_t start = 0;
  auto current = direction_of(whirl.speed[0], o.spin_speed[0], options.slowest);
  for (std::size_t k = 1; k <= n; ++k) {
    const auto direction =
        k < n ? direction_of(whirl.speed[k], o.spin_speed[k], options.slowest) : WhirlDirection::none;
    if (k < n) {
      const double contact = s.contact[k] - s.contact[k - 1];
      if (direction == WhirlDirection::forward) whirl.forward_time += contact;
      if (direction == WhirlDirection::backward) whirl.backward_time += contact;
    }
    if (k < n && direction == current) continue;
    if (current != WhirlDirection::none)
      if (auto stretch = stretch_of(o, s, start, k - 1, current)) {
        if (current == WhirlDirection::backward) whirl.backward_whirl_time += stretch->contact_time;
        whirl.stretches.push_back(*stretch);
      }
    start = k;
    current = direction;
  }
  return whirl;
}

namespace {

/// c a'^2 / g at the bottom with which N just touches zero at the top; below zero if less than rest will do.
double full_rub_start(double mu) {
  const double A = (2. - 4. * mu * mu) / (1. + 4. * mu * mu);
  return A + (1. + A) * std::exp(-turn * mu);
}

}  // namespace

double full_rub_speed(double mu, double air_gap, double gravity) {
  return std::sqrt(std::max(full_rub_start(mu), 0.) * gravity / air_gap);
}

double full_rub_friction() {
  double low = 0., high = 2.;
  for (int i = 0; i < 60; ++i) {
    const double mu = 0.5 * (low + high);
    (full_rub_start(mu) < 0. ? high : low) = mu;
  }
  return high;
}

double friction_that_sustains_whirl(std::complex<double> receptance) {
  if (!(receptance.real() < 0.)) return std::numeric_limits<double>::infinity();
  return std::fabs(receptance.imag() / receptance.real());
}

std::vector<std::string> series_of_whirl(const std::string& bearing) {
  const std::string at = "/bearings/" + bearing + "/";
  return {"/rotor/spin_speed", at + "orbit", at + "penetration"};
}

ContactWhirl recorded_whirl(const RecordedDrop& drop, const std::string& bearing, const WhirlOptions& options) {
  const std::string prefix = "/bearings/" + bearing + "/";
  const auto& times = drop.table("/time").values;
  const auto& spin = drop.table("/rotor/spin_speed").values;
  const auto& orbit = drop.table(prefix + "orbit").values;
  const auto& penetration = drop.table(prefix + "penetration").values;
  std::size_t n = std::min({times.size(), spin.size(), orbit.size() / 2, penetration.size()});
  std::vector<double> y(n), z(n);
  for (std::size_t k = 0; k < n; ++k) {
    y[k] = orbit[2 * k];
    z[k] = orbit[2 * k + 1];
    if (!std::isfinite(y[k] + z[k] + penetration[k] + spin[k])) n = k;
  }
  const auto cut = [n](const std::vector<double>& v) { return std::span(v).first(n); };
  return find_whirl({cut(times), cut(y), cut(z), cut(penetration), cut(spin)}, options);
}

WhirlSummary whirl_summary(const RecordedDrop& drop, const std::string& bearing) {
  const auto& p = drop.parameters();
  const ContactWhirl w = recorded_whirl(drop, bearing, {.row_interval = p.output.interval});
  WhirlSummary s;
  if (const WhirlStretch* longest = w.longest()) s.longest = *longest;
  if (const WhirlStretch* fastest = w.fastest_backward()) s.largest_backward_speed = fastest->fastest;
  s.contact_time = w.contact_time;
  s.forward_time = w.forward_time;
  s.backward_time = w.backward_time;
  s.backward_whirl_time = w.backward_whirl_time;
  s.has_full_rub = w.has_full_backward_rub();
  s.fastest_resolved = w.fastest_resolved;
  s.friction_coefficient = p.contact.friction_coefficient;
  s.friction_from_rest = full_rub_friction();
  s.speed_at_bottom = full_rub_speed(s.friction_coefficient, air_gap(touchdown_of(p, bearing), p.contact),
                                     std::hypot(p.run.gravity[1], p.run.gravity[2]));
  return s;
}

Json whirl_json(const WhirlSummary& w) {
  const auto share = [&](double time) { return w.contact_time > 0. ? number(time / w.contact_time) : Json(nullptr); };
  const auto& longest = w.longest;
  Json j;
  j["direction"] = to_string(longest ? longest->direction : WhirlDirection::none);
  j["frequency"] = longest ? number(longest->frequency()) : Json(nullptr);
  j["start"] = longest ? number(longest->start) : Json(nullptr);
  j["end"] = longest ? number(longest->end) : Json(nullptr);
  j["turns"] = longest ? number(longest->turns) : Json(0.);
  j["largest_backward_speed"] = w.largest_backward_speed ? number(*w.largest_backward_speed) : Json(nullptr);
  j["contact_time"] = number(w.contact_time);
  j["forward_share"] = share(w.forward_time);
  j["backward_share"] = share(w.backward_time);
  j["backward_whirl_share"] = share(w.backward_whirl_time);
  j["full_rub"] = w.has_full_rub ? "yes" : "no";
  j["fastest_resolved"] = number(w.fastest_resolved);
  j["full_rub_condition"] = {{"friction_coefficient", w.friction_coefficient},
                             {"friction_from_rest", w.friction_from_rest},
                             {"speed_at_bottom", w.speed_at_bottom}};
  return j;
}

std::string whirl_text(const std::string& bearing, const WhirlSummary& w) {
  if (!w.largest_backward_speed) return "";
  return fmt::format("{}: sustained backward whirl, up to {:.4g} Hz, during {:.3g} % of the contact time{}\n", bearing,
                     *w.largest_backward_speed / turn, 100. * w.backward_whirl_time / w.contact_time,
                     w.has_full_rub ? "; full rub" : "; contact lost in every turn");
}

}  // namespace rotordrop
