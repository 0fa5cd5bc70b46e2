#include "study/many/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "base/cpu_time.h"
#include "io/results_folder.h"
#include "model/lane_system.h"
#include "study/many/answers/result_check.h"
#include "study/many/answers/study_summary.h"
#include "study/many/journal.h"
#include "study/many/ranks/shared_points.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/study_folder.h"
#include "study/many/study_table.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

PointResult evaluated(const Study& study, const std::vector<std::string>& overrides, const StudyOptions& options) {
  try {
    const Case c = study.cases->read(overrides);
    return options.evaluate({c, options.stop, series_of_study(study), study.parts});
  } catch (const InputError& error) {
    PointResult result;
    result.reason = error.what();
    return result;
  }
}

/// What a study makes of a drop's result: tried once more if it failed and the study says so, with derived results, without what is not kept.
PointResult completed(const Study& study, const StudyPoint& point, const StudyOptions& options, PointResult result) {
  if (!result.is_interrupted && !result.is_done && study.on_failure == FailurePolicy::retry &&
      !(options.stop && *options.stop)) {
    const std::string reason = result.reason;
    result = evaluated(study, overrides_of_second_try(study, point), options);
    result.reason = result.is_done ? "done in a second try with a tenth of the tolerance; the first one: " + reason
                                   : "failed twice, the second time with a tenth of the tolerance: " + result.reason;
  }
  if (result.is_interrupted) return result;
  show_measured(study, result);
  complete_results(study, result);
  return result;
}

/// Runs points on several threads and follows them.
class StudyRun {
 public:
  StudyRun(const Study& study, const Design& design, const StudyOptions& options, Journal& journal, PointSource& points,
           StudyProgress start)
      : study_(study),
        design_(design),
        options_(options),
        journal_(journal),
        points_(points),
        progress_(std::move(start)),
        first_done_(progress_.done + progress_.failed) {}

  void run(unsigned n, StudyOutcome& outcome) {
    start_ = Clock::now();
    std::vector<double> finished(n, 0.);
    {
      std::vector<std::jthread> pool;
      for (unsigned k = 0; k < n; ++k)
        pool.emplace_back([this, k, &finished] {
          work();
          finished[k] = seconds_since(start_);
          const std::scoped_lock lock(lock_);
          ++n_ended_;
          ended_.notify_all();
        });
      follow(n);
    }
    if (error_) std::rethrow_exception(error_);
    outcome.wall_time = seconds_since(start_);
    for (const double t : finished)
      outcome.idle_share += (outcome.wall_time - t) / (n * std::max(outcome.wall_time, 1e-9));
    outcome.is_stopped = is_stopped_by_failure_;
  }

 private:
  [[nodiscard]] bool is_over() const {
    return is_stopped_by_failure_ || has_error_ || (options_.stop && *options_.stop);
  }

  void follow(unsigned n) {
    const std::chrono::milliseconds interval(points_.serving_interval());
    auto told = Clock::now();
    for (bool is_ended = false; !is_ended || !points_.is_complete();) {
      points_.serve(is_over());
      std::unique_lock lock(lock_);
      is_ended = ended_.wait_for(lock, interval, [&] { return n_ended_ == n; });
      if (is_ended && !points_.is_complete()) {
        lock.unlock();
        std::this_thread::sleep_for(interval);
        lock.lock();
      }
      if (!options_.report || Clock::now() - told < std::chrono::milliseconds(200)) continue;
      told = Clock::now();
      const StudyProgress now = progress();
      lock.unlock();  // however long the telling takes, workers go on
      options_.report(now);
    }
    if (options_.report) options_.report(progress());
  }

  [[nodiscard]] StudyProgress progress() const {
    StudyProgress p = progress_;
    const auto elsewhere = points_.elsewhere();
    p.done += elsewhere.done;
    p.failed += elsewhere.failed;
    const double now = seconds_since(start_);
    const auto here = static_cast<double>(p.done + p.failed - first_done_);
    p.per_second = here / std::max(now, 1e-9);
    p.time_left = here > 0. ? static_cast<double>(p.total - p.done - p.failed) / p.per_second
                            : std::numeric_limits<double>::quiet_NaN();
    return p;
  }

  void work() {
    try {
      if (study_.lanes) {
        WorkerFeed feed(*this);
        return evaluate_in_lanes(feed);
      }
      while (!is_over()) {
        const auto point = points_.next();
        if (!point) break;
        compute(*point);
      }
    } catch (...) {
      const std::scoped_lock lock(lock_);
      if (!error_) error_ = std::current_exception();
      has_error_ = true;
    }
  }

  void compute(std::size_t index) {
    const double cpu = thread_cpu_seconds();
    const PointResult result = run_point(study_, point_of(study_, design_, index), options_);
    take(index, result, thread_cpu_seconds() - cpu);
  }

  /// The points of one worker that computes them in lanes.
  class WorkerFeed final : public PointFeed {
   public:
    explicit WorkerFeed(StudyRun& run) : run_(run), first_share_(run.points_.first_share(LaneSystem::width)) {}

