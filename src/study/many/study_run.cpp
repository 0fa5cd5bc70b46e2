#include "study/many/study_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "base/cpu_time.h"
#include "io/results_folder.h"
#include "study/many/answers/result_check.h"
#include "study/many/answers/study_summary.h"
#include "study/many/journal.h"
#include "study/many/study_folder.h"
#include "study/many/study_table.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Second try of a failed drop.
std::vector<std::string> with_smaller_step(const Case& c, std::vector<std::string> overrides) {
  const auto& integration = c.parameters.integration;
  overrides.push_back(fmt::format("integration.tolerance={}", std::max(1e-13, 0.1 * integration.tolerance)));
  overrides.push_back(fmt::format("integration.step={}", std::max(1e-9, 0.1 * step_or_bound(integration))));
  return overrides;
}

std::vector<std::string> overrides_of(const Study& study, const StudyPoint& point) {
  auto overrides = study.set;
  overrides.insert(overrides.end(), point.overrides.begin(), point.overrides.end());
  return overrides;
}

PointResult evaluated(const Study& study, const std::vector<std::string>& overrides, const StudyOptions& options) {
  try {
    const Case c = read_case(study.case_file, overrides);
    return options.evaluate({c, options.stop, study.keep_series});
  } catch (const InputError& error) {
    PointResult result;
    result.reason = error.what();
    return result;
  }
}

/// Runs points on several threads and follows them.
class StudyRun {
 public:
  StudyRun(const Study& study, const Design& design, const StudyOptions& options, Journal& journal,
           std::vector<std::size_t> waiting, StudyProgress start)
      : study_(study),
        design_(design),
        options_(options),
        journal_(journal),
        waiting_(std::move(waiting)),
        progress_(std::move(start)),
        first_done_(progress_.done + progress_.failed) {}

  void run(StudyOutcome& outcome) {
    const unsigned n = workers_of(options_.n_workers, waiting_.size());
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
    std::unique_lock lock(lock_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(200), [&] { return n_ended_ == n; }))
      if (options_.report) options_.report(progress());
    if (options_.report) options_.report(progress());
  }

  [[nodiscard]] StudyProgress progress() const {
    StudyProgress p = progress_;
    const double now = seconds_since(start_);
    const auto here = static_cast<double>(p.done + p.failed - first_done_);
    p.per_second = here / std::max(now, 1e-9);
    p.time_left = here > 0. ? static_cast<double>(p.total - p.done - p.failed) / p.per_second
                            : std::numeric_limits<double>::quiet_NaN();
    return p;
  }

  void work() {
    try {
      for (std::size_t i; !is_over() && (i = next_.fetch_add(1)) < waiting_.size();) compute(waiting_[i]);
    } catch (...) {
      const std::scoped_lock lock(lock_);
      if (!error_) error_ = std::current_exception();
      has_error_ = true;
    }
  }

  void compute(std::size_t index) {
    const double cpu = thread_cpu_seconds();
    const PointResult result = run_point(study_, point_of(study_, design_, index), options_);
    if (result.is_interrupted) return;
    journal_.append(index, result, thread_cpu_seconds() - cpu);
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
  std::vector<std::size_t> waiting_;
  StudyProgress progress_;
  std::size_t first_done_;
  std::atomic<std::size_t> next_{0};
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

std::string named(const Study& study, const StudyPoint& point) {
  std::string text;
  for (std::size_t i = 0; i < study.parameters.size() && i < 6; ++i)
    text += fmt::format("{}{} = {}", i ? ", " : "", study.parameters[i].name, to_text(point.values[i]));
  return text;
}

}  // namespace

PointResult run_point(const Study& study, const StudyPoint& point, const StudyOptions& options) {
  const auto overrides = overrides_of(study, point);
  PointResult result = evaluated(study, overrides, options);
  if (!result.is_interrupted && !result.is_done && study.on_failure == FailurePolicy::retry &&
      !(options.stop && *options.stop)) {
    const std::string reason = result.reason;
    const Case c = read_case(study.case_file, overrides);
    result = evaluated(study, with_smaller_step(c, overrides), options);
    result.reason = result.is_done ? "done in a second try with a tenth of the tolerance; the first one: " + reason
                                   : "failed twice, the second time with a tenth of the tolerance: " + result.reason;
  }
  if (!result.is_interrupted) complete_results(study, result);
  return result;
}

unsigned workers_of(unsigned asked, std::size_t n_tasks) {
  const unsigned n = asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::clamp<std::size_t>(n, 1, std::max<std::size_t>(n_tasks, 1)));
}

