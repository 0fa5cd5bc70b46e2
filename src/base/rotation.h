#pragma once

#include <cmath>
#include <numbers>

namespace rotordrop {

inline constexpr double two_pi = 2. * std::numbers::pi;
inline constexpr double to_rpm = 30. / std::numbers::pi;  // from rad/s

/// The angle [rad] without whole turns, from -pi to pi: which way round is shorter.
inline double shorter_way(double angle) {
  return std::fabs(angle) <= std::numbers::pi ? angle : std::remainder(angle, two_pi);
}

}  // namespace rotordrop
