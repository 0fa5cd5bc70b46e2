#include "analysis/lanes/scalars_in_lanes.h"

#include "base/level_choice.h"

namespace rotordrop {

std::unique_ptr<ScalarsInLanes> make_scalars_in_lanes(const std::vector<BearingColumns>& columns) {
  return ROTORDROP_OF_LEVEL(scalars_in_lanes)(columns);
}

}  // namespace rotordrop
