#include "analysis/facts/first_touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rotordrop {
namespace {

/// Where a rotor that falls freely is beside one bearing.
struct Fall {
  double y = 0, z = 0, velocity_y = 0, velocity_z = 0;  // at the start
  double g_y = 0, g_z = 0, damping = 0, gap = 0;        // damping: over the mass [1/s]

  /// Of u'' + alpha u' = g: u = v (1 - e)/alpha + g (t - (1 - e)/alpha)/alpha, e = exp(-alpha t).
  [[nodiscard]] double way(double velocity, double g, double t) const {
    const double x = damping * t;
    if (x < 1e-4) return (velocity * (1. - 0.5 * x) + g * t * (0.5 - x / 6.)) * t;  // to x^2
    const double glide = -std::expm1(-x) / damping;
    return velocity * glide + g * (t - glide) / damping;
  }
  [[nodiscard]] bool touches(double t) const {
    return std::hypot(y + way(velocity_y, g_y, t), z + way(velocity_z, g_z, t)) >= gap;
  }
};

std::vector<Fall> falls(const MachineParameters& p) {
  std::vector<Fall> all;
  const Motion start = initial_disturbance(p.rotor);
  const double x_cg = rigid_body(p.rotor.geometry).centre_of_gravity;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) {
      const double x = p.rotor.geometry.position(b->node) - x_cg;
      all.push_back({start.y + start.theta_z * x, start.z - start.theta_y * x, start.velocity_y + start.tilt_rate_z * x,
                     start.velocity_z - start.tilt_rate_y * x, p.run.gravity[1], p.run.gravity[2],
                     p.rotor.mass_proportional_alpha, air_gap(*b, p.contact)});
    }
  return all;
}

}  // namespace

std::optional<double> first_touch(const MachineParameters& p, double within) {
  for (const auto& entry : p.bearings)
    if (!entry.touchdown()) return std::nullopt;
  const auto all = falls(p);
  const auto touches = [&](double t) {
    return std::any_of(all.begin(), all.end(), [&](const Fall& fall) { return fall.touches(t); });
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

std::string first_touch_text(const MachineParameters& p) {
  const auto t = first_touch(p);
  if (!t) return "";
  const double end = p.run.latest_end();
  const bool moves_along = p.rotor.axial_motion == AxialFreedom::free;  // to shoulders, which are not looked at
  return fmt::format("first touch{}: after about {:.3g} ms, by free fall{}\n", moves_along ? " of a bore" : "",
                     *t * 1e3,
                     *t < end ? ""
                              : fmt::format(". The run ends before, at {:.6g} ms: {} is touched. Check run.end_time;"
                                            " a bare number is in seconds",
                                            end * 1e3, moves_along ? "no bore" : "nothing"));
}

}  // namespace rotordrop
