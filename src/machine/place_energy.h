#pragma once

namespace rotordrop {

/// Energy that has entered a thermal place since the start [J].
struct PlaceEnergy {
  double rub = 0, rub_into_ring = 0, inner = 0, outer = 0;
};

}  // namespace rotordrop
