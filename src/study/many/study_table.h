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

/// The shard's own file beside a study's: which rows it holds.
struct ShardFile {
  std::filesystem::path file;  ///< seen from the folder of study.h5
  std::size_t shard = 1, n_shards = 1;
};

/// study.h5 and study.csv: the same table gives the same bytes.
/// @param shards  where given, results and series are virtual datasets over these files
void write_study_hdf5(const std::filesystem::path& file, const Study& study, const Design& design,
                      const StudyTable& table, const std::string& digest, const std::vector<ShardFile>& shards = {});
/// shard.h5: the rows of one shard, and which points they are.
void write_shard_hdf5(const std::filesystem::path& file, const Study& study, const Design& design,
                      const StudyTable& table, const std::string& digest, std::size_t shard, std::size_t n_shards);
void write_study_csv(const std::filesystem::path& file, const Study& study, const Design& design,
                     const StudyTable& table);

}  // namespace rotordrop
