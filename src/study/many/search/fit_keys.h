#pragma once
#include "base/parameters/section.h"
#include "study/compare/measured.h"

namespace rotordrop {

/// [fit]: parameters with a range become those at which the drop shows what was measured.
struct FitParameters {
  std::vector<MeasuredParameters> measured;
  int evaluations = 200;  ///< at most, of each search
  int searches = 1;
  double difference = 1e-3;  ///< of derivatives: part of each range
  double tolerance = 1e-5;   ///< part of each range
};
Section<FitParameters> fit_section();

/// [fit] with what was measured.
struct Fit {
  FitParameters keys;
  std::vector<Measured> measured;
};

}  // namespace rotordrop
