#pragma once
#include <optional>
#include <string>

#include "base/parameters.h"

namespace rotordrop {

/// [thermal.fe]: the finite elements of every touchdown bearing.
struct FeParameters {
  double surface_cell = 0, largest_cell = 0, refinement = 1;
  std::optional<double> strip_half_width;
  double relieved_shoulder = 0;
  bool shaft = false;
  std::optional<std::string> mesh;
};
Section<FeParameters> fe_section();

/// The file that `mesh` means for one bearing: NAME in it is replaced by the bearing's name.
std::string own_mesh_file(const std::string& pattern, const std::string& bearing);

}  // namespace rotordrop
