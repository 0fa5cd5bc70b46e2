#include "laws/heat/heat_flow.h"

#include <numbers>

namespace rotordrop {

double elliptic_constriction(double a, double first_kind, double k_1, double k_2) {
  return first_kind / (2. * std::numbers::pi * a) * (1. / k_1 + 1. / k_2);
}

}  // namespace rotordrop
