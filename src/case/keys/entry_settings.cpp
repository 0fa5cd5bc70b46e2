#include "case/keys/entry_settings.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "case/keys/case_keys.h"

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

}  // namespace

bool names_entry(const Setting& setting) { return setting.key.find('[') != std::string::npos; }

void set_entries(Node& tree, const std::vector<Setting>& settings) {
  for (auto setting = settings.begin(); setting != settings.end(); ++setting) {
    if (!names_entry(*setting)) continue;
    const std::string list = list_of(*setting);
    const auto gives = [&](const Setting& later) { return gives_list(later, list); };
    if (std::none_of(std::next(setting), settings.end(), gives))
      set_key(tree, without_spaces(setting->key), setting->value, {setting->value.where().file, 0, 0});
  }
}

}  // namespace rotordrop
