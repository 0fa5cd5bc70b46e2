#pragma once
#include <csignal>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "case/case.h"
#include "study/drop/summary_parts.h"

namespace rotordrop {

/// One time series of a drop.
struct PointSeries {
  std::string path, unit, long_name;
  std::size_t width = 1;       ///< values per instant
  std::vector<double> time;    ///< [s]
  std::vector<double> values;  ///< [time, width]
};

/// What is left of one drop.
struct PointResult {
  bool is_done = false;         ///< it came to its end
  bool is_interrupted = false;  ///< stopped from outside: nothing of it counts
  std::string reason;           ///< why it is not done
  std::vector<std::pair<std::string, double>>
      scalars;  ///< numbers of summary.json by their dotted names, SI; NaN: has not happened
  std::vector<PointSeries> series;
  double end_time = 0;     ///< simulated [s]
  std::vector<double> at;  ///< of a search: values of the parameters that it changes, SI
};

struct PointRequest {
  const Case& drop_case;
  const volatile std::sig_atomic_t* stop = nullptr;
  std::vector<std::string> series;  ///< datasets to keep
  SummaryParts parts;               ///< that are asked for
};

/// Runs one drop of a study. Never throws for what is wrong with the drop: that is the result's reason.
PointResult evaluate_point(const PointRequest& request);

/// Runs several drops of a study, side by side in lanes where they are alike; those that do not run in lanes one by one. A drop's result does not
/// depend on those that it is handed over with.
std::vector<PointResult> evaluate_together(std::span<const PointRequest> requests);

using Evaluator = std::function<PointResult(const PointRequest&)>;

}  // namespace rotordrop
