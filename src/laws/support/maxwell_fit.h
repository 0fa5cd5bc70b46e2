#pragma once
// A generalised Maxwell model that has a table's storage and loss stiffness.
#include <array>
#include <vector>

#include "laws/support/support_laws.h"

namespace rotordrop {

/// Dynamic stiffness at one frequency.
struct DynamicStiffness {
  double frequency = 0;          ///< [Hz], > 0
  double storage = 0, loss = 0;  ///< [N/m]
};

struct MaxwellFit {
  MaxwellModel model;
  double largest_error = 0;    ///< of the complex stiffness, over its magnitude
  double worst_frequency = 0;  ///< where [Hz]
};

/// Non-negative springs k_0, k_j, damper c and relaxation times nearest to the table, each row weighted by its magnitude. Relaxation times come from a grid a decade
/// beyond the table on both sides that is refined about those in use; so a table of any passive material is met to rounding, and one that no
/// such material has is met as nearly as can be. Source: Lawson & Hanson (1974), ch. 23 (non-negative least squares).
/// @param table  rising frequencies
[[nodiscard]] MaxwellFit fit_maxwell(const std::vector<DynamicStiffness>& table);

/// Spring and damper with the table's stiffness at one frequency [Hz], by straight lines in the table.
[[nodiscard]] MaxwellModel kelvin_voigt(const std::vector<DynamicStiffness>& table, double frequency);

}  // namespace rotordrop
