#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/preload/preload_course.h"

namespace rotordrop {

/// Combined verdict of the time history and the criterion: "stable", "runs-away", "runs-away-on-the-way" (from cold, although a stable operating
/// point exists), "seized-from-the-start", "undecided".
/// @param settled  which of the points the history settled at (add_settled)
std::string verdict_of(const PreloadCourse& way, const OperatingPoints& points, std::optional<std::size_t> settled);

/// One touchdown bearing running steadily from cold: its way in time, its operating points, what would have to change until none is left,
/// and a verdict. Tables are added. See docs/how-to/preload.md for every key.
nlohmann::ordered_json run_preload_loop(const Case& preload_case, const std::string& bearing,
                                        std::vector<PreloadTable>& tables, const Look& look = {});

}  // namespace rotordrop
