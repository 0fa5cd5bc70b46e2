#include "bearing/touchdown_parameters.h"

#include "bearing/cage_parameters.h"
#include "bearing/friction_parameters.h"
#include "bearing/ring_bending_parameters.h"
#include "bearing/touchdown_checks.h"

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
              .usual = or_zero(between(-2e-4, 2e-4)),
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
               {.range = between(1e-2, 1e2),
                .usual = between(0.05, 20),
                .fallback = "1",
                .source = "1: the circuit as published",
                .help = help});
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
              .usual = or_zero(between(1e-5, 2e-3)),
              .help = "Axial gap to the shoulder at the ring's -x face, with ring and rotor in their unloaded "
                      "positions. This shoulder stops a rotor moving towards +x. If not given, there is no shoulder."});
  s.quantity("gap_plus_x", &P::gap_plus_x,
             {.unit = "m",
              .range = at_least(0),
              .usual = or_zero(between(1e-5, 2e-3)),
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
       .usual = between(1e5, 1e13),
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
  s.quantity("ball_diameter", &P::ball_diameter,
             {.unit = "m", .range = positive(), .usual = between(1e-3, 0.15), .help = "Diameter d of a ball."});
  s.quantity("pitch_diameter", &P::pitch_diameter,
             {.unit = "m",
              .range = positive(),
              .usual = between(5e-3, 2),
              .help = "Diameter d_m of the circle of ball centres."});
  s.quantities(
      "conformity", &P::conformity,
      {.range = between(0.501, 0.6),
       .usual = between(0.505, 0.56),
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
              .usual = between(-3e-5, 2e-4),
              .fallback = "0 um",
              .help = "Radial clearance, mounted, cold and at standstill: half of a catalogue's radial internal "
                      "clearance (C3 and so on), which is diametral. For deep-groove bearings."});
  s.quantity("preload", &P::preload,
             {.unit = "N",
              .range = at_least(0),
              .usual = at_most(1e5),
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
  s.text("ring", &P::ring, {.fallback = "steel", .help = "Material of rings and housing, a name of [materials]."});
  s.text("journal", &P::journal,
         {.help = "Material of the rotor under the bearing, a name of [materials], for all that concerns heat: the "
                  "shaft's capacity, conduction and thermal growth, local temperatures and the Jaeger share. That of "
                  "`ring` if not given. Elasticity is that of the rotor's geometry."});
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
  add_cage_keys(s);
  s.choice("gyroscopic_split", &P::gyroscopic_split,
           {{"outer", GyroscopicSplit::outer}, {"equal", GyroscopicSplit::equal}},
           {.fallback = "outer",
            .source = "Jones 1960, outer-race control; Harris' lambda_o = 2 or lambda_i = lambda_o = 1",
            .help = "Raceway whose friction balances the gyroscopic moments of inertial balls: the outer one, or half "
                    "on each. Equal halves lower the preload at speed."});
  s.quantity("ball_damping_beta", &P::ball_damping_beta,
             {.unit = "s",
              .range = between(0, 1e-3),
              .usual = or_zero(between(5e-7, 2e-4)),
              .fallback = "2.5e-5 s",
              .source = std::string(paper) + ", upper end of the range 0.25..2.5e-5",
              .help = "Damping of a ball's contacts divided by their tangent stiffness."});
}

void add_ring_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.quantity("ring_mass", &P::ring_mass,
             {.unit = "kg",
              .range = positive(),
              .usual = between(1e-3, 500),
              .help = "Mass of the inner ring, of all rows together."});
  s.quantity("ring_spin_inertia", &P::ring_spin_inertia,
             {.unit = "kg m2",
              .range = positive(),
              .usual = between(1e-9, 100),
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
             {.unit = "m",
              .range = between(1e-5, 10),
              .usual = between(1e-3, 1),
              .help = "Width of the bearing, all rows together."});
  s.quantities("inner_ring_diameters", &P::inner_ring_diameters,
               {.unit = "m",
                .range = positive(),
                .usual = between(1e-3, 2),
                .help = "Bore and outside (shoulder) diameter of the inner ring."});
  s.quantities("outer_ring_diameters", &P::outer_ring_diameters,
               {.unit = "m",
                .range = positive(),
                .usual = between(1e-3, 2),
                .help = "Inside (shoulder) and outside diameter of the outer ring."});
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
  s.quantities(
      "housing_diameters", &P::housing_diameters,
      {.unit = "m", .range = positive(), .usual = between(1e-3, 5), .help = "Housing: bore and outside diameter."});
  s.quantity("housing_length", &P::housing_length,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-3, 3),
              .help = "Axial length of the housing that takes up heat, all rows together."});
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
              .usual = between(1e-3, 0.5),
              .help = "Length of shaft that takes up rub heat; the bearing's width if not given."});
  s.table(
      "circuit", &P::circuit, circuit_section(),
      {.help = "Calibration factors of the bearing's lumped circuit; they multiply the values derived from geometry."});
  s.table("support", &P::support, support_section());
  s.list("waviness", &P::waviness, waviness_section());
}

}  // namespace

Section<TouchdownParameters> touchdown_section() {
  using P = TouchdownParameters;
  Section<P> s("touchdown", "Ball bearing that catches the falling rotor.");
  s.if_incomplete("A bearing of the catalogue brings most of them: catalogue = \"6014\".");
  s.text("catalogue", &P::catalogue,
         {.help = "Name of a bearing in params/bearings, such as \"6014\"; its values apply to all keys not set in "
                  "this table."});
  s.integer(
      "count", &P::count,
      {.range = between(1, 8),
       .fallback = 1,
       .help = "Number of catalogue bearings beside each other, such as 2 for a pair: rows, width, ring_mass, "
               "ring_spin_inertia and C0 of the catalogue count that many times, C by count^0.7 (ISO 281). Values "
               "that the case gives itself are of the whole set. arrangement and preload say how they are set."});
  s.integer("node", &P::node, {.range = at_least(1), .help = "Rotor node at which the bearing sits, numbered from 1."});
  s.quantity("contact_stiffness", &P::contact_stiffness,
             {.unit = "N/m^n",
              .range = positive(),
              .usual = between(1e6, 1e14),
              .help = "Contact stiffness K in the normal force K delta^n between rotor and bore. Larger values make "
                      "the first impact harder. If not given, "
                      "that of a line contact of journal and bore by their radii, materials and width, with the same "
                      "approach at a tenth of C0; `check` shows it."});
  s.quantity("contact_width", &P::contact_width,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-4, 1),
              .help = "Length along the axis over which rotor and bore touch: for a contact stiffness from the bodies, "
                      "the slices of a free ring, local temperatures and wear; `width` if not given."});
  s.quantity(
      "crown_radius", &P::crown_radius,
      {.unit = "m",
       .range = positive(),
       .usual = between(1e-3, 1e3),
       .help = "Radius of the journal's profile along the axis, for a contact stiffness from the bodies: a point "
               "contact by Hertz where that yields more than the line. A cylinder if not given."});
  s.quantity(
      "bore_radius", &P::bore_radius,
      {.unit = "m", .range = positive(), .help = "Bore radius of this bearing; contact.bore_radius if not given."});
  s.quantity("air_gap", &P::air_gap,
             {.unit = "m",
              .range = positive(),
              .usual = between(0.05e-3, 1e-3),
              .help = "Air gap of this bearing; contact.air_gap if not given."});
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

}  // namespace rotordrop
