#include "thermal/circuit/lumped_kind.h"

namespace rotordrop {

ThermalKind lumped_kind() {
  return {.name = "lumped",
          .title = "lumped thermal circuit",
          .word = "circuit",
          .mark = "lumped",
          .group = "/thermal/",
          .is_unmarked = true,
          .is_circuit = true,
          .has_ring_states = true,
          .make = [](const ThermalGeometry& geometry) { return std::make_unique<ThermalNetwork>(geometry.circuits); }};
}

}  // namespace rotordrop
