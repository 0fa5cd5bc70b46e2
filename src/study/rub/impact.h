#pragma once
#include <limits>
#include <string>
#include <vector>

#include "study/recorded_drop.h"

namespace rotordrop {

/// When something is reported.
struct Instant {
  std::string name;
  double time = 0;
};

/// The first impact of a bearing; NaN if there was none.
struct Impact {
  double start = std::numeric_limits<double>::quiet_NaN(), end = std::numeric_limits<double>::quiet_NaN(),
         peak_time = std::numeric_limits<double>::quiet_NaN(), peak = 0;
};
/// Begins and ends where the recorded penetration passes zero; the peak is the largest sample.
Impact first_impact(const RecordedDrop& drop, const std::string& bearing);

/// The impact's peak, the given times [s] before the end, and the end.
std::vector<Instant> instants_of(const Impact& impact, double end, const std::vector<double>& more);

}  // namespace rotordrop
