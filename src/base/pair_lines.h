#pragma once
#include <cstddef>

namespace rotordrop {

/// Two lines of a table of pairs of numbers, one behind the other, and what each of them weighs.
struct PairLines {
  const float* first;     ///< [entry][2]
  std::ptrdiff_t length;  ///< from a line to the next, in numbers
  float weight[2];
  [[nodiscard]] const PairLines& of_lane(int) const { return *this; }
};
/// Some of each lane.
template <int lanes>
struct PairLinesOf {
  PairLines lane[lanes];
  [[nodiscard]] const PairLines& of_lane(int l) const { return lane[l]; }
};

}  // namespace rotordrop
