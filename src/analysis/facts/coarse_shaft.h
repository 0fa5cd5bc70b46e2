#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "rotor/geometry.h"

namespace rotordrop {

/// Elements of a shaft that are too long for its bending modes.
struct CoarseShaft {
  std::vector<std::size_t> elements;  ///< those that are long, the longest first
  int mode = 0;                       ///< free-free bending mode at rest that errs most, from 1
  double frequency = 0, refined = 0;  ///< of this mode, with the elements as given and with the long ones cut [Hz]
};

/// Compares the first two free-free bending modes, and those below twice the spin speed, with those of the same shaft whose long elements are
/// cut by pieces_of().
///
/// A cubic element errs by about (k h)^4 / 720 in a mode's frequency, k its wave number (modes of a uniform beam: k L = 4.73, 7.85). Elements are long above an eighth of the rotor's length (0.1 % in the second mode of a uniform beam; stepped shafts
/// bend more in places) or above 1/k of their own wave number at twice the spin speed (0.14 %). A shaft without long elements costs nothing;
/// one of more than 300 nodes is not looked at.
/// @param spin_speed     [rad/s], any sign
/// @param largest_error  of a frequency, as a ratio
/// @return empty if no mode errs by more
[[nodiscard]] std::optional<CoarseShaft> coarse_shaft(const RotorGeometry& geometry, double spin_speed,
                                                      double largest_error);

/// Number of equal pieces into which an element of a coarse shaft is best cut: none is longer than a sixteenth of the rotor,
/// or half a 1/k; 20 at most.
[[nodiscard]] int pieces_of(const RotorGeometry& geometry, const ShaftElement& element, double spin_speed);

}  // namespace rotordrop
