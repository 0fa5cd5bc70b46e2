#pragma once

// A touchdown bearing as numbers, made from its parameters and what surrounds it.
#include <array>
#include <optional>
#include <string>

#include "bearing/touchdown_parameters.h"

namespace rotordrop {

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
  [[nodiscard]] const ElasticMaterial& rotor() const { return journal ? journal->material : ring; }
};

/// What lies between a rotor that leans on a shoulder and the balls: a half space under the annulus that touches, and the ring's wall from its face to the row
/// that carries the load [m/N].
struct ShoulderCompliance {
  double rotor = 0, ring = 0;
  [[nodiscard]] double stiffness() const { return 1. / (rotor + ring); }
};
ShoulderCompliance shoulder_compliance(const TouchdownParameters& bearing, const TouchdownSurroundings& surroundings);
/// The given one, or that of the geometry [N/m].
double shoulder_stiffness(const TouchdownParameters& bearing, const TouchdownSurroundings& surroundings);

TouchdownBearingData touchdown_data(const std::string& name, const TouchdownParameters& bearing,
                                    const ContactParameters& contact, const TouchdownSurroundings& surroundings);

}  // namespace rotordrop
