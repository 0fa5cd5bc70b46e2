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
  double friction_coefficient = 0;    ///< dynamic
  double air_gap = 0;                 ///< radial [m]
  double exponent = 0;                ///< n of F = K delta^n
  double lambda = 0;                  ///< damping [s/m]
  double regularisation_speed = 0;    ///< [m/s]
  std::optional<double> bore_radius;  ///< [m]
  std::optional<double> static_friction_coefficient;
  double stribeck_speed = 0;                                              ///< [m/s]
  std::optional<std::vector<std::array<double, 2>>> friction_over_speed;  ///< pairs of slip speed [m/s] and coefficient
  std::optional<std::vector<std::array<double, 2>>> friction_over_temperature;  ///< pairs of temperature [K] and factor
  double wear_coefficient_bore = 0, wear_coefficient_rotor = 0;                 ///< Archard's k = K/H [m^2/N]
  double wear_depth_limit = 0;                                                  ///< [m]
  FrictionLaw friction_law = FrictionLaw::automatic;
  double tangential_stiffness = 0;  ///< of the bristle [N/m]
  double contact_length = 0;        ///< along the surface, after which a bristle leaves the contact [m]
};
Section<ContactParameters> contact_section();

/// The largest friction coefficient between rotor and bore at any slip speed and temperature.
double largest_friction(const ContactParameters& contact);

}  // namespace rotordrop
