#include "bearing/touchdown_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bearing/contact_stiffness.h"
#include "bearing/ring_bending_parameters.h"
#include "laws/ball_kinematics.h"
#include "laws/shoulder_contact.h"

namespace rotordrop {
namespace {

constexpr const char* paper = "Neisi, Heikkinen & Sopanen 2019";

Section<WavinessParameters> waviness_section() {
  Section<WavinessParameters> s("waviness",
                                "Sinusoidal deviations of bearing surfaces, any number; their amplitudes superpose.");
  using W = WavySurface;
  s.choice("surface", &WavinessParameters::surface,
           {{"inner_race", W::inner_race},
            {"outer_race", W::outer_race},
            {"bore", W::bore},
            {"inner", W::inner_race},
            {"outer", W::outer_race}},
           {.help = "Surface with the waviness; \"inner\" and \"outer\" are the raceways. Waviness of inner raceway "
                    "and bore turns with the inner ring."});
  s.integer("order", &WavinessParameters::order,
            {.range = between(1, 1000), .help = "Waves per turn: 1 is eccentricity, 2 ellipticity, 3 a triangle."});
  s.quantity("amplitude", &WavinessParameters::amplitude,
             {.unit = "m",
              .range = between(-1e-3, 1e-3),
              .help = "Half the height from valley to peak; positive means more penetration."});
  s.quantity("phase", &WavinessParameters::phase,
             {.unit = "rad", .fallback = "0", .help = "Phase of the wave at +y when the ring has not turned."});
  return s;
}

Section<CircuitFactors> circuit_section() {
  using P = CircuitFactors;
  Section<P> s("circuit",
               "Calibration factors of the bearing's lumped circuit; they multiply the values derived from geometry.");
  const auto factor = [&](const char* key, double P::*member, const char* help) {
    s.quantity(key, member,
               {.range = between(1e-2, 1e2), .fallback = "1", .source = "1: the circuit as published", .help = help});
  };
  factor("shaft_ring", &P::shaft_ring, "Factor on R2 + R3, shaft to inner ring.");
  factor("inner_race", &P::inner_race, "Factor on R4, inner ring to its contact with the balls.");
  factor("ball", &P::ball, "Factor on R5, balls and constriction, at both raceways.");
  factor("outer_race", &P::outer_race, "Factor on R7, ball contact to outer ring.");
  factor("fit", &P::fit, "Factor on R8, outer ring to housing.");
  factor("inner_ring_capacity", &P::inner_ring_capacity, "Factor on the heat capacity of the inner ring.");
  factor("outer_ring_capacity", &P::outer_ring_capacity, "Factor on the heat capacity of the outer ring.");
  factor("housing_capacity", &P::housing_capacity, "Factor on the heat capacity of the housing.");
  return s;
}

Section<ShoulderParameters> shoulder_section() {
  using P = ShoulderParameters;
  Section<P> s("shoulders", "Shoulders of the rotor that meet the inner ring's faces and take axial load.");
  s.quantity("gap_minus_x", &P::gap_minus_x,
             {.unit = "m",
              .range = at_least(0),
              .help = "Axial gap to the shoulder at the ring's -x face, with ring and rotor in their unloaded "
                      "positions. This shoulder stops a rotor moving towards +x. If not given, there is no shoulder."});
  s.quantity("gap_plus_x", &P::gap_plus_x,
             {.unit = "m",
              .range = at_least(0),
              .help = "Axial gap to the shoulder at the +x face, which stops motion towards -x."});
  s.quantity("radius", &P::radius,
             {.unit = "m",
              .range = positive(),
              .help = "Mean radius of the touching faces; midway between the inner ring's diameters if not given. They "
                      "touch equally far to both sides of it, up to the nearer edge of the ring's face."});
  s.quantity(
      "stiffness", &P::stiffness,
      {.unit = "N/m",
       .range = positive(),
       .help =
           "Contact stiffness of the whole face; from the bodies if not given: the rotor's shoulder as a half space "
           "under the faces that touch, in series with the ring's wall between its face and the row that carries "
           "the load. That holds for flat faces in full contact and a shoulder as stiff as the shaft: a collar, a "
           "sleeve or faces that are not flat are softer. Damping from contact.lambda, friction from "
           "contact.friction_coefficient."});
  return s;
}

void add_row_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.integer(
      "rows", &P::rows,
      {.range = between(1, 8), .fallback = 1, .help = "Rows of balls on one inner ring (or rings clamped together)."});
  s.choice(
      "arrangement", &P::arrangement,
      {{"X", RowArrangement::face_to_face}, {"O", RowArrangement::back_to_back}, {"tandem", RowArrangement::tandem}},
      {.fallback = "X",
       .help = "Arrangement of two rows: X (face-to-face), O (back-to-back) or tandem. Not used for a single row."});
  s.integer("balls_per_row", &P::balls_per_row,
            {.range = between(3, BallRow::max_balls), .help = "Number of balls Z per row."});
  s.quantity("ball_diameter", &P::ball_diameter, {.unit = "m", .range = positive(), .help = "Diameter d of a ball."});
  s.quantity("pitch_diameter", &P::pitch_diameter,
             {.unit = "m", .range = positive(), .help = "Diameter d_m of the circle of ball centres."});
  s.quantities(
      "conformity", &P::conformity,
      {.range = between(0.501, 0.6),
       .fallback = {"0.52", "0.52"},
       .source = "usual value",
       .help = "Groove radius divided by ball diameter, inner and outer raceway. Smaller values stiffen the contact."});
  s.quantity("contact_angle", &P::contact_angle,
             {.unit = "rad",
              .range = between(0, 1.2),
              .fallback = "0 deg",
              .help = "Nominal contact angle; 0 for a deep-groove bearing."});
  s.quantity("radial_clearance", &P::radial_clearance,
             {.unit = "m",
              .range = between(-1e-4, 1e-3),
              .fallback = "0 um",
              .help = "Radial clearance, mounted, cold and at standstill: half of a catalogue's radial internal "
                      "clearance (C3 and so on), which is diametral. For deep-groove bearings."});
  s.quantity("preload", &P::preload,
             {.unit = "N",
              .range = at_least(0),
              .fallback = "0 N",
              .help = "Axial preload of a set of angular-contact rows, mounted, cold and at standstill: the axial load "
                      "of each row, which is the preload that catalogues give for a pair. More preload stiffens the "
                      "bearing."});
  s.quantity("row_phase", &P::row_phase,
             {.range = between(-1, 1),
              .fallback = "0",
              .help = "Azimuth of a row's first ball relative to the previous row, in ball spacings."});
  s.quantity("cage_phase", &P::cage_phase,
             {.range = between(-1, 1),
              .fallback = "0",
              .help = "Azimuth of the first row's first ball at the start of a drop and in statics, from +y, in ball "
                      "spacings."});
  s.quantity("row_spacing", &P::row_spacing,
             {.unit = "m",
              .range = positive(),
              .help = "Axial distance between neighbouring rows; width / rows if not given."});
  s.text("ball", &P::ball, {.fallback = "steel", .help = "Material of the balls, a name of [materials]."});
  s.text("ring", &P::ring,
         {.fallback = "steel", .help = "Material of rings, housing and shaft lump, a name of [materials]."});
  s.choice(
      "elliptic_integrals", &P::elliptic_integrals,
      {{"fit", EllipticIntegrals::brewe_hamrock}, {"exact", EllipticIntegrals::exact}},
      {.fallback = "fit",
       .source = "Brewe & Hamrock 1977; the fits are within 1.2 % of the exact integrals",
       .help = "Elliptic integrals for the Hertz contact stiffness of balls and raceways: fitted formulas or exact."});
  s.choice(
      "ball_model", &P::ball_model, {{"quasi-static", BallModel::quasi_static}, {"inertial", BallModel::inertial}},
      {.fallback = "quasi-static",
       .help =
           "quasi-static: massless balls. inertial: each ball in equilibrium with its centrifugal force and gyroscopic "
           "moment (Jones, outer-race control), with separate contact stiffnesses at inner and outer raceway."});
  s.choice("gyroscopic_split", &P::gyroscopic_split,
           {{"outer", GyroscopicSplit::outer}, {"equal", GyroscopicSplit::equal}},
           {.fallback = "outer",
            .source = "Jones 1960, outer-race control; Harris' lambda_o = 2 or lambda_i = lambda_o = 1",
            .help = "Raceway whose friction balances the gyroscopic moments of inertial balls: the outer one, or half "
                    "on each. Equal halves lower the preload at speed."});
  s.quantity("ball_damping_beta", &P::ball_damping_beta,
             {.unit = "s",
              .range = between(0, 1e-3),
              .fallback = "2.5e-5 s",
              .source = std::string(paper) + ", upper end of the range 0.25..2.5e-5",
              .help = "Damping of a ball's contacts divided by their tangent stiffness."});
}

void add_ring_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.quantity("ring_mass", &P::ring_mass,
             {.unit = "kg", .range = positive(), .help = "Mass of the inner ring, of all rows together."});
  s.quantity("ring_spin_inertia", &P::ring_spin_inertia,
             {.unit = "kg m2",
              .range = positive(),
              .help = "Spin inertia of the inner ring with its balls and cage. Sets spin-up time and rub heat."});
  s.choice("ring_motion", &P::ring_motion, {{"translations", RingMotion::translations}, {"free", RingMotion::free}},
           {.fallback = "translations",
            .help = "Motion of the inner ring besides spin: radial only (translations), or also axial and tilting "
                    "(free). A free ring contacts the rotor along its whole width."});
  s.quantity("ring_diametral_inertia", &P::ring_diametral_inertia,
             {.unit = "kg m2",
              .range = positive(),
              .help = "Moment of inertia of the inner ring about a diameter, for ring_motion = \"free\"; if not given, "
                      "that of a hollow cylinder with its mass, diameters and width."});
  s.table("shoulders", &P::shoulders, shoulder_section(),
          {.help = "Shoulders of an axially free rotor next to a free inner ring."});
  s.quantity("width", &P::width,
             {.unit = "m", .range = positive(), .help = "Width of the bearing, all rows together."});
  s.quantities("inner_ring_diameters", &P::inner_ring_diameters,
               {.unit = "m", .range = positive(), .help = "Bore and outside (shoulder) diameter of the inner ring."});
  s.quantities("outer_ring_diameters", &P::outer_ring_diameters,
               {.unit = "m", .range = positive(), .help = "Inside (shoulder) and outside diameter of the outer ring."});
  s.quantity("inner_shoulder_diameter", &P::inner_shoulder_diameter,
             {.unit = "m",
              .range = positive(),
              .help = "Shoulder beside the inner ring's groove, where the raceway ends; the second of "
                      "inner_ring_diameters if not given."});
  s.quantity("outer_shoulder_diameter", &P::outer_shoulder_diameter,
             {.unit = "m",
              .range = positive(),
              .help = "Shoulder beside the outer ring's groove, where the raceway ends; the first of "
                      "outer_ring_diameters if not given."});
  s.quantities("housing_diameters", &P::housing_diameters,
               {.unit = "m", .range = positive(), .help = "Housing: bore and outside diameter."});
  s.quantity(
      "housing_length", &P::housing_length,
      {.unit = "m", .range = positive(), .help = "Axial length of the housing that takes up heat, all rows together."});
  s.quantity("housing_fit", &P::housing_fit,
             {.unit = "m",
              .range = between(-1e-3, 1e-3),
              .fallback = "0 um",
              .source = "estimate",
              .help = "Radial interference between outer ring and housing before assembly, half of what fits are given "
                      "by, the diameter; negative: clearance. Used by thermal.expansion = \"elastic\". Growth is "
                      "measured from the assembled state."});
  s.choice(
      "housing_fit_kind", &P::housing_fit_kind,
      {{"frictionless", HousingFit::frictionless}, {"bonded", HousingFit::bonded}},
      {.fallback = "frictionless",
       .help = "What the fit transmits: pressure only (it opens instead of going into tension), or every traction."});
  s.quantity("shaft_lump_length", &P::shaft_lump_length,
             {.unit = "m",
              .range = positive(),
              .help = "Length of shaft that takes up rub heat; the bearing's width if not given."});
  s.table(
      "circuit", &P::circuit, circuit_section(),
      {.help = "Calibration factors of the bearing's lumped circuit; they multiply the values derived from geometry."});
  s.table("support", &P::support, support_section());
  s.list("waviness", &P::waviness, waviness_section());
}

