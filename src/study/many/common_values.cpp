#include "study/many/common_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "io/text/toml_text.h"

namespace rotordrop {
namespace {

/// Those of all bearings, without "bearings." and without the place in a list.
std::vector<std::string> common_keys(const Case& c, const std::vector<std::string>& keys) {
  std::vector<std::string> common;
  const auto is_bearing = [&](const std::string& name) {
    return std::any_of(c.parameters.bearings.begin(), c.parameters.bearings.end(),
                       [&](const auto& bearing) { return bearing.name == name; });
  };
  for (const std::string& key : keys) {
    const std::string table = "bearings.";
    if (!key.starts_with(table)) continue;
    const std::string last = key.substr(table.size(), key.find('[') - table.size());
    if (last.find('.') == std::string::npos && !is_bearing(last)) common.push_back(last);
  }
  return common;
}

/// Whether a bearing has the value from elsewhere than its own table and its catalogue entry.
bool takes_common_value(const Case& c, const std::string& bearing, const std::string& key) {
  return !c.tree.find("bearings")->find(bearing)->has(key);
}

}  // namespace

std::string text_with_common_values(const Case& c, const std::vector<std::string>& keys) {
  const auto common = common_keys(c, keys);
  if (common.empty()) return c.resolved.text;
  const auto touchdowns = touchdown_names(c.parameters);
  std::istringstream lines(c.resolved.text);
  std::string text, bearing;
  std::map<std::string, std::string> moved;  // lines by key
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) {
      const auto found = std::find_if(touchdowns.begin(), touchdowns.end(), [&](const std::string& name) {
        return line.starts_with("[bearings." + toml_key(name) + "]");
      });
      bearing = found == touchdowns.end() ? "" : *found;
    }
    const std::string key = line.substr(0, line.find(' '));
    const bool is_common = !bearing.empty() && std::find(common.begin(), common.end(), key) != common.end() &&
                           takes_common_value(c, bearing, key);
    if (is_common)
      moved.emplace(key, line);
    else
      text += line + "\n";
  }
  if (!moved.empty()) text += "\n[bearings]\n";
  for (const auto& [key, line] : moved) text += line + "\n";
  return text;
}

std::vector<Fault> common_values_without_effect(const Case& c, const std::vector<std::string>& keys,
                                                const SourcePosition& where) {
  const auto touchdowns = touchdown_names(c.parameters);
  std::vector<Fault> warnings;
  for (const auto& key : common_keys(c, keys))
    if (!touchdowns.empty() && std::none_of(touchdowns.begin(), touchdowns.end(), [&](const std::string& bearing) {
          return takes_common_value(c, bearing, key);
        }))
      warnings.push_back(
          {where, fmt::format("bearings.{} has no effect: every touchdown bearing has a value of its own.", key),
           fmt::format("Vary bearings.{}.{}, or one name for that of every bearing.", touchdowns.front(), key)});
  return warnings;
}

}  // namespace rotordrop
