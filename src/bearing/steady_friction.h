#pragma once
#include "bearing/bearing_statics.h"
#include "bearing/touchdown_bearing.h"

namespace rotordrop {

/// Friction torque of a bearing whose inner ring turns steadily [N m], against its spin.
struct SteadyFriction {
  double load = 0;  ///< M_L of all rows, from the load law "equivalent", whatever the bearing's own
  double drag = 0;  ///< M_v
  double spin = 0;  ///< of the balls' spin moments; 0 unless they are to add heat
  [[nodiscard]] double total() const { return load + drag + spin; }
};

/// As a drop has it (docs/model.md, section 5), with the balls' loads of a ring at rest: per row P = P0 = max(F_r, 0.9 F_a cot phi - 0.1 F_r),
/// phi nominal. A row without contact angle has P = F_r: balls pressed evenly all round by growth make no heat in this law.
SteadyFriction steady_friction(const TouchdownBearingData& bearing, const RingReport& ring, double speed);

/// Part of the heat that enters the inner race, r_i / (r_i + r_o).
double inner_heat_share(const TouchdownBearingData& bearing);

}  // namespace rotordrop
