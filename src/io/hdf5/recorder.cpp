#include "io/hdf5/recorder.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

#include "base/errors.h"
#include "io/half_made_file.h"
#include "io/hdf5/hdf5_driver.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/recorded_group.h"
#include "io/hdf5/trial_reading.h"

namespace rotordrop {

namespace fs = std::filesystem;
using hdf5::Handle;
using Clock = std::chrono::steady_clock;

namespace {

void check_channels(const RecordHeader& header, const std::vector<SeriesGroup>& groups,
                    const RecorderOptions& options) {
  if (options.rows_per_flush == 0 || options.rows_per_chunk == 0)
    throw std::invalid_argument("Recorder: rows_per_flush and rows_per_chunk must be 1 or more");
  std::set<std::string> known;
  const auto add = [&](const std::string& path) {
    if (path.size() < 2 || path.front() != '/' || path.back() == '/')
      throw std::invalid_argument("Recorder: \"" + path +
                                  "\" is not a dataset's path; it must look like \"/group/name\"");
    if (!known.insert(path).second) throw std::invalid_argument("Recorder: two datasets are called " + path);
  };
  for (const auto& text : header.texts) add(text.first);
  for (const auto& group : groups) {
    add(group.time_path);
    for (const auto& channel : group.channels) {
      add(channel.path);
      if (channel.size == 0) throw std::invalid_argument("Recorder: channel " + channel.path + " has size 0");
      if (!channel.columns.empty() && channel.columns.size() != channel.size)
        throw std::invalid_argument("Recorder: channel " + channel.path + " has " + std::to_string(channel.size) +
                                    " values per row but " + std::to_string(channel.columns.size()) + " column names");
    }
  }
}

/// Puts `from` in the place of `to`; refuses to replace an existing file unless told so, even if it appeared just now.
void give_name(const fs::path& from, const fs::path& to, bool may_replace) {
  if (!may_replace) {
    if (::link(from.c_str(), to.c_str()) == 0) {
      ::unlink(from.c_str());
      return;
    }
    if (errno == EEXIST)
      throw InputError({to.string()}, "this result file already exists.",
                       "Choose another directory, or allow it to be overwritten.");
    // Some file systems have no links; there the rename below has to do.
  }
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw SolverError("cannot make " + to.string() + ": " + error.message());
}

}  // namespace

struct Recorder::Implementation {
  fs::path path;
  RecordHeader header;
  RecorderOptions options;
  std::vector<SeriesGroup> series;
  Handle file;  // before the groups: their datasets close first
  std::vector<RecordedGroup> groups;
  Clock::time_point last_flush = Clock::now();
  std::string failure;  ///< why writing failed; empty while all is well
  bool is_closed = false;

