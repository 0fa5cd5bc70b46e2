#pragma once
#include <array>
#include <utility>

namespace rotordrop {

/// Calibration of a bearing's lumped circuit: every factor multiplies what geometry gives. All 1: the circuit as published.
struct CircuitFactors {
  double shaft_ring = 1;  ///< of R2 + R3
  double inner_race = 1;  ///< of R4
  double ball = 1;        ///< of R5, at both races
  double outer_race = 1;  ///< of R7
  double fit = 1;         ///< of R8
  double inner_ring_capacity = 1, outer_ring_capacity = 1, housing_capacity = 1;
};

/// With the names that parameter files have.
inline constexpr std::array<std::pair<const char*, double CircuitFactors::*>, 8> circuit_factors = {
    {{"shaft_ring", &CircuitFactors::shaft_ring},
     {"inner_race", &CircuitFactors::inner_race},
     {"ball", &CircuitFactors::ball},
     {"outer_race", &CircuitFactors::outer_race},
     {"fit", &CircuitFactors::fit},
     {"inner_ring_capacity", &CircuitFactors::inner_ring_capacity},
     {"outer_ring_capacity", &CircuitFactors::outer_ring_capacity},
     {"housing_capacity", &CircuitFactors::housing_capacity}}};

}  // namespace rotordrop