void add_friction_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.quantity("f1_z", &P::f1_z,
             {.range = at_least(0),
              .help = "z in f1 = z (P0/C0)^y of the load-dependent friction torque f1 P1 d_m; load_law defines the "
                      "loads P0 and P1."});
  s.quantity("f1_y", &P::f1_y, {.range = at_least(0), .help = "y in f1 = z (P0/C0)^y."});
  s.quantity("C0", &P::C0,
             {.unit = "N",
              .range = positive(),
              .help = "Static load rating of all rows together; for a pair twice the catalogue value of a single "
                      "bearing. Each of n rows has C0 / n."});
  s.quantity("C", &P::C,
             {.unit = "N",
              .range = positive(),
              .help = "Dynamic load rating; not used by the drop, kept with the bearing's data."});
  s.quantity("f2", &P::f2,
             {.range = at_least(0),
              .fallback = "0.25",
              .source = "calibration: 0.25 per bearing gives the paper's 110 W; catalogues' 1-2 would give 0.4-0.7 kW",
              .help = "Factor of the speed-dependent friction torque, for the whole bearing or set."});
  s.quantity("drag_viscosity", &P::drag_viscosity,
             {.unit = "m2/s",
              .range = positive(),
              .fallback = "15e-6 m2/s",
              .source = std::string(paper) + ", air",
              .help = "Kinematic viscosity in the speed-dependent friction torque."});
  s.quantity("drag_regularisation", &P::drag_regularisation,
             {.unit = "rad/s",
              .range = positive(),
              .fallback = "2 rad/s",
              .source = "estimate",
              .help = "The friction torque passes through standstill as tanh(speed / this)."});
  s.choice(
      "load_law", &P::load_law, {{"radial", FrictionLoadLaw::radial}, {"equivalent", FrictionLoadLaw::equivalent}},
      {.fallback = "equivalent",
       .help = "Loads in the friction torque. equivalent: for each row, including its axial load F_a and thus preload, "
               "P0 = max(F_r, X0 F_r + Y0 F_a) by ISO 76 in (P0/C0)^y and P1 = max(F_r, 0.9 F_a cot phi - 0.1 F_r) "
               "times f1, for a row without contact angle 3 F_a in place of 0.9 F_a cot phi. radial: P0 and P1 are the "
               "radial resultant of all rows, without preload; thrust then causes no friction."});
  s.choice("internal_heat", &P::internal_heat,
           {{"energy-consistent", InternalHeat::energy_consistent},
            {"with-spin", InternalHeat::with_spin},
            {"ball-speed", InternalHeat::ball_speed}},
           {.fallback = "energy-consistent",
            .help = "Bearing friction heat. energy-consistent: from the friction torque. with-spin: the balls' spin "
                    "moments are an additional torque. ball-speed: friction torque times ball speed as in eq. 24 of "
                    "the reference paper, more heat than the work done; for comparison only."});
  s.quantity("race_friction_coefficient", &P::race_friction_coefficient,
             {.range = at_least(0),
              .help = "Friction coefficient between balls and raceways, for the spin moment and for the traction that "
                      "keeps the balls rolling (skid_demand); "
                      "contact.friction_coefficient if not given."});
}

