#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "analysis/drop.h"
#include "base/aligned_numbers.h"
#include "base/row_store.h"

namespace rotordrop {

/// One number over time.
struct SeriesInMemory {
  std::vector<double> times;   ///< [s], rising
  std::vector<double> values;  ///< of the same length
};

/// The series of a drop in memory, by the paths of their observables: those of the machine, of its details, of its sections' windows.
class MemorySeries {
 public:
  /// Tells by its path whether an observable is kept.
  using Choice = std::function<bool(const std::string& path)>;
  /// Takes all rows of a drop from now on. Must outlive the drop's run.
  /// @param is_kept  none: all are
  MemorySeries(const Machine& machine, Drop& drop, const Choice& is_kept = {});

  [[nodiscard]] bool has(const std::string& path) const;
  /// @throws std::out_of_range for a path or a column that is not kept
  [[nodiscard]] SeriesInMemory series(const std::string& path, std::size_t column = 0) const;
  /// Rows of an earlier part of the same run. @param read  numbers of a path, row after row; of paths of times, too
  void restore(const std::function<std::vector<double>(const std::string& path)>& read);

  /// An observable that is kept, and where it stands in a row.
  struct Kept {
    std::string path;
    std::string unit, long_name;
    std::size_t first = 0, size = 1;
    std::vector<std::string> columns;  ///< their names, if they have any
    std::size_t column = 0;            ///< its first among what is kept
  };
  /// Observables that have rows at the same times.
  class Group final : public RowSink {
   public:
    Group(std::string times_path, std::initializer_list<const std::vector<Observable>*> lists, const Choice& is_kept);
    void row(double time, std::span<const double> values) override;
    [[nodiscard]] bool takes_tiles() const override { return true; }
    void rows(const RowTile& tile) override;
    /// Of one that is kept, row after row.
    [[nodiscard]] std::vector<double> values(const Kept& k) const { return values(k.column, k.size); }
    /// Of neighbouring columns of what is kept, row after row.
    [[nodiscard]] std::vector<double> values(std::size_t column, std::size_t size) const;
    /// Rows that were kept elsewhere. @param read  as of MemorySeries::restore()
    void restore(const std::function<std::vector<double>(const std::string& path)>& read);
    std::string path;  ///< of the times: "/time"
    std::vector<double> times;
    std::vector<Kept> kept;

   private:
    struct Part {
      std::size_t first, size;
    };
    std::vector<Part> parts_;  // of a row, that are kept
    std::vector<double> row_;
    AlignedNumbers tile_;  // [columns that are kept][RowTile::width]
    RowStore rows_;
  };
  [[nodiscard]] const std::deque<Group>& groups() const { return groups_; }
  /// All that was kept; nothing is left here.
  [[nodiscard]] std::deque<Group> take() { return std::move(groups_); }

 private:
  [[nodiscard]] std::pair<const Group*, const Kept*> find(const std::string& path) const;
  std::deque<Group> groups_;
};

}  // namespace rotordrop
