#include "io/hdf5/recorded_group.h"

#include <array>
#include <bit>

namespace rotordrop {
namespace {

std::uint64_t mixed(std::uint64_t sum, std::uint64_t bits) {
  sum = (sum ^ bits) * 0x9e3779b97f4a7c15U;
  return sum ^ (sum >> 32);
}

/// Mixes a row's bits into a check sum. Each multiplication waits for the one before it, so there are four sums.
std::uint64_t mixed(std::uint64_t sum, double time, std::span<const double> row) {
  constexpr std::size_t n_sums = 4;
  std::array<std::uint64_t, n_sums> sums = {sum, 1, 2, 3};
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::size_t i = 0;
  for (; i + n_sums <= row.size(); i += n_sums)
    for (std::size_t k = 0; k < n_sums; ++k) sums[k] = mixed(sums[k], bits(row[i + k]));
  for (; i < row.size(); ++i) sums[0] = mixed(sums[0], bits(row[i]));
  std::uint64_t all = bits(time);
  for (const std::uint64_t part : sums) all = mixed(all, part);
  return all;
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
  last_time = t;
  times.push_back(t);
  rows.append(row);
  check_sum = mixed(check_sum, t, row);
}

void RecordedGroup::write_columns() {
  const std::size_t n = rows.n_rows();
  if (n == 0) return;
  for_each_column(columns, rows, [&](const SeriesColumn& column, std::span<const double> values) {
    write_rows(column, n_rows() - n, values);
  });
  rows.clear();
}

void RecordedGroup::write_times() {
  if (times.empty()) return;
  write_rows(time, n_told, times);
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
