#pragma once
#include "base/errors.h"
#include "model/support.h"
#include "thermal/thermal_kinds.h"

namespace rotordrop {

// What parts of others declare becomes datasets, tolerances and columns of reports: names that cannot be, stand twice or hide each other, and scales that
// are none, are refused before anything runs.

/// @param support  as its kind made it; may be null
/// @param where    its table in the case
void check_declared(const Support* support, const std::string& name, const SourcePosition& where, Faults& faults);
/// Likewise a thermal model, and what it does (declared_heat.h); what cases add to a circuit (thermal.node) was checked before.
/// @param n_places  touchdown bearings of the case
void check_declared(const ThermalModel* model, const ThermalKind& kind, std::size_t n_places,
                    const SourcePosition& where, Faults& faults);

}  // namespace rotordrop
