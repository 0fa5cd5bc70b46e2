#pragma once
#include <vector>

#include "model/heat_conduction.h"

namespace rotordrop {

/// Cells between two coordinates are wanted no larger than `size`; at a distance d from there, no larger than size + slope d.
struct GridDemand {
  double from = 0, to = 0, size = 0;  ///< [m]
};

/// Lines of one direction of the grid: all `ends`, and between them cells as the demands want them.
/// @param ends    coordinates [m], in any order
/// @param growth  largest ratio of neighbouring cells between two ends, > 1
/// @return rising [m]
std::vector<double> grid_lines(std::vector<double> ends, const std::vector<GridDemand>& demands, double growth);

/// The lines of both directions, common to all bodies, so that cells of bodies that touch meet face to face.
struct Grid {
  std::vector<double> x, r;
};
/// Every body wants numerics.cells across itself; a boundary with flux wants them numerics.grading times thinner, the end of an interface inside a
/// side numerics.end_grading times.
Grid make_grid(const HeatConductionProblem& problem);

}  // namespace rotordrop
