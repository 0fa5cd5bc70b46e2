#include "io/hdf5/resumed_recording.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "io/half_made_file.h"
#include "io/hdf5/hdf5_driver.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/series_reader.h"

namespace rotordrop {

namespace fs = std::filesystem;
using hdf5::attribute_texts;
using hdf5::Handle;
using hdf5::has_object;
using hdf5::SeriesReader;
using hdf5::throw_damaged;
using hdf5::throw_unreadable;

namespace {

/// Where a channel's rows come from; nothing if the old file does not have it.
struct Source {
  std::unique_ptr<SeriesReader> reader;
  std::size_t size = 1;
};

Source source_of(const Channel& channel, hid_t file, const fs::path& path) {
  Source source;
  source.size = channel.size;
  if (!has_object(file, channel.path)) return source;
  source.reader = std::make_unique<SeriesReader>(file, path, channel.path);
  if (source.reader->row_size() != channel.size)
    throw_unreadable(path, channel.path + " has " + std::to_string(source.reader->row_size()) +
                               " values per row in this file; this case has " + std::to_string(channel.size) + ".");
  const auto unit = attribute_texts(source.reader->id(), path, channel.path, "units");
  if (unit.empty() || unit.front() != channel.unit)
    throw_unreadable(path, channel.path + " is in " + (unit.empty() ? "?" : unit.front()) +
                               " in this file; now it is in " + channel.unit + ".");
  return source;
}

/// How many of the times rise and are not behind `time`. @throws DamagedFile if they end with one that does not rise
std::size_t n_rising(const std::vector<double>& times, double time, const fs::path& path, const std::string& name) {
  double last = -std::numeric_limits<double>::infinity();
  std::size_t n = 0;
  while (n < times.size() && times[n] > last && times[n] <= time) last = times[n++];
  if (n < times.size() && !(times[n] > last))
    throw_damaged(path,
                  name + " does not rise after row " + std::to_string(n) + " (t = " + std::to_string(last) + " s).");
  return n;
}

/// Copies the rows of a group until `time`, or as many as `n_expected` if that is given.
std::size_t copy_group(hid_t file, const fs::path& path, double time, std::size_t index, Recorder& recorder,
                       std::vector<std::string>& missing, std::optional<std::size_t> n_expected) {
  const SeriesGroup& group = recorder.groups()[index];
  if (!has_object(file, group.time_path)) {
    if (n_expected.value_or(0) > 0) throw_damaged(path, group.time_path + " is missing.");
    missing.push_back(group.time_path);
    return 0;
  }
  const SeriesReader time_reader(file, path, group.time_path);
  std::size_t n_there = time_reader.n_rows();
  std::vector<Source> sources;
  for (const auto& channel : group.channels) {
    sources.push_back(source_of(channel, file, path));
    if (sources.back().reader)
      n_there = std::min(n_there, sources.back().reader->n_rows());
    else
      missing.push_back(channel.path);
  }
  if (n_expected && n_there < *n_expected)
    throw_damaged(path, group.time_path + " and its series have " + std::to_string(n_there) + " rows; " +
                            std::to_string(*n_expected) + " were written.");
  const std::vector<double> times = time_reader.rows(0, n_expected.value_or(n_there));
  const std::size_t n_rows = n_rising(times, time, path, group.time_path);
  if (n_expected && n_rows < *n_expected)
    throw_damaged(path, group.time_path + " has rows that were written later than the checkpoint.");

  constexpr std::size_t block = 4096;  // rows held at once
  const std::size_t row_size = recorder.row_size(index);
  std::vector<double> rows;
  for (std::size_t from = 0; from < n_rows; from += block) {
    const std::size_t n = std::min(block, n_rows - from);
    rows.assign(n * row_size, std::numeric_limits<double>::quiet_NaN());
    std::size_t first = 0;
    for (const auto& source : sources) {
      if (source.reader) {
        const std::vector<double> values = source.reader->rows(from, n);
        for (std::size_t row = 0; row < n; ++row)
          std::copy_n(values.data() + row * source.size, source.size, rows.data() + row * row_size + first);
      }
      first += source.size;
    }
    for (std::size_t row = 0; row < n; ++row)
      recorder.append(index, times[from + row], std::span(rows).subspan(row * row_size, row_size));
  }
  return n_rows;
}

}  // namespace

CopiedRows copy_rows_until(const fs::path& old_path, double time, Recorder& recorder, const RecordedRows& expected) {
  const Handle file = hdf5::open_for_reading(old_path);
  CopiedRows copied;
  const std::size_t n_groups = recorder.groups().size();
  const bool is_expected = expected.n_rows.size() == n_groups;
  for (std::size_t group = 0; group < n_groups; ++group)
    copied.n_rows.push_back(copy_group(file.id(), old_path, time, group, recorder, copied.missing,
                                       is_expected ? std::optional(expected.n_rows[group]) : std::nullopt));
  // Of channels that the old file does not have, NaN was copied: such rows are known to be others.
  const RecordedRows now = recorder.sync();
  for (std::size_t group = 0; is_expected && copied.missing.empty() && group < n_groups; ++group)
    if (now.check_sums[group] != expected.check_sums[group])
      throw_damaged(old_path, "the rows of " + recorder.groups()[group].time_path +
                                  " are not those that were written: their checksum differs.");
  return copied;
}

ResumedRecorder resume_recording(const fs::path& path, double time, const RecordHeader& header,
                                 std::vector<SeriesGroup> groups, RecorderOptions options,
                                 const RecordedRows& expected) {
  const fs::path beside = path.string() + ".resuming";
  options.overwrite = true;  // of what an earlier attempt to resume may have left
  HalfMadeFile half_made(beside);
  Recorder recorder(beside, header, std::move(groups), options);
  CopiedRows copied = copy_rows_until(path, time, recorder, expected);
  recorder.move_to(path);
  half_made.keep();
  return {std::move(recorder), std::move(copied)};
}

}  // namespace rotordrop
