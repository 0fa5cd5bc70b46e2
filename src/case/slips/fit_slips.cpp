#include "case/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "analysis/facts/bearing_estimates.h"
#include "case/plausibility.h"
#include "machine/bearing_data.h"

namespace rotordrop {
namespace {

/// "an elastomer", of a soft support.
std::string carrier(const TouchdownParameters& b) {
  return (b.support.type == "elastomer" ? "an " : "a ") + b.support.type;
}

/// Housing and fit against the bearing.
void look_at_housing(const std::string& name, const TouchdownParameters& b, GrowthSource expansion, const Node& table,
                     std::vector<Fault>& warnings) {
  constexpr double shortest = 0.3, widest = 5., tightest = 2e-3;  // estimates
  const double outside = b.outer_ring_diameters[1];
  if (b.housing_length < shortest * b.width)
    warn(warnings, position_of_value(table, "housing_length"),
         fmt::format("the housing of bearings.{} is {:.4g} mm long, but the bearing is {:.4g} mm wide.", name,
                     mm(b.housing_length), mm(b.width)),
         "It is what takes up heat, of all rows together.");
  if (b.housing_diameters[1] > widest * outside)
    warn(warnings, position_of_value(table, "housing_diameters"),
         fmt::format("the housing of bearings.{} has an outside diameter of {:.4g} mm, {:.3g} times the bearing's.",
                     name, mm(b.housing_diameters[1]), b.housing_diameters[1] / outside),
         "A bare number is in metres. It is what takes up heat near the bearing, not the machine's frame.");
  if (std::fabs(b.housing_fit) > tightest * outside)
    warn(warnings, position_of_value(table, "housing_fit"),
         fmt::format("bearings.{}.housing_fit = {:.4g} um is {:.2g} % of the bearing's diameter, {:.4g} mm; fits are a "
                     "tenth of a percent at most.",
                     name, b.housing_fit * 1e6, 100. * b.housing_fit / outside, mm(outside)),
         "It is by radius. A bare number is in metres: 20 um are 20e-6.");
  else if (b.housing_fit != 0. && expansion != GrowthSource::elastic)
    warn(warnings, position_of_value(table, "housing_fit"),
         fmt::format("bearings.{}.housing_fit does not count: thermal.expansion takes ring and housing as one body.",
                     name),
         "It is part of thermal.expansion = \"elastic\".");
  if (is_soft(b.support) && expansion == GrowthSource::elastic)
    warn(warnings, position_of_value(table_at(table, "support"), "type"),
         fmt::format("the outer ring of bearings.{} is carried by {}, but elasticity lets it grow as if it sat in its "
                     "housing.",
                     name, carrier(b)),
         "thermal.expansion = \"formula\" lets it grow by itself.");
}

/// Clearance by ISO 5753: that of class 5, by radius, is 18 um in a bore of 10 mm and 50 um in one of 70 mm.
void look_at_clearance(const std::string& name, const TouchdownParameters& b, const Node& table,
                       std::vector<Fault>& warnings) {
  const double most = 20e-6 + 1.5e-3 * b.inner_ring_diameters[0];
  if (b.radial_clearance > most)
    warn(warnings, position_of_value(table, "radial_clearance"),
         fmt::format("bearings.{}.radial_clearance = {:.4g} um; a bore of {:.4g} mm has less than {:.3g} um.", name,
                     b.radial_clearance * 1e6, mm(b.inner_ring_diameters[0]), most * 1e6),
         "It is by radius, half of what catalogues give, and not the rotor's air gap (contact.air_gap).");
}

/// What is given of the bodies that touch, against their dimensions.
void look_at_contacts(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                      std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  if (b.contact_width && *b.contact_width > 2. * b.width)
    warn(warnings, position_of_value(table, "contact_width"),
         fmt::format("bearings.{}.contact_width is {:.4g} mm, but the bearing is {:.4g} mm wide.", name,
                     mm(*b.contact_width), mm(b.width)),
         "A bare number is in metres.");
  // Where the rotor rubs, its elasticity is known by the geometry, its heat by a name only.
  const auto around = touchdown_surroundings(p, b);
  if (const double of_ring = around.ring.youngs_modulus, of_rotor = around.rotor().youngs_modulus;
      !b.journal && std::fabs(of_rotor - of_ring) > 0.15 * of_ring)
    warn(warnings, position_of(table_at(tree, "bearings"), name),
         fmt::format("the rotor's surface at bearings.{} has a modulus of {:.4g} GPa, the material \"{}\" of its ring "
                     "{:.4g} GPa: conductivity, heat capacity and thermal expansion of both are those of \"{}\".",
                     name, of_rotor * 1e-9, b.ring, of_ring * 1e-9, b.ring),
         fmt::format("Name the rotor's material by bearings.{}.journal.", name));
  if (const auto& given = b.ring_diametral_inertia;
      given && (*given < 0.3 * b.ring_spin_inertia || *given > 5. * b.ring_spin_inertia))
    warn(warnings, position_of_value(table, "ring_diametral_inertia"),
         fmt::format("bearings.{}.ring_diametral_inertia = {:.4g} kg m2 is {:.3g} times ring_spin_inertia; a thin ring "
                     "has half of it.",
                     name, *given, *given / b.ring_spin_inertia),
         "It is of the inner ring about a diameter, in kg m2.");
  if (const auto& given = b.shoulders.stiffness) {
    const double bodies = bearing_estimates(p, b).shoulder_stiffness;
    if (*given > 30. * bodies || *given < 1e-3 * bodies)
      warn(warnings, position_of_value(table_at(table, "shoulders"), "stiffness"),
           fmt::format("bearings.{}.shoulders.stiffness = {:.4g} N/m is {:.3g} times that of the bodies, {:.3g} N/m.",
                       name, *given, *given / bodies, bodies),
           "Leave it out to take what the bodies give; a collar or a sleeve is softer. A bare number is in N/m.");
  }
  // The ellipse of balls and raceway is a small part of the ball.
  for (const auto& [table_name, key, half_width, owner] :
       {std::tuple{"thermal", "contact_half_width", p.thermal.contact_half_width, &table_at(tree, "thermal")},
        {"thermal.fe", "strip_half_width", p.thermal.fe.strip_half_width.value_or(0.),
         &table_at(tree, "thermal", "fe")}})
    if (half_width > 0.25 * b.ball_diameter)
      warn(warnings, position_of_value(*owner, key),
           fmt::format("{}.{} = {:.4g} mm is more than a quarter of the balls' diameter in bearings.{}, {:.4g} mm.",
                       table_name, key, mm(half_width), name, mm(b.ball_diameter)),
           "It is half of what balls touch across their track. A bare number is in metres.");
}

/// A journal's wall that the contact stiffness from the bodies takes for one backed rigidly.
void look_at_wall(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                  std::vector<Fault>& warnings) {
  // Estimate: a ring under a radial force that shear carries away gives way by 0.52 F (R/t)^3 / (E w) (Fourier series of an inextensible ring), w the
  // width of contact and as much wall as its radius on both sides. With a wall of 0.45 of the outer radius that is a quarter of the approach of journal
  // and ring of a 6018 under 5 kN, with 0.13 more than ten times it.
  constexpr double thinnest_wall = 0.45;
  const auto around = touchdown_surroundings(p, b);
  if (b.contact_stiffness || !around.journal || around.journal->inner_radius <= 0.) return;
  const double outside = bore_radius(b, p.contact) - air_gap(b, p.contact);
  const double wall = outside - around.journal->inner_radius;
  if (wall < thinnest_wall * outside)
    warn(warnings, position_of_value(table_at(tree, "bearings", name), "node"),
         fmt::format("the journal in bearings.{} is a tube with a wall of {:.4g} mm, {:.2g} of its radius: the contact "
                     "stiffness from the bodies leaves out that such a wall bends, and is too large.",
                     name, mm(wall), wall / outside),
         fmt::format("Give bearings.{}.contact_stiffness where peak forces matter, and vary it; from {} of the radius "
                     "on the wall adds less than a quarter (estimate).",
                     name, thinnest_wall));
}

/// Whether heat reaches the housings in the case.
bool follows_heat_to_housings(const CaseParameters& p, const Node& tree) {
  // Estimate: before, little of the rub's heat has come through the balls to the outer ring (some 0.4 K/W and 100 J/K: 40 s).
  constexpr double short_run = 10.;  // [s]
  return tree.find("preload") || latest_end_of_all(p) >= short_run;
}

/// Heat through what carries an outer ring, where that is no metal fit.
void look_at_conduction(const std::string& name, const TouchdownParameters& b, const CaseParameters& p,
                        const Node& tree, std::vector<Fault>& warnings) {
  if (p.thermal.models.empty() || !is_soft(b.support)) return;
  if (tree.find("thermal") && table_at(tree, "thermal").has("fit_resistance")) return;
  const Node& bearing = table_at(tree, "bearings", name);
  warn(warnings, position_of_value(bearing.find("support") ? *bearing.find("support") : bearing, "type"),
       fmt::format("the outer ring of bearings.{} is carried by {}, but its heat goes to the housing through a metal "
                   "fit: thermal.fit_resistance is its default, {:.4g} K/W.",
                   name, carrier(b), p.thermal.fit_resistance),
       "Give thermal.fit_resistance. Estimates: 1 to 30 K/W of O-rings, 0.05 to 0.5 K/W of a ribbon or an oil film.");
}

/// A resistance that only elastomers have.
void look_at_fit_resistance(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  constexpr double most_of_metal = 3.;  // estimate: a metal fit has 0.001 to 0.1, an oil film or a ribbon up to 1 K/W
  const auto is_soft = [](const SupportEntry& entry) {
    return entry.touchdown() && entry.touchdown()->support.type == "elastomer";
  };
  if (p.thermal.fit_resistance <= most_of_metal || std::any_of(p.bearings.begin(), p.bearings.end(), is_soft)) return;
  warn(
      warnings, position_of_value(table_at(tree, "thermal"), "fit_resistance"),
      fmt::format("thermal.fit_resistance = {:.6g} K/W is unusual: where no elastomer carries an outer ring it is most "
                  "often <= {:.4g} K/W.",
                  p.thermal.fit_resistance, most_of_metal),
      "A bare number is in K/W.");
}

/// Friction between rotor and bore.
void look_at_friction(const ContactParameters& c, const Node& tree, std::vector<Fault>& warnings) {
  if (const auto& given = c.static_friction_coefficient; given && *given < c.friction_coefficient)
    warn(warnings, position_of_value(table_at(tree, "contact"), "static_friction_coefficient"),
         fmt::format("contact.static_friction_coefficient = {:.4g} is less than the dynamic one, {:.4g}.", *given,
                     c.friction_coefficient),
         "Surfaces at rest hold each other better than sliding ones: they may be exchanged.");
}

/// What rolling contacts conduct by, where they do not conduct.
void look_at_rolling_conduction(const ThermalParameters& thermal, const Node& tree, std::vector<Fault>& warnings) {
  if (thermal.contact_conduction == BallConductionModel::rolling) return;
  for (const auto& [key, counts] : {std::pair{"oil_film", thermal.oil_film > 0.},
                                    std::pair{"ball_track", thermal.ball_track != BallTrack::repeating}})
    if (counts)
      warn(warnings, position_of_value(table_at(tree, "thermal"), key),
           fmt::format("thermal.{} does not count: balls conduct by the resistance R5.", key),
           "It is part of thermal.contact_conduction = \"rolling\".");
}

/// Growth of an earlier run that is not taken.
void look_at_recorded_growth(const ThermalParameters& thermal, const Node& tree, std::vector<Fault>& warnings) {
  if (!thermal.recorded || thermal.driver == recorded_driver) return;
  warn(warnings, position_of_value(table_at(tree, "thermal"), "recorded"),
       fmt::format("thermal.recorded does not count: thermal.driver is \"{}\".", thermal.driver),
       "thermal.driver = \"recorded\" takes the growth from there.");
}

}  // namespace

void look_at_fits(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  look_at_friction(p.contact, tree, warnings);
  look_at_fit_resistance(p, tree, warnings);
  look_at_rolling_conduction(p.thermal, tree, warnings);
  look_at_recorded_growth(p.thermal, tree, warnings);
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) {
      const Node& table = table_at(tree, "bearings", entry.name);
      look_at_housing(entry.name, *b, p.thermal.expansion, table, warnings);
      look_at_clearance(entry.name, *b, table, warnings);
      look_at_contacts(entry.name, *b, p, tree, warnings);
      look_at_wall(entry.name, *b, p, tree, warnings);
      if (follows_heat_to_housings(p, tree)) look_at_conduction(entry.name, *b, p, tree, warnings);
    }
}

