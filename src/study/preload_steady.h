#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/preload_tables.h"

namespace rotordrop {

/// One touchdown bearing running steadily from cold: its way in time, its operating points, what would have to change until none is left,
/// and a verdict. Tables are added. See docs/preload.md for every key.
nlohmann::ordered_json run_preload_loop(const Case& preload_case, const std::string& bearing,
                                        std::vector<PreloadTable>& tables);

}  // namespace rotordrop
