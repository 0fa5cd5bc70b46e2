#pragma once
// What `rotordrop preload` writes into HDF5, table by table.
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/statics/running_bearing.h"
#include "case/case.h"
#include "io/hdf5/recorder.h"

namespace rotordrop {

/// Rows of numbers over an axis; becomes one group of datasets.
struct PreloadTable {
  SeriesGroup group;
  std::vector<double> axis;
  std::vector<std::vector<double>> rows;
};

/// Tabulated quantities of a running bearing, in order, at `prefix` + name.
std::vector<Channel> running_channels(const std::string& prefix, std::size_t size = 1,
                                      const std::vector<std::string>& columns = {});
/// The same numbers, of one state; NaN for what is not there.
std::vector<double> running_values(const RunningState& state);

/// @throws InputError if the file is there and must not be replaced
void write_tables(const std::filesystem::path& file, const Case& preload_case, const std::vector<PreloadTable>& tables,
                  bool overwrite);

/// Called before each search; what it throws ends all of them.
using Look = std::function<void()>;

/// KINSOL's search, for the machine. Throws a SolverError where nothing is found.
FindRest rest_finder(const std::string& bearing, Look look = {});

}  // namespace rotordrop
