#pragma once
#include <string>
#include <vector>

#include "study/many/study_file.h"

namespace rotordrop {

/// One entry of a table whose keys are dotted names, written as one key or as nested tables.
struct NamedNode {
  std::string name;
  SourcePosition where;
  const Node* value;
};
/// Entries of a table by their dotted names: tables that hold none of `words` are followed.
std::vector<NamedNode> flattened(const Node& table, const std::vector<std::string>& words);

/// Reads [vary] into study.parameters; study.base must be read.
void read_vary(const Node& table, Study& study, Faults& faults);

}  // namespace rotordrop