/// @param path  name of the bearing's table, "bearings.TB1"
void check_geometry(const TouchdownParameters& b, const Node& table, const std::string& path, Faults& faults) {
  const auto mm = [](double metres) { return fmt::format("{:.6g} mm", metres * 1e3); };
  const auto fault = [&](const char* key, const std::string& message, const std::string& advice = "") {
    faults.add(position_of_value(table, key), fmt::format("{}: {}.", path, message), advice);
  };
  const double circumference = b.balls_per_row * b.ball_diameter;
  if (circumference > std::numbers::pi * b.pitch_diameter)
    fault("balls_per_row",
          fmt::format("{} balls of {} do not fit on a pitch circle of {}", b.balls_per_row, mm(b.ball_diameter),
                      mm(b.pitch_diameter)),
          "Check balls_per_row, ball_diameter and pitch_diameter.");
  const auto rising = [&](const char* key, const std::array<double, 2>& pair) {
    if (!(pair[0] < pair[1]))
      fault(key, fmt::format("{} = [{}, {}]: the second must be larger than the first", key, mm(pair[0]), mm(pair[1])));
    return pair[0] < pair[1];
  };
  const bool sane = rising("inner_ring_diameters", b.inner_ring_diameters) &
                    rising("outer_ring_diameters", b.outer_ring_diameters) &
                    rising("housing_diameters", b.housing_diameters);
  if (sane) {
    if (!(b.inner_ring_diameters[1] < b.pitch_diameter))
      fault("inner_ring_diameters",
            fmt::format("the inner ring's outside diameter {} is not smaller than the pitch_diameter {}",
                        mm(b.inner_ring_diameters[1]), mm(b.pitch_diameter)),
            "The inner ring must lie inside the pitch circle of its balls; check that both dimensions come from the "
            "same drawing.");
    if (!(b.outer_ring_diameters[0] > b.pitch_diameter))
      fault("outer_ring_diameters",
            fmt::format("the outer ring's inside diameter {} is not larger than the pitch_diameter {}",
                        mm(b.outer_ring_diameters[0]), mm(b.pitch_diameter)),
            "The outer ring must lie outside the pitch circle of its balls; check that both dimensions come from the "
            "same drawing.");
    if (b.housing_diameters[1] <= b.outer_ring_diameters[1])
      fault("housing_diameters", fmt::format("the housing's outside diameter {} is not larger than the outer ring's {}",
                                             mm(b.housing_diameters[1]), mm(b.outer_ring_diameters[1])));
    else if (std::abs(b.housing_diameters[0] - b.outer_ring_diameters[1]) > 0.01 * b.outer_ring_diameters[1])
      fault("housing_diameters",
            fmt::format("the housing's bore {} does not fit the outer ring's outside diameter {}",
                        mm(b.housing_diameters[0]), mm(b.outer_ring_diameters[1])),
            "The ring sits in the housing; count a sleeve between them as part of the housing.");
    const double projected = b.ball_diameter * std::cos(b.contact_angle);
    if (b.pitch_diameter - projected <= b.inner_ring_diameters[0])
      fault("ball_diameter",
            fmt::format("balls of {} on a pitch circle of {} reach into the bore of {}", mm(b.ball_diameter),
                        mm(b.pitch_diameter), mm(b.inner_ring_diameters[0])),
            "Check ball_diameter, pitch_diameter and inner_ring_diameters.");
    if (b.pitch_diameter + projected >= b.outer_ring_diameters[1])
      fault("ball_diameter",
            fmt::format("balls of {} on a pitch circle of {} reach out of the outer ring of {}", mm(b.ball_diameter),
                        mm(b.pitch_diameter), mm(b.outer_ring_diameters[1])),
            "Check ball_diameter, pitch_diameter and outer_ring_diameters.");
  }
  if (const auto& radius = b.shoulders.radius;
      radius && !b.shoulders.stiffness &&
      !(2. * *radius > b.inner_ring_diameters[0] && 2. * *radius < b.inner_ring_diameters[1]))
    fault("shoulders",
          fmt::format("shoulders.radius = {} is not on the inner ring's face, which reaches from {} to {}", mm(*radius),
                      mm(0.5 * b.inner_ring_diameters[0]), mm(0.5 * b.inner_ring_diameters[1])),
          "Check the radius, or give shoulders.stiffness.");
  const double A = (b.conformity[0] + b.conformity[1] - 1.) * b.ball_diameter;
  if (b.radial_clearance >= A * std::cos(b.contact_angle))
    fault("radial_clearance",
          fmt::format("radial_clearance = {} is not smaller than the distance of the groove centres, {}",
                      mm(b.radial_clearance), mm(A)));
  if (b.preload > 0. && b.contact_angle == 0.)
    fault("preload", fmt::format("preload = {:.6g} N on a bearing with contact_angle = 0", b.preload),
          "Balls at a contact angle of zero take no axial load: give a contact_angle, or no preload.");
  else if (b.preload > 0. && b.radial_clearance > 0.)
    fault("radial_clearance",
          fmt::format("radial_clearance = {} on a bearing with preload = {:.6g} N, which closes it",
                      mm(b.radial_clearance), b.preload),
          "Leave out one of the two.");
  if (b.rows > 2 && b.arrangement != RowArrangement::tandem)
    fault("arrangement", fmt::format("{} rows can only be in tandem", b.rows),
          "Allowed: X, O with rows = 2; tandem with any.");
  const bool is_opposed = b.rows == 2 && b.arrangement != RowArrangement::tandem;
  if (b.ring_motion == RingMotion::free && b.contact_angle != 0. && !is_opposed)
    fault("ring_motion",
          "ring_motion = \"free\" with rows whose contact angles all point the same way: their balls push the ring off "
          "axially and nothing holds it",
          "Take two rows in X or O, a contact_angle of 0, or ring_motion = \"translations\".");
  if (b.ring_motion != RingMotion::free && (b.shoulders.gap_minus_x || b.shoulders.gap_plus_x))
    fault("shoulders", "shoulders beside a ring that cannot move along the axis", "Set ring_motion = \"free\".");
  // The ring's mass at half the pitch radius spins with a quarter of a hoop's inertia; balls and cage add less than the ring has.
  const double hoop = 0.25 * b.ring_mass * b.pitch_diameter * b.pitch_diameter;
  if (b.ring_spin_inertia > 20. * hoop || b.ring_spin_inertia < 0.05 * hoop)
    fault("ring_spin_inertia",
          fmt::format("the ring_spin_inertia of {:.6g} kg m2 is far from that of a hoop of the ring's mass on the "
                      "pitch circle, {:.3g} kg m2.",
                      b.ring_spin_inertia, hoop),
          "Allowed: 1/20 to 20 times that value. Check the unit: kg m2, not kg mm2.");
}

}  // namespace

