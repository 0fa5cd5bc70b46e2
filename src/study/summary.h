#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/drop_run.h"

namespace rotordrop {

/// Scalars of a run, SI; see docs/reference/results.md for every key.
/// @param elements  of the machine, or null
/// @param results   the run's results.h5, closed
nlohmann::ordered_json summarise(const Case& drop_case, const Machine& machine, const DropScalars& scalars,
                                 const DropResult& result, FiniteElements* elements,
                                 const std::filesystem::path& results);

/// The main results as a few lines for the terminal.
std::string summary_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
