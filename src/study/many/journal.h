#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "study/many/evaluate_point.h"

namespace rotordrop {

/// One finished point, done or failed.
struct PointRecord {
  std::size_t point = 0;
  bool is_done = false;
  std::string reason;      ///< of a failure, or what a second try changed
  double cpu_time = 0;     ///< [s]
  std::size_t layout = 0;  ///< which list of names its values follow
  std::vector<double> values;
  std::vector<PointSeries> series;
  std::vector<double> at;  ///< of a search: values of the parameters that it changes, SI
};

/// A finished point as it was computed. @param layouts  of its journal
PointResult result_of(const PointRecord& record, const std::vector<std::vector<std::string>>& layouts);

/// Finished points of a study in an append-only file. Each line carries its own check sum: of a killed program at most the last line is
/// lost, and its point is computed again.
class Journal {
 public:
  struct Content {
    std::string header;                             ///< what the study is, as its writer gave it
    std::vector<std::vector<std::string>> layouts;  ///< names of values
    std::map<std::size_t, PointRecord> records;     ///< by point
    std::size_t valid_bytes = 0;
  };
  /// @throws InputError if the file is no journal. A damaged end is left out.
  static Content read(const std::filesystem::path& file);
  /// Its header alone: its first line. @throws InputError likewise
  static std::string header_of(const std::filesystem::path& file);

  /// A new file, or one to go on with after `content`, whose damaged end is cut off. @throws SolverError
  Journal(std::filesystem::path file, const std::string& header);
  Journal(std::filesystem::path file, const Content& content);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// Adds a finished point; safe from several threads. @throws SolverError if it cannot be written
  void append(std::size_t point, const PointResult& result, double cpu_time);
  /// Has the system bring all to the disk.
  void sync();

 private:
  void write_line(const std::string& json);
  std::filesystem::path file_;
  int handle_ = -1;
  std::mutex lock_;
  std::vector<std::vector<std::string>> layouts_;
  double last_sync_ = 0;
};

}  // namespace rotordrop
