#pragma once
#include <fmt/format.h>

#include <string>

namespace rotordrop {

/// "300 ms", from ten seconds on "114.582 s". @param time  [s]
inline std::string in_time(double time) {
  constexpr double long_time = 10.;  // [s]
  return time < long_time ? fmt::format("{:.6g} ms", time * 1e3) : fmt::format("{:.6g} s", time);
}

}  // namespace rotordrop
