#pragma once
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/real.h"
#include "bearing/row/ball_row_ports.h"
#include "bearing/row/inertial_balls.h"
#include "bearing/row/race_waves.h"
#include "laws/ball_balance.h"
#include "laws/skidding.h"

namespace rotordrop {

struct KernelInput;    // bearing/row/ball_row_kernels.h
struct InertialInput;  // bearing/row/inertial_kernels.h
template <class Real>
struct RowPlaceOf;  // bearing/row/ball_terms.h
struct Widening;    // bearing/row/ball_row_bending.h

/// Hertz constants of the balls on one race.
template <class Real>
struct RaceContactOf {
  Real stiffness = 0;    ///< K of Q = K delta^1.5 [N/m^1.5]
  Real axis_factor = 0;  ///< semi-major axis of the contact ellipse over Q^(1/3) [m/N^(1/3)]
  Real ellipticity = 1;  ///< semi-major over semi-minor axis
  // Edge of the raceway on either side, where the groove's circle reaches the shoulder.
  Real groove_radius = 0;               ///< [m]; 0: no edge
  Real edge_sine = 0, edge_cosine = 1;  ///< of its angle about the groove's centre, from the radial direction
  [[nodiscard]] bool has_edge() const { return groove_radius > 0.; }
  /// Distance of the edge from the centre of a contact, in the contact's tangent plane [m]; infinite without an edge.
  [[nodiscard]] double edge_distance(double sine, double cosine) const;
  /// Part of the contact ellipse's length that lies beyond the edge, 0 to 1. The ellipse is that of an endless groove.
  /// @param load [N]; @param sine, cosine  of the contact angle
  [[nodiscard]] double truncation(double load, double sine, double cosine) const;
  /// Largest pressure in the contact ellipse under a load [N], 3 Q / (2 pi a b) [Pa]; 0 without load.
  [[nodiscard]] Real largest_pressure(const Real& load) const {
    const Real major = axis_factor * cbrt(load);
    return select(load <= 0., Real(0.), 1.5 * load * ellipticity / (std::numbers::pi * major * major));
  }
};
using RaceContact = RaceContactOf<double>;

/// One row of balls between two races.
struct BallRowGeometry {
  int n_balls = 0;              ///< Z
  double ball_diameter = 0;     ///< d [m]
  double pitch_diameter = 0;    ///< d_m [m]
  double inner_conformity = 0;  ///< f_in, groove radius over d
  double outer_conformity = 0;  ///< f_out
  double contact_angle = 0;     ///< phi_0 [rad]
  double radial_clearance = 0;  ///< of a deep-groove bearing, half the diametral one [m]
  double stiffness = 0;         ///< K_b, inner and outer contact in series [N/m^1.5]
  double damping_beta = 0;      ///< beta, damping over tangent stiffness [s]
  double direction = 1;         ///< +1: loaded by an inner ring moving towards +x; -1 the opposite
  double position = 0;          ///< axial position of the row in the ring's frame [m]
  double difference_share =
      0;             ///< of Expansion::row_difference that the row grows beyond the rows' mean: -1/2 first, +1/2 last
  double phase = 0;  ///< azimuth of the first ball at cage angle zero [rad]
  double preload_offset = 0;  ///< axial approach of the races at rest [m]
  RaceContact inner, outer;   ///< each contact by itself; `stiffness` is both in series
  double ball_mass = 0;       ///< [kg]; for the balls' inertia
  bool conducts = false;      ///< a row of balls with inertia sums the cube roots of its loads too
  bool has_inertia = false;   ///< each ball in balance with its centrifugal force and gyroscopic moment
  int highest_harmonic = 0;   ///< of the rings' bending; 0: rigid rings
  double inner_gyroscopic_share =
      0;  ///< part of the gyroscopic traction at the inner race; the rest is at the outer one
};

/// How a row's grooves move and widen with the axial strain of a ring, the growth of its width over its width. With s the row's direction and
/// x its position, the contact points lie at x -+ s (d/2) sin phi_0; a groove's centre is its radius f d away from them along the normal, and
/// that radius grows with the ring.
template <class Real>
struct GrooveStrainOf {
  Real axial = 0;   ///< growth of B_x per strain [m]
  Real radial = 0;  ///< growth of B_r per strain, besides that of the contact points' radii [m]
  Real groove = 0;  ///< growth of the groove's radius per strain; what the contact's deflection loses [m]
};
using GrooveStrain = GrooveStrainOf<double>;
template <class Real>
struct RowStrainsOf {
  GrooveStrainOf<Real> inner, outer;
};
using RowStrains = RowStrainsOf<double>;
RowStrains row_strains(const BallRowGeometry& geometry);

/// Where the grooves' centres are, B_r and B_x of an undisplaced ring [m].
template <class Real>
struct GroovesOf {
  Real A, radial, axial, arm;  ///< A, A cos phi_0 - clearance, s (A sin phi_0 + offset), R_c
};
/// Of a row as mounted.
GroovesOf<double> groove_centres(const BallRowGeometry& geometry);
/// The same grown: what growth adds to the penetrations, (u_in - u_out) . n (laws/bearing_growth.h), in A, B_r and B_x; the ball's 2 eps_b is apart.
/// @param difference_share  as in BallRowGeometry
/// @param by                has radial_growth, row_difference, inner_strain and outer_strain of BallRowInput
template <class Real, class Growth>
GroovesOf<Real> grown(GroovesOf<Real> g, const RowStrainsOf<Real>& strains, const Real& difference_share,
                      const Growth& by) {
  const auto& [of_inner, of_outer] = strains;
  g.A += by.inner_strain * of_inner.groove + by.outer_strain * of_outer.groove;
  g.radial += by.radial_growth + difference_share * by.row_difference +
              (by.inner_strain * of_inner.radial + by.outer_strain * of_outer.radial);
  g.axial += by.inner_strain * of_inner.axial + by.outer_strain * of_outer.axial;
  return g;
}

/// Raceways' edges as the tractions' sums need them. Beyond an edge lies 1/2 - r (sine cos phi - cosine |sin phi|) / (2 a) of the length 2 a, a = factor K^(1/3) root.
template <class Real>
struct RaceEdgeOf {
  Real sine, cosine;  // times r / (2 factor K^(1/3))
  RaceEdgeOf() = default;
  /// @param stiffness_root  K^(1/3)
  RaceEdgeOf(const RaceContactOf<Real>& race, const Real& stiffness_root) {
    const Real per_axis = 0.5 * race.groove_radius / (race.axis_factor * stiffness_root);
    const auto has_edge = race.groove_radius > 0.;
    sine = select(has_edge, per_axis * race.edge_sine, Real(1e30));
    cosine = select(has_edge, per_axis * race.edge_cosine, Real(-1e30));
  }
  /// What lies beyond the edge, below 0 if nothing does; with stiffness_root = 1 root is that of the load, Q^(1/3).
  [[nodiscard, gnu::always_inline]] inline Real beyond(Real sin_phi, Real cos_phi, Real root) const {
    return 0.5 - (sine * cos_phi - cosine * abs(sin_phi)) / (root + 1e-30);
  }
};
template <class Real>
struct RaceEdgesOf {
  RaceEdgeOf<Real> inner, outer;
};

/// What a row is, as numbers: nothing but these, so that those of several drops can be laid side by side.
template <class Real>
struct RowNumbers {
  GroovesOf<Real> grooves;
  RowStrainsOf<Real> strains;
  Real position;                            ///< of the inner groove's centre along the axis, in the ring's frame [m]
  Real difference_share;                    ///< as in BallRowGeometry
  Real stiffness, damping, stiffness_root;  ///< K, 1.5 beta, K^(1/3)
  Real ball_mass, pitch_diameter, inner_gyroscopic_share;  ///< as in BallRowGeometry
  RaceContactOf<Real> inner, outer;
  RaceEdgesOf<Real> edges;
  InertialRowOf<Real> inertial;  ///< balls with inertia
  RaceEdgesOf<Real> load_edges;  ///< and the edges for roots of their loads

