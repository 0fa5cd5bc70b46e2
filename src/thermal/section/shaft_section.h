#pragma once
#include <vector>

#include "thermal/section/section_builder.h"
#include "thermal/section/shaft_steps.h"

namespace rotordrop {

/// Adds the shaft under the bearing, body "shaft", and beside it a body for each step. All share their layers, so that where two
/// bodies touch with their faces vertices lie on vertices.
/// @param bore, radius  of the shaft under the bearing [m]; bore 0: it is solid
/// @param columns  of the shaft under the bearing
void add_shaft(double bore, double radius, const Columns& columns, const std::vector<ShaftStep>& steps,
               const CellSizes& sizes, SectionBuilder& builder);

}  // namespace rotordrop
