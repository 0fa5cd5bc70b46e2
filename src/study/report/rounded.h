#pragma once

// Numbers as pictures need them: short.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace rotordrop {

/// Null if it is not finite.
nlohmann::ordered_json rounded(double value, int digits);
/// Five digits are more than a picture shows; times get one more, since they grow while their differences do not. Values that are not finite
/// become null.
nlohmann::ordered_json rounded(std::span<const double> values, double scale, int digits = 5);
/// To a hundred-thousandth of their range, which may be small beside the values themselves (an air gap).
nlohmann::ordered_json rounded_to_range(const std::vector<double>& values, double scale);

}  // namespace rotordrop