Section<ContactParameters> contact_section() {
  using P = ContactParameters;
  Section<P> s("contact", "Contact between rotor surface and inner-ring bore, for all touchdown bearings.");
  s.quantity("friction_coefficient", &P::friction_coefficient,
             {.range = between(0, 2),
              .fallback = "0.1",
              .source = std::string(paper) + ", table 2",
              .help = "Dynamic friction coefficient between rotor and bore. Larger values spin the ring up faster and "
                      "push the rotor further sideways."});
  s.quantity("air_gap", &P::air_gap,
             {.unit = "m",
              .range = positive(),
              .fallback = "250 um",
              .source = std::string(paper) + ", table 2",
              .help = "Radial gap between rotor and inner ring at rest and ambient temperature."});
  s.quantity("exponent", &P::exponent,
             {.range = between(1, 3),
              .fallback = "1.1111111111111112",
              .source = std::string(paper) + ", n = 10/9",
              .help = "Exponent n of the normal force K delta^n."});
  s.quantity("lambda", &P::lambda,
             {.unit = "s/m",
              .range = between(0, 5),
              .fallback = "0.08 s/m",
              .source = std::string(paper) + "; Hunt & Crossley 1975 give 0.08..0.32",
              .help = "Contact damping; for small impact speeds v the restitution is 1 - lambda v."});
  s.quantity("regularisation_speed", &P::regularisation_speed,
             {.unit = "m/s",
              .range = positive(),
              .fallback = "0.05 m/s",
              .source = "estimate",
              .help = "Friction is smoothed through zero slip as v / sqrt(v^2 + this^2). Smaller values are sharper "
                      "and harder to integrate."});
  s.quantity("bore_radius", &P::bore_radius,
             {.unit = "m",
              .range = positive(),
              .help = "Bore radius of the inner rings; half of the inner ring's bore diameter if not given."});
  s.quantity(
      "static_friction_coefficient", &P::static_friction_coefficient,
      {.range = between(0, 2), .help = "Static friction coefficient (Stribeck law); the dynamic value if not given."});
  s.quantity("stribeck_speed", &P::stribeck_speed,
             {.unit = "m/s",
              .range = positive(),
              .fallback = "0.5 m/s",
              .source = "estimate",
              .help = "Slip speed over which friction falls from the static to the dynamic value."});
  s.function("friction_over_speed", &P::friction_over_speed,
             {.argument_unit = "m/s",
              .range = between(0, 2),
              .help = "Dynamic friction coefficient between rotor and bore over slip speed; replaces "
                      "friction_coefficient in the contact. Linear between the pairs, constant outside; "
                      "regularisation_speed still applies. Values derived from a single coefficient "
                      "(race_friction_coefficient, the condition for a full rub) still use friction_coefficient."});
  s.function("friction_over_temperature", &P::friction_over_temperature,
             {.argument_unit = "K",
              .range = between(0, 10),
              .help = "Factor on the friction between rotor and bore over the mean temperature of the inner ring in "
                      "the lumped circuit: linear between the pairs, constant outside. The local temperature of the "
                      "rub contact has no influence."});
  s.quantity("wear_coefficient_bore", &P::wear_coefficient_bore,
             {.unit = "m2/N",
              .range = at_least(0),
              .fallback = "1e-14 m2/N",
              .source = "estimate: K/H with K = 7e-5 for unlubricated hardened steel (Archard 1953; Rabinowicz 1995: "
                        "1e-5 to 1e-3) and H = 7 GPa (60 HRC)",
              .help = "Wear volume of the bore divided by normal force and sliding distance (Archard). It affects only "
                      "the reported wear."});
  s.quantity("wear_coefficient_rotor", &P::wear_coefficient_rotor,
             {.unit = "m2/N",
              .range = at_least(0),
              .fallback = "2.3e-14 m2/N",
              .source = "estimate: K/H with the same K and H = 3 GPa (quenched and tempered steel of a landing sleeve)",
              .help = "Wear volume of the rotor surface divided by normal force and sliding distance (Archard)."});
  s.quantity("wear_depth_limit", &P::wear_depth_limit,
             {.unit = "m",
              .range = positive(),
              .fallback = "50 um",
              .source = "estimate: a fifth of the reference case's air gap",
              .help = "Permitted wear depth of bore or rotor; the number of drops until then is reported."});
  s.choice(
      "friction_law", &P::friction_law,
      {{"automatic", FrictionLaw::automatic},
       {"regularised", FrictionLaw::regularised},
       {"sticking", FrictionLaw::sticking}},
      {.fallback = "automatic",
       .help =
           "Friction between rotor and bore near zero slip. regularised: proportional to the slip speed there, so a "
           "resting rotor creeps. sticking: elastic-plastic, so a resting rotor stays in place. automatic: sticking "
           "with rotor.axial_motion = \"free\", otherwise regularised. Shoulders always use the regularised law."});
  s.quantity("tangential_stiffness", &P::tangential_stiffness,
             {.unit = "N/m",
              .range = positive(),
              .fallback = "1e8 N/m",
              .source = "estimate: about a third of the normal stiffness under a resting rotor (Mindlin: 0.8 of it)",
              .help = "Tangential contact stiffness between rotor and the whole bore before slip, for friction_law = "
                      "\"sticking\"."});
  s.quantity("contact_length", &P::contact_length,
             {.unit = "m",
              .range = positive(),
              .fallback = "2 mm",
              .source = "estimate: Hertz' line contact of rotor and bore under some hundred newtons",
              .help = "Length of the contact along the surface; with friction_law = \"sticking\" the bristles are "
                      "renewed after surfaces that turn together have moved by it."});
  s.check([](const P& p, const Node& table, Faults& faults) {
    if (p.bore_radius && p.air_gap >= *p.bore_radius)
      faults.add(position_of_value(table, "air_gap"),
                 fmt::format("contact.air_gap = {:.6g} mm is not smaller than bore_radius = {:.6g} mm.",
                             p.air_gap * 1e3, *p.bore_radius * 1e3),
                 "The rotor's radius is bore_radius - air_gap.");
    if (p.friction_over_speed && p.static_friction_coefficient)
      faults.add(
          position_of_value(table, "static_friction_coefficient"),
          "contact.static_friction_coefficient and contact.friction_over_speed both say how friction changes with "
          "slip speed.",
          "Give one of them; a table may begin with the static value at 0 m/s.");
    if (p.friction_over_speed && p.friction_over_speed->front()[0] < 0.)
      faults.add(position_of_value(table, "friction_over_speed"),
                 "contact.friction_over_speed has a negative slip speed; friction depends on the magnitude alone.",
                 "Begin the table at 0 m/s or above.");
    if (p.friction_over_temperature && p.friction_over_temperature->front()[0] < 0.)
      faults.add(position_of_value(table, "friction_over_temperature"),
                 "contact.friction_over_temperature has a temperature below 0 K.",
                 "Temperatures are absolute: write 20 degC or 293.15 K.");
  });
  return s;
}

