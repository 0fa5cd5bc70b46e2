#pragma once
#include <string>
#include <vector>

#include "analysis/preload/preload_criterion.h"
#include "study/preload/preload_tables.h"

namespace rotordrop {

/// Steady running of a bearing from cold until it settles, reaches a limit, or reaches the end time.
struct PreloadCourse {
  bool is_settled = false;  ///< no temperature changes faster than settled_rate
  LimitMet limit = LimitMet::none;
  double time = 0;        ///< of the end [s]
  std::vector<double> y;  ///< at the end: temperatures, then heat made and lost [J]
  double largest_preload = 0, largest_preload_time = 0;
  PreloadTable table;  ///< every step
};

/// Follows a loop in time by backward differences; the instant of a limit is found within its step.
/// @param prefix  of the table's datasets
PreloadCourse follow_preload(const PreloadLoop& loop, const PreloadParameters& settings, const std::string& prefix);

}  // namespace rotordrop
