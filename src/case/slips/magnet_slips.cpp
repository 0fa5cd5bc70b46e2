#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "case/slips/slips.h"
#include "machine/magnets.h"

namespace rotordrop {
namespace {

/// Magnets that push the rotor away before they let go.
void look_at_given_forces(const CaseParameters& p, double mass, const Node& tree, std::vector<Fault>& warnings) {
  bool all_given = true;
  std::array<double, 2> held{};
  const SupportEntry* last = nullptr;
  for (const auto& entry : p.bearings) {
    const auto* magnet = entry.magnet();
    if (!magnet) continue;
    last = &entry;
    // Estimate: closed loops of 10 kN/m in small pumps to 1 GN/m in large compressors.
    constexpr double softest = 1e3, stiffest = 1e9;
    for (std::size_t i = 0; i < 2; ++i)
      if (const double K = magnet->stiffness[i][i]; K != 0. && (std::fabs(K) < softest || std::fabs(K) > stiffest))
        warn(warnings, position_of_value(table_at(tree, "bearings", entry.name), "stiffness"),
             fmt::format("bearings.{}.stiffness = {:.4g} N/m is unusual for a magnet: most often it is between {:.0e} "
                         "and {:.0e} N/m.",
                         entry.name, K, softest, stiffest),
             "A bare number is in N/m: 10 N/um are 1e7.");
    all_given = all_given && magnet->holding_force.has_value();
    for (std::size_t i = 0; i < 2; ++i) {
      if (magnet->holding_force) held[i] += (*magnet->holding_force)[i];
      if (magnet->damping[i][i] < 0.)
        warn(warnings, position_of_value(table_at(tree, "bearings", entry.name), "damping"),
             fmt::format("bearings.{}.damping = {:.4g} N s/m on its diagonal drives the rotor while the magnet holds "
                         "it.",
                         entry.name, magnet->damping[i][i]),
             "Damping is positive: force on the rotor = -C v.");
    }
  }
  if (!last || !all_given) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const double weight = mass * p.run.gravity[i + 1];
    if (std::fabs(held[i] + weight) > std::max(std::fabs(weight), 0.1 * mass * standard_gravity))
      warn(warnings, position_of_value(table_at(tree, "bearings", last->name), "holding_force"),
           fmt::format(
               "the magnets hold the rotor with {:.4g} N along {} where its weight is {:.4g} N: it is not at rest "
               "where it starts.",
               held[i], i == 0 ? "y" : "z", weight),
           "holding_force is what a magnet carries with the rotor at rest and undisturbed; leave it out to share the "
           "weight.");
  }
}

/// What magnets without a force of their own have to give, so that all together balance the weight and its moment.
void look_at_forces_that_follow(const CaseParameters& p, const RigidBody& body, const Node& tree,
                                std::vector<Fault>& warnings) {
  constexpr double most_of_weight = 3., noticed = 0.05;  // estimates; a magnet is made for the rotor's weight
  const auto forces = magnet_holding_forces(p, body);
  const SupportEntry* given = nullptr;
  for (const auto& entry : p.bearings)
    if (const auto* magnet = entry.magnet(); magnet && magnet->holding_force) given = &entry;
  if (!given) return;  // they share the weight as two supports do
  std::size_t k = 0;
  for (const auto& entry : p.bearings) {
    const auto* magnet = entry.magnet();
    if (!magnet) continue;
    const auto force = forces[k++];
    if (magnet->holding_force) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const double weight = body.mass * p.run.gravity[i + 1];
      const double scale = std::max(std::fabs(weight), 0.1 * body.mass * standard_gravity);
      const bool pulls_down = force[i] * weight > 0. && std::fabs(force[i]) > noticed * scale;
      if (!pulls_down && std::fabs(force[i]) <= most_of_weight * scale) continue;
      warn(
          warnings, position_of_value(table_at(tree, "bearings", given->name), "holding_force"),
          fmt::format("with the holding_force that is given, bearings.{} must {} with {:.4g} N along {}, where the "
                      "rotor's weight is {:.4g} N.",
                      entry.name, pulls_down ? "pull the rotor down" : "hold the rotor", force[i], i == 0 ? "y" : "z",
                      weight),
          "Magnets without a holding_force balance what the others leave of the weight and its moment. Leave it out of "
          "all to share the weight.");
    }
  }
}

/// Springs of magnets against the rotor that they hold.
void look_at_softness(const CaseParameters& p, double mass, const Node& tree, std::vector<Fault>& warnings) {
  constexpr double slowest = 5.;  // estimate: rigid modes on magnetic bearings are most often at 10 to 200 Hz [Hz]
  std::array<double, 2> K{};
  const SupportEntry* first = nullptr;
  for (const auto& entry : p.bearings) {
    const auto* magnet = entry.magnet();
    const auto* linear = entry.linear();
    if (magnet && !first) first = &entry;
    for (std::size_t i = 0; i < 2; ++i)
      K[i] += magnet ? magnet->stiffness[i][i] : linear ? linear->stiffness[i][i] : 0.;
  }
  const std::size_t softer = K[1] > 0. && (K[0] <= 0. || K[1] < K[0]) ? 1 : 0;
  if (!first || K[softer] <= 0.) return;
  const double frequency = std::sqrt(K[softer] / mass) / (2. * std::numbers::pi);
  if (frequency < slowest)
    warn(warnings, position_of_value(table_at(tree, "bearings", first->name), "stiffness"),
         fmt::format("the magnets hold the rotor of {:.4g} kg with {:.4g} N/m along {}, on which it swings at {:.2g} "
                     "Hz; on magnetic bearings it is most often 10 to 200 Hz.",
                     mass, K[softer], softer == 0 ? "y" : "z", frequency),
         "A bare number is in N/m: 10 N/um are 1e7.");
}

}  // namespace

void look_at_magnets(const CaseParameters& p, const RigidBody& body, const Node& tree, std::vector<Fault>& warnings) {
  look_at_given_forces(p, body.mass, tree, warnings);
  look_at_forces_that_follow(p, body, tree, warnings);
  look_at_softness(p, body.mass, tree, warnings);
}

}  // namespace rotordrop
