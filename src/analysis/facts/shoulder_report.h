#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// What a case says of the shoulders beside a bearing's ring, and how much their stiffness matters.
struct ShoulderReport {
  double stiffness = 0;                                          ///< in force [N/m]
  bool is_given = false;                                         ///< or else from the bodies
  double rotor_stiffness = 0, ring_stiffness = 0;                ///< from the bodies: half space, ring's wall [N/m]
  static constexpr std::array<double, 3> parts = {0.5, 1., 2.};  ///< of the stiffness, for the spread
  /// A side to which the rotor is pushed.
  struct Side {
    double direction = 1;           ///< of the push: +1 towards +x
    double gap = 0, thrust = 0;     ///< [m], [N]: the largest force along the axis, weight included
    double speed = 0;               ///< at which the rotor arrives, without friction and damping [m/s]
    std::array<double, 3> force{};  ///< the largest on the shoulder by energy, for `parts` of the stiffness [N]
  };
  std::vector<Side> sides;
};
/// None for a bearing without shoulders. The force by energy is that of the whole rotor on the shoulder and the balls behind it as two springs in series, the thrust pushing on,
/// without damping, the ring's mass, friction and other bearings: an estimate, whose spread over the stiffness is what it is for.
std::optional<ShoulderReport> shoulder_report(const MachineParameters& parameters, const std::string& bearing);

}  // namespace rotordrop
