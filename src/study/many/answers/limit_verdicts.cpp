#include "study/many/answers/limit_verdicts.h"

#include <algorithm>

#include "study/limit_verdict.h"

namespace rotordrop {

LimitVerdicts::LimitVerdicts(const StudyTable& table, const std::vector<Limit>& limits)
    : table_(table), told_(table.n_points) {
  const auto is_told = [&](const std::string& name) {
    return tells_contact(name) || std::any_of(limits.begin(), limits.end(), [&](const Limit& limit) {
             return is_needed_for_verdict(name, limit.pattern);
           });
  };
  for (const auto& column : table.results)
    if (is_told(column.name))
      for (std::size_t k = 0; k < table.n_points; ++k)
        if (table.status[k] == PointStatus::done) told_[k].emplace_back(column.name, column.values[k]);
}

LimitBreak LimitVerdicts::breaks(const Limit& limit, std::size_t point) const {
  const ResultColumn* column = table_.find(limit.pattern);
  if (table_.status[point] == PointStatus::failed) return {{}, "the drop failed"};
  if (table_.status[point] == PointStatus::not_run) return {{}, "not run"};
  if (!column) return {{}, "no value"};
  LimitBreak found{false, ""};
  for (const bool is_max : {true, false}) {
    if (!(is_max ? limit.max : limit.min)) continue;
    const auto verdict = verdict_on(limit, is_max, column->values[point], told_[point]);
    if (verdict.is_kept == false) return {true, ""};
    if (!verdict.is_kept) found = {{}, verdict.why};
  }
  return found;
}

std::size_t LimitVerdicts::n_without_contact() const {
  return static_cast<std::size_t>(std::count_if(told_.begin(), told_.end(), is_without_contact));
}

}  // namespace rotordrop