Section<TouchdownParameters> touchdown_section() {
  using P = TouchdownParameters;
  Section<P> s("touchdown", "Ball bearing that catches the falling rotor.");
  s.text("catalogue", &P::catalogue,
         {.help = "Name of a bearing in params/bearings, such as \"6014\"; its values apply to all keys not set in "
                  "this table."});
  s.integer("node", &P::node, {.range = at_least(1), .help = "Rotor node at which the bearing sits, numbered from 1."});
  s.quantity("contact_stiffness", &P::contact_stiffness,
             {.unit = "N/m^n",
              .range = positive(),
              .help = "Contact stiffness K in the normal force K delta^n between rotor and bore. Larger values make "
                      "the first impact harder. If not given, "
                      "that of a line contact of journal and bore by their radii, materials and width, with the same "
                      "approach at a tenth of C0; `check` shows it."});
  s.quantity("contact_width", &P::contact_width,
             {.unit = "m",
              .range = positive(),
              .help = "Length along the axis over which rotor and bore touch, for a contact stiffness from the bodies; "
                      "`width` if not given."});
  s.quantity(
      "crown_radius", &P::crown_radius,
      {.unit = "m",
       .range = positive(),
       .help = "Radius of the journal's profile along the axis, for a contact stiffness from the bodies: a point "
               "contact by Hertz where that yields more than the line. A cylinder if not given."});
  s.quantity(
      "bore_radius", &P::bore_radius,
      {.unit = "m", .range = positive(), .help = "Bore radius of this bearing; contact.bore_radius if not given."});
  s.quantity("air_gap", &P::air_gap,
             {.unit = "m", .range = positive(), .help = "Air gap of this bearing; contact.air_gap if not given."});
  add_row_keys(s);
  add_ring_keys(s);
  add_ring_bending_keys(s);
  add_friction_keys(s);
  s.quantity("bore_diameter", &P::bore_diameter,
             {.unit = "m", .range = positive(), .help = "Catalogue dimension; kept with the bearing's data."});
  s.quantity("outside_diameter", &P::outside_diameter,
             {.unit = "m", .range = positive(), .help = "Catalogue dimension; kept with the bearing's data."});
  s.check(check_geometry);
  s.check(check_ring_bending);
  return s;
}

