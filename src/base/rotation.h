#pragma once

#include <numbers>

namespace rotordrop {

inline constexpr double two_pi = 2. * std::numbers::pi;
inline constexpr double to_rpm = 30. / std::numbers::pi;  // from rad/s

}  // namespace rotordrop
