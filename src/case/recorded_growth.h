#pragma once
#include <memory>

#include "case/case.h"
#include "machine/heat/growth_history.h"

namespace rotordrop {

/// Growth that an earlier run fed back (/bearings/NAME/expansion), if thermal.driver requires it; null otherwise. Linear between that
/// run's records; what it recorded last holds on.
/// @throws InputError if the file or one of the case's bearings is not there
std::shared_ptr<const GrowthHistory> recorded_growth(const Case& drop_case);

}  // namespace rotordrop
