#pragma once
#include <array>
#include <cmath>
#include <limits>

#include "analysis/watch/followed.h"
#include "model/run_warning.h"

namespace rotordrop {

/// How often, how far and for how long a quantity is above its limit, from instant to instant.
struct Exceedance {
  double count = 0;                                         ///< times that it rises above, one at the start included
  double worst = -std::numeric_limits<double>::infinity();  ///< largest value
  double time = never;                                      ///< of it [s]
  double first_time = never;                                ///< above [s]
  double duration = 0;                                      ///< between instants that are both above [s]
  /// Of what was watched, with its limit.
  [[nodiscard]] RunWarning as_warning(const WarningKind* kind, const std::string& place, const std::string& part,
                                      double limit) const {
    return {kind, place, part, static_cast<long>(count), worst, limit, time, first_time, duration};
  }
  /// @returns whether it is above now
  bool follow(double t, double value, double limit) {
    const bool is_above = value > limit;
    if (is_above) {
      if (was_above())
        duration += t - last_time_;
      else
        ++count;
      if (std::isnan(first_time)) first_time = t;
      if (value > worst) {
        worst = value;
        time = t;
      }
      last_time_ = t;
    }
    was_above_ = is_above ? 1. : 0.;
    return is_above;
  }
  /// At the last instant. Else one that is not above either changes nothing.
  [[nodiscard]] bool was_above() const { return was_above_ != 0.; }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() {
    return std::array{&count, &worst, &time, &first_time, &duration, &last_time_, &was_above_};
  }

 private:
  double last_time_ = never, was_above_ = 0.;
};

}  // namespace rotordrop
