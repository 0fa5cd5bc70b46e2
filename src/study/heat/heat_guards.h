#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/exceedance.h"
#include "model/run_warning.h"
#include "study/heat/bearing_heat_case.h"

namespace rotordrop {

/// Watches whether means of a heated bearing's parts exceed what their materials stand (temperature_limit), from instant to instant.
class HeatGuards {
 public:
  explicit HeatGuards(const BearingHeatCase& heat_case);

  /// @param temperatures  of a model's names [K]
  void look(std::size_t model, double time, std::span<const double> temperatures);
  [[nodiscard]] std::vector<RunWarning> found() const;

 private:
  struct Guard {
    std::size_t model = 0, name = 0;
    std::string part;
    double limit = 0;  ///< [K]
    Exceedance seen = {};
  };
  std::string bearing_;
  std::vector<Guard> guards_;
};

}  // namespace rotordrop
