#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/aligned_numbers.h"
#include "model/rotor_model.h"
#include "rotor/geometry.h"
#include "rotor/windage.h"

namespace rotordrop {

/// Which of the rotor's modes take part.
enum class RotorRepresentation {
  rigid,  ///< translation and tilt
  modal,  ///< and the flexible free-free modes up to a cut-off frequency
  full    ///< all: an exact change of basis of the finite-element model (up to 87 kHz for the reference rotor)
};

/// A heavy spot. Its centrifugal force turns with the rotor.
struct Unbalance {
  int node = 0;      ///< numbered from 1
  double me = 0;     ///< mass times eccentricity [kg m], >= 0
  double angle = 0;  ///< from +y towards +z at spin angle 0 [rad]
};

/// Value over time [time s, value], times rising; linear between, constant before and after. Empty: 0.
using TimeTable = std::vector<std::array<double, 2>>;
[[nodiscard]] double value_at(const TimeTable& table, double t);

/// Rigid motion of the rotor along its axis.
struct AxialMotion {
  double gravity = 0;  ///< acceleration along +x [m/s^2]
  TimeTable force;     ///< on the rotor along +x [N]
};

/// What a rotor model needs besides its geometry.
struct RotorSettings {
  RotorRepresentation representation = RotorRepresentation::modal;
  double cut_off_frequency = 4500;  ///< [Hz], of the modal representation
  bool residual_flexibility =
      false;  ///< of the modal representation: the static flexibility of the stations kept exactly (modal_basis.h)
  double modal_damping = 0.005;        ///< ratio of every flexible mode
  double mass_proportional_alpha = 0;  ///< [1/s], on every mode, the rigid ones too: force = -alpha M x'
  double gravity_y = 0;                ///< acceleration along +y [m/s^2]; -9.81 on Earth
  double gravity_z = 0;                ///< acceleration along +z [m/s^2]
  std::vector<Unbalance> unbalance;
  TimeTable drive_torque;            ///< on the rotor [N m]
  std::optional<Windage> windage;    ///< none: the rotor turns in a vacuum
  std::optional<AxialMotion> axial;  ///< none: the rotor is held along its axis
};

/// Straight line through the points (y1, z1) at x1 and (y2, z2) at x2, at rest: its motion at x. [m]
[[nodiscard]] Motion straight_line(double x1, double y1, double z1, double x2, double y2, double z2, double x);
/// Circular orbit of a point.
/// @param radius       [m]
/// @param angle        of the position, from +y towards +z [rad]
/// @param whirl_speed  positive from +y towards +z [rad/s]
[[nodiscard]] Motion orbit(double radius, double angle, double whirl_speed);
[[nodiscard]] Motion operator+(const Motion& a, const Motion& b);

/// Spinning flexible rotor in the coordinates of its free-free modes at rest (modal_basis.h).
///
///   q_y'' = Phi^T f_y / m - omega G q_z' - c q_y' - omega_k^2 q_y,   c_k = 2 zeta omega_k + alpha (rigid modes: alpha)
///   q_z'' = Phi^T f_z / m + omega G q_y' - c q_z' - omega_k^2 q_z
///   Ip omega' = torques on the stations + drive torque - windage torque
/// with the force of an unbalance
///   f_y = me (omega^2 cos(theta + a) + omega' sin(theta + a))
///   f_z = me (omega^2 sin(theta + a) - omega' cos(theta + a))
/// which has no reaction torque on the spin, so it does net work: rates() reports it.
///
/// Along the axis, if it may move there, it is rigid: m x'' = forces of the stations + m g_x + axial force - alpha m x'.
///
/// State [4 n_modes + 2]: q_y, q_z [m], q_y', q_z' [m/s], spin angle [rad], spin speed [rad/s]; with axial motion two more: x [m], x' [m/s].
/// Modes are scaled to the rotor's mass, see ModalBasis.
/// Source: Neisi, Heikkinen & Sopanen (2019), eq. (1).
/// Valid:  small deflections and tilts; a shaft without axial flexibility; spin torques along the shaft's own axis.
class ModalRotor final : public RotorModel {
 public:
  /// @param station_nodes  nodes (from 1) at which forces act and motion is asked for
  ModalRotor(const RotorGeometry& geometry, const RotorSettings& settings, const std::vector<int>& station_nodes);

  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  [[nodiscard]] std::size_t n_stations() const override { return n_stations_; }
  void motions(std::span<const double> y, std::span<Motion> out) const override;
  [[nodiscard]] Motion node_motion(int node, std::span<const double> y) const override;
  [[nodiscard]] Spin spin(std::span<const double> y) const override { return {y[4 * n_modes_], y[4 * n_modes_ + 1]}; }
  RotorPower rates(double t, std::span<const double> y, std::span<const Force> force_on_station,
                   std::span<double> dydt) const override;
  [[nodiscard]] bool has_windage() const override { return windage_.has_value(); }
  [[nodiscard]] double energy(std::span<const double> y) const override;
  /// Its flexible modes, those of both planes; none if the damping of one is below 2e-4 of critical: what gyroscopic coupling to the others does, seen a few
  /// times in many turns, then adds up.
  [[nodiscard]] std::vector<Oscillator> oscillators() const override;
  /// Points of the tables over time.
  [[nodiscard]] std::vector<double> instants() const override;
  /// Of a rotor that bends: modal_y, modal_z, its modal coordinates [m].
  [[nodiscard]] std::vector<Observable> observables() const override;
  void observe(std::span<const double> y, std::span<double> out) const override;

