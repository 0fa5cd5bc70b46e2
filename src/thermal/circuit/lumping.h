#pragma once
#include <string>
#include <vector>

#include "thermal/circuit/bearing_circuit.h"

// When a body may be taken as one temperature.
namespace rotordrop {

/// A body of a bearing, as one lump of the circuit.
struct LumpedBody {
  std::string name;        ///< of its node
  double length = 0;       ///< L: thickness that heat from one side has to cross; radius of shaft and balls [m]
  double diffusivity = 0;  ///< a = k/(rho c) [m2/s]
  double biot = 0;         ///< Bi = h L/k, h = (sum of 1/R to its neighbours and ambient)/area

  /// Fo = a t/L^2.
  [[nodiscard]] double fourier(double time) const;
  /// From when, after a pulse of heat on one side, what is left of the unevenness is below `part` of the mean rise: an insulated plate, whose slowest
  /// part decays as 2 exp(-pi^2 Fo) at the heated side; so Fo = ln(2/part)/pi^2, 0.30 for a tenth [s].
  [[nodiscard]] double evening_time(double part = 0.1) const;
  /// sqrt(a t): how deep heat has gone [m].
  [[nodiscard]] double depth(double time) const;
};

/// Lumps with Bi below this differ by less than 5 % inside while heat flows steadily through their surface.
inline constexpr double largest_lumped_biot = 0.1;

/// Shaft, inner ring, balls, outer ring, housing. R to a neighbour leaves out what lies within the body itself:
///   shaft       R1 to ambient, R3 to the ring (unless they conduct in contact only: then R3 plus the gap)      over pi d_s W
///   inner ring  R2 to the shaft's middle, R5 to the balls                                                     over pi d_bore W
///   balls       2 x R5's constriction, R6 to ambient                                                          over their surface
///   outer ring  R5 to the balls, R8's fit and housing                                                         over its inside
///   housing     R8's ring and fit; R9 at a rise of 1 K, h = 23 W/(m2 K)                                        over its inside
/// Masses are those of the bodies' materials; balls take L = radius.
std::vector<LumpedBody> lumped_bodies(const BearingCircuitData& bearing);

}  // namespace rotordrop
