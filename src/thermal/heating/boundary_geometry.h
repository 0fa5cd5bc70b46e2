#pragma once

// Where the boundaries of a section of rectangles lie, and what interfaces leave of them.
#include <array>
#include <vector>

#include "base/errors.h"
#include "base/node.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// From and to along the boundary: radii of a face, places along the axis of a surface [m].
std::array<double, 2> extent_along(const HeatConductionProblem& problem, const HeatBoundary& boundary);
/// Place of a face along the axis, or radius of a surface [m].
double line(const HeatConductionProblem& problem, const HeatBoundary& boundary);
/// What interfaces leave of a boundary, from and to along it [m].
std::vector<std::array<double, 2>> free_parts(const HeatConductionProblem& problem, const HeatBoundary& boundary);
/// Area of a part of a boundary, from and to along it [m2].
double area_of(const HeatConductionProblem& problem, const HeatBoundary& boundary, double from, double to);
/// Area of the free part of a boundary [m2].
double free_area(const HeatConductionProblem& problem, const HeatBoundary& boundary);
/// Faults of a body that is too thin: a grid common to all bodies cannot show one that is far thinner than the whole.
/// @param tree  the case, for the place of the fault
void check_proportions(const HeatConductionProblem& problem, const Node& tree, Faults& faults);

}  // namespace rotordrop
