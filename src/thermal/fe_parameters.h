#pragma once
#include <optional>
#include <string>

#include "base/parameters.h"

namespace rotordrop {

/// Races with their grooves, or rectangles of the rings' diameters.
enum class FeSection { grooved, plain };
/// How the finite elements take part in a drop: on few modes in the state vector, in windows beside it, or with all modes of the mesh in it.
enum class FeCoupling { reduced, windowed, monolithic };

/// [thermal.fe]: the finite elements of every touchdown bearing.
struct FeParameters {
  double surface_cell = 0, largest_cell = 0, refinement = 1;
  std::optional<double> strip_half_width;
  double relieved_shoulder = 0;
  bool shaft = false;
  std::optional<std::string> mesh;
  FeSection section = FeSection::grooved;
  FeCoupling coupling = FeCoupling::reduced;
  int degree = 2, modes = 0;
  double window_tolerance = 0, longest_window = 0;
};
Section<FeParameters> fe_section();

/// The file that `mesh` means for one bearing: NAME in it is replaced by the bearing's name.
std::string own_mesh_file(const std::string& pattern, const std::string& bearing);

}  // namespace rotordrop
