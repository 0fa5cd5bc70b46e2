#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "study/time_series.h"

namespace rotordrop {

/// [[measured]]: a measured quantity, and which series of a drop it is.
struct MeasuredParameters {
  std::string file;
  std::string series;                      ///< path of a dataset of results.h5
  int component = 0;                       ///< column of that dataset
  std::optional<std::string> time, value;  ///< columns of the file, by name; datasets of an HDF5 file
  std::string time_unit, unit;             ///< of columns whose names tell none
  std::optional<std::string>
      deviation;                      ///< standard deviation of the noise: a number in the values' unit, or a quantity
  std::optional<double> bandwidth;    ///< of the sensor, -3 dB [Hz]
  double delay = 0;                   ///< of the sensor [s]
  std::optional<double> from, until;  ///< part that counts, in the measurement's time [s]
};
Section<MeasuredParameters> measured_section();

/// A measured quantity in SI.
struct Measured {
  MeasuredParameters keys;
  std::string name;                 ///< "/bearings/TB1/orbit[0]"
  std::string unit;                 ///< SI
  TimeSeries data;                  ///< times that count only
  TimeSeries after_end;             ///< what was measured after the end of the drop: no part of `data`
  std::optional<double> deviation;  ///< SI
};

/// A measured quantity without its numbers.
Measured described(const MeasuredParameters& keys);

/// Reads a file. @param folder  where relative names begin. @throws InputError
Measured read_measured(const MeasuredParameters& keys, const std::filesystem::path& folder,
                       const SourcePosition& where);
/// All columns of a table (CSV) whose names are series: "time [ms], /bearings/TB1/orbit[0] [um]". A file that ends in .toml has [[measured]] tables.
/// @throws InputError
std::vector<Measured> read_measured_file(const std::filesystem::path& file);

/// Whether a dataset of results.h5 holds the times of others, as "/time" and "/detail/time" do.
bool is_axis_of_times(const std::string& series);

/// Whether numbers in two SI units are the same, as in "J" and "N m".
bool is_same_unit(const std::string& a, const std::string& b);

/// Moves what a sensor shows of times after the end of a drop from `data` to `after_end`. @throws InputError if no value is left
/// @param end  last instant that is known of the quantity [s]
void leave_out_after(Measured& measured, double end, const SourcePosition& where);
/// "values of /bearings/TB1/orbit[0] after the end are left out: 12 of 500."; empty if none was left out.
std::string left_out_text(const Measured& measured, double end);
/// Last instant of a drop that the values are compared with [s].
double last_compared(const Measured& measured);

/// What a sensor with a bandwidth (first order) and a delay shows of a quantity, at the times of a measurement.
std::vector<double> sensed(const TimeSeries& quantity, const Measured& by);

/// Difference of a measured quantity and what a drop says of it.
struct MeasuredDifference {
  std::size_t n = 0;
  double rms = 0, mean = 0, largest = 0, largest_time = 0;  ///< measured - computed
  double share = 0;  ///< 1 - sum of squares over that about the measured mean (R^2); NaN for a constant
};
MeasuredDifference difference_of(const Measured& measured, const std::vector<double>& computed);

}  // namespace rotordrop
