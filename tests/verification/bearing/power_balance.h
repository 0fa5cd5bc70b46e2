#pragma once
// What the tests of power balances share: a bearing at an instant, and how fast its energy changes as it moves on.
#include <vector>

#include "bearing/touchdown_bearing.h"
#include "numerical_derivative.h"

namespace rotordrop::testing {

struct Instant {
  SupportInput in;
  std::vector<double> y;
  Expansion growth_rate = {};
};

/// Change of the energy per second by central differences [W].
/// @param rates  of the first states; those after them stay
/// @param step   [s], so short that no ball comes to touch
inline double energy_rate(const TouchdownBearing& bearing, const Instant& s, const std::vector<double>& rates,
                          double step) {
  return derivative(
      [&](double t) {
        Instant moved = s;
        for (std::size_t i = 0; i < rates.size(); ++i) moved.y[i] += t * rates[i];
        auto& j = moved.in.journal;
        j.x += t * j.velocity_x;
        j.y += t * j.velocity_y;
        j.z += t * j.velocity_z;
        j.theta_y += t * j.tilt_rate_y;
        j.theta_z += t * j.tilt_rate_z;
        for (const auto surface : growth_surfaces) moved.in.growth.*surface += t * s.growth_rate.*surface;
        return bearing.energy(moved.in, moved.y);
      },
      step);
}

}  // namespace rotordrop::testing
