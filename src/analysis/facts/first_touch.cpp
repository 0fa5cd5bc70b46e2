#include "analysis/facts/first_touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "machine/speed_growth.h"

namespace rotordrop {
namespace {

/// Where a rotor that falls freely is beside one bearing.
struct Fall {
  double y = 0, z = 0, velocity_y = 0, velocity_z = 0;  // at the start
  double g_y = 0, g_z = 0, damping = 0, gap = 0;        // damping: over the mass [1/s]
  double waves = 0;                                     // of the bore, sum of amplitudes [m]
  bool is_probe = false;
  std::string name;

  /// Of u'' + alpha u' = g: u = v (1 - e)/alpha + g (t - (1 - e)/alpha)/alpha, e = exp(-alpha t).
  [[nodiscard]] double way(double velocity, double g, double t) const {
    const double x = damping * t;
    if (x < 1e-4) return (velocity * (1. - 0.5 * x) + g * t * (0.5 - x / 6.)) * t;  // to x^2
    const double glide = -std::expm1(-x) / damping;
    return velocity * glide + g * (t - glide) / damping;
  }
  /// @param side  -1: at the crests of the waves, 1: at their troughs
  [[nodiscard]] bool touches(double t, double side) const {
    return std::hypot(y + way(velocity_y, g_y, t), z + way(velocity_z, g_z, t)) >= gap + side * waves;
  }
};

std::vector<Fall> falls(const MachineParameters& p) {
  std::vector<Fall> all;
  const Motion start = initial_disturbance(p.rotor);
  const double x_cg = rigid_body(p.rotor.geometry).centre_of_gravity;
  const auto fall_at = [&](int node, const std::string& name) {
    const double x = p.rotor.geometry.position(node) - x_cg;
    Fall fall;
    fall.y = start.y + start.theta_z * x;
    fall.z = start.z - start.theta_y * x;
    fall.velocity_y = start.velocity_y + start.tilt_rate_z * x;
    fall.velocity_z = start.velocity_z - start.tilt_rate_y * x;
    fall.g_y = p.run.gravity[1];
    fall.g_z = p.run.gravity[2];
    fall.damping = p.rotor.mass_proportional_alpha;
    fall.name = name;
    return fall;
  };
  const bool grows = drop_grows_by_speed(p);  // the rotor, as rings do not turn yet
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) {
      Fall fall = fall_at(b->node, entry.name);
      const double growth = grows ? rotor_growth_by_speed(p, *b) * p.run.initial_speed * p.run.initial_speed : 0.;
      fall.gap = air_gap(*b, p.contact) - growth;
      for (const auto& wave : b->waviness)
        if (wave.surface == WavySurface::bore) fall.waves += std::fabs(wave.amplitude);
      all.push_back(std::move(fall));
    }
  for (const auto& [name, probe] : p.rotor.probes) {
    if (!probe.contact) continue;
    Fall fall = fall_at(probe.node, name);
    fall.y -= probe.centre[0];
    fall.z -= probe.centre[1];
    fall.gap = probe.clearance;
    fall.is_probe = true;
    all.push_back(std::move(fall));
  }
  return all;
}

/// When one of them touches first [s].
std::optional<double> first_of(const std::vector<Fall>& all, double side, double within) {
  const auto touches = [&](double t) {
    return std::any_of(all.begin(), all.end(), [&](const Fall& fall) { return fall.touches(t, side); });
  };
  constexpr double look = 1e-4;  // a gap is not crossed and left again within it [s]
  double before = 0.;
  while (!touches(before + look)) {
    before += look;
    if (before > within) return std::nullopt;
  }
  double after = before + look;
  while (after - before > 1e-9) (touches(0.5 * (before + after)) ? after : before) = 0.5 * (before + after);
  return after;
}

}  // namespace

std::optional<FirstTouch> first_touch(const MachineParameters& p, double within) {
  for (const auto& entry : p.bearings)
    if (!entry.touchdown()) return std::nullopt;
  const auto all = falls(p);
  const auto earliest = first_of(all, -1., within);
  if (!earliest) return std::nullopt;
  const auto first =
      std::find_if(all.begin(), all.end(), [&](const Fall& fall) { return fall.touches(*earliest, -1.); });
  return FirstTouch{*earliest, first_of(all, 1., within).value_or(within), first->is_probe, first->name};
}

std::string first_touch_text(const MachineParameters& p) {
  const auto first = first_touch(p);
  if (!first) return "";
  const double end = p.run.latest_end();
  const bool moves_along = p.rotor.axial_motion == AxialFreedom::free;  // to shoulders, which are not looked at
  const bool has_waves = first->latest > first->earliest;
  const std::string time = has_waves ? fmt::format("{:.3g} to {:.3g} ms, by where the waves of the bore stand",
                                                   first->earliest * 1e3, first->latest * 1e3)
                                     : fmt::format("{:.3g} ms", first->earliest * 1e3);
  const std::string what = first->is_probe ? fmt::format(", at the probe {}", first->name)
                           : moves_along   ? " of a bore"
                                           : "";
  return fmt::format("first touch{}: after about {}, by free fall{}\n", what, time,
                     first->earliest < end
                         ? ""
                         : fmt::format(". The run ends before, at {:.6g} ms: {} is touched. Check run.end_time;"
                                       " a bare number is in seconds",
                                       end * 1e3, moves_along ? "no bore" : "nothing"));
}

}  // namespace rotordrop
