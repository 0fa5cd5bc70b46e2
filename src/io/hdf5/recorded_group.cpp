#include "io/hdf5/recorded_group.h"

#include <bit>

namespace rotordrop {
namespace {

/// Check sum of consecutive values of a column, the first of them at the place `first`. Each value's part depends only on the value and its place, so it does
/// not matter how many come at a time.
std::uint64_t sum_of(std::uint64_t column, std::uint64_t first, std::span<const double> values) {
  constexpr std::uint64_t per_column = 0xbf58476d1ce4e5b9U, per_place = 0x94d049bb133111ebU,
                          factor = 0x9e3779b97f4a7c15U;
  std::uint64_t sum = 0, place = (column + 1) * per_column + first * per_place;
  for (const double value : values) {
    // Round numbers have only high bits, and a product carries only upwards: the upper half is folded into the lower one first.
    std::uint64_t bits = std::bit_cast<std::uint64_t>(value) ^ place;
    bits = (bits ^ (bits >> 32)) * factor;
    sum += bits ^ (bits >> 32);
    place += per_place;
  }
  return sum;
}

/// Calls take(column, values [n_rows, size]) with the rows of each: of columns, or of channels that have none yet.
template <class Columns, class Take>
void for_each_column(const Columns& columns, const RowStore& rows, const Take& take) {
  std::vector<double> values;
  std::size_t first = 0;  // value of the column in a row
  for (const auto& column : columns) {
    values.resize(rows.n_rows() * column.size);
    rows.copy(first, column.size, values.data());
    take(column, values);
    first += column.size;
  }
}

}  // namespace

void RecordedGroup::append(double t, std::span<const double> row) {
  append_with({&t, 1}, [&] { rows.append(row); });
}

void RecordedGroup::append(const RowTile& tile) {
  append_with(tile.times, [&] { rows.append(tile); });
}

template <class Append>
void RecordedGroup::append_with(std::span<const double> of_rows, const Append& append_rows) {
  times.insert(times.end(), of_rows.begin(), of_rows.end());
  try {
    append_rows();
  } catch (...) {  // a time without its row would shift all that follow
    times.resize(times.size() - of_rows.size());
    throw;
  }
  last_time = of_rows.back();
}

void RecordedGroup::write_columns() {
  const std::size_t n = rows.n_rows(), from = n_rows() - n;
  if (n == 0) return;
  std::uint64_t number = 0;
  for_each_column(columns, rows, [&](const SeriesColumn& column, std::span<const double> values) {
    write_rows(column, from, values);
    check_sum += sum_of(++number, from * column.size, values);
  });
  rows.clear();
}

void RecordedGroup::write_times() {
  if (times.empty()) return;
  write_rows(time, n_told, times);
  check_sum += sum_of(0, n_told, times);
  n_told += times.size();
  times.clear();
}

void RecordedGroup::write_whole(const SeriesGroup& description, ColumnMaker& maker) const {
  const std::size_t n = rows.n_rows();
  write_all_rows(maker.make(description.times(), description.time_path, n), times);
  for_each_column(description.channels, rows, [&](const Channel& channel, std::span<const double> values) {
    write_all_rows(maker.make(channel, description.time_path, n), values);
  });
}

}  // namespace rotordrop
