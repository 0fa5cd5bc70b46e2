#include "study/many/answers/limit_verdicts.h"

#include <algorithm>
#include <cmath>

#include "study/result_limits.h"

namespace rotordrop {

LimitVerdicts::LimitVerdicts(const StudyTable& table) : table_(table), told_(table.n_points) {
  for (const auto& column : table.results)
    if (tells_contact(column.name) || tells_truncation(column.name))
      for (std::size_t k = 0; k < table.n_points; ++k)
        if (table.status[k] == PointStatus::done) told_[k].emplace_back(column.name, column.values[k]);
}

std::optional<bool> LimitVerdicts::breaks(const Limit& limit, std::size_t point) const {
  const ResultColumn* column = table_.find(limit.pattern);
  if (!column || table_.status[point] != PointStatus::done) return {};
  const double value = column->values[point];
  const auto& told = told_[point];
  if (!std::isfinite(value) || is_without_contact(told)) return {};
  bool is_certain = true;
  for (const bool is_max : {true, false}) {
    if (!(is_max ? limit.max : limit.min)) continue;
    const auto is_kept = keeps(limit, is_max, value, is_void(limit.pattern, told));
    if (is_kept == false) return true;
    is_certain = is_certain && is_kept;
  }
  return is_certain ? std::optional(false) : std::nullopt;
}

std::size_t LimitVerdicts::n_without_contact() const {
  return static_cast<std::size_t>(std::count_if(told_.begin(), told_.end(), is_without_contact));
}

}  // namespace rotordrop
