#pragma once
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/many/design.h"
#include "study/many/evaluate_point.h"

namespace rotordrop {

/// Where a study stands; for the moving line.
struct StudyProgress {
  std::size_t done = 0, failed = 0, total = 0;  ///< of this run's points; earlier ones of a resumed run included
  double per_second = 0;                        ///< points that this run has finished
  double time_left = 0;                         ///< estimate [s]
  std::string best_name;                        ///< a result whose smallest value is followed; empty: none
  double best = 0;
  std::string making;  ///< what is made of the results, once all drops are finished; empty: drops are computed
};

class Ranks;

struct StudyOptions {
  std::filesystem::path directory;
  unsigned n_workers = 0;               ///< 0: one per core
  std::size_t shard = 1, n_shards = 1;  ///< this run computes every n_shards-th point from the shard's on
  bool force = false, resume = false;
  Ranks* ranks = nullptr;  ///< processes that share the points; null: this one is alone
  const volatile std::sig_atomic_t* stop = nullptr;
  Evaluator evaluate = evaluate_point;
  std::function<void(const StudyProgress&)> report;
  std::function<void(const std::string&)> tell;
};

struct StudyOutcome {
  std::size_t n_points = 0, done = 0, failed = 0, missing = 0;
  bool is_complete = false;        ///< every point of this run (or shard) is finished
  bool is_stopped = false;         ///< by the policy after a failure
  bool is_anyone_lost = false;     ///< a rank fell silent
  double cpu_time = 0;             ///< of all drops [s]
  double wall_time = 0;            ///< of this run [s]
  double idle_share = 0;           ///< of the workers' time, waiting for the last drops
  std::vector<std::string> notes;  ///< what a user should know of it
};

/// Overrides of the study and of a point.
std::vector<std::string> overrides_of(const Study& study, const StudyPoint& point);
/// The same where the point failed and is tried once more: a tenth of the tolerance and of the longest step.
std::vector<std::string> overrides_of_second_try(const Study& study, const StudyPoint& point);

/// Number of threads for so many tasks. @param asked  0: one per core
unsigned workers_of(unsigned asked, std::size_t n_tasks);

/// Reads the case of every point and builds its machine, but for meshes. @throws InputError with the first faulty points
/// @param look  called now and then by the thread that calls this; what it throws ends the checking
/// @return what is unusual in points and not in the study's base case, each once, with the number of points and an example
std::vector<Fault> check_points(const Study& study, const Design& design, unsigned n_workers,
                                const std::function<void()>& look = {});

/// What a study knows of its results before it runs: the first point is begun and stopped after its first step.
struct ProbedResults {
  std::vector<std::string> names;  ///< results that are kept, derived ones included
};
/// Also resolves the limits' units. @throws InputError for limits, choices, formulas and kept results that no drop has
ProbedResults probe_results(Study& study, const Design& design, const Evaluator& evaluate);

/// Whether the points run in lanes: as the study says, or as the first point can.
/// @return what a user should know: why they cannot, if the study says so; else empty
std::string choose_lanes(Study& study, const Design& design);

/// What a dry run tells.
struct StudyEstimate {
  std::size_t n_rows = 0, n_points = 0;
  double cpu_time = 0;  ///< of all drops [s]; from a few seconds of the first one
  double bytes = 0;     ///< of the results
};
StudyEstimate estimate_study(const Study& study, const Design& design, const ProbedResults& results,
                             const Evaluator& evaluate);

/// Runs one point, once more if it fails and the study says so; its results are complete.
PointResult run_point(const Study& study, const StudyPoint& point, const StudyOptions& options);

/// Adds derived results to those of a drop and leaves out what is not kept.
void complete_results(const Study& study, PointResult& result);

/// Runs the points into a directory: study.journal, and when all are finished study.h5, study.csv, study.json (not of a shard).
/// @throws InputError if the directory holds something else, SolverError if it cannot be written
StudyOutcome run_study(const Study& study, const Design& design, const StudyOptions& options);

/// What a rank other than 0 does: it computes the points that rank 0 gives, into a journal of its own in the same directory.
StudyOutcome run_as_rank(const Study& study, const Design& design, const StudyOptions& options);

}  // namespace rotordrop
