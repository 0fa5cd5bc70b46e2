#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "machine/heat/finite_elements.h"

namespace rotordrop {

/// Hoop stresses, fit and raceways of a section with elastic growth at one instant, SI; docs/reference/results.md has the keys. Solves twice.
/// @param temperatures  the section's field [K]
/// @param speed         of the inner ring [rad/s]
nlohmann::ordered_json elastic_state(const FiniteElements::Section& section, std::span<const double> temperatures,
                                     double speed);

}  // namespace rotordrop
