#pragma once
#include "thermal/heating/heat_parameters.h"

namespace rotordrop {

/// Heat from the ledger of an earlier drop; see ReadRecordedHeat.
std::optional<RecordedHeat> read_recorded_heat(const RecordedHeatName& heat, const Node& table, const std::string& name,
                                               Faults& faults);

}  // namespace rotordrop
