#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bearing/bent_rings.h"
#include "bearing/row/ball_row.h"
#include "bearing/touchdown_numbers.h"
#include "laws/bearing_friction.h"
#include "laws/contact.h"
#include "laws/free_cage.h"
#include "laws/heat/rolling_conduction.h"
#include "laws/sticking.h"
#include "laws/support/support_law.h"
#include "model/support.h"

namespace rotordrop {

/// Which load enters the load-dependent friction torque (docs/theory/model.md).
enum class FrictionLoadLaw {
  radial,     ///< P1 = P0 = magnitude of the instantaneous radial resultant of all ball forces, without preload
  equivalent  ///< P1 and P0 of each row from its radial and axial load, preload included (FrictionLoadFactors)
};

/// What turns the cage.
enum class CageModel {
  rolling,  ///< balls roll without slip, and the cage turns with them
  free      ///< cage and balls have speeds of their own (laws/free_cage.h)
};

/// What the balls are.
enum class BallModel {
  quasi_static,  ///< springs without mass, both contacts in line
  inertial       ///< with centrifugal force and gyroscopic moment, each in its own balance (laws/ball_balance.h)
};

/// Where friction balances the balls' gyroscopic moments.
enum class GyroscopicSplit {
  outer,  ///< at the outer race (outer-race control)
  equal   ///< half at each race
};

/// Shoulder of the rotor beside one face of the inner ring.
struct Shoulder {
  double side = 1;                                       ///< of the ring's face: +1 at +x, -1 at -x
  double gap = std::numeric_limits<double>::infinity();  ///< axial, at the start [m]
};

/// What an inner ring with five degrees of freedom has besides; see docs/theory/model.md, section 4.
struct FreeRing {
  double polar_inertia = 0;      ///< of the ring alone, for its gyroscopic moment [kg m^2]
  double diametral_inertia = 0;  ///< [kg m^2]
  double gravity_x = 0;          ///< [m/s^2]
  double width = 0;              ///< from face to face [m]
  double contact_length = 0;     ///< along the axis, on which the rotor lies [m]
  std::vector<Shoulder> shoulders;
  double shoulder_radius = 0;     ///< mean radius of the faces that touch [m]
  double shoulder_stiffness = 0;  ///< [N/m]
};

/// Everything a touchdown bearing is made of, as numbers. Made from a case's parameters by touchdown_parameters.h.
struct TouchdownBearingData {
  std::string name;
  std::vector<BallRowGeometry> rows;  ///< all on one inner ring; equal but for phase, position, direction
  std::vector<RaceWave> race_waves;   ///< on every row
  std::vector<BoreWave> bore_waves;
  BallModel ball_model = BallModel::quasi_static;

  double cage_angle = 0;         ///< at the start [rad]
  double ring_mass = 0;          ///< inner ring(s) [kg]
  double ring_spin_inertia = 0;  ///< J, with balls and cage [kg m^2]
  double bore_radius = 0;        ///< r_b [m]
  double rotor_radius = 0;       ///< r_r, rotor's contact surface [m]
  double air_gap = 0;            ///< c_r, radial [m]
  HuntCrossley contact;
  CoulombFriction friction;
  std::optional<StickingFriction> sticking;  ///< none: regularised friction

  double f1_z = 0, f1_y = 0;  ///< f1 = z (P0/C0)^y
  double static_rating = 0;   ///< C0 of all rows together [N]
  double f2 = 0;
  double drag_viscosity = 0;       ///< [m^2/s]
  double drag_regularisation = 1;  ///< M tanh(omega_i / this) [rad/s]
  FrictionLoadLaw load_law = FrictionLoadLaw::radial;
  double race_friction_coefficient = 0;  ///< in eq. (23)
  double spin_axis_factor = 0;           ///< a / F^(1/3) of the inner contact [m/N^(1/3)]
  double spin_elliptic_integral = 1;     ///< E of the inner contact
  bool add_spin_heat = false;            ///< spin moments add torque and heat to M
  double heat_over_work = 1;             ///< above 1: heat that no work pays for, taken off other_dissipation

