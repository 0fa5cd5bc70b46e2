#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/many/design.h"
#include "study/many/journal.h"

namespace rotordrop {

enum class PointStatus : int { done = 0, failed = 1, not_run = 2 };

/// One quantity over all points of a study.
struct ResultColumn {
  std::string name, unit, long_name;
  std::vector<double> values;  ///< [points]; NaN: failed, not run, or it has not happened
};

/// All points of a study in the order of the design.
struct StudyTable {
  std::size_t n_points = 0;
  std::vector<PointStatus> status;
  std::vector<std::string> reason;
  std::vector<ResultColumn> results;
  double cpu_time = 0;                                     ///< [s]
  std::map<std::size_t, std::vector<PointSeries>> series;  ///< by point

  [[nodiscard]] std::size_t count(PointStatus of) const;
  [[nodiscard]] const ResultColumn* find(const std::string& name) const;
};

StudyTable make_table(const Study& study, const Design& design, const std::map<std::size_t, PointRecord>& records,
                      const std::vector<std::vector<std::string>>& layouts);

/// study.h5 and study.csv: the same table gives the same bytes.
void write_study_hdf5(const std::filesystem::path& file, const Study& study, const Design& design,
                      const StudyTable& table, const std::string& digest);
void write_study_csv(const std::filesystem::path& file, const Study& study, const Design& design,
                     const StudyTable& table);

}  // namespace rotordrop
