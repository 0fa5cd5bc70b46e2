#pragma once
#include <csignal>
#include <functional>
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

/// Where points that run in lanes come from, and where their results go.
class PointFeed {
 public:
  PointFeed() = default;
  PointFeed(const PointFeed&) = delete;
  PointFeed& operator=(const PointFeed&) = delete;
  virtual ~PointFeed() = default;
  /// A point to begin, which stays until it is done(); null: there is none now. @param may_wait  for one that comes later
  virtual const PointRequest* next(bool may_wait) = 0;
  virtual void done(const PointRequest& request, PointResult result) = 0;
};

/// Runs the drops of a feed until it has no more, side by side in lanes where they are alike; those that do not run in lanes one by one. A drop's result
/// does not depend on those beside it.
void evaluate_in_lanes(PointFeed& feed);

using Evaluator = std::function<PointResult(const PointRequest&)>;

}  // namespace rotordrop
