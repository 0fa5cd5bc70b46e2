#pragma once
#include <deque>
#include <string>
#include <vector>

#include "analysis/drop.h"

namespace rotordrop {

/// One number over time.
struct SeriesInMemory {
  std::vector<double> times;   ///< [s], rising
  std::vector<double> values;  ///< of the same length
};

/// The series of a drop in memory, by the paths of their observables: those of the machine, of its details, of its sections' windows.
class MemorySeries {
 public:
  /// Takes all rows of a drop from now on. Must outlive the drop's run.
  /// @param paths  of the observables that are kept; empty: all
  MemorySeries(const Machine& machine, Drop& drop, const std::vector<std::string>& paths = {});

  [[nodiscard]] bool has(const std::string& path) const;
  /// @throws std::out_of_range for a path or a column that is not kept
  [[nodiscard]] SeriesInMemory series(const std::string& path, std::size_t column = 0) const;
  /// Paths that are kept, in the order of the rows.
  [[nodiscard]] std::vector<std::string> paths() const;

 private:
  /// An observable that is kept, and where it stands in a row.
  struct Kept {
    std::string path;
    std::size_t first = 0, size = 1;
    std::vector<double> values;  // row after row
  };
  /// Observables that have rows at the same times.
  class Group final : public RowSink {
   public:
    Group(std::initializer_list<const std::vector<Observable>*> lists, const std::vector<std::string>& paths);
    void row(double time, std::span<const double> values) override;
    std::vector<double> times;
    std::vector<Kept> kept;
  };
  [[nodiscard]] std::pair<const Group*, const Kept*> find(const std::string& path) const;
  std::deque<Group> groups_;
};

}  // namespace rotordrop
