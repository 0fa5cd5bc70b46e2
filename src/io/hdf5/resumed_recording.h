#pragma once
// An interrupted recording, gone on with.

#include <filesystem>
#include <string>
#include <vector>

#include "io/hdf5/recorder.h"

namespace rotordrop {

/// What copy_rows_until() did.
struct CopiedRows {
  std::vector<std::size_t> n_rows;   ///< per group
  std::vector<std::string> missing;  ///< channels the old file does not have; NaN stands in their rows
};

/// Copies all rows with time <= `time` [s] of the recorder's channels from an older file, finished, being written or left by a
/// killed run. @throws InputError if the old file cannot be read, or holds a channel with another unit or size; DamagedFile if its
/// times do not rise, or if it lacks a row of `expected` or holds another
CopiedRows copy_rows_until(const std::filesystem::path& old_path, double time, Recorder& recorder,
                           const RecordedRows& expected = {});

/// A recorder that continues the file of an interrupted run: a new file beside it receives the rows up to `time` [s] and then takes
/// its name. Until then the old file is untouched, and it stays so if anything fails.
struct ResumedRecorder {
  Recorder recorder;
  CopiedRows copied;
};
[[nodiscard]] ResumedRecorder resume_recording(const std::filesystem::path& path, double time,
                                               const RecordHeader& header, std::vector<SeriesGroup> groups,
                                               RecorderOptions options = {}, const RecordedRows& expected = {});

}  // namespace rotordrop
