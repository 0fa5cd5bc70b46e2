#pragma once
#include <vector>

#include "analysis/facts/rotor_report.h"

namespace rotordrop {

/// A mode at one speed of a Campbell diagram.
struct CampbellPoint {
  double speed;           ///< [rad/s]
  const WhirlMode* mode;  ///< of the report
};
using CampbellLine = std::vector<CampbellPoint>;  ///< by rising speed

/// Modes of a diagram up to a frequency [Hz], joined from speed to speed, from the highest at the first speed downwards. Those of two neighbouring speeds are joined in their
/// order so that frequencies change least; where a motion begins to oscillate, or ceases to, a line begins or ends between the others. Lines end at the frequency, too.
[[nodiscard]] std::vector<CampbellLine> campbell_lines(const CriticalSpeedReport& report, double largest_frequency);

}  // namespace rotordrop