  /// F_0 = m d_m omega^2 / 2 [N]: the centrifugal force of a ball that would go round as fast as the ring.
  [[nodiscard]] Real inertia_force(const Real& ring_speed) const {
    return rotordrop::centrifugal_force(ball_mass, pitch_diameter, ring_speed);
  }
  /// Below, the closed form of balls without inertia has the same digits; the balance would have none to work on [N].
  static constexpr double negligible_inertia_force = 1e-9;
  /// What adds to the deflections of both contacts, waves left out [m].
  struct Added {
    Real inner, outer;
  };
  [[nodiscard]] Added added(const BallRowInputOf<Real>& in) const {
    return {in.ball_growth - in.inner_strain * strains.inner.groove,
            in.ball_growth - in.outer_strain * strains.outer.groove};
  }
  /// Centrifugal force of a ball at the cage's speed [N].
  [[nodiscard]] Real centrifugal_force(const BallRowInputOf<Real>& in) const {
    return rotordrop::centrifugal_force(ball_mass, pitch_diameter, in.cage_speed);
  }
  /// dU/d(inner_strain) and dU/d(outer_strain) [J] of an evaluation.
  [[nodiscard]] std::pair<Real, Real> strain_gradient(const BallRowOutputOf<Real>& out) const {
    const auto gradient = [&](const GrooveStrainOf<Real>& s, const Real& normal) {
      return s.axial * out.elastic_axial + s.radial * out.elastic_radial - s.groove * normal;
    };
    return {gradient(strains.inner, out.elastic_normal - out.elastic_outer_surplus),
            gradient(strains.outer, out.elastic_normal + out.elastic_outer_surplus)};
  }
};

/// Forces of a row of balls after Sopanen & Mikkola (2003), without trigonometry per ball. With b the azimuth of a ball,
///   e_r = e_y cos b + e_z sin b + x_row (psi_z cos b - psi_y sin b),   e_t = e_x + R_c (psi_y sin b - psi_z cos b),
///   B_r = A cos phi_0 - clearance + e_r + eps_in - eps_out + g cos phi_0,   B_x = s (A sin phi_0 + offset) + e_t + u_x,in - u_x,out + s g sin phi_0,
///   delta = sqrt(B_r^2 + B_x^2) - A - g + 2 eps_b + waves,                 F = K delta^0.5 (delta + 1.5 beta delta') >= 0,
/// u_x the axial displacements of the contact points and g the growth of both groove radii (row_strains()), delta' being the ring's rate along the contact normal (B_r, B_x), without cage motion. The tilts' terms are those of u = psi x r with the
/// one arm R_c, so the elastic forces are the gradient of an energy. With inertia and a turning ring each ball has its own balance
/// (inertial_balls.h); F is then its load on the inner race, along the inner contact's normal, damped with the same beta.
/// Corrects Neisi 2019, eqs. (2)-(6), (12); see docs/theory/model.md. Each equation stands at its line in ball_terms.h.
class BallRow {
 public:
  static constexpr int max_balls = most_balls;

