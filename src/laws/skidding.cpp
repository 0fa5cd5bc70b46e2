#include "laws/skidding.h"

#include <algorithm>

namespace rotordrop {

double traction_demand(double traction, double mu, double load) {
  if (traction == 0.) return 0.;
  const double given = mu * load;
  return given > 0. ? std::min(traction / given, largest_traction_demand) : largest_traction_demand;
}

double rolling_demand(const RowTractions& row, int n_balls, double ball_mass, double acceleration, double mu) {
  const auto one = rolling_tractions(ball_mass, acceleration);
  return std::max(traction_demand(std::hypot(n_balls * one.inner, row.inner_gyroscopic), mu, row.inner_load),
                  traction_demand(std::hypot(n_balls * one.outer, row.gyroscopic), mu, row.outer_load));
}

}  // namespace rotordrop
