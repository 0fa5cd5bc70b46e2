#pragma once
#include "bearing/statics/bearing_statics.h"
#include "bearing/touchdown_bearing.h"

namespace rotordrop {

/// Friction torque of a bearing whose inner ring turns steadily [N m], against its spin.
struct SteadyFriction {
  double load = 0;  ///< M_L of all rows, from the load law "equivalent", whatever the bearing's own
  double drag = 0;  ///< M_v
  double spin = 0;  ///< of the balls' spin moments; 0 unless they are to add heat
  [[nodiscard]] double total() const { return load + drag + spin; }
};

/// As a drop has it (docs/theory/model.md, section 5), with the balls' loads of a ring at rest: per row P1 and P0 from its radial and axial load,
/// FrictionLoadFactors at the nominal contact angle. A deep-groove row whose balls growth presses uniformly all round has neither load, so no
/// load-dependent heat in this law.
SteadyFriction steady_friction(const TouchdownBearingData& bearing, const RingReport& ring, double speed);

/// Part of the heat that enters the inner race, r_i / (r_i + r_o).
double inner_heat_share(const TouchdownBearingData& bearing);

}  // namespace rotordrop
