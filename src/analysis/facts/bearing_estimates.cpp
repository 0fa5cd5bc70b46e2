#include "analysis/facts/bearing_estimates.h"

#include "bearing/contact_stiffness.h"
#include "laws/fatigue/rating_estimates.h"
#include "machine/bearing_data.h"

namespace rotordrop {

BearingEstimates bearing_estimates(const MachineParameters& p, const TouchdownParameters& b) {
  const auto ratings = estimated_ratings(b.rows, b.balls_per_row, b.ball_diameter, b.contact_angle);
  const MaterialParameters& ring = material_of(p, b.ring);
  return {ratings.static_load, ratings.dynamic_load,
          contact_stiffness(b, p.contact, touchdown_surroundings(p, b)).from_bodies,
          shoulder_compliance(b, {ring.E, ring.nu}).stiffness()};
}

}  // namespace rotordrop
