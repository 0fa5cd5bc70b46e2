#pragma once
#include <string>
#include <vector>

#include "base/node.h"
#include "base/parameters/section.h"

namespace rotordrop {

enum class SurrogateKind { polynomial_chaos, kriging };

/// [surrogate]: functions that stand for results, with their validation.
struct SurrogateParameters {
  Node results;  ///< names; a list of texts
  SurrogateKind kind = SurrogateKind::polynomial_chaos;
  int degree = 6;
  int folds = 5;
};
Section<SurrogateParameters> surrogate_section();

}  // namespace rotordrop
