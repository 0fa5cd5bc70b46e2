#include "analysis/facts/bearing_estimates.h"

#include "bearing/contact_stiffness.h"
#include "laws/fatigue/rating_estimates.h"
#include "machine/bearing_data.h"

namespace rotordrop {

BearingEstimates bearing_estimates(const MachineParameters& p, const TouchdownParameters& b) {
  const auto ratings = estimated_ratings(b.rows, b.balls_per_row, b.ball_diameter, b.contact_angle);
  const auto around = touchdown_surroundings(p, b);
  return {ratings.static_load, ratings.dynamic_load, contact_stiffness(b, p.contact, around).from_bodies,
          shoulder_compliance(b, around).stiffness()};
}

}  // namespace rotordrop
