#pragma once

namespace rotordrop {

/// What a summary tells from a drop's rows. Parts that nobody asks for take no time; warnings of them are left out with them.
struct SummaryParts {
  bool local_rub = true;  ///< local temperatures and wear of every rub: a third to a half of a drop's CPU time
  bool whirl = true;      ///< of rotor and ring; without both parts, rows of a drop in lanes are not evaluated
};

}  // namespace rotordrop
