#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rotordrop {

/// One entry of the state vector.
struct StateEntry {
  std::string name;            ///< e.g. "TB2/inner ring spin"; used in messages and as a dataset name
  std::string unit;            ///< UDUNITS text of the SI unit
  double scale = 1;            ///< typical size; absolute tolerance = relative tolerance * scale
  std::string long_name = {};  ///< what it is, in words; empty: the name says it
};

/// A contiguous run of entries owned by one part.
struct StateBlock {
  std::string name;
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// The one table of the state vector: who owns which entries, in which unit, of what typical size.
/// Tolerances, dataset names, the checkpoint's check and messages all come from it.
class StateLayout {
 public:
  /// Appends a block; returns its index. The entries' names are prefixed with "block/".
  std::size_t add_block(const std::string& name, const std::vector<StateEntry>& entries);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] const StateBlock& block(std::size_t index) const { return blocks_.at(index); }
  /// @throws std::out_of_range if there is no block of that name
  [[nodiscard]] const StateBlock& block(const std::string& name) const;
  [[nodiscard]] const std::vector<StateBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const std::vector<StateEntry>& entries() const { return entries_; }
  /// "TB2/inner ring spin [rad/s]"
  [[nodiscard]] std::string describe(std::size_t entry) const;

 private:
  std::vector<StateBlock> blocks_;
  std::vector<StateEntry> entries_;
};

}  // namespace rotordrop
