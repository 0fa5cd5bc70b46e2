#pragma once
#include <string>
#include <vector>

#include "base/node.h"

namespace rotordrop {

/// One entry of a table whose keys are dotted names, written as one key or as nested tables.
struct NamedNode {
  std::string name;
  SourcePosition where;
  const Node* value;
};
/// Entries of a table by their dotted names: tables that hold none of `words` are followed.
std::vector<NamedNode> flattened(const Node& table, const std::vector<std::string>& words);

/// Whether a dotted name fits a pattern such as "bearings.*.peak_contact_force": a star stands for any text without a dot.
bool fits(const std::string& name, const std::string& pattern);

}  // namespace rotordrop