double bore_radius(const TouchdownParameters& bearing, const ContactParameters& contact) {
  if (bearing.bore_radius) return *bearing.bore_radius;
  return contact.bore_radius.value_or(0.5 * bearing.inner_ring_diameters[0]);
}

SupportSurroundings support_surroundings(const TouchdownParameters& bearing) {
  return {0.5 * bearing.outer_ring_diameters[1], bearing.width};
}

double air_gap(const TouchdownParameters& bearing, const ContactParameters& contact) {
  return bearing.air_gap.value_or(contact.air_gap);
}

void check_touchdown(const std::string& name, const TouchdownParameters& b, const ContactParameters& contact,
                     const Node& table, const Node& contact_table, Faults& faults) {
  const double bore = bore_radius(b, contact), gap = air_gap(b, contact);
  if (gap >= 0.2 * bore)
    faults.add(
        position_of_value(b.air_gap ? table : contact_table, "air_gap"),
        fmt::format("bearings.{}: the air gap of {:.6g} mm is more than a fifth of the bore radius of {:.6g} mm.", name,
                    gap * 1e3, bore * 1e3),
        "Air gaps are a few tenths of a millimetre; check the unit.");
  if (std::fabs(2. * bore - b.inner_ring_diameters[0]) > 0.01 * b.inner_ring_diameters[0])
    faults.add(b.bore_radius         ? position_of_value(table, "bore_radius")
               : contact.bore_radius ? position_of_value(contact_table, "bore_radius")
                                     : position_of_value(table, "inner_ring_diameters"),
               fmt::format(
                   "bearings.{}: the bore radius of {:.6g} mm is not half the inner ring's bore diameter of {:.6g} mm.",
                   name, bore * 1e3, b.inner_ring_diameters[0] * 1e3),
               "contact.bore_radius holds for all bearings; bearings.NAME.bore_radius for one.");
  if (b.preload > b.C0)
    faults.add(position_of_value(table, "preload"),
               fmt::format("bearings.{}: the preload of {:.6g} N is more than the static load rating C0 = {:.6g} N.",
                           name, b.preload, b.C0),
               "Preloads are typically a few percent of C0; check the unit.");
}