  /// @throws std::invalid_argument for more than max_balls balls
  BallRow(const BallRowGeometry& geometry, const std::vector<RaceWave>& waves);

  [[nodiscard]] const BallRowGeometry& geometry() const { return geometry_; }
  /// Axial and tilting motion of the ring taken as zero: the cheap form for rings that only translate.
  /// @param tractions  if given, what skidding needs besides, F_c being that of the cage's speed; with inertia of the
  ///                   balls' own balance, without their damping
  void evaluate_translations(const BallRowInput& input, BallRowOutput& out, RowTractions* tractions = nullptr) const;
  void evaluate(const BallRowInput& input, BallRowOutput& out, RowTractions* tractions = nullptr) const;
  /// Load of every ball on the inner race [n_balls] [N]; with inertia without its damping.
  void ball_loads(const BallRowInput& input, std::span<double> load, std::span<double> outer_load = {}) const;
  /// Elastic energy sum 2/5 K delta^2.5 [J], of both contacts.
  [[nodiscard]] double energy(const BallRowInput& input) const;
  /// Axial approach of the races [m] at which an undisplaced row carries an axial load [N] with this geometry's contact.
  static double offset_for_axial_load(const BallRowGeometry& geometry, double axial_load);
  [[nodiscard]] const RowNumbers<double>& numbers() const { return numbers_; }
  /// Whether the centres of both grooves stay in one plane while the ring only translates, whatever grows.
  [[nodiscard]] bool is_radial() const {
    return numbers_.grooves.axial == 0. && numbers_.strains.inner.axial == 0. && numbers_.strains.outer.axial == 0.;
  }
  [[nodiscard]] std::size_t n_balls() const { return static_cast<std::size_t>(geometry_.n_balls); }
  /// Of the balls' azimuths at cage angle zero [n_balls].
  [[nodiscard]] std::span<const double> cosines() const { return {cosine_.data(), n_balls()}; }
  [[nodiscard]] std::span<const double> sines() const { return {sine_.data(), n_balls()}; }
  [[nodiscard]] const RaceWaves& waves() const { return waves_; }
  /// Of a row whose balls have inertia, else nullptr.
  [[nodiscard]] const InertialStarts* starts() const { return starts_.get(); }