  double support_mass = 0;                                  ///< [kg]
  double support_stiffness_y = 0, support_stiffness_z = 0;  ///< [N/m]
  double support_damping_y = 0, support_damping_z = 0;      ///< [N s/m]
  std::shared_ptr<const SupportLaw> support_law;            ///< instead of these springs and dampers, if there is one
  double width = 0;                     ///< of the rings, all rows, over which their widths grow; 0: they do not [m]
  Expansion centrifugal_growth;         ///< per square of the ring's speed [m s^2]
  double gravity_y = 0, gravity_z = 0;  ///< on the inner ring [m/s^2]
  std::optional<RowConduction> conduction;  ///< of every row; none: the thermal models have fixed resistances
  std::optional<BentRings> bending;         ///< none: rigid rings
  bool heats_rows_apart = false;            ///< tells a thermal model the heat of each row
  std::optional<FreeRing> free_ring;        ///< none: axial and tilting motion of the inner ring are locked
  std::optional<FreeCage> free_cage;        ///< none: the balls roll, and the cage's speed follows the inner ring's
};

struct BoreSlice;  // bearing/touchdown_touch.h

/// Ball bearing that catches a falling rotor: rotor surface against bore, inner-ring body, ball rows, outer ring on its support.
/// The inner ring translates and spins; it also tilts and moves along its axis if it is a free one. The outer ring does not rotate.
class TouchdownBearing final : public Support {
 public:
  static constexpr std::size_t max_rows = 8;
  static constexpr std::size_t max_shapes = 80;  ///< coefficients of one ring: harmonics to 41
  explicit TouchdownBearing(TouchdownBearingData data);

  /// Offsets in this support's part of the state vector.
  enum State : std::size_t {
    ring_y,
    ring_z,
    ring_vy,
    ring_vz,
    ring_angle,
    ring_spin,
    support_y,
    support_z,
    support_vy,
    support_vz,
    cage_angle,
    n_state,
    // Of a free ring also:
    ring_x = n_state,
    ring_vx,
    tilt_y,
    tilt_z,
    tilt_rate_y,
    tilt_rate_z,
    n_state_free
  };
  /// Where the bristles of sticking friction begin: of every slice along the bore around it and, of a free ring, along it [m].
  [[nodiscard]] std::size_t bristles_at() const { return data_.free_ring ? n_state_free : n_state; }
  [[nodiscard]] std::size_t n_bristles() const;
  /// Where bent rings begin: coefficients a_2, b_2, a_3, ... of the inner ring, of the outer ring [m], then their rates [m/s].
  [[nodiscard]] std::size_t shapes_at() const { return bristles_at() + n_bristles(); }
  [[nodiscard]] std::size_t n_shapes() const { return data_.bending ? data_.bending->n_shapes() : 0; }
  /// Where the inner states of the support's law begin.
  [[nodiscard]] std::size_t support_states_at() const { return shapes_at() + 2 * n_shapes(); }
  /// Where a free cage begins: its speed and the balls' spin [rad/s].
  [[nodiscard]] std::size_t free_cage_at() const { return support_states_at() + n_support_states_; }
  /// Offsets in its own ledgers.
  enum Ledger : std::size_t {
    contact_impulse,
    contact_damping,
    ball_damping,
    support_damping,
    waviness_work,
    cage_work,
    inertia_of_balls,
    spin_up_drive,
    spin_up_centres,
    n_ledger,
    // Of bent rings and of a free cage also, in this order:
    first_optional_ledger = n_ledger
  };