std::vector<RowPlace> row_places(const TouchdownParameters& b) {
  std::vector<RowPlace> places;
  const double spacing = b.row_spacing.value_or(b.width / b.rows);
  for (int i = 0; i < b.rows; ++i) {
    RowPlace place;
    place.position = (i - 0.5 * (b.rows - 1)) * spacing;
    place.difference_share = b.rows > 1 ? static_cast<double>(i) / (b.rows - 1) - 0.5 : 0.;
    const double inwards =
        place.position > 0. ? 1. : -1.;  // in an X set each row's inner ring is loaded away from the other row
    place.direction = b.rows == 1 || b.arrangement == RowArrangement::tandem ? 1.
                      : b.arrangement == RowArrangement::face_to_face        ? inwards
                                                                             : -inwards;
    places.push_back(place);
  }
  return places;
}

ShoulderCompliance shoulder_compliance(const TouchdownParameters& b, const ElasticMaterial& ring) {
  const double r_1 = 0.5 * b.inner_ring_diameters[0], r_2 = 0.5 * b.inner_ring_diameters[1],
               middle = b.shoulders.radius.value_or(0.5 * (r_1 + r_2)), height = std::min(middle - r_1, r_2 - middle);
  // A shoulder at the -x face pushes the ring onto the rows that lean to +x; the other side is its mirror.
  double length = 0.;
  int n = 0;
  for (const auto& row : row_places(b))
    if (row.direction > 0.) {
      length += 0.5 * b.width + row.position;
      ++n;
    }
  return {annulus_compliance(middle - height, middle + height, ring), sleeve_compliance(r_1, r_2, length / n, ring)};
}

double shoulder_stiffness(const TouchdownParameters& b, const ElasticMaterial& ring) {
  return b.shoulders.stiffness ? *b.shoulders.stiffness : shoulder_compliance(b, ring).stiffness();
}

namespace {

FreeRing free_ring_data(const TouchdownParameters& b, const ElasticMaterial& material, double gravity_x) {
  const double r_1 = 0.5 * b.inner_ring_diameters[0], r_2 = 0.5 * b.inner_ring_diameters[1];
  const double radii = b.ring_mass * (r_1 * r_1 + r_2 * r_2);
  FreeRing ring;
  ring.polar_inertia = radii / 2.;
  ring.diametral_inertia = b.ring_diametral_inertia.value_or(radii / 4. + b.ring_mass * b.width * b.width / 12.);
  ring.gravity_x = gravity_x;
  ring.width = b.width;
  if (b.shoulders.gap_minus_x) ring.shoulders.push_back({-1., *b.shoulders.gap_minus_x});
  if (b.shoulders.gap_plus_x) ring.shoulders.push_back({1., *b.shoulders.gap_plus_x});
  ring.shoulder_radius = b.shoulders.radius.value_or(0.5 * (r_1 + r_2));
  ring.shoulder_stiffness = shoulder_stiffness(b, material);
  return ring;
}

}  // namespace

