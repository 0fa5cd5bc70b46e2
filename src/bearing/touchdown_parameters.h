#pragma once

// The keys of [bearings.NAME] with type = "touchdown", and what follows from them alone.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "bearing/contact_parameters.h"
#include "bearing/support/support_parameters.h"
#include "bearing/touchdown_bearing.h"
#include "laws/hertz.h"
#include "model/circuit_factors.h"

namespace rotordrop {

enum class WavySurface { inner_race, outer_race, bore };

/// One wave of bearings.NAME.waviness.
struct WavinessParameters {
  WavySurface surface = WavySurface::inner_race;
  int order = 1;
  double amplitude = 0;  ///< [m]
  double phase = 0;      ///< [rad]
};

/// What an inner ring may do besides spinning.
enum class RingMotion {
  translations,  ///< in the plane across the axis
  free           ///< along the axis too, and tilt
};

/// bearings.NAME.shoulders: of the rotor, beside a free inner ring.
struct ShoulderParameters {
  std::optional<double> gap_minus_x, gap_plus_x;  ///< at the ring's face at -x, +x [m]
  std::optional<double> radius;                   ///< mean radius of the faces that touch [m]
  std::optional<double> stiffness;                ///< [N/m]; none: from the bodies' geometry

  [[nodiscard]] bool any() const { return gap_minus_x || gap_plus_x; }
};

enum class RowArrangement { face_to_face, back_to_back, tandem };

/// Heat inside the bearing: of the friction torque alone, with the balls' spin moments as an additional torque, or torque times ball speed (eq. 24).
enum class InternalHeat { energy_consistent, with_spin, ball_speed };

/// What the fit of the outer ring in its housing passes on: pressure alone, or every traction.
enum class HousingFit { frictionless, bonded };

/// bearings.NAME with type = "touchdown".
struct TouchdownParameters {
  std::optional<std::string> catalogue;
  int count = 1;  ///< of catalogue bearings beside each other
  int node = 0;
  std::optional<double> contact_stiffness;            ///< K of rotor and bore [N/m^n]
  std::optional<double> contact_width, crown_radius;  ///< [m]
  std::optional<double> bore_radius, air_gap;         ///< [m]
  int rows = 1, balls_per_row = 0;
  RowArrangement arrangement = RowArrangement::face_to_face;
  double ball_diameter = 0, pitch_diameter = 0;  ///< d, d_m [m]
  std::array<double, 2> conformity{};            ///< inner, outer groove radius over d
  double contact_angle = 0;                      ///< [rad]
  double radial_clearance = 0;                   ///< half the diametral one [m]
  double preload = 0;                            ///< of each row [N]
  double row_phase = 0, cage_phase = 0;          ///< [rad]
  std::optional<double> row_spacing;             ///< [m]
  std::string ball, ring;                        ///< materials
  std::optional<std::string> journal;            ///< material; none: that of the ring
  double ring_mass = 0;                          ///< inner ring(s) [kg]
  double ring_spin_inertia = 0;                  ///< with balls and cage [kg m^2]
  double width = 0;                              ///< of the rings, all rows [m]
  double f1_z = 0, f1_y = 0, f2 = 0;             ///< of the friction torque (laws/bearing_friction.h)
  double C0 = 0;                                 ///< static load rating of all rows together [N]
  double required_static_safety = 1;
  std::optional<double> C;                                ///< dynamic load rating [N]
  std::optional<double> bore_diameter, outside_diameter;  ///< [m]
  SupportParameters support;
  std::vector<WavinessParameters> waviness;
  double ball_damping_beta = 0;    ///< [s]
  double drag_viscosity = 0;       ///< [m^2/s]
  double drag_regularisation = 0;  ///< [rad/s]
  RingMotion ring_motion = RingMotion::translations;
  std::optional<double> ring_diametral_inertia;  ///< [kg m^2]
  ShoulderParameters shoulders;
  BallModel ball_model = BallModel::quasi_static;
  CageModel cage = CageModel::rolling;
  std::optional<double> cage_inertia;             ///< [kg m^2]
  double race_traction = 0, pocket_friction = 0;  ///< coefficients
  double race_traction_slip = 0;                  ///< [m/s]
  GyroscopicSplit gyroscopic_split = GyroscopicSplit::outer;
  InternalHeat internal_heat = InternalHeat::energy_consistent;
  FrictionLoadLaw load_law = FrictionLoadLaw::radial;
  EllipticIntegrals elliptic_integrals = EllipticIntegrals::brewe_hamrock;
  std::optional<double> race_friction_coefficient;
  std::array<double, 2> inner_ring_diameters{}, outer_ring_diameters{}, housing_diameters{};  ///< [m]
  std::optional<double> inner_shoulder_diameter, outer_shoulder_diameter;                     ///< [m]
  double housing_length = 0;                                                                  ///< [m]
  double housing_fit = 0;  ///< interference with the outer ring, by radius [m]
  HousingFit housing_fit_kind = HousingFit::frictionless;
  std::optional<double> shaft_lump_length;  ///< [m]; none: the width
  CircuitFactors circuit;
  RingBendingModel ring_bending = RingBendingModel::none;
  int ring_harmonics = 0;
  double ring_bending_damping = 0;           ///< part of the critical one
  double ring_frequency_limit = 0;           ///< [Hz]
  std::optional<double> outer_ring_bedding;  ///< radial stiffness of the housing's bore per area [N/m^3]
};
Section<TouchdownParameters> touchdown_section();

/// Pressure at which a ball leaves a permanent mark of 1e-4 of its diameter [Pa]. Source: ISO 76, ball bearings.
inline constexpr double static_pressure_limit = 4.2e9;
/// Static safety: the load that makes that pressure over the one that makes a given pressure [Pa], which grows with its cube (Hertz).
inline double static_safety(double pressure) { return std::pow(static_pressure_limit / pressure, 3); }

/// Radius of the bore [m]: the bearing's own, else that of [contact], else half the inner ring's bore.
double bore_radius(const TouchdownParameters& bearing, const ContactParameters& contact);
/// Radial air gap [m]: the bearing's own, else that of [contact].
double air_gap(const TouchdownParameters& bearing, const ContactParameters& contact);

/// What the outer ring's support takes from its bearing.
SupportSurroundings support_surroundings(const TouchdownParameters& bearing);

/// Where a row of balls sits, and which way it leans.
struct RowPlace {
  double position = 0;          ///< along the axis, from the middle of the bearing [m]
  double direction = 1;         ///< side to which the outer contact leans
  double difference_share = 0;  ///< of Expansion::row_difference, beyond the mean of the rows
};
/// Of all rows, with rising position.
std::vector<RowPlace> row_places(const TouchdownParameters& bearing);

}  // namespace rotordrop
