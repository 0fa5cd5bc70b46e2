#pragma once
// A bearing that runs steadily, as heat sees it: a growth in, a heat out.
#include <functional>
#include <span>

#include "analysis/statics/statics.h"

namespace rotordrop {

/// A bearing at rest in its balls while it turns.
struct RunningState {
  double heat = 0;                                           ///< that it releases [W]
  double load_torque = 0, drag_torque = 0, spin_torque = 0;  ///< [N m]
  double preload = 0;                                        ///< smaller axial force of opposed rows [N]
  double largest_ball_load = 0;                              ///< [N]
  double largest_pressure = 0;                               ///< [Pa]
  double static_safety = 0;                                  ///< (4.2 GPa / largest pressure)^3; infinite without load
  double axial_stiffness = 0;                                ///< [N/m]
  double radial_stiffness_y = 0, radial_stiffness_z = 0;
  double radial_clearance =
      0;  ///< how far the ring, else in its mounted place, may move until a ball is touched; negative: they are pressed [m]
  bool is_floating = false;          ///< no ball touches
  BallConduction balls;              ///< what they conduct as they roll; zeros if thermal models have fixed resistances
  double centrifugal_over_load = 0;  ///< largest of the rows (bearing_statics.h)
  bool neglects_centrifugal = false;  ///< the balls have no inertia, though it matters
};

/// What heat is made of; physics of the bearing behind one function, so that loops can be tried on laws with known answers.
class RunningBearing {
 public:
  RunningBearing() = default;
  RunningBearing(const RunningBearing&) = delete;
  RunningBearing& operator=(const RunningBearing&) = delete;
  virtual ~RunningBearing() = default;
  /// @param growth  by heat [m]
  [[nodiscard]] virtual RunningState at(const Expansion& growth) const = 0;
  /// Whether RunningState::balls depends on growth.
  [[nodiscard]] virtual bool balls_roll() const { return false; }
  /// Part of the heat that enters the inner race.
  [[nodiscard]] virtual double inner_share() const = 0;
};

/// Finds the rest of a system from a start in `x`. @throws SolverError
using FindRest = std::function<void(EquilibriumSystem& system, std::span<double> x)>;

/// Growth of a bearing's surfaces that heat has no part in: [preload]'s, of fits and speed.
Expansion cold_growth(const MachineParameters& parameters, const TouchdownParameters& bearing, double speed);

/// Whether [preload] takes growth by speed.
bool preload_grows_by_speed(const MachineParameters& parameters);

/// By how much the outer raceway closes per interference of outer ring and housing (laws/ring_growth.h).
double housing_closure(const TouchdownParameters& bearing);

/// One touchdown bearing by itself in equilibrium (analysis/statics/statics.h), friction by the load law "equivalent" (bearing/statics/steady_friction.h).
class TouchdownRunning final : public RunningBearing {
 public:
  /// @param at_rest  growth without heat, speed and load
  TouchdownRunning(const MachineParameters& parameters, const std::string& name, const TouchdownParameters& bearing,
                   const BearingState& at_rest, FindRest find);
  [[nodiscard]] RunningState at(const Expansion& growth) const override {
    return in({combined(1., growth, 1., at_rest_.growth), at_rest_.speed, at_rest_.load});
  }
  /// In any state; growth is the whole one.
  [[nodiscard]] RunningState in(const BearingState& state) const;
  [[nodiscard]] double inner_share() const override;
  [[nodiscard]] bool balls_roll() const override { return data_.conduction.has_value(); }

 private:
  StaticsParameters statics_;
  TouchdownParameters bearing_;
  TouchdownBearingData data_;
  BearingState at_rest_;
  FindRest find_;
};

/// [preload]'s load.
Force preload_load(const PreloadParameters& preload);
/// [preload]'s speed [rad/s].
double preload_speed(const MachineParameters& parameters);

}  // namespace rotordrop
