#include "case/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/units.h"
#include "case/keys/dotted_names.h"

namespace rotordrop {
namespace {

constexpr std::array<const char*, 2> bounds = {"max", "min"};

void add_given_twice(const std::string& name, const Node::Entry& entry, const SourcePosition& before, Faults& faults) {
  faults.add(entry.where, fmt::format("limits.{}.{} is given twice.", name, entry.key),
             before.is_known() ? fmt::format("The other one is at {}.", to_string(before)) : "");
}

/// RESULT = { max, min } of all names; of a bound that is given twice the later one.
Node spelt(const Node& limits, Faults* faults) {
  Node result = Node::table(limits.where());
  for (const auto& [name, where, value] : flattened(limits, {bounds.begin(), bounds.end()})) {
    const Node::Entry* same = limits.entry(name);
    const Node* before = result.find(name);
    if (before && before->is_table() && value->is_table() && faults)
      for (const auto& entry : value->entries())
        if (const Node::Entry* other = before->entry(entry.key)) add_given_twice(name, entry, other->where, *faults);
    result.set(Node::Entry{name, where, before ? merged(*before, *value) : *value, same ? same->comment : ""});
  }
  return result;
}

}  // namespace

void spell_limits(Node& tree, const Node& base, Faults& faults) {
  const Node::Entry* limits = tree.entry("limits");
  if (!limits || !limits->value.is_table()) return;
  Node own = spelt(limits->value, &faults);
  const Node* under = base.find("limits");
  if (under && under->is_table())
    for (const auto& wide : std::vector(own.entries()))
      for (const auto& old : under->entries()) {
        if (!wide.value.is_table() || !old.value.is_table() || old.key == wide.key || !fits(old.key, wide.key))
          continue;
        for (const char* bound : bounds) {
          if (!wide.value.has(bound) || !old.value.has(bound)) continue;
          if (!own.has(old.key)) own.set(old.key, Node::table(wide.where), wide.where);
          if (Node* narrow = own.find(old.key); narrow->is_table() && !narrow->has(bound))
            narrow->set(bound, Node(), wide.where);
        }
      }
  tree.set(Node::Entry{"limits", limits->where, std::move(own), limits->comment});
}

void spell_set_limits(Node& tree) {
  const Node::Entry* limits = tree.entry("limits");
  if (limits && limits->value.is_table())
    tree.set(Node::Entry{"limits", limits->where, spelt(limits->value, nullptr), limits->comment});
}

void drop_replaced_limits(Node& tree) {
  Node* limits = tree.find("limits");
  if (!limits || !limits->is_table()) return;
  std::vector<std::string> gone;
  for (auto& entry : limits->entries()) {
    if (!entry.value.is_table() || entry.value.entries().empty()) continue;  // its reader says what is wrong
    for (const char* bound : bounds)
      if (const Node* value = entry.value.find(bound); value && value->is(Node::Kind::null)) entry.value.erase(bound);
    if (entry.value.entries().empty()) gone.push_back(entry.key);
  }
  for (const auto& name : gone) limits->erase(name);
}

void read_limits(const Node& table, std::vector<Limit>& limits, Faults& faults) {
  if (table.is(Node::Kind::null)) return;
  if (!table.is_table()) {
    faults.add(table.where(), "limits must be a table.", "Write [limits] and below it RESULT = { max = \"6 kN\" }.");
    return;
  }
  const std::size_t n_before = limits.size();
  for (const auto& [name, where, node] : flattened(table, {bounds.begin(), bounds.end()})) {
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
      const auto text_of = entry.key == "max" ? &Limit::max_text : &Limit::min_text;
      auto& text = limit.*text_of;
      const auto same =
          std::find_if(limits.begin() + static_cast<std::ptrdiff_t>(n_before), limits.end(),
                       [&](const Limit& other) { return other.pattern == limit.pattern && !(other.*text_of).empty(); });
      if (same != limits.end()) add_given_twice(name, entry, same->where, faults);
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