std::vector<Fault> look_at_preload(const CaseParameters& p, const Node& tree) {
  std::vector<Fault> warnings;
  const Node& thermal = table_at(tree, "thermal");
  constexpr const char* feeds_back =
      "There the growth of rings and balls always counts: heat is what changes a preload.";
  if (!p.thermal.growth)
    warn(warnings, position_of_value(thermal, "growth"), "thermal.growth = false is not for `preload`.", feeds_back);
  if (p.thermal.driver == no_driver || p.thermal.driver == recorded_driver)
    warn(warnings, position_of_value(thermal, "driver"),
         fmt::format("thermal.driver = \"{}\" is not for `preload`.", p.thermal.driver), feeds_back);
  if (p.thermal.expansion == GrowthSource::elastic && p.preload.model == "lumped")
    warn(warnings, position_of_value(thermal, "expansion"),
         "thermal.expansion = \"elastic\" does not count: preload.model = \"lumped\" grows by formulas.",
         "preload.model = \"fe\" takes the growth from elasticity.");
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (b && !follows_heat_to_housings(p, tree)) look_at_conduction(entry.name, *b, p, tree, warnings);
    if (b && b->cage == CageModel::free)
      warn(warnings, position_of_value(table_at(tree, "bearings", entry.name), "cage"),
           fmt::format("bearings.{}.cage = \"free\" is not for `preload`.", entry.name),
           "There balls and cage roll at the steady speed.");
  }
  return warnings;
}

}  // namespace rotordrop