    const PointRequest* next(bool may_wait) override {
      while (!run_.is_over() && (n_taken_ < first_share_ || is_any_done_)) {
        const auto index = may_wait ? run_.points_.next() : run_.points_.next_at_hand();
        if (!index) break;
        ++n_taken_;
        if (const PointRequest* request = begin(*index)) return request;
      }
      return nullptr;
    }

    void done(const PointRequest& request, PointResult result) override {
      const auto found =
          std::find_if(begun_.begin(), begun_.end(), [&](const Begun& one) { return &one.request == &request; });
      finish(found->index, completed(run_.study_, found->point, run_.options_, std::move(result)));
      begun_.erase(found);
    }

   private:
    struct Begun {
      std::size_t index;
      StudyPoint point;
      Case drop_case;
      PointRequest request;
      Begun(std::size_t i, StudyPoint p, Case c, const StudyRun& run)
          : index(i),
            point(std::move(p)),
            drop_case(std::move(c)),
            request{drop_case, run.options_.stop, series_of_study(run.study_), run.study_.parts} {}
    };

    /// A point whose case is wrong is done at once.
    const PointRequest* begin(std::size_t index) {
      StudyPoint point = point_of(run_.study_, run_.design_, index);
      try {
        Case c = run_.study_.cases->read(overrides_of(run_.study_, point));
        return &begun_.emplace_back(index, std::move(point), std::move(c), run_).request;
      } catch (const InputError& error) {
        PointResult result;
        result.reason = error.what();
        finish(index, completed(run_.study_, point, run_.options_, std::move(result)));
        return nullptr;
      }
    }

    void finish(std::size_t index, const PointResult& result) {
      const double cpu = thread_cpu_seconds();
      run_.take(index, result, cpu - std::exchange(cpu_, cpu));
      is_any_done_ = true;
    }

    StudyRun& run_;
    std::size_t first_share_, n_taken_ = 0;
    bool is_any_done_ = false;
    double cpu_ = thread_cpu_seconds();
    std::list<Begun> begun_;
  };

  void take(std::size_t index, const PointResult& result, double cpu) {
    if (result.is_interrupted) return;
    journal_.append(index, result, cpu);
    points_.finished(index, result.is_done);
    const std::scoped_lock lock(lock_);
    ++(result.is_done ? progress_.done : progress_.failed);
    for (const auto& [name, value] : result.scalars)
      if (name == progress_.best_name && !(progress_.best <= value)) progress_.best = value;
    if (!result.is_done && study_.on_failure == FailurePolicy::stop) is_stopped_by_failure_ = true;
  }

  const Study& study_;
  const Design& design_;
  const StudyOptions& options_;
  Journal& journal_;
  PointSource& points_;
  StudyProgress progress_;
  std::size_t first_done_;
  std::atomic<bool> is_stopped_by_failure_{false}, has_error_{false};
  std::exception_ptr error_;
  mutable std::mutex lock_;
  std::condition_variable ended_;
  unsigned n_ended_ = 0;
  Clock::time_point start_;
};

std::string name_of_best(const Study& study) {
  if (study.choice) return study.choice->result;
  for (const auto& limit : study.limits)
    if (limit.max) return limit.pattern;
  return study.derived.empty() ? "" : study.derived.front().name;
}

/// Writes the results of a study whose drops are all finished. @return false if the making of its surrogates was stopped from outside
bool write_unless_stopped(const Study& study, const Design& design, const StudyTable& table, const std::string& digest,
                          const StudyOptions& options) {
  StudyProgress p;
  p.done = table.count(PointStatus::done);
  p.failed = table.count(PointStatus::failed);
  p.total = table.n_points;
  const SummaryWatch watch{options.stop, [&](const std::string& what) {
                             p.making = what;
                             if (options.report) options.report(p);
                           }};
  try {
    write_results(options.directory, study, design, table, digest, watch);
  } catch (const SummaryStopped&) {
    return false;
  }
  return true;
}

}  // namespace

PointResult run_point(const Study& study, const StudyPoint& point, const StudyOptions& options) {
  return completed(study, point, options, evaluated(study, overrides_of(study, point), options));
}

std::vector<std::string> overrides_of(const Study& study, const StudyPoint& point) {
  auto overrides = study.set;
  overrides.insert(overrides.end(), point.overrides.begin(), point.overrides.end());
  return overrides;
}

std::vector<std::string> overrides_of_second_try(const Study& study, const StudyPoint& point) {
  auto overrides = overrides_of(study, point);
  const auto integration = study.cases->read(overrides).parameters.integration;
  overrides.push_back(fmt::format("integration.tolerance={}", std::max(1e-13, 0.1 * integration.tolerance)));
  overrides.push_back(fmt::format("integration.step={}", std::max(1e-9, 0.1 * step_or_bound(integration))));
  return overrides;
}

