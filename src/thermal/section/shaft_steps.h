#pragma once
#include <string>

namespace rotordrop {

/// A piece of the shaft beside a bearing, of one diameter: a body of its own for the finite elements.
struct ShaftStep {
  std::string name;                ///< "shaft_left_1", counted from the bearing; left: towards -x
  double from = 0, to = 0;         ///< along the axis from the middle of the bearing [m], rising
  double inside = 0, outside = 0;  ///< radii [m]; inside 0: solid
  bool is_left = false;
  bool is_first = false;  ///< of its side: it continues the shaft under the bearing
};

}  // namespace rotordrop
