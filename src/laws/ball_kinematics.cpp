#include "laws/ball_kinematics.h"

#include <cmath>

namespace rotordrop {

double cage_speed_ratio(double d, double d_m, double phi) { return 0.5 * (1. - d * std::cos(phi) / d_m); }

double ball_spin_ratio(double d, double d_m, double phi) {
  const double gamma = d * std::cos(phi) / d_m;
  return 0.5 * d_m / d * (1. - gamma * gamma);
}

double pitch_angle_outer_race_control(double phi_o, double d, double d_m) {
  return std::atan2(std::sin(phi_o), std::cos(phi_o) + d / d_m);  // eq. (14)
}

SpinSpeeds spin_speeds(double ring_speed, double phi_i, double phi_o, double theta, double d, double d_m) {
  // Eq. (15), corrected. Rolling without slip at both contact centres of a ball whose axis is pitched by theta, relative to the cage:
  //   omega_co (d_m + d cos phi_o) = omega_b d cos(phi_o - theta),
  //   omega_ci (d_m - d cos phi_i) = omega_b d cos(phi_i - theta),   omega_ci + omega_co = omega_i.
  const double outer_over_b = d * std::cos(phi_o - theta) / (d_m + d * std::cos(phi_o));
  const double inner_over_b = d * std::cos(phi_i - theta) / (d_m - d * std::cos(phi_i));
  const double omega_b = ring_speed / (outer_over_b + inner_over_b);
  const double omega_co = omega_b * outer_over_b;
  const double omega_ci = omega_b * inner_over_b;
  // eq. (13), corrected
  return {omega_ci * std::sin(phi_i) + omega_b * std::sin(phi_i - theta),
          omega_co * std::sin(phi_o) - omega_b * std::sin(phi_o - theta)};
}

}  // namespace rotordrop