unsigned workers_of(unsigned asked, std::size_t n_tasks) {
  const unsigned n = asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::clamp<std::size_t>(n, 1, std::max<std::size_t>(n_tasks, 1)));
}

void complete_results(const Study& study, PointResult& result) {
  if (!result.is_done) {
    result.scalars.clear();
    result.series.clear();
    return;
  }
  const std::size_t n_own = result.scalars.size();
  for (const auto& derived : study.derived) {
    std::vector<double> values;
    for (const auto& name : derived.formula.names()) {
      const auto found =
          std::find_if(result.scalars.begin(), result.scalars.end(), [&](const auto& s) { return s.first == name; });
      values.push_back(found == result.scalars.end() ? std::numeric_limits<double>::quiet_NaN() : found->second);
    }
    result.scalars.emplace_back(derived.name, derived.formula.value(values));
  }
  for (std::size_t i = 0; i < n_own; ++i)
    for (const auto& derived : study.derived)
      if (derived.name == result.scalars[i].first) result.scalars[i].first.clear();  // a derived result replaces it
  std::erase_if(result.scalars, [&](const auto& s) { return s.first.empty() || !is_kept(study, s.first); });
}

StudyOutcome run_study(const Study& study, const Design& design, const StudyOptions& options) {
  const ResultsFolder folder(options.directory, ResultsFolder::existing_results(options.resume, options.force),
                             ResultsFolder::Results::of_study);
  const std::string digest = digest_of(study, design);
  const std::string header = journal_header(study, digest, options.shard, options.n_shards);
  const fs::path file = options.directory / "study.journal";
  auto earlier = earlier_points(study, options, header);

  StudyOutcome outcome;
  outcome.n_points = n_points(study, design);
  std::vector<std::size_t> waiting;
  StudyProgress start;
  for (std::size_t i = options.shard - 1; i < outcome.n_points; i += options.n_shards) {
    ++start.total;
    const auto found = earlier ? earlier->records.find(i) : decltype(earlier->records.end()){};
    if (earlier && found != earlier->records.end())
      ++(found->second.is_done ? start.done : start.failed);
    else
      waiting.push_back(i);
  }
  start.best_name = name_of_best(study);
  start.best = std::numeric_limits<double>::quiet_NaN();
  {
    std::optional<Journal> journal;
    if (earlier)
      journal.emplace(file, *earlier);
    else
      journal.emplace(file, header);
    const unsigned n_workers = workers_of(options.n_workers, waiting.size());
    if (options.ranks) {
      options.ranks->begin(true);
      SharedPoints points(std::move(waiting), *options.ranks, study.on_failure == FailurePolicy::stop, options.tell);
      StudyRun(study, design, options, *journal, points, start).run(n_workers, outcome);
      outcome.is_anyone_lost = points.is_anyone_lost();
      outcome.is_stopped |= points.is_stopped_by_failure();
    } else if (!waiting.empty()) {
      LocalPoints points(std::move(waiting), n_workers);
      StudyRun(study, design, options, *journal, points, start).run(n_workers, outcome);
    }
    journal->sync();
  }
  folder.require_there();
  if (options.ranks) take_journals_of_ranks(options.directory, header);
  const auto content = Journal::read(file);
  const StudyTable table = make_table(study, design, content.records, content.layouts);
  outcome.done = table.count(PointStatus::done);
  outcome.failed = table.count(PointStatus::failed);
  outcome.missing = table.count(PointStatus::not_run);
  outcome.cpu_time = table.cpu_time;
  outcome.is_complete = outcome.done + outcome.failed == start.total;
  if (outcome.is_complete && options.n_shards == 1)
    outcome.is_complete = write_unless_stopped(study, design, table, digest, options);
  else if (outcome.is_complete)
    write_shard_hdf5(options.directory / "shard.h5", study, design, table, digest, options.shard, options.n_shards);
  folder.require_there();
  return outcome;
}

StudyOutcome run_as_rank(const Study& study, const Design& design, const StudyOptions& options) {
  StudyOutcome outcome;
  outcome.is_complete = !options.ranks->begin(true);  // rank 0 then says why nothing is begun
  if (outcome.is_complete) return outcome;
  const std::string header = journal_header(study, digest_of(study, design), options.shard, options.n_shards);
  const unsigned n_workers = workers_of(options.n_workers, n_points(study, design));
  GivenPoints points(*options.ranks, n_workers * (study.lanes ? static_cast<unsigned>(LaneSystem::width) : 1U));
  {
    Journal journal(journal_of_rank(options.directory, options.ranks->rank()), header);
    StudyRun(study, design, options, journal, points, {}).run(n_workers, outcome);
    journal.sync();
  }
  outcome.is_anyone_lost = points.is_rank_0_lost();
  if (!outcome.is_anyone_lost) points.say_bye();
  outcome.is_complete = !(options.stop && *options.stop) && !outcome.is_stopped && !outcome.is_anyone_lost;
  return outcome;
}

}  // namespace rotordrop
