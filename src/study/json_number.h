#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace rotordrop {

/// JSON has no NaN and no infinity: what has not happened, or has no bound, is null.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace rotordrop
