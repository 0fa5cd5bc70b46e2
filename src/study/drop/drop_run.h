#pragma once
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/drop.h"
#include "case/case.h"
#include "study/drop/drop_progress.h"
#include "study/drop/drop_summary.h"
#include "study/recorded_drop.h"

namespace rotordrop {

struct RunOptions {
  std::filesystem::path directory;
  bool force = false;                                ///< replace results that are there
  bool resume = false;                               ///< go on from the newest checkpoint there
  const volatile std::sig_atomic_t* stop = nullptr;  ///< nonzero: end after the current step, as if interrupted
  FiniteElements* elements = nullptr;                ///< those that the machine was built with, if any
  std::function<void(const Progress&)> report;       ///< called a few times a second
  std::function<void(const std::string&)> tell;      ///< called with what a user should know
  /// As a study in lanes computes it, bit for bit, if the drop runs in lanes; not of a run that is resumed.
  bool in_lanes = false;
};

/// A finished or interrupted drop with its summary.
struct FinishedDrop : DropResult {
  DropSummary summary;
  std::shared_ptr<const RecordedDrop>
      recorded;  ///< series that its summary needs; all if two thermal models can be compared
};

/// Finds limits on results that a drop of the case does not have, by its first step. @throws InputError
void require_known_limits(const Case& drop_case, const Machine& machine, FiniteElements* elements);

/// Runs a case into a directory: results.h5, parameters.toml, checkpoints and summary.json.
/// @throws InputError if the directory holds results and neither force nor resume is set
/// @throws SolverError if the integration fails; the last good state is saved as a checkpoint in DIRECTORY/failed
FinishedDrop run_drop(const Case& drop_case, const Machine& machine, const RunOptions& options);

struct MemoryRunOptions {
  FiniteElements* elements = nullptr;  ///< those that the machine was built with, if any
  std::function<bool()> is_stopped;    ///< asked after every step; what it throws ends the run
  SummaryParts parts;
  MemorySeries::Choice is_kept;                 ///< series besides those that the summary needs; none: all
  std::function<void(const Progress&)> report;  ///< called a few times a second
  FitWatch::Tell tell;                          ///< called with what a user should know
};

/// Paths of all series that drops of a machine have, those of times among them; windows' are known to the drop alone.
[[nodiscard]] std::vector<std::string> series_of(const Machine& machine);

/// A drop in memory, in parts: for drops that run side by side.
class MemoryDrop {
 public:
  /// @param drop_case, machine  must outlive it
  MemoryDrop(const Case& drop_case, const Machine& machine, MemoryRunOptions options);
  [[nodiscard]] Drop& drop() { return drop_; }
  /// After its run. @throws SolverError for warnings that the case calls fatal
  FinishedDrop finished(double wall_time, double cpu_time);

 private:
  [[nodiscard]] MemorySeries::Choice choice() const;
  const Case& case_;
  const Machine& machine_;
  MemoryRunOptions options_;
  Drop drop_;
  MemorySeries series_;
};

/// Runs a case without a file: no checkpoints, no temperature fields.
/// @throws SolverError if the integration fails
FinishedDrop run_drop_in_memory(const Case& drop_case, const Machine& machine, const MemoryRunOptions& options);

}  // namespace rotordrop
