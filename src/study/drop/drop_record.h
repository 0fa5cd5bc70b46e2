#pragma once
#include <deque>
#include <filesystem>
#include <optional>

#include "analysis/drop.h"
#include "analysis/memory_series.h"
#include "case/case.h"
#include "io/hdf5/recorder.h"

namespace rotordrop {

/// The series of a drop in DIRECTORY/results.h5.
class DropRecord {
 public:
  DropRecord(const std::filesystem::path& directory, const Case& drop_case, const Machine& machine, Drop& drop);

  /// A new file. @param overwrite  one that is there  @param in_lanes  the drop runs in lanes, which the file tells
  void open(bool overwrite, bool in_lanes);
  /// The file of an interrupted run, cut at a time. @throws DamagedFile if it lacks rows that were `recorded` by then
  /// @param series  gets the rows that the file keeps
  void resume(double time, const RecordedRows& recorded, MemorySeries& series);
  /// On the disk. @returns how far it has come
  RecordedRows sync() { return recorder_->sync(); }
  void close() { recorder_->close(); }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  /// A group of the file.
  class Group final : public RowSink {
   public:
    Group(DropRecord& record, std::size_t index) : record_(record), index_(index) {}
    void row(double time, std::span<const double> values) override { record_.recorder_->append(index_, time, values); }
    [[nodiscard]] bool takes_tiles() const override { return true; }
    void rows(const RowTile& tile) override { record_.recorder_->append(index_, tile); }

   private:
    DropRecord& record_;
    std::size_t index_;
  };
  /// @returns who takes its rows
  RowSink& add_group(const std::string& times, std::initializer_list<const std::vector<Observable>*> lists);

  std::filesystem::path file_;
  const Case& case_;
  std::vector<SeriesGroup> groups_;
  std::deque<Group> sinks_;
  std::optional<Recorder> recorder_;
};

}  // namespace rotordrop
