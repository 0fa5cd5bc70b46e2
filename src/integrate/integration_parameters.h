#pragma once
#include "base/parameters.h"

namespace rotordrop {

enum class IntegrationMethod { runge_kutta_4, dormand_prince, fehlberg_8, adams };

/// [integration].
struct IntegrationParameters {
  IntegrationMethod method = IntegrationMethod::runge_kutta_4;
  double step = 0;          ///< [s]
  double tolerance = 0;     ///< relative; absolute is this times each state's scale
  double maximum_step = 0;  ///< [s]
};
Section<IntegrationParameters> integration_section();

}  // namespace rotordrop
