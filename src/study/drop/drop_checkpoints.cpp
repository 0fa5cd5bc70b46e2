#include "study/drop/drop_checkpoints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/cpu_time.h"
#include "base/errors.h"
#include "case/given_values.h"
#include "case/named_files.h"
#include "io/checkpoint.h"
#include "io/hdf5/recorded_series.h"
#include "io/sha256.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

std::string digests_of_files(const Case& c) {
  std::string digests;
  for (const auto& file : named_files(c)) digests += "\n" + file.digest;
  return digests;
}

}  // namespace

DropCheckpoints::DropCheckpoints(fs::path directory, const Case& drop_case, const Machine& machine, Drop& drop,
                                 DropRecord& record, MemorySeries& series, ResultsFolder& folder, Tell tell)
    : directory_(std::move(directory)),
      drop_(drop),
      record_(record),
      series_(series),
      folder_(folder),
      tell_(std::move(tell)),
      interval_(drop_case.parameters.output.checkpoint_interval),
      parameters_(drop_case.resolved.text),
      digests_of_files_(digests_of_files(drop_case)) {
  for (const auto& entry : machine.layout().entries()) entry_names_.push_back(entry.name);
}

const std::string& DropCheckpoints::parameter_digest() {
  if (parameter_digest_.empty()) parameter_digest_ = digest_of_parameters(parameters_);
  return parameter_digest_;
}

void DropCheckpoints::start_clocks() {
  wall_start_ = last_ = Clock::now();
  cpu_start_ = cpu_seconds();
}

double DropCheckpoints::wall_time() const {
  return earlier_wall_ + std::chrono::duration<double>(Clock::now() - wall_start_).count();
}

double DropCheckpoints::cpu_time() const { return earlier_cpu_ + cpu_seconds() - cpu_start_; }

void DropCheckpoints::step(const Step& step) {
  if (++counter_ % 64 != 0) return;
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - last_).count() <= interval_) return;
  last_ = now;
  std::vector<double> state(entry_names_.size());
  step.interpolate(step.time, state);
  write(directory_ / "checkpoints", step.time, state);
}

void DropCheckpoints::save() { write(directory_ / "checkpoints", drop_.loop().time(), drop_.loop().state()); }

void DropCheckpoints::write(const fs::path& directory, double time, std::span<const double> state) {
  folder_.require_there();
  drop_.rows().settle();
  recorded_ = record_.sync();  // on the disk before the checkpoint that relies on it
  written(directory, time, state);
}

fs::path DropCheckpoints::written(const fs::path& directory, double time, std::span<const double> state) {
  Checkpoint c;
  c.time = time;
  c.state.assign(state.begin(), state.end());
  c.parameter_digest = digest();
  c.entry_names = entry_names_;
  drop_.loop().pack(c.extras);
  c.extras["recorded rows"] = recorded_.packed();
  c.extras["clocks"] = {wall_time(), cpu_time()};
  return write_checkpoint(directory, c);
}

fs::path DropCheckpoints::save_failed() {
  try {
    drop_.rows().settle();
    recorded_ = record_.sync();
  } catch (const SolverError&) {  // the recorder is what failed: the state may still find room
  }
  return written(directory_ / "failed", drop_.loop().time(), drop_.loop().state());
}

void DropCheckpoints::resume() {
  // After a power cut the rows of the newest checkpoint may not be on file, but those of an earlier one.
  std::string damage;
  for (fs::path newer; newer = read_newest(newer), true;) {
    try {
      if (time_ > 0.)
        record_.resume(time_, recorded_, series_);
      else
        record_.open(true, false);
      if (tell_ && !damage.empty())
        tell_(fmt::format("the results are damaged: {} The run resumes from an earlier checkpoint, {}", damage,
                          newer.string()));
      return;
    } catch (const DamagedFile& error) {
      const auto& fault = error.faults().front();
      const std::string earlier = newest_valid_checkpoint(directory_ / "checkpoints", newer).path.string();
      if (earlier.empty())
        throw InputError(fault.where, "the results are damaged: " + fault.message,
                         "No checkpoint can be resumed with them. What can be read of them stays as it is; choose "
                         "another directory with -o DIR, or start anew with --force.");
      damage = fault.message;
    }
  }
}

/// What stands beside the results; empty if nothing does.
std::string DropCheckpoints::earlier_parameters() const {
  std::ifstream file(directory_ / "parameters.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// @param newer  a checkpoint that is of no use; empty at first
/// @return the checkpoint; empty if the run starts anew
fs::path DropCheckpoints::read_newest(const fs::path& newer) {
  const auto found = newest_valid_checkpoint(directory_ / "checkpoints", newer);
  if (!found.checkpoint) {
    const std::string where = directory_.string();
    if (!found.skipped.empty())
      throw InputError(
          {where, 0, 0}, "none of the checkpoints can be read",
          fmt::format("{}\nWhat can be read of the results stays as it is; choose another directory with -o "
                      "DIR, or start anew with --force.",
                      fmt::join(found.skipped, "\n")));
    if (fs::exists(directory_ / "summary.json"))
      throw InputError({where, 0, 0}, "there is no checkpoint to go on from",
                       "The run was finished, or its checkpoints were removed.");
    // Killed before its first checkpoint: it starts anew, but only as what it was.
    const std::string earlier = earlier_parameters();
    if (!earlier.empty() && digest_of_parameters(earlier) != parameter_digest()) {
      const std::string differing = differing_parameters(earlier, parameters_);
      throw InputError(
          {where, 0, 0},
          fmt::format("the directory holds the run of another case{}", differing.empty() ? "" : ": " + differing),
          "Choose another with -o DIR, or replace the results with --force.");
    }
    if (tell_) tell_("there is no checkpoint yet: the run starts anew");
    return {};
  }
  if (tell_)
    for (const auto& file : found.skipped) tell_("a newer checkpoint cannot be read: " + file);
  const Checkpoint& c = *found.checkpoint;
  require_same_case(found.path, c, digest(), entry_names_,
                    [this] { return differing_parameters(earlier_parameters(), parameters_); });
  try {
    const auto& clocks = c.extras.at("clocks");
    if (clocks.size() != 2) throw std::invalid_argument("a checkpoint of another kind");
    drop_.loop().unpack(c.time, c.state, c.extras);
    time_ = c.time;
    recorded_ =
        c.extras.contains("recorded rows") ? RecordedRows::unpacked(c.extras.at("recorded rows")) : RecordedRows{};
    earlier_wall_ = clocks[0];
    earlier_cpu_ = clocks[1];
  } catch (const std::logic_error&) {  // something is missing, or of another size
    throw InputError({found.path.string()}, "this checkpoint does not hold what this version of the program needs.",
                     "Start anew with --force, or resume with the version that wrote it.");
  }
  return found.path;
}

}  // namespace rotordrop
