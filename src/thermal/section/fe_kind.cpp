#include "thermal/section/fe_kind.h"

#include "thermal/fe_parameters.h"

namespace rotordrop {

ThermalKind fe_kind() {
  return {.name = fe_name,
          .title = "finite elements",
          .word = "finite elements",
          .mark = "FE",
          .group = std::string("/") + fe_name + "/",
          .meshes_sections = true,
          .make = [](const ThermalGeometry& geometry) {
            return std::make_unique<ReducedSections>(geometry.sections(), geometry.ambient);
          }};
}

}  // namespace rotordrop
