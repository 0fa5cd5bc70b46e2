#include "rotor/balance_grade.h"

namespace rotordrop {

double permissible_unbalance(double mass, double grade, double speed) { return mass * grade / speed; }

std::array<double, 2> unbalance_in_planes(double U, double x_A, double x_B, double x_G) {
  return {U * (x_B - x_G) / (x_B - x_A), U * (x_G - x_A) / (x_B - x_A)};
}

}  // namespace rotordrop
