#include "case/slips/slips.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "analysis/facts/bearing_estimates.h"
#include "base/rotation.h"

namespace rotordrop {
namespace {

// Of a row's static rating: estimate; the paper's pair has 0.9 %.
constexpr double heaviest_preload = 0.2, lightest_preload = 2e-4;
constexpr double largest_inertia_ratio =
    3.;  // those of the catalogue are within 10 %; what turns with the ring, such as a sleeve, adds
constexpr double smallest_contact_angle = 0.09;  // 5 deg [rad]

void look_at_bearing(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                     std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const double bore = 2. * bore_radius(b, p.contact), gap = air_gap(b, p.contact), journal = bore - 2. * gap;
  const double speed = 0.5 * journal * std::fabs(p.run.initial_speed);
  if (speed > fastest_surface)
    warn(warnings, position_of_value(table_at(tree, "run"), "initial_speed"),
         fmt::format("the rotor's surface runs at {:.0f} m/s in bearings.{} ({:.0f} rpm, diameter {:.4g} mm); most "
                     "often it is below {:.0f} m/s.",
                     speed, name, std::fabs(p.run.initial_speed) * to_rpm, mm(journal), fastest_surface),
         "A bare speed is in rad/s: if rpm is meant, write for example \"15200 rpm\".");
  // The journal is the shaft, perhaps with a sleeve on it; a shaft that does not pass the bore is another machine's.
  if (const double shaft = shaft_diameter(p.rotor.geometry, b.node); shaft > 0.) {
    if (shaft > bore)
      warn(warnings, position_of_value(table, "node"),
           fmt::format("the shaft at node {} has a diameter of {:.4g} mm; it does not pass the bore of bearings.{}, "
                       "{:.4g} mm.",
                       b.node, mm(shaft), name, mm(bore)),
           "Check the node, the bearing's size and the units of the rotor's od.");
    else if (bore - shaft < 1.2 * gap)  // gaps are varied with the same shaft
      warn(
          warnings, position_of_value(table, "node"),
          fmt::format("the shaft at node {} has a diameter of {:.5g} mm and leaves {:.4g} mm by radius in bearings.{}, "
                      "{:.5g} mm, where the air gap is {:.4g} mm.",
                      b.node, mm(shaft), mm(0.5 * (bore - shaft)), name, mm(bore), mm(gap)),
          "The air gap is by radius: half of what bore and journal differ by. The drop has a journal that leaves it.");
    else if (shaft < 0.95 * journal)
      warn(
          warnings, position_of_value(table, "node"),
          fmt::format("the shaft at node {} has a diameter of {:.4g} mm, less than 95 % of the journal in bearings.{}, "
                      "{:.4g} mm, which is its bore less twice the air gap.",
                      b.node, mm(shaft), name, mm(journal)),
          "Unless a sleeve is on it, check the node, the bearing's size and the units of the rotor's od.");
  }
  if (b.bore_diameter && std::fabs(*b.bore_diameter - b.inner_ring_diameters[0]) > 0.02 * *b.bore_diameter)
    warn(warnings, position_of_value(table, "inner_ring_diameters"),
         fmt::format("bearings.{} has inner_ring_diameters from {:.4g} mm, but its bore_diameter is {:.4g} mm.", name,
                     mm(b.inner_ring_diameters[0]), mm(*b.bore_diameter)),
         "One of them may belong to another size.");
  if (b.outside_diameter && std::fabs(*b.outside_diameter - b.outer_ring_diameters[1]) > 0.02 * *b.outside_diameter)
    warn(warnings, position_of_value(table, "outer_ring_diameters"),
         fmt::format("bearings.{} has outer_ring_diameters up to {:.4g} mm, but its outside_diameter is {:.4g} mm.",
                     name, mm(b.outer_ring_diameters[1]), mm(*b.outside_diameter)),
         "One of them may belong to another size.");
  if (b.width < b.rows * b.ball_diameter) {
    const bool is_one = b.rows == 1;
    warn(warnings, position_of_value(table, "width"),
         fmt::format("bearings.{} is {:.4g} mm wide, but its {} of balls of {:.4g} mm {} {:.4g} mm.", name, mm(b.width),
                     is_one ? "row" : fmt::format("{} rows", b.rows), mm(b.ball_diameter), is_one ? "needs" : "need",
                     mm(b.rows * b.ball_diameter)),
         is_one ? "The balls' diameter may belong to another size."
                : "A catalogue entry describes one bearing: of a pair, width, ring_mass, ring_spin_inertia and C0 "
                  "are those of both together.");
  }
  if (b.row_spacing && b.rows > 1 && *b.row_spacing < b.ball_diameter)
    warn(warnings, position_of_value(table, "row_spacing"),
         fmt::format("the rows of bearings.{} are {:.4g} mm apart, but its balls are {:.4g} mm thick: rows overlap.",
                     name, mm(*b.row_spacing), mm(b.ball_diameter)),
         "row_spacing is from centre to centre of neighbouring rows.");
  if (b.housing_length > 20. * b.outer_ring_diameters[1])
    warn(warnings, position_of_value(table, "housing_length"),
         fmt::format("the housing of bearings.{} is {:.4g} mm long, more than 20 times the bearing's diameter.", name,
                     mm(b.housing_length)),
         "A bare number is in metres.");
  if (b.width > b.outer_ring_diameters[1])
    warn(warnings, position_of_value(table, "width"),
         fmt::format("bearings.{} is {:.4g} mm wide, more than its diameter, {:.4g} mm.", name, mm(b.width),
                     mm(b.outer_ring_diameters[1])),
         "A bare number is in metres.");
}

/// Spin inertia of the inner ring with the balls that it drives [kg m2], as docs/theory/model.md has it, but for the cage (some per cent): estimate
/// from the ring's mass, diameters and balls.
double spin_inertia_estimate(const TouchdownParameters& b, double ball_density) {
  const double inside = 0.5 * b.inner_ring_diameters[0], outside = 0.5 * b.inner_ring_diameters[1];
  const double ring = 0.5 * b.ring_mass * (inside * inside + outside * outside);
  const double D = b.ball_diameter, d_m = b.pitch_diameter;
  const double ball_mass = ball_density * std::numbers::pi / 6. * D * D * D;
  const double gamma = D * std::cos(b.contact_angle) / d_m;
  const double cage_ratio = 0.5 * (1. - gamma), spin_ratio = 0.5 * d_m / D * (1. - gamma * gamma);
  const double of_a_ball = 0.25 * ball_mass * d_m * d_m * cage_ratio * cage_ratio +  // on its orbit
                           0.1 * ball_mass * D * D * spin_ratio * spin_ratio;        // about its own axis
  return ring + b.rows * b.balls_per_row * of_a_ball;
}

/// Of the ring against its dimensions, and of a row alone what belongs to sets.
void look_at_ring(const std::string& name, const TouchdownParameters& b, const MaterialParameters* ring,
                  const MaterialParameters* ball, const Node& tree, std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const auto [inside, outside] = std::pair(b.inner_ring_diameters[0], b.inner_ring_diameters[1]);
  if (ring) {
    const double solid = ring->rho * 0.25 * std::numbers::pi * (outside * outside - inside * inside) * b.width;
    if (b.ring_mass > 5. * solid || b.ring_mass < 0.2 * solid)
      warn(warnings, position_of_value(table, "ring_mass"),
           fmt::format("bearings.{}.ring_mass is {:.4g} kg, but a ring of its diameters, width and material has {:.3g} "
                       "kg.",
                       name, b.ring_mass, solid),
           "It is of the inner ring, of all rows together, without balls and cage. Check the unit.");
  }
  if (ball) {
    const double estimate = spin_inertia_estimate(b, ball->rho);
    if (b.ring_spin_inertia > largest_inertia_ratio * estimate ||
        b.ring_spin_inertia < estimate / largest_inertia_ratio)
      warn(warnings, position_of_value(table, "ring_spin_inertia"),
           fmt::format("bearings.{}.ring_spin_inertia is {:.3g} kg m2, but an inner ring of this mass and these "
                       "diameters has about {:.2g} kg m2 with its balls.",
                       name, b.ring_spin_inertia, estimate),
           "It is of the inner ring and the balls that it drives, of all rows together; rub heat and the time until "
           "the ring follows the rotor go with it. A bare number is in kg m2: 1 kg cm2 is 1e-4 kg m2.");
  }
  // Where raceways end: beside the groove, between the ring's other face and the balls' centres.
  for (const auto& [key, shoulder, from, to] :
       {std::tuple{"inner_shoulder_diameter", b.inner_shoulder_diameter, b.inner_ring_diameters[0], b.pitch_diameter},
        {"outer_shoulder_diameter", b.outer_shoulder_diameter, b.pitch_diameter, b.outer_ring_diameters[1]}})
    if (shoulder && (*shoulder <= from || *shoulder >= to))
      warn(warnings, position_of_value(table, key),
           fmt::format("bearings.{}.{} is {:.4g} mm, but a shoulder of this ring lies between {:.4g} and {:.4g} mm.",
                       name, key, mm(*shoulder), mm(from), mm(to)),
           "It is a diameter, between the ring's face and the pitch circle.");
  if (const double wall = 0.5 * (b.housing_diameters[1] - b.housing_diameters[0]); wall < 0.02 * b.housing_diameters[0])
    warn(warnings, position_of_value(table, "housing_diameters"),
         fmt::format("the housing of bearings.{} has a wall of {:.4g} mm around a bore of {:.4g} mm.", name, mm(wall),
                     mm(b.housing_diameters[0])),
         "housing_diameters are bore and outside.");
  for (const auto& [key, is_given] :
       {std::pair{"arrangement", b.arrangement != RowArrangement::face_to_face}, {"preload", b.preload > 0.}})
    if (b.rows == 1 && is_given)
      warn(warnings, position_of_value(table, key),
           fmt::format("bearings.{}.{} is of a set, but the bearing has rows = 1.", name, key),
           "Write count = 2 for a pair of catalogue bearings, or rows = 2 with the data of both; or leave it out.");
}

/// What the case has but its laws leave out.
void look_at_laws(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                  std::vector<Fault>& warnings) {
  if (p.rotor.axial_motion != AxialFreedom::free || b.load_law != FrictionLoadLaw::radial) return;
  warn(
      warnings, position_of_value(table_at(tree, "bearings", name), "load_law"),
      fmt::format("{} takes axial load (rotor.axial_motion = \"free\"), but with load_law = \"radial\" thrust makes no "
                  "friction and no heat in it.",
                  name),
      fmt::format("Set bearings.{}.load_law = \"equivalent\".", name));
}

/// Ratings against the balls, stiffness against the bodies.
void look_at_ratings(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                     std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const BearingEstimates estimates = bearing_estimates(p, b);
  const auto compare = [&](const char* key, double given, double estimate) {
    if (given > 3. * estimate || given < estimate / 3.)
      warn(warnings, position_of_value(table, key),
           fmt::format("bearings.{}.{} is {:.4g} kN, but {} of balls like these {} about {:.3g} kN.", name, key,
                       given * 1e-3, b.rows == 1 ? "a row" : fmt::format("{} rows", b.rows),
                       b.rows == 1 ? "has" : "have", estimate * 1e-3),
           "It is of all rows together. A bare number is in N. Check number and diameter of the balls, too.");
  };
  compare("C0", b.C0, estimates.static_load);
  if (b.C) compare("C", *b.C, estimates.dynamic_load);
  const double part = b.preload * b.rows / b.C0;
  if (b.preload > 0. && (part > heaviest_preload || part < lightest_preload))
    warn(warnings, position_of_value(table, "preload"),
         fmt::format("bearings.{}.preload = {:.4g} N is {:.3g} % of the static rating of a row, {:.4g} kN; most "
                     "often it is a few percent.",
                     name, b.preload, 100. * part, 1e-3 * b.C0 / b.rows),
         "It is the axial load of each row. A bare number is in N: 0.29 kN are 290 N.");
  if (b.contact_angle > 0. && b.contact_angle < smallest_contact_angle)
    warn(warnings, position_of_value(table, "contact_angle"),
         fmt::format("bearings.{}.contact_angle = {:.4g} deg: angular contact bearings have 12 to 40 deg, and deep "
                     "groove bearings 0 here.",
                     name, b.contact_angle * 180. / std::numbers::pi),
         "A bare number is in rad: 0.436 rad are 25 deg.");
  const double bodies = estimates.contact_stiffness;
  if (const auto& given = b.contact_stiffness; given && bodies > 0. && (*given > 15. * bodies || *given < bodies / 15.))
    warn(
        warnings, position_of_value(table, "contact_stiffness"),
        fmt::format("bearings.{}.contact_stiffness = {:.4g} N/m^n, but journal and bore of these dimensions have about "
                    "{:.3g}.",
                    name, *given, bodies),
        fmt::format("It is of N and m, with the exponent n = {:.4g}. Leave it out to take what the bodies give.",
                    p.contact.exponent));
}

}  // namespace

void look_at_bearings(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  for (const auto& entry : p.bearings)
    if (const auto* touchdown = entry.touchdown()) {
      look_at_bearing(entry.name, *touchdown, p, tree, warnings);
      look_at_laws(entry.name, *touchdown, p, tree, warnings);
      look_at_ring(entry.name, *touchdown, find_material(p, touchdown->ring), find_material(p, touchdown->ball), tree,
                   warnings);
      look_at_ratings(entry.name, *touchdown, p, tree, warnings);
    }
}

}  // namespace rotordrop
