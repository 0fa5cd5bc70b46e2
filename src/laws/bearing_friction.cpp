#include "laws/bearing_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rotordrop {

FrictionLoadFactors friction_load_factors(double contact_angle) {
  if (contact_angle == 0.) return {};
  constexpr std::array<double, 9> Y_0 = {0.52, 0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22};  // 5, 10 ... 45 deg
  constexpr double spacing = 5. * std::numbers::pi / 180.;
  const double phi = std::max(contact_angle, spacing);
  const double at = std::min(phi / spacing - 1., static_cast<double>(Y_0.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(at), Y_0.size() - 2);
  const double part = at - static_cast<double>(below);
  return {0.5, Y_0[below] + part * (Y_0[below + 1] - Y_0[below]), 0.9 / std::tan(phi)};
}

}  // namespace rotordrop
