#include "study/many/search/search_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "io/results_folder.h"
#include "study/many/answers/study_summary.h"
#include "study/many/search/drop_pool.h"
#include "study/many/search/evaluation.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/search/least_squares.h"
#include "study/many/study_folder.h"
#include "study/many/study_table.h"

namespace rotordrop {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> values_of(const std::vector<PointResult>& drops, const std::string& result) {
  std::vector<double> values;
  for (const auto& drop : drops) {
    const auto found =
        std::find_if(drop.scalars.begin(), drop.scalars.end(), [&](const auto& s) { return s.first == result; });
    values.push_back(drop.is_done && found != drop.scalars.end() ? found->second : nan);
  }
  return values;
}

/// Why the first evaluation of a search gives no value.
std::string reason_of(const Study& study, const std::vector<PointResult>& drops) {
  for (const auto& drop : drops)
    if (!drop.is_done) return drop.reason;
  return study.minimise->result + " or a limited result has not happened there (NaN)";
}

/// All searches of a study, each in a thread, over one pool of workers.
class SearchRun {
 public:
  SearchRun(const Study& study, const StudyOptions& options, DropPool& pool)
      : study_(study), options_(options), pool_(pool), space_(study) {}

  /// @return what a user should know of the searches
  std::vector<std::string> run() {
    const auto n = study_.n_searches();
    const auto starts = space_.starts(n);
    std::vector<std::jthread> threads;
    start_ = Clock::now();
    for (std::size_t k = 0; k < n; ++k) threads.emplace_back([this, k, &starts] { search(k, starts[k]); });
    std::unique_lock lock(lock_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(200), [&] { return n_ended_ == n; })) tell();
    tell();
    if (error_) std::rethrow_exception(error_);
    std::vector<std::string> notes;
    for (auto& [number, note] : notes_) notes.push_back(std::move(note));
    return notes;
  }

 private:
  void search(std::size_t number, const std::vector<double>& start) {
    try {
      if (study_.fit)
        fit(number, start);
      else
        minimise(number, start);
    } catch (const SearchStopped&) {
    } catch (...) {
      const std::scoped_lock lock(lock_);
      if (!error_) error_ = std::current_exception();
    }
    const std::scoped_lock lock(lock_);
    ++n_ended_;
    ended_.notify_all();
  }

  void minimise(std::size_t number, const std::vector<double>& start) {
    std::size_t n_evaluations = 0;
    const bool has_ended = search_minimum(
        *study_.minimise, start, n_constraints(study_), static_cast<std::uint64_t>(study_.design.seed) + number,
        [&](const std::vector<double>& place) { return evaluate(number, n_evaluations++, place); },
        [&] {
          if (pool_.is_over()) throw SearchStopped{};
        });
    if (has_ended) return;
    const std::scoped_lock lock(lock_);
    notes_[number] = fmt::format("search {} of {} ended after {} evaluations: {} asked only for places that it knew",
                                 number + 1, study_.n_searches(), n_evaluations, name_of(study_.minimise->method));
  }

  SearchValue evaluate(std::size_t search, std::size_t evaluation, const std::vector<double>& place) {
    const auto at = space_.values(place);
    const auto drops = drops_at(search, evaluation, {at});
    const SearchValue found = judged(study_, [&](const std::string& result) { return values_of(drops, result); });
    if (search == 0 && evaluation == 0 && !std::isfinite(found.value))
      throw SolverError("the search cannot begin: its first evaluation has no value.\n       " +
                        reason_of(study_, drops));
    const bool is_allowed =
        std::all_of(found.constraints.begin(), found.constraints.end(), [](double c) { return c <= 0.; });
    const std::scoped_lock lock(lock_);
    if (is_allowed && std::isfinite(found.value) && !(best_ <= found.value)) best_ = found.value;
    return found;
  }

  std::vector<PointResult> drops_at(std::size_t search, std::size_t evaluation,
                                    const std::vector<std::vector<double>>& values) {
    return pool_.run(first_drop(search, evaluation, study_.evaluations_of_search(), space_.n_drops()),
                     space_.rows_at(values), values);
  }

