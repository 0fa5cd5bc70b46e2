#include "case/keys/entry_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "case/keys/case_keys.h"
#include "io/text/comments.h"

namespace rotordrop {
namespace {

std::string without_spaces(std::string key) {
  key.erase(std::remove(key.begin(), key.end(), ' '), key.end());
  return key;
}

/// The list that an entry's setting is about: "rotor.unbalance".
std::string list_of(const Setting& entry) { return without_spaces(entry.key.substr(0, entry.key.find('['))); }

/// Whether a setting gives a whole list, by its name or within a table.
bool gives_list(const Setting& setting, const std::string& list) {
  if (names_entry(setting)) return false;
  Node given = Node::table();
  apply_setting(given, setting);
  const Node* node = &given;
  for (const KeyStep& step : steps_of(list, {})) node = node && node->is_table() ? node->find(step.key) : nullptr;
  return node != nullptr;
}

/// The place of a list stands for all of it: it says so where --set gives one entry of it.
void tell_entry_in_origin(Node& tree, const std::string& key, const SourcePosition& given_by) {
  const auto steps = steps_of(key, {});
  if (steps.back().entries.empty()) return;  // a key in a table of a list has a place of its own
  Node* node = &tree;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    node = node->find(steps[i].key);
    for (const std::size_t entry : steps[i].entries) node = &node->items().at(entry);
  }
  const auto found = std::find_if(node->entries().begin(), node->entries().end(),
                                  [&](const Node::Entry& entry) { return entry.key == steps.back().key; });
  if (found == node->entries().end() || found->where == given_by) return;
  if (found->where.line == 0) {  // of no line that could be told beside it
    found->where = given_by;
    return;
  }
  std::string place;
  for (const std::size_t entry : steps.back().entries) place += fmt::format("[{}]", entry);
  const Node::Entry by{"", given_by, {}};
  found->comment = fmt::format("{}{}; {} from {}", origin_mark, origin_text(*found), place, origin_text(by));
}

}  // namespace

bool names_entry(const Setting& setting) { return setting.key.find('[') != std::string::npos; }

void set_entries(Node& tree, const std::vector<Setting>& settings) {
  for (auto setting = settings.begin(); setting != settings.end(); ++setting) {
    if (!names_entry(*setting)) continue;
    const std::string list = list_of(*setting);
    const auto gives = [&](const Setting& later) { return gives_list(later, list); };
    if (std::any_of(std::next(setting), settings.end(), gives)) continue;
    const SourcePosition given_by{setting->value.where().file, 0, 0};
    set_key(tree, without_spaces(setting->key), setting->value, given_by);
    tell_entry_in_origin(tree, without_spaces(setting->key), given_by);
  }
}

}  // namespace rotordrop
