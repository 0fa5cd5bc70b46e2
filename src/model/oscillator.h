#pragma once
#include <cstddef>

namespace rotordrop {

/// Two entries of a state vector, a coordinate and its velocity, that would be an underdamped oscillator if nothing else acted on them:
///   q' = v,  v' = -omega^2 q - c v + whatever else acts
struct Oscillator {
  std::size_t coordinate = 0, velocity = 0;  ///< where they stand in the state vector
  double omega_squared = 0;                  ///< [1/s^2], > (damping_rate / 2)^2
  double damping_rate = 0;                   ///< c [1/s], >= 0
};

}  // namespace rotordrop
