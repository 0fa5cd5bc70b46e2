#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/rub/impact.h"
#include "study/time_series.h"

namespace rotordrop {

/// How the two sides of a difference are called.
struct Names {
  std::string first, second;
};

/// second - first: its largest value, when it leaves the tolerance, and its values at some instants.
nlohmann::ordered_json difference_json(const TimeSeries& first, const TimeSeries& second, const Tolerance& tolerance,
                                       const Names& names, const std::vector<Instant>& instants);

}  // namespace rotordrop