  /// Levenberg & Marquardt's steps; then a drop at the values found, and those for the derivatives there.
  void fit(std::size_t search, const std::vector<double>& start) {
    std::size_t evaluation = 0;
    const auto residuals = [&](const std::vector<std::vector<double>>& places) {
      std::vector<std::vector<double>> values;
      for (const auto& place : places) values.push_back(space_.values(place));
      const auto drops = drops_at(search, evaluation, values);
      std::vector<Eigen::VectorXd> found;
      for (const auto& drop : drops) found.push_back(residuals_of(*study_.fit, drop.series));
      if (search == 0 && evaluation == 0 && found.front().size() == 0)
        throw SolverError("the fit cannot begin: the drop at its start fails.\n       " + drops.front().reason);
      evaluation += places.size();
      const std::scoped_lock lock(lock_);
      for (const auto& r : found)
        if (r.size() > 0 && !(best_ <= r.squaredNorm())) best_ = r.squaredNorm();
      return found;
    };
    const auto& keys = study_.fit->keys;
    const auto at = least_squares({keys.evaluations, keys.difference, keys.tolerance}, start, residuals);
    evaluation = static_cast<std::size_t>(keys.evaluations);
    auto places = difference_places(at, keys.difference);
    places.insert(places.begin(), at);
    residuals(places);
  }

  void tell() const {
    if (!options_.report) return;
    StudyProgress p;
    const auto counts = pool_.counts();
    p.done = counts.done;
    p.failed = counts.failed;
    p.total = study_.n_searches() * study_.evaluations_of_search() * space_.n_drops();
    p.per_second =
        static_cast<double>(counts.here) / std::max(1e-9, std::chrono::duration<double>(Clock::now() - start_).count());
    p.time_left = p.per_second > 0. ? static_cast<double>(p.total - p.done - p.failed) / p.per_second : nan;
    p.best_name = study_.fit ? "sum of squares" : study_.minimise->result;
    p.best = best_;
    options_.report(p);
  }

  const Study& study_;
  const StudyOptions& options_;
  DropPool& pool_;
  const SearchSpace space_;
  std::mutex lock_;
  std::condition_variable ended_;
  std::size_t n_ended_ = 0;
  std::exception_ptr error_;
  std::map<std::size_t, std::string> notes_;  ///< by searches
  double best_ = nan;
  Clock::time_point start_;
};

}  // namespace

StudyOutcome run_search(const Study& study, const StudyOptions& options) {
  const ResultsFolder folder(options.directory, ResultsFolder::existing_results(options.resume, options.force),
                             ResultsFolder::Results::of_study);
  const SearchSpace space(study);
  const std::string digest = digest_of(study, space.corners());
  const std::string header = journal_header(study, digest, 1, 1);
  const auto file = options.directory / "study.journal";
  auto earlier = earlier_points(study, options, header);
  StudyOutcome outcome;
  const auto start = Clock::now();
  const auto n_searches = study.n_searches();
  {
    std::optional<Journal> journal;
    if (earlier)
      journal.emplace(file, *earlier);
    else
      journal.emplace(file, header);
    // A fit asks for the drops of all derivatives at once.
    const std::size_t n_at_once = study.fit ? std::max<std::size_t>(3, space.n_dimensions()) : space.n_drops();
    const unsigned n_workers = workers_of(options.n_workers, n_searches * n_at_once);
    DropPool pool(study, options, *journal, earlier ? std::move(*earlier) : Journal::Content{}, n_workers);
    outcome.notes = SearchRun(study, options, pool).run();
    if (const auto error = pool.error()) std::rethrow_exception(error);
    outcome.is_stopped = pool.is_stopped_by_failure();
    outcome.is_complete = !pool.is_over();
    outcome.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
    outcome.idle_share = std::max(0., 1. - pool.counts().working / (n_workers * std::max(outcome.wall_time, 1e-9)));
    journal->sync();
  }
  auto content = Journal::read(file);
  const Design design = design_of_search(study, content);
  const StudyTable table = make_table(study, design, content.records, content.layouts);
  outcome.n_points = table.n_points;
  outcome.done = table.count(PointStatus::done);
  outcome.failed = table.count(PointStatus::failed);
  outcome.missing = table.count(PointStatus::not_run);
  outcome.cpu_time = table.cpu_time;
  if (outcome.is_complete) write_results(options.directory, study, design, table, digest);
  folder.require_there();
  return outcome;
}

}  // namespace rotordrop
