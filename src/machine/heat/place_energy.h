#pragma once
#include <array>
#include <vector>

#include "model/ports.h"

namespace rotordrop {

/// Energy that has entered a thermal place since the start [J].
struct PlaceEnergy {
  double rub = 0, rub_into_ring = 0, inner = 0, outer = 0;
  std::vector<std::array<double, 2>> rows =
      {};  ///< of it at the inner and the outer race of each row, where rows are heated apart
};

/// What the balls of a thermal place conduct as they roll, if they do: of all rows, and of each where rows are heated apart.
struct PlaceConduction {
  BallConduction all;
  std::vector<BallConduction> rows = {};
};

}  // namespace rotordrop
