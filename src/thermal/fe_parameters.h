#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parameters/section.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// What cases and results call the finite elements: in thermal.models, [thermal.fe], [fe] of heat alone, /fe.
inline constexpr const char* fe_name = "fe";

/// Races with their grooves, or rectangles of the rings' diameters.
enum class FeSection { grooved, plain };
/// How the finite elements take part in a drop: on few modes in the state vector, in windows beside it, or with all modes of the mesh in it.
enum class FeCoupling { reduced, windowed, monolithic };

/// The shaft in the finite elements: one lump as in the circuit, meshed over shaft_lump_length, or meshed beside the bearing too.
enum class FeShaft { lump, bearing, beyond };

/// [thermal.fe]: the finite elements of every touchdown bearing.
struct FeParameters {
  double surface_cell = 0, largest_cell = 0, refinement = 1;
  std::optional<double> strip_half_width;
  double relieved_shoulder = 0;
  FeShaft shaft = FeShaft::lump;
  std::optional<double> shaft_reach;               ///< [m]
  std::optional<double> shaft_contact_resistance;  ///< [K/W]
  std::optional<std::string> mesh;
  FeSection section = FeSection::grooved;
  FeCoupling coupling = FeCoupling::reduced;
  int degree = 2, modes = 0;
  double response_tolerance = 0;
  double longest_step = 0;  ///< [s]
  HeatLinearSolver solver = HeatLinearSolver::direct;
  double window_tolerance = 0, longest_window = 0;
  std::vector<double> field_times;       ///< [s]
  std::optional<double> field_interval;  ///< [s]
};
Section<FeParameters> fe_section();

/// The key `solver`, here and in cases of heat alone.
inline std::vector<std::pair<std::string, HeatLinearSolver>> linear_solvers() {
  return {{"automatic", HeatLinearSolver::automatic},
          {"direct", HeatLinearSolver::direct},
          {"multigrid", HeatLinearSolver::multigrid}};
}
inline constexpr const char* linear_solver_help =
    "Solver of the linear equations. direct: factorisation. multigrid: conjugate gradients preconditioned "
    "with algebraic multigrid (PETSc, hypre), for meshes whose factors do not fit into memory. automatic: direct, as "
    "long as the factors are estimated to take less than half of the machine's memory.";

/// The file that `mesh` means for one bearing: NAME in it is replaced by the bearing's name.
std::string own_mesh_file(const std::string& pattern, const std::string& bearing);

}  // namespace rotordrop
