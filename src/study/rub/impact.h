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
  double next = std::numeric_limits<double>::quiet_NaN();  ///< when the contact closes again
};
/// Begins where the recorded penetration first passes zero, and ends where it does so while the journal comes back from the bore: the contact opens
/// sooner, for some microseconds, where the journal knocks a light ring away and meets it again. The peak is the largest sample.
/// @param drop   with series_of_impact()
/// @param until  as if the record ended there [s]
Impact first_impact(const RecordedDrop& drop, const std::string& bearing,
                    double until = std::numeric_limits<double>::infinity());

std::vector<std::string> series_of_impact(const std::string& bearing);

/// The impact's peak, the given times [s] before the end, and the end.
std::vector<Instant> instants_of(const Impact& impact, double end, const std::vector<double>& more);

}  // namespace rotordrop
