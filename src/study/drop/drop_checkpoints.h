#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/drop.h"
#include "case/case.h"
#include "io/results_folder.h"
#include "io/sha256.h"
#include "study/drop/drop_record.h"

namespace rotordrop {

/// Checkpoints of a drop in its folder: writes them as wall time passes, and resumes from the newest one that the recorded rows fit.
class DropCheckpoints final : public Observer {
 public:
  using Tell = std::function<void(const std::string&)>;
  /// @param series  gets the rows of before when the drop is resumed
  DropCheckpoints(std::filesystem::path directory, const Case& drop_case, const Machine& machine, Drop& drop,
                  DropRecord& record, MemorySeries& series, ResultsFolder& folder, Tell tell);

  /// Puts drop and record where the newest checkpoint left them, or to the start if there is none yet.
  /// @throws InputError if the folder holds another case, a finished run or nothing that can be read
  void resume();
  void step(const Step& step) override;
  /// Where the drop stands now.
  void save();
  /// The last good state of a drop that has failed. @returns the file
  std::filesystem::path save_failed();
  /// Of the time integration with its results, over all parts of a resumed run [s].
  [[nodiscard]] double wall_time() const;
  [[nodiscard]] double cpu_time() const;
  /// The time integration begins now.
  void start_clocks();

 private:
  using Clock = std::chrono::steady_clock;
  /// Digests of the parameters, made when a checkpoint is first written or read, since most runs end before; and of these with the files that they name.
  const std::string& parameter_digest();
  std::string digest() { return sha256_of(parameter_digest() + digests_of_files_); }
  [[nodiscard]] std::string earlier_parameters() const;
  std::filesystem::path read_newest(const std::filesystem::path& newer);
  void write(const std::filesystem::path& directory, double time, std::span<const double> state);
  std::filesystem::path written(const std::filesystem::path& directory, double time, std::span<const double> state);

  std::filesystem::path directory_;
  Drop& drop_;
  DropRecord& record_;
  MemorySeries& series_;
  ResultsFolder& folder_;
  Tell tell_;
  double interval_;                            // of wall time [s]
  std::string parameters_, digests_of_files_;  // as TOML; of the files as they were at the start
  std::string parameter_digest_;               // empty: not made yet
  std::vector<std::string> entry_names_;
  RecordedRows recorded_;  // of the last checkpoint
  double time_ = 0;        // of the one that is resumed from [s]
  double earlier_wall_ = 0, earlier_cpu_ = 0, cpu_start_ = 0;
  Clock::time_point wall_start_ = Clock::now(), last_ = wall_start_;
  long counter_ = 0;
};

}  // namespace rotordrop
