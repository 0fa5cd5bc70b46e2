#pragma once
#include <utility>

namespace rotordrop {

/// Point between two others at which a distance is least, or no longer above 0, by golden section.
/// @param at        makes the point in a place
/// @param place     of a point
/// @param distance  of a point, with one least value between low and high
/// @param width     of the rest at which the search ends
template <class At, class Place, class Distance>
auto turning_point(At&& at, Place&& place, Distance&& distance, double low, double high, double width) {
  constexpr double golden = 0.3819660112501051;
  auto a = at(low + golden * (high - low)), b = at(high - golden * (high - low));
  while (distance(a) > 0. && distance(b) > 0. && high - low > width) {
    if (distance(a) < distance(b)) {
      high = place(b);
      b = a;
      a = at(low + golden * (high - low));
    } else {
      low = place(a);
      a = b;
      b = at(high - golden * (high - low));
    }
  }
  return distance(a) < distance(b) ? std::move(a) : std::move(b);
}

}  // namespace rotordrop
