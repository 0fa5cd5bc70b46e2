#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/drop/drop_run.h"

namespace rotordrop {

/// Scalars of a run, SI; see docs/reference/results.md for every key.
/// @param elements  of the machine, or null
/// @param recorded  series of the finite elements, of orbits and rubs
nlohmann::ordered_json summarise(const Case& drop_case, const Machine& machine, const DropScalars& scalars,
                                 const DropResult& result, FiniteElements* elements, const RecordedDrop& recorded);

/// The main results as a few lines for the terminal.
std::string summary_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
