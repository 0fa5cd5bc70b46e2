#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

/// One allowed band of a result.
struct Limit {
  std::string pattern;             ///< of a result's name, "*" stands for any text without a dot
  std::optional<double> min, max;  ///< SI
  std::string min_text, max_text;  ///< as given, resolved when the result's unit is known
  SourcePosition where;
};

/// Reads [limits]: RESULT = { max = "6 kN" }, { min = 1 } or both. A bound that is given twice, in whatever spelling, is a fault.
void read_limits(const Node& table, std::vector<Limit>& limits, Faults& faults);

/// Brings the limits of one layer of a case into one spelling, "RESULT" = { max, min }, so that a bound replaces that of the layers below however
/// each of them is spelt. A name with * replaces the bounds of all names below that fit it: drop_replaced_limits() takes them out in the end.
/// @param tree  of the layer  @param base  what it will be laid over, in this spelling
void spell_limits(Node& tree, const Node& base, Faults& faults);

/// The same of settings that have been put into a tree in this spelling: the later one holds.
void spell_set_limits(Node& tree);

void drop_replaced_limits(Node& tree);

}  // namespace rotordrop
