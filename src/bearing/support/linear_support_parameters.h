#pragma once
#include "base/parameters/section.h"
#include "bearing/support/linear_support.h"

namespace rotordrop {

constexpr double stiffest_support = 1e12;  ///< usual [N/m]

/// bearings.NAME with type = "linear".
struct LinearSupportParameters {
  int node = 0;
  LinearSupport::Matrix stiffness{}, damping{};
};
Section<LinearSupportParameters> linear_support_section();

}  // namespace rotordrop
