#pragma once
#include "base/parameters/section.h"
#include "bearing/support/linear_support.h"

namespace rotordrop {

/// bearings.NAME with type = "linear".
struct LinearSupportParameters {
  int node = 0;
  LinearSupport::Matrix stiffness{}, damping{};
};
Section<LinearSupportParameters> linear_support_section();

}  // namespace rotordrop
