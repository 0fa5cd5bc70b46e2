#pragma once
// Result files: time series in HDF5, readable while the run goes on.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/row_tile.h"

namespace rotordrop {

/// One recorded quantity: a dataset [time] or [time, size].
struct Channel {
  std::string path;                  ///< "/bearings/TB2/contact_force"
  std::string unit;                  ///< SI unit in UDUNITS text, "1" if it has none; attribute `units`
  std::string long_name;             ///< what it is, in words; attribute `long_name`
  std::size_t size = 1;              ///< values per row; 1 gives a dataset [time]
  std::vector<std::string> columns;  ///< names of the `size` values, attribute `columns`; may be empty
};

/// Channels that are recorded at the same times.
struct SeriesGroup {
  std::string time_path;  ///< dataset of the times [s]: "/time", "/coarse/time"
  std::vector<Channel> channels;
  std::string unit = "s";          ///< of the axis, if it is not time
  std::string long_name = "time";  ///< likewise

  [[nodiscard]] Channel times() const { return {time_path, unit, long_name, 1, {}}; }
};

/// What a result file says about itself.
struct RecordHeader {
  std::vector<std::pair<std::string, std::string>> attributes;  ///< of the root: name, text ("git_revision", "a1b2c3d")
  std::vector<std::pair<std::string, std::string>>
      texts;  ///< datasets: path, text ("/parameters", the resolved parameters)
};

struct RecorderOptions {
  bool overwrite = false;             ///< replace an existing file; without it an existing file is an InputError
  double seconds_until_made = 0;      ///< [s] of wall time after which append() makes the file; 0: the constructor does
  std::size_t rows_per_flush = 8192;  ///< rows of a group after which readers are told of them
  std::size_t bytes_per_flush = 64'000'000;  ///< of rows that are in memory, likewise: those with thousands of values
  double seconds_per_flush = 1;              ///< [s] of wall time after which append() writes what it holds
  std::size_t rows_per_chunk =
      1024;  ///< chunk length of the datasets, which are written in whole chunks: larger is faster, but each takes one at least
};

/// How far a recording has come, for a checkpoint: a resumed run finds out whether the file still holds these rows.
struct RecordedRows {
  std::vector<std::size_t> n_rows;        ///< of each group
  std::vector<std::uint64_t> check_sums;  ///< of all values of these rows
  bool operator==(const RecordedRows&) const = default;

  /// As numbers that a double holds exactly, and back; of another size: no rows, which no file has to fit.
  [[nodiscard]] std::vector<double> packed() const;
  static RecordedRows unpacked(const std::vector<double>& numbers);
};

/// Writes one result file. It is made with everything in it by the constructor or soon after, as the options say; from then on rows are
/// added and readers may open it at any time, also after the writer was killed (h5py: `h5py.File(path, "r")`; with `swmr=True` a reader
/// can follow what is added).
///
/// A row is on file in all channels before its time is: a reader that takes as many rows as there are times never sees half a row.
/// The file appears under its name complete with all datasets, or not at all. Not compressed: that would cost five times as much as
/// writing, and rewritten compressed chunks leave holes in the file.
///
/// Errors: SolverError with path and reason (disk full, no permission); after a failed write the rows up to the last flush stay
/// readable, and further calls throw again. std::invalid_argument if the caller's table of channels or a row is wrong.
class Recorder {
 public:
  /// @throws InputError if the file exists and options.overwrite is false; SolverError if it cannot be made
  Recorder(const std::filesystem::path& path, const RecordHeader& header, std::vector<SeriesGroup> groups,
           const RecorderOptions& options = {});
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();  ///< closes; errors are lost here, so call close() where they matter

  /// Adds a row to a group. Buffered; see RecorderOptions.
  /// @param time  [s], not smaller than the group's last one
  /// @param row   the group's channels one after the other [row_size(group)], SI
  void append(std::size_t group, double time, std::span<const double> row);
  /// Adds the rows of a tile; none of them if a time decreases or their size is wrong.
  void append(std::size_t group, const RowTile& rows);
  /// Writes what is buffered and makes it visible to readers. Call it before a checkpoint is written.
  void flush();
  /// Flushes, and has the system bring all of it to the disk: after a power cut the rows so far are there.
  RecordedRows sync();
  /// Flushes and closes; later calls of append and flush throw std::logic_error. Closing twice is harmless.
  void close();
  /// Gives the file another name, replacing what is there; goes on writing.
  void move_to(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] const std::vector<SeriesGroup>& groups() const;
  [[nodiscard]] std::size_t row_size(std::size_t group) const;
  /// Rows appended so far, buffered ones included.
  [[nodiscard]] std::size_t n_rows(std::size_t group) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rotordrop