 private:
  /// @param waves, bent  space that what is returned may refer to
  [[nodiscard]] KernelInput kernel_input(const BallRowInput& input, WavesAtBalls& waves, Widening& bent) const;
  [[nodiscard]] KernelInput smooth_input(const BallRowInput& input) const;
  template <class Kernel>
  void press(Kernel kernel, const KernelInput& balls, const BallRowInput& input, BallRowOutput& out,
             RowTractions* tractions) const;
  template <class Kernel>
  void run_with_space(Kernel kernel, const BallRowInput& input, BallRowOutput& out, RowTractions* tractions) const;
  template <class Kernel>
  void run(Kernel kernel, const BallRowInput& input, BallRowOutput& out, RowTractions* tractions) const;
  void tabulate_shapes(const std::vector<double>& azimuth);
  void widen(const BallRowInput& input, Widening& widening) const;
  void press_shapes(const BallRowInput& input, Widening& widening) const;
  [[nodiscard]] double inertia_force(const BallRowInput& input) const;
  /// @param tilts  false for a ring that only translates; @param waves, bent  space that what is returned may refer to
  [[nodiscard]] InertialInput inertial_input(const BallRowInput& input, double F_0, bool tilts, WavesAtBalls& waves,
                                             Widening& bent) const;
  void inertial_loads(const BallRowInput& input, double F_0, std::span<double> inner, std::span<double> outer) const;
  [[nodiscard]] double inertial_energy(const BallRowInput& input, double F_0) const;
  void evaluate_inertial(const BallRowInput& input, double F_0, bool tilts, BallRowOutput& out,
                         RowTractions* tractions) const;

  BallRowGeometry geometry_;
  RowNumbers<double> numbers_{};
  std::shared_ptr<const InertialStarts> starts_;  // of a row with inertia
  AlignedNumbers cosine_, sine_;  // of the balls' azimuths at cage angle zero, [n_padded]: filled up with idle balls
  std::size_t n_padded_ = 0;
  RaceWaves waves_;
  AlignedNumbers
      shapes_;  // cos, sin of n times the azimuths at cage angle zero, n = 2 ...: [2 (highest - 1)][n_padded]
  AlignedNumbers shapes_by_ball_;  // the same, [n_padded][2 (highest - 1), filled up to whole vectors]
};

}  // namespace rotordrop
