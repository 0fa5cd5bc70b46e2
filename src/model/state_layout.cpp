#include "model/state_layout.h"

#include <stdexcept>

namespace rotordrop {

std::size_t StateLayout::add_block(const std::string& name, const std::vector<StateEntry>& entries) {
  blocks_.push_back({name, entries_.size(), entries.size()});
  for (const auto& entry : entries)
    entries_.push_back({name + "/" + entry.name, entry.unit, entry.scale, entry.long_name});
  return blocks_.size() - 1;
}

const StateBlock& StateLayout::block(const std::string& name) const {
  for (const auto& candidate : blocks_)
    if (candidate.name == name) return candidate;
  throw std::out_of_range("no state block named " + name);
}

std::string StateLayout::describe(std::size_t entry) const {
  const auto& e = entries_.at(entry);
  return e.name + " [" + e.unit + "]";
}

}  // namespace rotordrop
