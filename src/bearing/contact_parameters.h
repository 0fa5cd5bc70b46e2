#pragma once

// The keys of [contact].
#include <array>
#include <optional>
#include <vector>

#include "base/parameters/section.h"

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

/// The largest friction coefficient between rotor and bore at any slip speed and temperature.
double largest_friction(const ContactParameters& contact);

}  // namespace rotordrop
