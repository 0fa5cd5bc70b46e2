#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "bearing/support/support_parameters.h"
#include "bearing/touchdown_bearing.h"
#include "laws/hertz.h"
#include "model/circuit_factors.h"

namespace rotordrop {

/// Friction of rotor and bore near rest.
enum class FrictionLaw {
  automatic,    ///< sticking for a rotor that is free along its axis, else regularised
  regularised,  ///< through zero with the slip speed: a resting rotor creeps under a force
  sticking      ///< elastic-plastic (laws/sticking.h): it stays
};

/// [contact]: rotor surface against inner-ring bore, for all touchdown bearings.
struct ContactParameters {
  double friction_coefficient = 0, air_gap = 0, exponent = 0, lambda = 0, regularisation_speed = 0;
  std::optional<double> bore_radius;
  std::optional<double> static_friction_coefficient;
  double stribeck_speed = 0;
  std::optional<std::vector<std::array<double, 2>>> friction_over_speed, friction_over_temperature;
  double wear_coefficient_bore = 0, wear_coefficient_rotor = 0, wear_depth_limit = 0;
  FrictionLaw friction_law = FrictionLaw::automatic;
  double tangential_stiffness = 0, contact_length = 0;
};
Section<ContactParameters> contact_section();

enum class WavySurface { inner_race, outer_race, bore };

/// One wave of bearings.NAME.waviness.
struct WavinessParameters {
  WavySurface surface = WavySurface::inner_race;
  int order = 1;
  double amplitude = 0, phase = 0;
};

/// What an inner ring may do besides spinning.
enum class RingMotion {
  translations,  ///< in the plane across the axis
  free           ///< along the axis too, and tilt
};

/// bearings.NAME.shoulders: of the rotor, beside a free inner ring.
struct ShoulderParameters {
  std::optional<double> gap_minus_x, gap_plus_x;  ///< at the ring's face at -x, +x [m]
  std::optional<double> radius;
  std::optional<double> stiffness;  ///< none: from the bodies' geometry
};

enum class RowArrangement { face_to_face, back_to_back, tandem };

/// Heat inside the bearing: of the friction torque alone, with the balls' spin moments as an additional torque, or torque times ball speed (eq. 24).
enum class InternalHeat { energy_consistent, with_spin, ball_speed };

/// What the fit of the outer ring in its housing passes on: pressure alone, or every traction.
enum class HousingFit { frictionless, bonded };

/// bearings.NAME with type = "touchdown".
struct TouchdownParameters {
  std::optional<std::string> catalogue;
  int node = 0;
  std::optional<double> contact_stiffness, contact_width, crown_radius;
  std::optional<double> bore_radius, air_gap;
  int rows = 1, balls_per_row = 0;
  RowArrangement arrangement = RowArrangement::face_to_face;
  double ball_diameter = 0, pitch_diameter = 0;
  std::array<double, 2> conformity{};
  double contact_angle = 0, radial_clearance = 0, preload = 0, row_phase = 0, cage_phase = 0;
  std::optional<double> row_spacing;
  std::string ball, ring;
  double ring_mass = 0, ring_spin_inertia = 0, width = 0;
  double f1_z = 0, f1_y = 0, f2 = 0, C0 = 0;
  std::optional<double> C, bore_diameter, outside_diameter;
  SupportParameters support;
  std::vector<WavinessParameters> waviness;
  double ball_damping_beta = 0, drag_viscosity = 0, drag_regularisation = 0;
  RingMotion ring_motion = RingMotion::translations;
  std::optional<double> ring_diametral_inertia;
  ShoulderParameters shoulders;
  BallModel ball_model = BallModel::quasi_static;
  GyroscopicSplit gyroscopic_split = GyroscopicSplit::outer;
  InternalHeat internal_heat = InternalHeat::energy_consistent;
  FrictionLoadLaw load_law = FrictionLoadLaw::radial;
  EllipticIntegrals elliptic_integrals = EllipticIntegrals::brewe_hamrock;
  std::optional<double> race_friction_coefficient;
  std::array<double, 2> inner_ring_diameters{}, outer_ring_diameters{}, housing_diameters{};
  std::optional<double> inner_shoulder_diameter, outer_shoulder_diameter;
  double housing_length = 0;
  double housing_fit = 0;
  HousingFit housing_fit_kind = HousingFit::frictionless;
  std::optional<double> shaft_lump_length;
  CircuitFactors circuit;
  RingBendingModel ring_bending = RingBendingModel::none;
  int ring_harmonics = 0;
  double ring_bending_damping = 0, ring_frequency_limit = 0;
  std::optional<double> outer_ring_bedding;
};
Section<TouchdownParameters> touchdown_section();

/// Pressure at which a ball leaves a permanent mark of 1e-4 of its diameter [Pa]. Source: ISO 76, ball bearings.
inline constexpr double static_pressure_limit = 4.2e9;

/// The rotor under a bearing.
struct JournalBody {
  ElasticMaterial material;
  double inner_radius = 0;  ///< of a hollow shaft [m]
};

/// What a touchdown bearing takes from elsewhere in the case.
struct TouchdownSurroundings {
  ElasticMaterial ring, ball;
  std::array<double, 3> gravity{};     ///< along x, y, z [m/s^2]
  double ball_density = 0;             ///< [kg/m^3]
  bool has_axial_motion = false;       ///< the rotor is free along its axis
  double ring_density = 0;             ///< [kg/m^3]; for rings that bend
  std::optional<JournalBody> journal;  ///< none: a solid one of the rings' material
};

/// Radius of the bore [m]: the bearing's own, else that of [contact], else half the inner ring's bore.
double bore_radius(const TouchdownParameters& bearing, const ContactParameters& contact);
/// Radial air gap [m]: the bearing's own, else that of [contact].
double air_gap(const TouchdownParameters& bearing, const ContactParameters& contact);

/// What lies between a rotor that leans on a shoulder and the balls: a half space under the annulus that touches, and the ring's wall from its face to the row
/// that carries the load [m/N].
struct ShoulderCompliance {
  double rotor = 0, ring = 0;
  [[nodiscard]] double stiffness() const { return 1. / (rotor + ring); }
};
ShoulderCompliance shoulder_compliance(const TouchdownParameters& bearing, const ElasticMaterial& ring);
/// The given one, or that of the geometry [N/m].
double shoulder_stiffness(const TouchdownParameters& bearing, const ElasticMaterial& ring);

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

TouchdownBearingData touchdown_data(const std::string& name, const TouchdownParameters& bearing,
                                    const ContactParameters& contact, const TouchdownSurroundings& surroundings);

/// Checks that need both the bearing and [contact]; the tables give the places of faults.
void check_touchdown(const std::string& name, const TouchdownParameters& bearing, const ContactParameters& contact,
                     const Node& bearing_table, const Node& contact_table, Faults& faults);

}  // namespace rotordrop