  /// State of the undeformed rotor that moves as a rigid body.
  /// @param motion_of_centre_of_gravity  displacement, tilt and their rates; see straight_line() and orbit()
  /// @param y                            [n_state]
  void initial_rigid_state(const Motion& motion_of_centre_of_gravity, const Spin& spin, std::span<double> y) const;
  /// Adds to a state how the flexible modes bend at rest under the forces along y and z on the stations [n_stations]. Moments are left out; uniform
  /// gravity bends no free-free mode.
  void add_static_deflection(std::span<const Force> force_on_station, std::span<double> y) const;
  /// Displacement of a node per unit of a modal coordinate [-]. @param node  numbered from 1; @param mode  from 0
  [[nodiscard]] double mode_shape(int node, std::size_t mode) const;
  /// Torque of motor or brake [N m].
  [[nodiscard]] double drive_torque(double t) const { return value_at(drive_torque_, t); }

  [[nodiscard]] const RigidBody& body() const { return body_; }
  [[nodiscard]] std::size_t n_state() const { return axial_at() + (axial_ ? 2 : 0); }
  [[nodiscard]] std::size_t n_modes() const { return n_modes_; }
  [[nodiscard]] std::size_t n_nodes() const { return n_nodes_; }
  /// Axial position of a station [m].
  /// Natural frequencies of the modes of one plane [n_modes] [Hz]; the first two are rigid, 0.
  [[nodiscard]] std::vector<double> mode_frequencies() const;

 private:
  template <class Real>
  friend class ModalRotorInLanes;  // rotor/modal_rotor_in_lanes.h
  struct Kernels;                  // bodies of rates() and motions(), for several widths of vectors
  /// Deflections and slopes of points per unit of each mode's coordinate, those of all points side by side.
  struct Shapes {
    std::size_t n_modes = 0, stride = 0;
    AlignedNumbers columns;  // [modes][points][deflection, slope], and at least one point without any behind them
    Shapes() = default;
    Shapes(std::size_t modes, std::size_t n_points);
    double& deflection(std::size_t point, std::size_t mode) { return columns[mode * stride + 2 * point]; }
    double& slope(std::size_t point, std::size_t mode) { return columns[mode * stride + 2 * point + 1]; }
    [[nodiscard]] double deflection(std::size_t point, std::size_t mode) const {
      return columns[mode * stride + 2 * point];
    }
    [[nodiscard]] double slope(std::size_t point, std::size_t mode) const {
      return columns[mode * stride + 2 * point + 1];
    }
  };

  [[nodiscard]] std::size_t axial_at() const { return 4 * n_modes_ + 2; }
  void add_axial_motion(std::span<const double> y, std::span<Motion> out) const;
  void add_axial_rates(double t, std::span<const double> y, std::span<const Force> force_on_station,
                       std::span<double> dydt, RotorPower& power) const;

  std::size_t n_modes_ = 0, n_stations_ = 0, n_nodes_ = 0;
  RigidBody body_;
  double gravity_y_ = 0, gravity_z_ = 0, alpha_ = 0;
  // Lists of modes are filled up to whole vectors.
  AlignedNumbers omega_squared_;    // [modes]
  AlignedNumbers damping_rate_;     // [modes] 2 zeta omega_k + alpha
  AlignedNumbers gyroscopic_;       // [n_modes columns][modes]
  AlignedNumbers unbalance_cos_;    // [modes] sum of me cos(a) Phi / m
  AlignedNumbers unbalance_sin_;    // [modes] sum of me sin(a) Phi / m
  AlignedNumbers force_influence_;  // [n_stations][force, moment][modes] acceleration per unit force
  Shapes station_shape_, node_shape_;
  TimeTable drive_torque_;
  std::optional<Windage> windage_;
  std::optional<AxialMotion> axial_;
};

}  // namespace rotordrop
