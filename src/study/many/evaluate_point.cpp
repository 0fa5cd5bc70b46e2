#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/drop_lanes.h"
#include "base/cpu_time.h"
#include "base/parameters/suggestion.h"
#include "case/built_machine.h"
#include "model/lane_system.h"
#include "study/drop/drop_run.h"
#include "study/result_limits.h"

namespace rotordrop {
namespace {

PointSeries series_of(const Machine& machine, const RecordedDrop& drop, const std::string& path) {
  if (drop.has(path)) {
    const auto& table = drop.table(path);
    const auto& meaning = table.meaning;
    return {path, meaning.unit, meaning.long_name, table.n_columns, drop.table(meaning.time_path).values, table.values};
  }
  std::vector<std::string> known = drop.datasets(), others = series_of(machine);
  known.insert(known.end(), others.begin(), others.end());
  throw InputError({"keep.series", 0, 0}, fmt::format("a drop of this case has no series {}.", path),
                   suggestion(path, known, "docs/reference/results.md lists them."));
}

MemoryRunOptions options_of(const PointRequest& request, BuiltMachine& built) {
  const Case& c = request.drop_case;
  MemoryRunOptions options;
  options.elements = &built.elements();
  options.is_stopped = [stop = request.stop] { return stop && *stop; };
  // What a case judges by itself may be of any part.
  const bool is_judged = !c.parameters.run.fatal_warnings.empty() || !c.parameters.limits.empty();
  options.parts = is_judged ? SummaryParts{} : request.parts;
  options.is_kept = [&request](const std::string& path) {
    return std::find(request.series.begin(), request.series.end(), path) != request.series.end();
  };
  return options;
}

PointResult result_of(const PointRequest& request, const Machine& machine, const FinishedDrop& run) {
  PointResult result;
  result.is_done = run.completed;
  result.is_interrupted = !run.completed;
  result.end_time = run.end_time;
  result.scalars = numbers_of(summary_json(run.summary));
  for (const auto& path : request.series) result.series.push_back(series_of(machine, *run.recorded, path));
  return result;
}

PointResult failed(const std::exception& error) {
  PointResult result;
  result.reason = error.what();
  return result;
}

PointResult run_alone(const PointRequest& request, BuiltMachine& built) {
  return result_of(request, built.machine(),
                   run_drop_in_memory(request.drop_case, built.machine(), options_of(request, built)));
}

/// A drop that runs in lanes.
struct LaneDrop {
  const PointRequest* request;
  std::unique_ptr<BuiltMachine> built;
  std::unique_ptr<MemoryDrop> run;
  double wall_time = 0, cpu_time = 0;  // its share of the lanes' times [s]
};

/// Whether two drops run side by side.
bool are_alike(const LaneDrop& a, const LaneDrop& b) {
  return are_alike(a.built->machine(), a.request->drop_case.parameters.integration, b.built->machine(),
                   b.request->drop_case.parameters.integration);
}

/// Points in lanes. Those that are not alike to the ones that run wait until these are over.
class PointsInLanes final : public LaneFeed {
 public:
  explicit PointsInLanes(PointFeed& feed) : feed_(feed) {}

  void run() {
    const auto is_stopped = [this] {
      const auto* stop = running_.empty() ? nullptr : running_.front().request->stop;
      return stop && *stop;
    };
    while (run_in_lanes(*this, is_stopped) > 0) start_clocks();
  }

  Drop* next() override {
    share_times();
    Drop* drop = begin_next();
    start_clocks();
    return drop;
  }

  void over(Drop& drop, const std::exception_ptr& failure) override {
    share_times();
    const auto found =
        std::find_if(running_.begin(), running_.end(), [&](const LaneDrop& one) { return &one.run->drop() == &drop; });
    feed_.done(*found->request, result_of_lane(*found, failure));
    running_.erase(found);
    start_clocks();
  }

 private:
  Drop* begin_next() {
    const auto fits = [this](const LaneDrop& one) { return running_.empty() || are_alike(running_.front(), one); };
    if (const auto found = std::find_if(waiting_.begin(), waiting_.end(), fits); found != waiting_.end()) {
      running_.splice(running_.end(), waiting_, found);
      return &running_.back().run->drop();
    }
    while (waiting_.size() < most_waiting) {
      const PointRequest* request = feed_.next(running_.empty());
      if (!request) return nullptr;
      take(*request);
      if (waiting_.empty() || waiting_.back().request != request || !fits(waiting_.back())) continue;
      running_.splice(running_.end(), waiting_, std::prev(waiting_.end()));
      return &running_.back().run->drop();
    }
    return nullptr;
  }

  /// Builds a point's drop, which then waits; one that does not run in lanes is run at once.
  void take(const PointRequest& request) {
    PointResult result;
    try {
      const Case& c = request.drop_case;
      auto built = std::make_unique<BuiltMachine>(c);
      const bool is_meshed = c.parameters.thermal.runs_sections();  // as choose_lanes() has it
      if (!is_meshed && why_not_in_lanes(built->machine(), c.parameters.integration).empty()) {
        auto run = std::make_unique<MemoryDrop>(c, built->machine(), options_of(request, *built));
        waiting_.push_back({&request, std::move(built), std::move(run)});
        return;
      }
      result = run_alone(request, *built);
    } catch (const std::exception& error) {
      result = failed(error);
    }
    feed_.done(request, std::move(result));
  }

  static PointResult result_of_lane(LaneDrop& one, const std::exception_ptr& failure) {
    try {
      if (failure) std::rethrow_exception(failure);
      return result_of(*one.request, one.built->machine(), one.run->finished(one.wall_time, one.cpu_time));
    } catch (const std::exception& error) {
      return failed(error);
    }
  }

  void start_clocks() {
    wall_ = std::chrono::steady_clock::now();
    cpu_ = thread_cpu_seconds();
  }
  /// Gives the time since start_clocks() to those that run.
  void share_times() {
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    const double cpu = thread_cpu_seconds() - cpu_;
    for (LaneDrop& one : running_) {
      one.wall_time += wall / static_cast<double>(running_.size());
      one.cpu_time += cpu / static_cast<double>(running_.size());
    }
  }

  static constexpr std::size_t most_waiting = 2 * LaneSystem::width;
  PointFeed& feed_;
  std::list<LaneDrop> running_, waiting_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = 0;
};

}  // namespace

PointResult evaluate_point(const PointRequest& request) {
  try {
    BuiltMachine built(request.drop_case);
    return run_alone(request, built);
  } catch (const std::exception& error) {
    return failed(error);
  }
}

void evaluate_in_lanes(PointFeed& feed) { PointsInLanes(feed).run(); }

}  // namespace rotordrop
