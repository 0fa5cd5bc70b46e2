#pragma once
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace rotordrop {

/// JSON has no NaN and no infinity: what has not happened, or has no bound, is null.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : nlohmann::ordered_json(nullptr);
}

/// A number of a JSON object by its path, NaN if it is not there or null.
inline double number_at(const nlohmann::ordered_json& j, const std::string& pointer) {
  const nlohmann::ordered_json::json_pointer p(pointer);
  if (j.is_null() || !j.contains(p) || !j.at(p).is_number()) return std::numeric_limits<double>::quiet_NaN();
  return j.at(p).get<double>();
}

}  // namespace rotordrop
