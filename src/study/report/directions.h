#pragma once
#include <array>
#include <cmath>
#include <string>

// What the axes across the rotor are called, for gravity may have any direction.
namespace rotordrop {

/// Whether gravity acts along an axis and no other. @param gravity  along x, y, z [m/s^2]
inline bool is_along(const std::array<double, 3>& gravity, std::size_t axis) {
  const double size = std::hypot(gravity[0], gravity[1], gravity[2]);
  return size > 0. && std::fabs(gravity[axis]) > (1. - 1e-9) * size;
}

/// "y (up)", "z (down)", or the axis alone where gravity does not act along it. @param axis  1: y, 2: z
inline std::string axis_name(const std::array<double, 3>& gravity, std::size_t axis) {
  const std::string name = axis == 1 ? "y" : "z";
  if (!is_along(gravity, axis)) return name;
  return name + (gravity[axis] < 0. ? " (up)" : " (down)");
}

/// "vertical displacement", "horizontal displacement"; "displacement along y" of a vertical or an inclined rotor and without gravity.
inline std::string displacement_along(const std::array<double, 3>& gravity, std::size_t axis) {
  if (is_along(gravity, axis)) return "vertical displacement";
  if (is_along(gravity, 3 - axis)) return "horizontal displacement";
  return axis == 1 ? "displacement along y" : "displacement along z";
}

}  // namespace rotordrop
