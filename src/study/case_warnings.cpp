#include "study/case_warnings.h"

#include <fmt/format.h>

namespace rotordrop {

std::vector<std::string> case_warnings(const Case& c) {
  std::vector<std::string> list;
  for (const auto& entry : c.parameters.bearings) {
    const auto* b = entry.touchdown();
    if (b && c.parameters.rotor.axial_motion == AxialFreedom::free && b->load_law == FrictionLoadLaw::radial)
      list.push_back(fmt::format(
          "{} takes axial load (rotor.axial_motion = \"free\"), but with load_law = \"radial\" thrust makes no "
          "friction and no heat in it; set bearings.{}.load_law = \"equivalent\".",
          entry.name, entry.name));
  }
  return list;
}

}  // namespace rotordrop
