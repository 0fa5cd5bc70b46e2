#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/recorded_drop.h"

namespace rotordrop {

/// What is told of the files that a complete run writes beside its results.
struct FilesOfFinishedRun {
  std::vector<std::string> comparison;  ///< sentences; none of a run with one thermal model
  std::filesystem::path page;           ///< the report that was made again; empty if none was
};

/// Writes what belongs to a complete run beside its results: the comparison of several thermal models, and once more a report that shows the
/// unfinished run.
/// @param drop     with the series of series_of_comparison()
/// @param resumed  the run was interrupted before: pages that lie in the directory are of that time
/// @param tell     called with what a user should know
/// @throws SolverError if its thermal models cannot be compared
FilesOfFinishedRun write_files_of_finished_run(const std::filesystem::path& directory, const RecordedDrop& drop,
                                               bool resumed, const std::function<void(const std::string&)>& tell);

}  // namespace rotordrop
