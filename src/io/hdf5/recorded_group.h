#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/row_store.h"
#include "io/hdf5/series_column.h"

namespace rotordrop {

/// Rows of series at common times while they are recorded: on their way from memory into the columns of a file.
struct RecordedGroup {
  SeriesColumn time;
  std::vector<SeriesColumn> columns;
  std::vector<double> times;  ///< of the rows that readers are not yet told of
  RowStore rows;              ///< the last of these, in no column yet
  std::size_t n_told = 0;
  double last_time = -std::numeric_limits<double>::infinity();
  std::uint64_t check_sum = 0;  ///< of all values and times that were written; after write_times() of all rows

  [[nodiscard]] std::size_t n_rows() const { return n_told + times.size(); }
  /// Keeps a row, or nothing where there is no room for it. @param row [rows.row_size()]
  void append(double time, std::span<const double> row);
  /// Keeps several.
  void append(const RowTile& tile);
  /// Writes the rows that are in no column yet. Nobody is told of them before write_times(). @throws SolverError
  void write_columns();
  /// Tells of all rows that are in the columns. @throws SolverError
  void write_times();
  /// Makes datasets of all rows, which were in no column so far, and closes them. @throws SolverError
  void write_whole(const SeriesGroup& description, ColumnMaker& maker) const;

 private:
  template <class Append>
  void append_with(std::span<const double> of_rows, const Append& append_rows);
};

}  // namespace rotordrop
