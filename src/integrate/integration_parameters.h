#pragma once
#include <optional>

#include "base/parameters/section.h"
#include "integrate/methods.h"

namespace rotordrop {

/// [integration].
struct IntegrationParameters {
  IntegrationMethod method = IntegrationMethod::tsitouras;
  std::optional<double> step;  ///< [s]: of the fixed-step method, or the longest of the others
  double tolerance = 0;        ///< relative; absolute is this times each state's scale
  double exponential_above =
      20e3;  ///< systems with an oscillator above this have all of them integrated by exponentials [Hz]
};
Section<IntegrationParameters> integration_section();

/// The step of the fixed-step method, or the longest step of an error-controlled one: as given, else 5 us or 50 us. [s]
double step_or_bound(const IntegrationParameters& parameters);

}  // namespace rotordrop
