#pragma once
#include <cstddef>
#include <string_view>

namespace rotordrop {

/// Where the first letter begins that is no UTF-8; npos if all is.
[[nodiscard]] inline std::size_t first_not_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : static_cast<unsigned char>(0);
    };
    const unsigned char c = byte(0);
    const std::size_t more = c < 0x80u ? 0 : c >= 0xf0u ? 3 : c >= 0xe0u ? 2 : 1;
    // Numbers written with more bytes than they need, surrogates and what is beyond the last letter are none.
    const unsigned char least = c == 0xe0u ? 0xa0u : c == 0xf0u ? 0x90u : 0x80u;
    const unsigned char most = c == 0xedu ? 0x9fu : c == 0xf4u ? 0x8fu : 0xbfu;
    if ((c >= 0x80u && c < 0xc2u) || c > 0xf4u || (more > 0 && (byte(1) < least || byte(1) > most))) return i;
    for (std::size_t k = 2; k <= more; ++k)
      if ((byte(k) & 0xc0u) != 0x80u) return i;
    i += more + 1;
  }
  return std::string_view::npos;
}

[[nodiscard]] inline bool is_utf8(std::string_view text) { return first_not_utf8(text) == std::string_view::npos; }

}  // namespace rotordrop
