#include "study/report/packed.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rotordrop {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? letters[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

nlohmann::ordered_json packed(std::span<const double> values, double scale) {
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  const double low = std::min(*smallest * scale, *largest * scale),
               high = std::max(*smallest * scale, *largest * scale);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const double v : values) {
    const double part = high > low ? (v * scale - low) / (high - low) : 0.;
    const auto level = static_cast<std::uint16_t>(std::lround(65535. * std::clamp(part, 0., 1.)));
    bytes.push_back(static_cast<std::uint8_t>(level & 255u));
    bytes.push_back(static_cast<std::uint8_t>(level >> 8));
  }
  return {{"low", low}, {"high", high}, {"levels", base64(bytes)}};
}

std::string packed_floats(std::span<const double> values, double scale) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (const double v : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(v * scale));
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift & 255u));
  }
  return base64(bytes);
}

}  // namespace rotordrop
