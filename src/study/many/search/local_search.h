#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "study/many/search/minimise_keys.h"

namespace rotordrop {

/// What one evaluation of a search gives.
struct SearchValue {
  double value = 0;                 ///< what becomes small; NaN: the evaluation failed
  std::vector<double> constraints;  ///< by how much each limit is broken, over its size; <= 0: it is kept
};

/// One search by NLopt in the unit cube. It ends when its steps are small, its evaluations are used up, or it asked 10 000 times in a row for places
/// that it knows. Where a method ends outside a limit, what is left of its evaluations goes into steps back to the allowed side. The same input gives the same course: random numbers of the methods follow from the seed.
/// @param evaluate  of a place [n] that was not asked for before; what it throws ends the search and comes out
/// @param between   called where no place is evaluated; what it throws ends the search and comes out
/// @return          false if the method came back to known places only
bool search_minimum(const MinimiseParameters& settings, const std::vector<double>& start, std::size_t n_constraints,
                    std::uint64_t seed, const std::function<SearchValue(const std::vector<double>& place)>& evaluate,
                    const std::function<void()>& between = {});

}  // namespace rotordrop