  void make_groups();
  /// @throws InputError if the file exists and must not be replaced
  void require_absent() const;
  /// @param goes_on  rows will follow, which readers may follow, too; else it is closed, with all rows in it
  void make_file(bool goes_on = true);
  void write_header();
  void make_datasets();
  /// One after the other, so that HDF5 has one in memory at a time.
  void write_whole_datasets() const;
  void close_datasets();
  void flush();
  /// The group, if rows of this size and these times can be added to it. @throws std::invalid_argument
  RecordedGroup& group_for(std::size_t index, std::size_t row_size, std::span<const double> times);
  /// Writes the group if a chunk is full or a flush is due.
  void pass_on(RecordedGroup& group);
  /// Calls what writes. @throws SolverError, after which the recorder only says so again
  template <class Work>
  void write_with(const Work& work);
  void close();
  /// Leaves the file as it is, as if the program had been killed. Closing a file after a failed write crashes HDF5 1.10.8 or
  /// makes the file unreadable.
  void abandon() noexcept;
  void require_open() const;
};

void Recorder::Implementation::make_groups() {
  for (const auto& description : series) {
    std::size_t row_size = 0;
    for (const auto& channel : description.channels) row_size += channel.size;
    groups.emplace_back().rows = RowStore(row_size);
  }
}

void Recorder::Implementation::require_absent() const {
  std::error_code ignored;
  if (!options.overwrite && fs::exists(path, ignored))
    throw InputError({path.string()}, "this result file already exists.",
                     "Choose another directory, or allow it to be overwritten.");
}

void Recorder::Implementation::make_file(bool goes_on) {
  hdf5::be_quiet();
  require_absent();
  // Made under another name first: nobody ever opens a file whose datasets are still being made, and an older one stays until
  // the new one is sound.
  const fs::path beside = path.string() + "." + std::to_string(::getpid()) + ".new";
  const Handle access = hdf5::access_for_writing();
  HalfMadeFile half_made(beside);
  try {
    file = Handle(H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "cannot create it");
    write_header();
    if (goes_on) {
      make_datasets();
      hdf5::require(H5Fflush(file.id(), H5F_SCOPE_LOCAL), "cannot write it");
      hdf5::require(H5Fstart_swmr_write(file.id()), "cannot make it readable while the run goes on");
    } else {
      write_whole_datasets();
      close_datasets();
    }
    hdf5::know_readable(beside);
  } catch (const SolverError& error) {
    abandon();
    failure = "the result file " + path.string() + " could not be made: " + error.what() + ".";
    throw SolverError(failure);
  }
  try {
    give_name(beside, path, options.overwrite);
  } catch (const std::exception& error) {
    abandon();
    failure = error.what();
    throw;
  }
  half_made.keep();
}

void Recorder::Implementation::write_header() {
  for (const auto& [name, text] : header.attributes) hdf5::write_attribute(file.id(), name, text);
  for (const auto& [name, text] : header.texts) hdf5::write_text(file.id(), name, text);
}

void Recorder::Implementation::make_datasets() {
  ColumnMaker maker(file.id(), options.rows_per_chunk);
  for (std::size_t i = 0; i < series.size(); ++i) {
    groups[i].time = maker.make(series[i].times(), series[i].time_path);
    for (const auto& channel : series[i].channels)
      groups[i].columns.push_back(maker.make(channel, series[i].time_path));
  }
}

void Recorder::Implementation::write_whole_datasets() const {
  ColumnMaker maker(file.id(), options.rows_per_chunk);
  for (std::size_t i = 0; i < series.size(); ++i) groups[i].write_whole(series[i], maker);
}

template <class Work>
void Recorder::Implementation::write_with(const Work& work) {
  try {
    work();
  } catch (const SolverError& error) {
    failure = "the result file " + path.string() + " could not be written (" + error.what() + ").\n" +
              "       Its rows up to the last successful write can be read. Is the disk full?";
    abandon();
    throw SolverError(failure);
  }
}

void Recorder::Implementation::flush() {
  hdf5::be_quiet();
  if (!file.is_open()) make_file();
  last_flush = Clock::now();
  if (std::all_of(groups.begin(), groups.end(), [](const RecordedGroup& group) { return group.times.empty(); })) return;
  write_with([this] {
    for (auto& group : groups) group.write_columns();
    hdf5::require(H5Fflush(file.id(), H5F_SCOPE_LOCAL),
                  "flush");  // the values are out before the times that announce them
    for (auto& group : groups) {
      if (group.times.empty()) continue;
      group.write_times();
      hdf5::require(H5Dflush(group.time.dataset.id()), "flush");
    }
  });
}

RecordedGroup& Recorder::Implementation::group_for(std::size_t index, std::size_t row_size,
                                                   std::span<const double> times) {
  require_open();
  RecordedGroup& group = groups.at(index);
  if (row_size != group.rows.row_size())
    throw std::invalid_argument("Recorder: a row of " + series[index].time_path + " has " +
                                std::to_string(group.rows.row_size()) + " values, given were " +
                                std::to_string(row_size));
  double last = group.last_time;
  for (const double time : times) {
    if (!(time >= last))
      throw std::invalid_argument("Recorder: times of " + series[index].time_path + " must not decrease");
    last = time;
  }
  return group;
}

void Recorder::Implementation::pass_on(RecordedGroup& group) {
  const std::chrono::duration<double> waited = Clock::now() - last_flush;
  if (!file.is_open() && waited.count() >= options.seconds_until_made) make_file();
  // Whole chunks go out as they are full: memory that was used before costs less than fresh memory for all rows.
  if (file.is_open() && group.n_rows() % options.rows_per_chunk == 0) {
    hdf5::be_quiet();
    write_with([&] { group.write_columns(); });
  }
  if (group.times.size() >= options.rows_per_flush || group.rows.bytes() >= options.bytes_per_flush ||
      waited.count() >= options.seconds_per_flush)
    flush();
}

void Recorder::Implementation::close() {
  if (is_closed) return;
  require_open();
  // A file that nobody could follow so far needs no order in which its rows appear.
  if (!file.is_open()) {
    make_file(false);
    is_closed = true;
    return;
  }
  flush();
  is_closed = true;
  try {
    close_datasets();
  } catch (const SolverError& error) {
    failure = "the result file " + path.string() + " could not be closed: " + error.what() + ".";
    throw SolverError(failure);
  }
}

void Recorder::Implementation::close_datasets() {
  bool is_sound = true;
  for (auto& group : groups) {
    is_sound = group.time.dataset.reset() && is_sound;
    for (auto& column : group.columns) is_sound = column.dataset.reset() && is_sound;
  }
  is_sound = file.reset() && is_sound;
  if (!is_sound) throw SolverError(hdf5::last_error());
}

void Recorder::Implementation::abandon() noexcept {
  for (auto& group : groups) {
    group.time.dataset.leak();
    for (auto& column : group.columns) column.dataset.leak();
  }
  groups.clear();
  file.leak();
}

void Recorder::Implementation::require_open() const {
  if (!failure.empty()) throw SolverError(failure);
  if (is_closed) throw std::logic_error("Recorder: the file " + path.string() + " is closed");
}

Recorder::Recorder(const fs::path& path, const RecordHeader& header, std::vector<SeriesGroup> groups,
                   const RecorderOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
  check_channels(header, groups, options);
  implementation_->path = path;
  implementation_->header = header;
  implementation_->options = options;
  implementation_->series = std::move(groups);
  implementation_->make_groups();
  implementation_->require_absent();
  if (options.seconds_until_made <= 0.) implementation_->flush();
}

Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Recorder::~Recorder() {
  if (!implementation_) return;
  try {
    close();
  } catch (...) {  // a destructor has nobody to tell
  }
}

void Recorder::append(std::size_t index, double time, std::span<const double> row) {
  RecordedGroup& group = implementation_->group_for(index, row.size(), {&time, 1});
  group.append(time, row);
  implementation_->pass_on(group);
}

void Recorder::append(std::size_t index, const RowTile& rows) {
  RecordedGroup& group = implementation_->group_for(index, rows.row_size, rows.times);
  const std::size_t chunk = implementation_->options.rows_per_chunk;
  for (std::size_t from = 0; from < rows.n_rows();) {
    const std::size_t n = std::min(rows.n_rows() - from, chunk - group.n_rows() % chunk);
    group.append(rows.part(from, n));
    implementation_->pass_on(group);
    from += n;
  }
}

void Recorder::flush() {
  implementation_->require_open();
  implementation_->flush();
}

RecordedRows Recorder::sync() {
  flush();
  RecordedRows rows;
  for (const RecordedGroup& group : implementation_->groups) {
    rows.n_rows.push_back(group.n_told);
    rows.check_sums.push_back(group.check_sum);
  }
  try {
    hdf5::require(H5Fflush(implementation_->file.id(), H5F_SCOPE_GLOBAL), "flush");
    hdf5::sync(implementation_->file.id(), "sync");
  } catch (const SolverError& error) {
    implementation_->failure =
        "the result file " + implementation_->path.string() + " could not be written (" + error.what() + ").";
    implementation_->abandon();
    throw SolverError(implementation_->failure);
  }
  return rows;
}

void Recorder::close() { implementation_->close(); }

namespace {
constexpr double half = 4294967296.;  // 2^32: a double holds half a check sum exactly
}  // namespace

std::vector<double> RecordedRows::packed() const {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < n_rows.size(); ++i) {
    numbers.push_back(static_cast<double>(n_rows[i]));
    numbers.push_back(static_cast<double>(check_sums.at(i) >> 32));
    numbers.push_back(static_cast<double>(check_sums.at(i) & 0xffffffffU));
  }
  return numbers;
}

RecordedRows RecordedRows::unpacked(const std::vector<double>& numbers) {
  RecordedRows rows;
  if (numbers.size() % 3 != 0) return rows;
  for (const double number : numbers)
    if (!(number >= 0. && number < half * half)) return rows;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    rows.n_rows.push_back(static_cast<std::size_t>(numbers[i]));
    rows.check_sums.push_back(static_cast<std::uint64_t>(numbers[i + 1]) << 32 |
                              static_cast<std::uint64_t>(numbers[i + 2]));
  }
  return rows;
}

void Recorder::move_to(const fs::path& path) {
  flush();  // it is there then, too
  give_name(implementation_->path, path, true);
  implementation_->path = path;
}

const fs::path& Recorder::path() const { return implementation_->path; }
const std::vector<SeriesGroup>& Recorder::groups() const { return implementation_->series; }
std::size_t Recorder::row_size(std::size_t group) const { return implementation_->groups.at(group).rows.row_size(); }
std::size_t Recorder::n_rows(std::size_t group) const { return implementation_->groups.at(group).n_rows(); }

}  // namespace rotordrop
