#include "study/report/rounded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace rotordrop {

using Json = nlohmann::ordered_json;

Json rounded(double value, int digits) {
  // Not std::stod, which throws for subnormal numbers.
  return std::isfinite(value) ? Json(std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr)) : Json();
}

Json rounded(std::span<const double> values, double scale, int digits) {
  Json list = Json::array();
  for (const double v : values) list.push_back(rounded(v * scale, digits));
  return list;
}

Json rounded_to_range(const std::vector<double>& values, double scale) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = (*high - *low) * std::fabs(scale);
  if (!(range > 0.)) return rounded(values, scale);
  const double quantum = std::pow(10., std::floor(std::log10(range)) - 4.);
  std::vector<double> list;
  for (const double v : values) list.push_back(std::round(v * scale / quantum) * quantum);
  return rounded(list, 1., 10);
}

}  // namespace rotordrop
