#pragma once
// Stiffness of rotor and bore from their bodies, where a case gives none.
#include <optional>
#include <string>

#include "bearing/touchdown_data.h"

namespace rotordrop {

/// K of F = K delta^n of rotor and bore, and where it comes from.
struct ContactStiffness {
  double value = 0;            ///< [N/m^n]
  bool is_given = false;       ///< by the case, not from bodies
  double from_bodies = 0;      ///< what the bodies give [N/m^n]; 0 if there is no journal
  double reference_force = 0;  ///< at which the law and the bodies have the same approach [N]
  double approach = 0;         ///< there [m]
  double half_width = 0;       ///< of the contact there, around the circumference [m]
  double length = 0;           ///< of the contact there, along the axis [m]
  bool is_ellipse = false;     ///< that of a crowned journal; else a rectangle
  /// Approach of the law over that of the bodies, less 1, at a fifth and at five times the reference force.
  double deviation_low = 0, deviation_high = 0;
};
[[nodiscard]] ContactStiffness contact_stiffness(const TouchdownParameters& bearing, const ContactParameters& contact,
                                                 const TouchdownSurroundings& surroundings);
/// A line for `check`.
[[nodiscard]] std::string contact_stiffness_words(const std::string& name, const ContactStiffness& stiffness,
                                                  double exponent);

}  // namespace rotordrop
