#include "case/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rotation.h"
#include "case/plausibility.h"

namespace rotordrop {
namespace {

constexpr double slowest_spin = 10. * std::numbers::pi;  // 300 rpm [rad/s]
constexpr double coarsest_balance = 0.01;                // G10 [m/s]; ISO 21940-11 has G0.4 to G4000
constexpr double finest_balance = 1e-6;                  // G0.001, most often a unit [m/s]
constexpr double finest_grade = 1e-4;                    // G0.1 [m/s]
constexpr double fastest_windage_decay = 3.;             // of the speed by its windage alone, T = Ip omega / torque [s]
constexpr double densest_power = 20e3;                   // estimate [W/kg]
constexpr double largest_thrust = 50.;                   // times the rotor's weight

double largest(const TimeTable& table) {
  double found = 0.;
  for (const auto& [time, value] : table)
    if (std::fabs(value) > std::fabs(found)) found = value;
  return found;
}

void look_at_speeds(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node &rotor = table_at(tree, "rotor"), &run = table_at(tree, "run");
  const double spin = std::fabs(p.run.initial_speed);
  const bool has_touchdown = std::any_of(p.bearings.begin(), p.bearings.end(),
                                         [](const SupportEntry& entry) { return entry.touchdown() != nullptr; });
  if (has_touchdown && spin != 0. && spin < slowest_spin)
    warn(warnings, position_of_value(run, "initial_speed"),
         fmt::format("the rotor spins at {:.4g} rpm; magnetically levitated rotors spin faster than {:.0f} rpm.",
                     spin * to_rpm, slowest_spin * to_rpm),
         "A point is a decimal point: eleven thousand is 11000 rpm, not 11.000 rpm.");
  if (const auto& speed = p.rotor.balance_speed; speed && *speed < slowest_spin)
    warn(warnings, position_of_value(rotor, "balance_speed"),
         fmt::format("rotor.balance_speed is {:.4g} rpm; a grade is for the highest speed in service, most often above "
                     "{:.0f} rpm.",
                     *speed * to_rpm, slowest_spin * to_rpm),
         "A point is a decimal point: twelve thousand is 12000 rpm, not 12.000 rpm.");
  if (const auto& speed = p.rotor.balance_speed)
    for (auto& slip : look_at_speed(p, "rotor.balance_speed", *speed))
      warn(warnings, position_of_value(rotor, "balance_speed"), fmt::format("rotor.balance_speed: {}", slip.message),
           slip.advice);
  if (const double orbit = std::fabs(p.rotor.initial_orbit.speed);
      p.rotor.initial_orbit.radius > 0. && spin > 0. && orbit > 5. * spin)
    warn(warnings, position_of_value(table_at(tree, "rotor", "initial_orbit"), "speed"),
         fmt::format("rotor.initial_orbit.speed is {:.4g} rpm, {:.3g} times the rotor's {:.4g} rpm.", orbit * to_rpm,
                     orbit / spin, spin * to_rpm),
         "A bare number is in rad/s: if rpm is meant, write for example \"9000 rpm\".");
}

void look_at_unbalance(const CaseParameters& p, double mass, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  double unbalance = 0.;
  for (const auto& one : p.rotor.unbalance) unbalance += one.me;
  const double e_omega = unbalance / mass * std::fabs(p.run.initial_speed);
  if (const auto& grade = p.rotor.balance_grade; grade && *grade > 0. && *grade < finest_grade)
    return warn(warnings, position_of_value(rotor, "balance_grade"),
                fmt::format("rotor.balance_grade is G{:.4g}; the finest of ISO 21940-11 is G0.4.", *grade * 1e3),
                "The number behind G is in mm/s: G2.5.");
  if (e_omega > 0. && e_omega < finest_balance)
    return warn(warnings, position_of_value(rotor, "unbalance"),
                fmt::format("the rotor's unbalance of {:.4g} kg m in {:.4g} kg is e omega = {:.2g} mm/s at its initial "
                            "speed; the finest grade of ISO 21940-11 is G0.4, 0.4 mm/s.",
                            unbalance, mass, e_omega * 1e3),
                "A bare number is in kg m: one gram millimetre is 1e-6. Without unbalance leave the list out.");
  if (e_omega <= coarsest_balance) return;
  const bool by_grade = p.rotor.balance_grade.has_value();
  warn(warnings, position_of_value(rotor, by_grade ? "balance_grade" : "unbalance"),
       fmt::format("the rotor's unbalance of {:.4g} kg m in {:.4g} kg is e omega = {:.4g} mm/s at its initial speed; "
                   "machines like this are balanced to G0.4 to G6.3.",
                   unbalance, mass, e_omega * 1e3),
       by_grade ? "Check balance_grade and balance_speed. A lost blade may be meant."
                : "A bare number is in kg m: one gram millimetre is 1e-6. A lost blade may be meant.");
}

/// The gas around the rotor.
void look_at_gas(const CaseParameters& p, const WindageParameters& windage, const Node& table,
                 std::vector<Fault>& warnings) {
  // Dynamic viscosity hardly depends on pressure: butane has 7e-6, hydrogen 9e-6, neon 3.2e-5 Pa s; with a margin for heat and cold.
  constexpr double least = 4e-6, most = 1e-4, densest_gas = 200.;
  const double viscosity = windage.viscosity * windage.density;
  if (windage.law == WindageLaw::geometry && windage.density < densest_gas && (viscosity < least || viscosity > most))
    warn(warnings, position_of_value(table, "viscosity"),
         fmt::format("the gas of rotor.windage has {:.4g} kg/m3 times {:.4g} m2/s = {:.3g} Pa s; air has 1.8e-5, "
                     "hydrogen 9e-6 Pa s, at any pressure.",
                     windage.density, windage.viscosity, viscosity),
         "viscosity is the kinematic one, dynamic viscosity over density: air has 15e-6 m2/s at 1.2 kg/m3.");
  if (!windage.gap) return;
  double widest = 0.;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) widest = std::max(widest, air_gap(*b, p.contact));
  if (*windage.gap < widest)
    warn(warnings, position_of_value(table, "gap"),
         fmt::format("rotor.windage.gap = {:.4g} um is less than the air gap of the touchdown bearings, {:.4g} um: "
                     "the rotor would rub there.",
                     *windage.gap * 1e6, widest * 1e6),
         "It is radial, between the rotor and the casing around it. A bare number is in metres.");
  if (const double radius = 0.5 * largest_diameter(p.rotor.geometry); radius > 0. && *windage.gap > 0.5 * radius)
    warn(warnings, position_of_value(table, "gap"),
         fmt::format("rotor.windage.gap = {:.4g} mm is more than half the rotor's radius, {:.4g} mm.", mm(*windage.gap),
                     mm(radius)),
         "A bare number is in metres. Leave the gap out for a rotor in free gas.");
}

/// What turns the rotor and pushes it along, against its inertia and weight.
void look_at_drive(const CaseParameters& p, const RigidBody& body, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  const double spin = std::fabs(p.run.initial_speed), end = p.run.latest_end();
  if (const double torque = largest(p.rotor.torque);
      p.run.until == EndCondition::time && spin > 0. && std::fabs(torque) * end > 3. * body.Ip * spin)
    warn(warnings, position_of_value(rotor, "torque"),
         fmt::format("rotor.torque of {:.4g} N m changes the speed by {:.4g} rpm in {:.4g} s, {:.3g} times the rotor's "
                     "{:.4g} rpm.",
                     torque, torque * end / body.Ip * to_rpm, end, std::fabs(torque) * end / (body.Ip * spin),
                     spin * to_rpm),
         "A bare number is in N m. Check its time table, and Ip of the rotor.");
  if (const double power = std::fabs(largest(p.rotor.torque)) * spin; power > densest_power * body.mass)
    warn(warnings, position_of_value(rotor, "torque"),
         fmt::format("rotor.torque of {:.4g} N m at {:.4g} rpm is {:.3g} MW, {:.3g} kW for each kilogram of the rotor.",
                     largest(p.rotor.torque), spin * to_rpm, power * 1e-6, power * 1e-3 / body.mass),
         "A bare number is in N m. Check the mass of the rotor, too.");
  if (p.rotor.windage) look_at_gas(p, *p.rotor.windage, table_at(tree, "rotor", "windage"), warnings);
  if (p.rotor.windage && spin > 0.) {
    const double torque = windage_of(p.rotor.geometry, *p.rotor.windage)(spin);
    if (torque > 0. && body.Ip * spin / torque < fastest_windage_decay)
      warn(
          warnings, position_of(rotor, "windage"),
          fmt::format("rotor.windage brakes with {:.4g} N m ({:.3g} kW) at {:.4g} rpm: it would halve the speed within "
                      "{:.3g} s.",
                      torque, 1e-3 * torque * spin, spin * to_rpm, body.Ip * spin / torque),
          "Check its torque and speed, or density, viscosity, gap and factor of the gas.");
  }
  if (const double force = largest(p.rotor.axial_force);
      std::fabs(force) > largest_thrust * body.mass * standard_gravity)
    warn(warnings, position_of_value(rotor, "axial_force"),
         fmt::format("rotor.axial_force of {:.4g} N is {:.3g} times the rotor's weight.", force,
                     std::fabs(force) / (body.mass * standard_gravity)),
         "A bare number is in N.");
  if (p.rotor.axial_motion != AxialFreedom::free && p.run.gravity[0] != 0.)
    warn(warnings, position_of_value(table_at(tree, "run"), "gravity"),
         fmt::format("gravity of {:.4g} m/s2 along the axis has no effect: the rotor is locked there.",
                     p.run.gravity[0]),
         "Set rotor.axial_motion = \"free\".");
}

}  // namespace

void look_at_motion(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const RigidBody body = rigid_body(p.rotor.geometry);
  look_at_speeds(p, tree, warnings);
  look_at_unbalance(p, body.mass, tree, warnings);
  look_at_drive(p, body, tree, warnings);
}

}  // namespace rotordrop
