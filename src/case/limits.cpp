#include "case/limits.h"

#include <fmt/format.h>

#include "base/units.h"
#include "case/keys/dotted_names.h"

namespace rotordrop {

void read_limits(const Node& table, std::vector<Limit>& limits, Faults& faults) {
  if (table.is(Node::Kind::null)) return;
  if (!table.is_table()) {
    faults.add(table.where(), "limits must be a table.", "Write [limits] and below it RESULT = { max = \"6 kN\" }.");
    return;
  }
  for (const auto& [name, where, node] : flattened(table, {"max", "min"})) {
    Limit limit{name, {}, {}, {}, {}, where};
    if (!node->is_table()) {
      faults.add(where, fmt::format("limits.{} is neither a max nor a min of a result.", name),
                 "Write RESULT.max = \"6 kN\" or RESULT = { max = \"6 kN\", min = 0 }. Known: max, min.");
      continue;
    }
    for (const auto& entry : node->entries()) {
      if (entry.key != "max" && entry.key != "min") {
        faults.add(entry.where, fmt::format("unknown key \"{}\" in limits.{}.", entry.key, name), "Known: max, min.");
        continue;
      }
      auto& text = entry.key == "max" ? limit.max_text : limit.min_text;
      if (entry.value.is_text())
        text = entry.value.text();
      else if (entry.value.is_number())
        text = shortest(entry.value.number());
      else
        faults.add(entry.where, fmt::format("limits.{}.{} must be a number or a quantity.", name, entry.key));
    }
    if (limit.max_text.empty() && limit.min_text.empty())
      faults.add(where, fmt::format("limits.{} has neither max nor min.", name), "For example { max = \"6 kN\" }.");
    limits.push_back(std::move(limit));
  }
}

}  // namespace rotordrop