  [[nodiscard]] const TouchdownBearingData& data() const { return data_; }
  [[nodiscard]] const std::string& name() const override { return data_.name; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  [[nodiscard]] std::vector<Observable> detailed_observables() const override;
  [[nodiscard]] std::size_t n_heated_rows() const override { return data_.heats_rows_apart ? rows_.size() : 0; }
  /// How far the nearest place of a shoulder's face is inside the ring [m]; below zero what is left of the gap, minus infinity without shoulders.
  /// @param journal  the rotor's motion; @param y  the bearing's state
  [[nodiscard]] double overlap_with_shoulders(const Motion& journal, std::span<const double> y) const;
  /// Energy in the bristles of sticking friction; 0 of other friction [J].
  [[nodiscard]] double energy_of_bristles(std::span<const double> y) const;
  /// Rings at rest, hanging in their balls under their own weight and bent by their waves and preload; the support carries the rings only.
  void initial_state(std::span<double> y) const override;
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override;
  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override;

  [[nodiscard]] const TouchdownFormulas<double>& numbers() const { return numbers_; }
  [[nodiscard]] std::span<const BallRow> rows() const { return rows_; }
  /// Whether evaluate_with() in lanes knows all that this bearing has.
  [[nodiscard]] bool runs_in_lanes() const;
  /// Whether two bearings differ in nothing but their numbers and those of their rows.
  [[nodiscard]] bool is_alike(const TouchdownBearing& other) const;
  /// evaluate() of this bearing, or of bearings alike side by side (touchdown_evaluate.h).
  /// @tparam Of  has numbers(), rows(), carried(), observe_support() and stored_in_support(): TouchdownBearing, or TouchdownInLanes
  template <class Real, class Of>
  void evaluate_with(const Of& of, const SupportInputOf<Real>& input, std::span<const Real> y, std::span<Real> dydt,
                     std::span<Real> ledger_rates, SupportOutputOf<Real>& out) const;
  /// energy() likewise.
  template <class Real, class Of>
  [[nodiscard]] Real energy_with(const Of& of, const SupportInputOf<Real>& input, std::span<const Real> y) const;
  /// Force of the support's law on the outer ring, and loss; writes the rates of the law's states into dydt.
  SupportAnswer carried(std::span<const double> y, std::span<double> dydt) const;
  /// @param out  [3]
  void observe_support(const SupportAnswer& answer, std::span<const double> y, std::span<double> out) const;
  /// Energy that the support's law stores [J].
  [[nodiscard]] double stored_in_support(std::span<const double> y) const;
  [[nodiscard]] std::size_t n_support_states() const { return n_support_states_; }

 private:
  template <class Real>
  static constexpr bool has_all = !RealTraits<Real>::is_in_lanes;  // of one drop: all that a bearing can have
  template <class Real>
  struct BodiesOf;  // rotor and ring at one place along the bore
  template <class Real>
  struct ContactOf;  // rotor against bore at one place along it
  template <class Real>
  struct TouchOf;  // rotor on ring, all places together
  template <class Real>
  struct ObservedTouchOf;
  template <class Real>
  struct BallSumsOf;  // over the rows
  template <class Real>
  struct BallForcesOf;  // rows and sums
  using Bodies = BodiesOf<double>;
  using Contact = ContactOf<double>;
  using Touch = TouchOf<double>;
  using BallForces = BallForcesOf<double>;
  struct ShapeForces;  // on the shapes of bent rings
  struct ArcTable;     // shapes at the points around the bore
  struct Arc;          // of points where rotor and bore may overlap
  /// Thermal and centrifugal.
  template <class Real>
  [[nodiscard]] static ExpansionOf<Real> growth(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& input,
                                                std::span<const Real> y);
  /// @tparam tilts  of a free ring; another one only translates
  /// @param x       along the bore, from the ring's middle [m]
  template <bool tilts, class Real>
  [[nodiscard]] BodiesOf<Real> bodies(const MotionOf<Real>& journal, std::span<const Real> y, double x) const;
  /// Sliding friction of a contact whose normal force and slip around the bore are known; none where a bristle holds it.
  template <bool tilts, class Real>
  void slide(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& input, const BodiesOf<Real>& at,
             ContactOf<Real>& c) const;
  template <bool tilts, class Real>
  [[nodiscard]] ContactOf<Real> contact(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& input,
                                        const ExpansionOf<Real>& growth, std::span<const Real> y,
                                        const BodiesOf<Real>& at) const;
  template <bool tilts, class Real>
  [[nodiscard]] ContactOf<Real> contact_in_slice(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& input,
                                                 const ExpansionOf<Real>& growth, std::span<const Real> y,
                                                 const BoreSlice& slice, std::span<Real> bristle_rates,
                                                 std::span<Real> shape_forces) const;
  /// Of a bent bore, whose shapes it presses, at a point or over an arc; or of one that sticks.
  template <bool tilts>
  [[nodiscard]] Contact bent_or_sticking_contact(const SupportInput& input, const Expansion& growth,
                                                 std::span<const double> y, Bodies at, const BoreSlice& slice,
                                                 std::span<double> bristle_rates, std::span<double> shape_forces) const;
  template <bool tilts, class Real>
  [[nodiscard]] static TouchOf<Real> touch_in_slice(const TouchdownFormulas<Real>& q, const ContactOf<Real>& c,
                                                    const BoreSlice& slice);
  template <class Real>
  struct BoreWavesAtPointOf {
    Real height = 0, rate = 0;  // [m], [m/s]
  };
  /// On the line of centres, where rotor and bore are nearest.
  template <class Real>
  [[nodiscard]] static BoreWavesAtPointOf<Real> bore_waves_at(const TouchdownFormulas<Real>& q, std::span<const Real> y,
                                                              Real n_y, Real n_z, Real centres_turning);
  /// @param bristle_rates  [n_bristles()]
  /// @param shape_forces   on the inner ring's shapes, added to [BentRings::n_inner()] [N]
  template <class Real>
  [[nodiscard]] TouchOf<Real> touch(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& input,
                                    const ExpansionOf<Real>& growth, std::span<const Real> y,
                                    std::span<Real> bristle_rates, std::span<Real> shape_forces) const;
  [[nodiscard]] Touch touch_of_free_ring(const SupportInput& input, const Expansion& growth, std::span<const double> y,
                                         std::span<double> bristle_rates, std::span<double> shape_forces) const;
  // Bent rings (touchdown_bending.cpp).
  [[nodiscard]] std::span<const double> inner_shape(std::span<const double> y) const;
  [[nodiscard]] std::span<const double> inner_shape_rate(std::span<const double> y) const;
  struct BendAtPoint {
    double u = 0, rate = 0, slope = 0;  // [m], [m/s], du/d(theta) [m]
  };
  [[nodiscard]] BendAtPoint bend_at_point(std::span<const double> y, double n_y, double n_z) const;
  void press_at_point(const Contact& contact, double share, std::span<double> shape_forces) const;
  [[nodiscard]] Contact contact_over_arc(const SupportInput& input, const Expansion& growth, std::span<const double> y,
                                         const Bodies& at, double share, std::span<double> shape_forces) const;
  [[nodiscard]] double arc_energy(const Expansion& growth, std::span<const double> y, const Bodies& at) const;
  [[nodiscard]] std::shared_ptr<const ArcTable> make_arc_table() const;
  void find_arc(std::span<const double> y, const Bodies& at, double distance, double gap, double bound, Arc& arc) const;
  [[nodiscard]] double farthest_bend(std::span<const double> y) const;
  void lend_shapes(ShapeForces& shapes, BallRowInput& input) const;
  void fill_ball_shapes(std::span<const double> y, ShapeForces& shapes) const;
  struct ShapeMotion {
    double stiffness, mass, inverse_mass, damping;  // [N/m], [kg], [1/kg], [N s/m]
  };
  [[nodiscard]] std::vector<ShapeMotion> shape_motions() const;
  /// Of inner and outer ring in series, for each coefficient of the inner one [N/m].
  [[nodiscard]] std::vector<double> stiffness_of_both_rings() const;
  /// Divides what the grooves are widened by between both rings. @param both  stiffness_of_both_rings()
  void bend_at_rest(std::span<const double> both, std::span<const double> widening, std::span<double> y) const;
  [[nodiscard]] double bend(std::span<const double> y, ShapeForces& forces, std::span<double> dydt) const;
  [[nodiscard]] double bending_energy(std::span<const double> y) const;
  [[nodiscard]] std::vector<StateEntry> shape_entries() const;
  [[nodiscard]] std::vector<Observable> shape_observables() const;
  [[nodiscard]] StickingFriction::Vector bristle(std::span<const double> y, std::size_t slice) const;
  void stick(const SupportInput& input, std::span<const double> y, std::size_t slice, Contact& contact,
             std::span<double> bristle_rates) const;
  [[nodiscard]] double contact_energy(const SupportInput& input, const Expansion& growth,
                                      std::span<const double> y) const;
  void touch_shoulders(const SupportInput& input, std::span<const double> y, Touch& sum) const;
  [[nodiscard]] SupportMotion support_motion(std::span<const double> y) const;
  /// Rates of a free ring's axial and tilting motion.
  void tilt(const BallForces& balls, Force on_ring, std::span<const double> y, std::span<double> dydt) const;
  /// Turns a free cage and brakes the inner ring by it. @return heat of the balls' slip, which is added to `heat` [W]
  double turn_cage(const BallForces& balls, std::span<const double> y, std::span<double> dydt, HeatInput& heat) const;
  template <class Real>
  [[nodiscard]] BallRowInputOf<Real> row_input(const TouchdownFormulas<Real>& q, const ExpansionOf<Real>& growth,
                                               std::span<const Real> y) const;
  template <class Real, class Row>
  [[nodiscard]] BallForcesOf<Real> ball_forces(std::span<const Row> rows, const BallRowInputOf<Real>& input,
                                               bool with_tractions) const;
  template <class Real>
  [[nodiscard]] Real load_torque_of(const TouchdownFormulas<Real>& q, const BallForcesOf<Real>& forces) const;
  template <class Real>
  [[nodiscard]] Real row_load_torque(const TouchdownFormulas<Real>& q, const BallRowOutputOf<Real>& row) const;
  [[nodiscard]] double spin_drag(const BallRowInput& input) const;
  [[nodiscard]] double row_spin_drag(const BallRow& row, const BallRowInput& input) const;
  /// @param turning  tanh of the ring's speed over its regularisation
  void divide_among_rows(const BallForces& forces, const BallRowInput& input, double load_torque, double drag_torque,
                         double turning, double ring_speed, std::span<RowHeat> out) const;
  template <class Real>
  [[nodiscard]] static BallConductancesOf<Real> row_conduction(const TouchdownFormulas<Real>& q,
                                                               const BallRowOutputOf<Real>& row,
                                                               const Real& ring_speed);
  template <class Real>
  [[nodiscard]] BallConductionOf<Real> conduction(const TouchdownFormulas<Real>& q, const BallForcesOf<Real>& forces,
                                                  const Real& ring_speed) const;
  template <class Real, class Row>
  void observe(const TouchdownFormulas<Real>& q, std::span<const Row> rows, const SupportInputOf<Real>& input,
               const ExpansionOf<Real>& growth, std::span<const Real> y, const ObservedTouchOf<Real>& touch,
               const BallForcesOf<Real>& balls, const Real& load_torque, const Real& drag_torque,
               const Real& ring_acceleration, const HeatInputOf<Real>& heat, std::span<Real> out) const;
  template <class Real, class Row>
  void observe_details(std::span<const Row> rows, const BallRowInputOf<Real>& input, std::span<const Real> y,
                       std::span<Real> out) const;
  [[nodiscard]] static TouchdownNumbers<double> numbers_of(const TouchdownBearingData& data);

  TouchdownBearingData data_;
  std::vector<BallRow> rows_;
  std::vector<ShapeMotion> shape_motions_;
  std::shared_ptr<const ArcTable> arc_table_;  // of bent rings that are touched over an arc
  std::size_t n_support_states_ = 0;
  TouchdownFormulas<double> numbers_;
};

}  // namespace rotordrop
