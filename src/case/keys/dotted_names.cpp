#include "case/keys/dotted_names.h"

#include <algorithm>

namespace rotordrop {
namespace {

void flatten(const Node& table, const std::string& path, const std::vector<std::string>& stop,
             std::vector<NamedNode>& to) {
  for (const auto& entry : table.entries()) {
    const std::string name = path.empty() ? entry.key : path + "." + entry.key;
    const bool is_inner =
        entry.value.is_table() && !entry.value.entries().empty() &&
        std::none_of(stop.begin(), stop.end(), [&](const auto& word) { return entry.value.has(word); });
    if (is_inner && path.size() < 500)
      flatten(entry.value, name, stop, to);
    else
      to.push_back({name, entry.where.is_known() ? entry.where : entry.value.where(), &entry.value});
  }
}

}  // namespace

std::vector<NamedNode> flattened(const Node& table, const std::vector<std::string>& stop) {
  std::vector<NamedNode> result;
  flatten(table, "", stop, result);
  return result;
}

bool fits(const std::string& name, const std::string& pattern) {
  // Greedy matching with one point to return to; a star takes no dot.
  std::size_t n = 0, p = 0, star = std::string::npos, from = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      from = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string::npos && name[from] != '.') {
      p = star + 1;
      n = ++from;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace rotordrop
