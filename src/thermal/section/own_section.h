#pragma once
#include <string>
#include <vector>

#include "base/errors.h"
#include "model/section_mesher.h"
#include "thermal/section/shaft_steps.h"

namespace rotordrop {

/// What a mesh that a user brings must have.
struct OwnSectionWishes {
  std::vector<std::string> bodies;     ///< all of these and no others, in this order
  int rows = 1;                        ///< every ring needs strip_1 to strip_ROWS
  std::vector<ShaftStep> shaft_steps;  ///< which of the bodies are the shaft beside the bearing
};

/// A section from a mesh file: quadrilaterals in named bodies, every edge of their outlines in one named group. Where the edges of a row's
/// raceway and strip lie on a circle to 1e-7 m, that is their arc.
/// @param file  for messages
SectionMesh own_section(const MeshFileContent& content, const OwnSectionWishes& wishes, const std::string& file,
                        Faults& faults);

}  // namespace rotordrop
