#pragma once
// Friction of one contact that sticks, then slips: a spring in series with a slider.
#include <algorithm>
#include <cmath>

namespace rotordrop {

/// Elastic-plastic element (Jenkins, Masing) whose yielding sets in over the last part of its range:
///
///   z' = v (1 - a),   a = clamp((|z| / z_s - (1 - e)) / e, 0, 1) while v moves z outwards, else 0
///   F  = k z,   stored k z^2 / 2,   lost k z v a >= 0
///
/// Independent of rate; e -> 0 is the sharp slider. Loading back from any place is elastic, so small loops inside the elastic range are closed and
/// cost nothing. With x the travel since a turn at z_1 towards the other side (|z_1| <= z_s), the elastic part ends at z = (1 - e) z_s, and then
///   z_s - z = e z_s exp(-(x - x_e) / (e z_s)).
/// Source: Iwan (1966), elements in parallel; the soft onset as in Dupont et al. (2002).
struct StopOperator {
  double stiffness = 0;                 ///< k [N/m], > 0
  double reach = 0;                     ///< z_s [m], > 0; k z_s is the force at which it slips
  static constexpr double onset = 0.2;  ///< e

  [[nodiscard]] double yielding(double z, double v) const {
    if (z * v <= 0.) return 0.;
    return std::clamp((std::fabs(z) / reach - (1. - onset)) / onset, 0., 1.);
  }
  /// The part of v by which it slips [m/s].
  [[nodiscard]] double flow(double z, double v) const { return v * yielding(z, v); }
  /// z after a slow push by x from the relaxed place.
  [[nodiscard]] double pushed(double x) const {
    const double elastic = (1. - onset) * reach, length = std::fabs(x);
    const double z =
        length <= elastic ? length : reach - onset * reach * std::exp(-(length - elastic) / (onset * reach));
    return std::copysign(z, x);
  }
  /// d pushed / dx
  [[nodiscard]] double pushed_slope(double x) const {
    const double beyond = std::fabs(x) - (1. - onset) * reach;
    return beyond <= 0. ? 1. : std::exp(-beyond / (onset * reach));
  }
  /// k times the integral of pushed() from 0 to x [J].
  [[nodiscard]] double pushed_energy(double x) const {
    const double length = std::fabs(x), elastic = (1. - onset) * reach, tail = onset * reach;
    if (length <= elastic) return 0.5 * stiffness * length * length;
    const double beyond = length - elastic;
    return stiffness * (0.5 * elastic * elastic + reach * beyond - tail * tail * (1. - std::exp(-beyond / tail)));
  }
};

}  // namespace rotordrop
