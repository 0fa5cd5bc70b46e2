#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/preload/preload_tables.h"

namespace rotordrop {

/// The maps of [preload.map] of one touchdown bearing: over growth and speed, over interference and speed, over the rings' rises. Tables are
/// added; what is returned says of each map its axes and its corners. Points without an equilibrium are NaN, and counted.
nlohmann::ordered_json make_preload_maps(const Case& preload_case, const std::string& bearing,
                                         std::vector<PreloadTable>& tables, const Look& look = {});

}  // namespace rotordrop
