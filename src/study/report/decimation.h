#pragma once
#include <cstddef>

#include "study/time_series.h"

namespace rotordrop {

/// Thins a series so that its plot looks the same: of each of `n_buckets` equal spans of time the smallest and the largest sample, at their own
/// times, beside the first and the last of all. So no peak is lost, and none is moved.
/// @return at most 2 n_buckets + 2 samples; all of them if there are no more
/// @throws std::invalid_argument if n_buckets is 0
TimeSeries decimated(const TimeSeries& series, std::size_t n_buckets);

}  // namespace rotordrop