TouchdownBearingData touchdown_data(const std::string& name, const TouchdownParameters& b,
                                    const ContactParameters& contact, const TouchdownSurroundings& around) {
  const double modulus = effective_modulus(around.ring, around.ball);
  const double projected = 0.5 * b.ball_diameter * std::cos(b.contact_angle);
  const auto inner = inner_race_contact(b.ball_diameter, 0.5 * b.pitch_diameter - projected, b.conformity[0]);
  const auto outer = outer_race_contact(b.ball_diameter, 0.5 * b.pitch_diameter + projected, b.conformity[1]);

  BallRowGeometry row;
  row.n_balls = b.balls_per_row;
  row.ball_diameter = b.ball_diameter;
  row.pitch_diameter = b.pitch_diameter;
  row.inner_conformity = b.conformity[0];
  row.outer_conformity = b.conformity[1];
  row.contact_angle = b.contact_angle;
  row.radial_clearance = b.radial_clearance;
  row.damping_beta = b.ball_damping_beta;
  // The groove's circle has its centre at d_m/2 +- (f - 1/2) d cos phi_0 from the axis and reaches the shoulder's radius at the edge's angle.
  const auto race = [&](const ContactGeometry& geometry, double side, double conformity, double shoulder_diameter) {
    RaceContact made{hertz_stiffness(geometry, modulus, b.elliptic_integrals),
                     semi_major_axis_factor(geometry, modulus, b.elliptic_integrals),
                     contact_ellipse(geometry, b.elliptic_integrals).k};
    made.groove_radius = conformity * b.ball_diameter;
    const double centre =
        0.5 * b.pitch_diameter - side * (conformity - 0.5) * b.ball_diameter * std::cos(b.contact_angle);
    made.edge_cosine = std::clamp(side * (0.5 * shoulder_diameter - centre) / made.groove_radius, -1., 1.);
    made.edge_sine = std::sqrt(1. - made.edge_cosine * made.edge_cosine);
    return made;
  };
  row.inner = race(inner, -1., b.conformity[0], b.inner_shoulder_diameter.value_or(b.inner_ring_diameters[1]));
  row.outer = race(outer, 1., b.conformity[1], b.outer_shoulder_diameter.value_or(b.outer_ring_diameters[0]));
  row.stiffness = stiffness_in_series(row.inner.stiffness, row.outer.stiffness);
  row.ball_mass = around.ball_density * std::numbers::pi / 6. * std::pow(b.ball_diameter, 3);
  row.has_inertia = b.ball_model == BallModel::inertial;
  row.inner_gyroscopic_share = b.gyroscopic_split == GyroscopicSplit::equal ? 0.5 : 0.;
  row.preload_offset = b.preload > 0. ? BallRow::offset_for_axial_load(row, b.preload) : 0.;

  TouchdownBearingData d;
  d.name = name;
  const auto places = row_places(b);
  for (int i = 0; i < b.rows; ++i) {
    row.position = places[static_cast<std::size_t>(i)].position;
    row.difference_share = places[static_cast<std::size_t>(i)].difference_share;
    row.direction = places[static_cast<std::size_t>(i)].direction;
    row.phase = i * b.row_phase * 2. * std::numbers::pi / b.balls_per_row;
    d.rows.push_back(row);
  }
  d.cage_angle = b.cage_phase * 2. * std::numbers::pi / b.balls_per_row;
  for (const auto& w : b.waviness) {
    if (w.surface == WavySurface::bore)
      d.bore_waves.push_back({w.order, w.amplitude, w.phase});
    else
      d.race_waves.push_back({w.surface == WavySurface::inner_race, w.order, w.amplitude, w.phase});
  }
  d.ball_model = b.ball_model;
  d.ring_mass = b.ring_mass;
  d.width = b.width;
  d.ring_spin_inertia = b.ring_spin_inertia;
  d.bore_radius = bore_radius(b, contact);
  d.air_gap = air_gap(b, contact);
  d.rotor_radius = d.bore_radius - d.air_gap;
  d.contact = {contact_stiffness(b, contact, around).value, contact.exponent, contact.lambda};
  d.friction = {contact.friction_coefficient, contact.regularisation_speed,
                contact.static_friction_coefficient.value_or(0.), contact.stribeck_speed,
                contact.static_friction_coefficient.has_value()};
  if (contact.friction_over_speed) d.friction.over_speed = *contact.friction_over_speed;
  if (contact.friction_over_temperature) d.friction.over_temperature = *contact.friction_over_temperature;
  d.friction.has_tables = contact.friction_over_speed || contact.friction_over_temperature;
  const auto standard = around.has_axial_motion ? FrictionLaw::sticking : FrictionLaw::regularised;
  if ((contact.friction_law == FrictionLaw::automatic ? standard : contact.friction_law) == FrictionLaw::sticking)
    d.sticking = StickingFriction{contact.tangential_stiffness, contact.contact_length};
  d.f1_z = b.f1_z;
  d.f1_y = b.f1_y;
  d.static_rating = b.C0;
  d.f2 = b.f2;
  d.drag_viscosity = b.drag_viscosity;
  d.drag_regularisation = b.drag_regularisation;
  d.load_law = b.load_law;
  d.race_friction_coefficient = b.race_friction_coefficient.value_or(contact.friction_coefficient);
  d.spin_axis_factor = semi_major_axis_factor(inner, modulus, b.elliptic_integrals);
  d.spin_elliptic_integral = contact_ellipse(inner, b.elliptic_integrals).E;
  d.add_spin_heat = b.internal_heat == InternalHeat::with_spin;
  if (b.internal_heat == InternalHeat::ball_speed) {
    const auto& g = d.rows.front();
    d.heat_over_work = ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  }
  d.support_mass = b.support.mass;
  d.support_law = support_law(b.support, support_surroundings(b));
  d.support_stiffness_y = b.support.K_y.value_or(0.);
  d.support_stiffness_z = b.support.K_z.value_or(0.);
  d.support_damping_y = b.support.C_y.value_or(0.);
  d.support_damping_z = b.support.C_z.value_or(0.);
  d.gravity_y = around.gravity[1];
  d.gravity_z = around.gravity[2];
  d.bending = bent_rings(b, d, around);
  if (b.ring_motion == RingMotion::free) d.free_ring = free_ring_data(b, around.ring, around.gravity[0]);
  return d;
}

}  // namespace rotordrop