void check_points(const Study& study, const Design& design, unsigned n_workers) {
  const std::size_t n = n_points(study, design);
  constexpr std::size_t n_told = 5;
  std::atomic<std::size_t> next{0}, n_bad{0};
  std::mutex lock;
  std::map<std::size_t, InputError> bad;
  const auto check = [&] {
    for (std::size_t i; n_bad < 100 && (i = next.fetch_add(1)) < n;) {
      try {
        read_case(study.case_file, overrides_of(study, point_of(study, design, i)));
      } catch (const InputError& error) {
        ++n_bad;
        const std::scoped_lock guard(lock);
        bad.emplace(i, error);
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    for (unsigned k = 0; k < workers_of(n_workers, n); ++k) pool.emplace_back(check);
  }
  if (bad.empty()) return;
  Faults faults;
  std::size_t told = 0;
  for (const auto& [i, error] : bad) {
    if (told++ == n_told) break;
    const StudyPoint point = point_of(study, design, i);
    for (const auto& fault : error.faults())
      faults.add({study.file.string(), 0, 0}, fmt::format("point {} is no valid case: {}", i, fault.message),
                 fmt::format("There {}.{}{}", named(study, point), fault.advice.empty() ? "" : "\n", fault.advice));
  }
  if (bad.size() > n_told)
    faults.add(
        {study.file.string(), 0, 0},
        fmt::format("{}{} further points are no valid cases.", n_bad >= 100 ? "at least " : "", bad.size() - n_told),
        "Narrow the ranges. A normal distribution reaches any value; \"truncated-normal\" has ends.");
  faults.throw_if_any();
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

ProbedResults probe_results(Study& study, const Design& design, const Evaluator& evaluate) {
  const Case c = read_case(study.case_file, overrides_of(study, point_of(study, design, 0)));
  const volatile std::sig_atomic_t at_once = 1;
  PointResult result = evaluate({c, &at_once, study.keep_series});
  if (result.scalars.empty())
    throw InputError({study.file.string(), 0, 0}, "the first point cannot even begin: " + result.reason);
  std::vector<std::string> names;
  for (const auto& scalar : result.scalars) names.push_back(scalar.first);
  Faults faults;
  for (const auto& derived : study.derived) {
    for (const auto& name : derived.formula.names())
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        const std::string guess = closest_name(name, names);
        faults.add(derived.where, fmt::format("derived.{}: no result is called \"{}\".", derived.name, name),
                   (guess.empty() ? "" : fmt::format("Did you mean \"{}\"?  ", guess)) +
                       "Formulas use the names of summary.json (docs/reference/results.md).");
      }
  }
  faults.throw_if_any();
  for (const auto& derived : study.derived) names.push_back(derived.name);
  resolve_results(study, names);
  ProbedResults probed;
  for (const auto& name : names)
    if (is_kept(study, name)) probed.names.push_back(name);
  return probed;
}

StudyEstimate estimate_study(const Study& study, const Design& design, const ProbedResults& results,
                             const Evaluator& evaluate) {
  StudyEstimate estimate;
  estimate.n_rows = design.n_rows;
  estimate.n_points = n_points(study, design);
  const Case c = read_case(study.case_file, overrides_of(study, point_of(study, design, 0)));
  volatile std::sig_atomic_t stop = 0;
  PointResult result;
  double cpu = 0.;
  {
    std::mutex lock;
    std::condition_variable ended;
    bool has_ended = false;
    const std::jthread drop([&] {
      const double start = thread_cpu_seconds();
      result = evaluate({c, &stop, study.keep_series});
      cpu = thread_cpu_seconds() - start;
      const std::scoped_lock guard(lock);
      has_ended = true;
      ended.notify_all();
    });
    std::unique_lock guard(lock);
    if (!ended.wait_for(guard, std::chrono::seconds(4), [&] { return has_ended; })) stop = 1;
  }
  if (!result.reason.empty()) throw SolverError("the first point fails: " + result.reason);
  const double part = result.is_done ? 1. : result.end_time / c.parameters.run.latest_end();
  estimate.cpu_time = cpu / std::max(part, 1e-9) * static_cast<double>(estimate.n_points);
  double numbers = static_cast<double>(results.names.size() + study.parameters.size() + 3);
  for (const auto& series : result.series)
    numbers += static_cast<double>(series.time.size() + series.values.size()) / std::max(part, 1e-9);
  // In study.h5 8 bytes a number; in the journal and the table of texts about 13 each.
  estimate.bytes = numbers * static_cast<double>(estimate.n_points) * (8. + 13. + 13.);
  return estimate;
}

StudyOutcome run_study(const Study& study, const Design& design, const StudyOptions& options) {
  const ResultsFolder folder(options.directory, options.resume  ? ResultsFolder::Existing::resume
                                                : options.force ? ResultsFolder::Existing::replace
                                                                : ResultsFolder::Existing::refuse);
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
    if (!waiting.empty()) StudyRun(study, design, options, *journal, std::move(waiting), start).run(outcome);
    journal->sync();
  }
  const auto content = Journal::read(file);
  const StudyTable table = make_table(study, design, content.records, content.layouts);
  outcome.done = table.count(PointStatus::done);
  outcome.failed = table.count(PointStatus::failed);
  outcome.missing = table.count(PointStatus::not_run);
  outcome.cpu_time = table.cpu_time;
  outcome.is_complete = outcome.done + outcome.failed == start.total;
  if (outcome.is_complete && options.n_shards == 1) write_results(options.directory, study, design, table, digest);
  folder.require_there();
  return outcome;
}

}  // namespace rotordrop
