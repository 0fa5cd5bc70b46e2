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
  double time = 0;        ///< of the limit, else from which it has settled, else of the end [s]
  std::vector<double> y;  ///< at the end of the table: temperatures, then heat made and lost [J]
  double largest_preload = 0, largest_preload_time = 0;
  PreloadTable table;  ///< every step, the one in which it settles to its end
};

/// Follows a loop in time by backward differences; the instants of a limit and of settling are found within their steps.
/// @param prefix  of the table's datasets
PreloadCourse follow_preload(const PreloadLoop& loop, const PreloadParameters& settings, const std::string& prefix);

}  // namespace rotordrop
