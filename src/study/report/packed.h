#pragma once

// Many numbers as text of few characters, for the page's script.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace rotordrop {

/// Base64 (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);
/// Values to 1/65535 of their range: {low, high, levels}, levels as base64 of unsigned 16-bit numbers, the lower byte first.
/// value = low + (high - low) level / 65535. @param values  finite
nlohmann::ordered_json packed(std::span<const double> values, double scale);
/// Base64 of 32-bit floating-point numbers (IEEE 754), the lowest byte first.
std::string packed_floats(std::span<const double> values, double scale);

}  // namespace rotordrop
