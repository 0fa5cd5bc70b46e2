#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/preload/preload_tables.h"
#include "study/recorded_drop.h"

namespace rotordrop {

/// Preload of one touchdown bearing over a recorded drop, quasi-static: the growth that the drop felt (/bearings/NAME/expansion) and its
/// ring speed, the inner ring in equilibrium at every instant. At most about 3000 evenly spaced instants; all instants if under load.
/// @throws InputError if the drop has no such bearing
nlohmann::ordered_json make_preload_history(const Case& preload_case, const std::string& bearing,
                                            const RecordedDrop& drop, std::vector<PreloadTable>& tables,
                                            const Look& look = {});

}  // namespace rotordrop
