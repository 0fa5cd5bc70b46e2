#pragma once
#include <string>
#include <vector>

#include "study/many/search/local_search.h"
#include "study/many/study_file.h"

namespace rotordrop {

/// Mean or quantile of the drops of one evaluation; NaN if one of them has no value. With a sample of one drop: its value.
/// @param is_lower  counts a quantile from the other end
double statistic_of(const MinimiseParameters& minimise, std::vector<double> values, bool is_lower = false);

/// What [minimise] and [limits] say about the drops of one evaluation.
/// @param values_of  values of a result in these drops, NaN where there is none
SearchValue judged(const Study& study, const std::function<std::vector<double>(const std::string& result)>& values_of);

/// Bounds of all limits: their number in SearchValue::constraints.
std::size_t n_constraints(const Study& study);

}  // namespace rotordrop
