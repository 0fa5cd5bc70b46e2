#include "analysis/facts/given_conduction.h"

#include <cmath>

#include "laws/ball_kinematics.h"
#include "machine/build_machine.h"

namespace rotordrop {

BallConduction given_conduction(const MachineParameters& parameters, const std::string& bearing, double ball_load,
                                double ring_speed) {
  MachineParameters p = parameters;
  p.thermal.contact_conduction = BallConductionModel::rolling;
  const TouchdownParameters& b = touchdown_of(p, bearing);
  const auto data = touchdown_data_of(p, bearing, b);
  const auto& g = data.rows.front();
  const double rolling =
      0.5 * g.ball_diameter * ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle) * ring_speed;
  const double root = std::cbrt(ball_load);
  const auto G = data.conduction->of_balls(b.rows * b.balls_per_row, root, root, rolling);
  return {G.inner_to_ball, G.outer_to_ball, G.inner_to_outer};
}

}  // namespace rotordrop
