#pragma once
#include <algorithm>
#include <array>
#include <vector>

namespace rotordrop {

/// Value of a table of pairs [argument, value] with rising arguments, at least one: straight lines between them, constant outside.
inline double table_value(const std::vector<std::array<double, 2>>& table, double x) {
  const auto after = std::upper_bound(table.begin(), table.end(), x,
                                      [](double a, const std::array<double, 2>& p) { return a < p[0]; });
  if (after == table.begin()) return table.front()[1];
  if (after == table.end()) return table.back()[1];
  const auto& low = *(after - 1);
  return low[1] + (x - low[0]) * ((*after)[1] - low[1]) / ((*after)[0] - low[0]);
}

}  // namespace rotordrop
