#include "study/many/search/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/many/answers/statistics.h"

namespace rotordrop {
namespace {

double excess(double value, double bound) { return (value - bound) / (bound != 0. ? std::fabs(bound) : 1.); }

}  // namespace

double statistic_of(const MinimiseParameters& minimise, std::vector<double> values, bool is_lower) {
  if (values.empty() || std::any_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }))
    return std::numeric_limits<double>::quiet_NaN();
  if (minimise.of == DropStatistic::mean) return mean_of(values);
  std::sort(values.begin(), values.end());
  return quantile_of(values, is_lower ? 1. - minimise.quantile : minimise.quantile);
}

SearchValue judged(const Study& study, const std::function<std::vector<double>(const std::string& result)>& values_of) {
  const auto& minimise = *study.minimise;
  SearchValue found{statistic_of(minimise, values_of(minimise.result)), {}};
  for (const auto& limit : study.limits) {
    const auto values = values_of(limit.pattern);
    if (limit.max) found.constraints.push_back(excess(statistic_of(minimise, values), *limit.max));
    if (limit.min) found.constraints.push_back(-excess(statistic_of(minimise, values, true), *limit.min));
  }
  // A limit on what has not happened, such as a second contact, cannot be judged: the evaluation counts as failed.
  for (const double c : found.constraints)
    if (!std::isfinite(c)) found.value = std::numeric_limits<double>::quiet_NaN();
  return found;
}

std::size_t n_constraints(const Study& study) {
  std::size_t n = 0;
  for (const auto& limit : study.limits) n += static_cast<std::size_t>(limit.max.has_value()) + limit.min.has_value();
  return n;
}

}  // namespace rotordrop
