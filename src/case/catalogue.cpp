#include "case/catalogue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/parameters/suggestion.h"
#include "base/units.h"
#include "case/bearing_sets.h"
#include "case/program_files.h"
#include "io/text/toml_reader.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

/// " (70 x 110 x 20 mm)" of a bearing of the catalogue; nothing of one that cannot be read.
std::string size_in_words(const fs::path& file) {
  Node bearing;
  try {
    bearing = read_toml(file);
  } catch (const InputError&) {
    return "";
  }
  std::vector<std::string> sizes;
  for (const char* key : {"bore_diameter", "outside_diameter", "width"})
    if (const Node* size = bearing.find(key); size && size->is_text())
      if (const auto read = convert_to_si(size->text(), "m", QuantityKind::plain))
        sizes.push_back(fmt::format("{:.4g}", read.value * 1e3));
  return sizes.empty() ? "" : fmt::format(" ({} mm)", fmt::join(sizes, " x "));
}

std::vector<fs::path> entries_of_catalogue(const fs::path& case_file) {
  std::vector<fs::path> files;
  for (const auto& folder : catalogue_folders(case_file)) {
    std::error_code ignored;
    for (const auto& other : fs::directory_iterator(folder, ignored))
      if (other.path().extension() == ".toml") files.push_back(other.path());
  }
  return files;
}

/// A sound bearing with the place, the supports and the laws of one whose catalogue data are not known.
Node stand_in(Node bearing, const fs::path& entry) {
  const Node data = read_toml(entry);
  for (const char* key : {"arrangement", "preload", "count", "bore_radius", "row_spacing"}) bearing.erase(key);
  bearing = merged(bearing, data);
  if (const Node* rings = data.find("outer_ring_diameters");
      rings && rings->is_array() && rings->items().size() == 2 && bearing.has("housing_diameters"))
    bearing.set("housing_diameters", Node::array({rings->items()[1], Node(100.)}));
  return bearing;
}

/// "6014" of "SKF 6014" and "6014-2RS": the longest known name within a text, with letters of makers and suffixes around it; the text if there is none.
std::string name_within(const std::string& text, const std::vector<std::string>& known) {
  std::string found;
  for (const auto& name : known)
    if (const auto at = text.find(name);
        at != std::string::npos && name.size() > found.size() &&
        (at == 0 || !std::isdigit(static_cast<unsigned char>(text[at - 1]))) &&
        (at + name.size() == text.size() || !std::isdigit(static_cast<unsigned char>(text[at + name.size()]))))
      found = name;
  return found.empty() ? text : found;
}

/// @param name  of the key's table: "bearings.TB1"
void load_entry(Node& bearing, const std::string& name, const fs::path& case_file, Faults& faults) {
  const Node* entry = bearing.is_table() ? bearing.find("catalogue") : nullptr;
  if (!entry) return;
  if (!entry->is_text()) {  // without it all that the bearing brings would be missing, too
    faults.add(entry->where(), fmt::format("{}.catalogue is {}; it must be a text in quotes.", name, kind_name(*entry)),
               entry->is_number() ? fmt::format("Write it as: catalogue = \"{}\"", to_text(*entry)) : "");
    faults.throw_if_any();
  }
  for (const auto& folder : catalogue_folders(case_file)) {
    const fs::path file = folder / (entry->text() + ".toml");
    std::error_code unreadable;
    if (fs::is_regular_file(file, unreadable)) {
      bearing = merged(read_toml(file), bearing);
      return;
    }
  }
  const std::vector<fs::path> files = entries_of_catalogue(case_file);
  std::vector<std::string> known, with_sizes;
  for (const fs::path& file : files) {
    known.push_back(file.stem().string());
    with_sizes.push_back(known.back() + size_in_words(file));
  }
  std::sort(with_sizes.begin(), with_sizes.end());
  faults.add(
      entry->where(), fmt::format("{}.catalogue = \"{}\": the catalogue has no such bearing.", name, entry->text()),
      suggestion(name_within(entry->text(), known), known, fmt::format("Known: {}.", fmt::join(with_sizes, ", "))));
  const std::string closest = closest_name(name_within(entry->text(), known), known);
  const auto like = std::find(known.begin(), known.end(), closest.empty() ? "6014" : closest);
  if (like == known.end()) faults.throw_if_any();
  bearing = stand_in(bearing, files[static_cast<std::size_t>(like - known.begin())]);
}

/// Values with which the layers below changed their entry of the catalogue, and which the data of another one replace.
void tell_what_goes(const std::string& name, const Node& bearing, const Node& under, const std::string& entry_under,
                    std::vector<Fault>& warnings) {
  const Node& catalogue = *bearing.find("catalogue");
  std::vector<std::string> gone;
  for (const auto& old : under.entries()) {
    const Node* now = bearing.find(old.key);
    if (now && is_from_catalogue(*now, catalogue.text()) && !is_from_catalogue(old.value, entry_under) &&
        to_text(*now) != to_text(old.value))
      gone.push_back(fmt::format("{} = {}", old.key, to_text(old.value)));
  }
  if (gone.empty()) return;
  warnings.push_back({catalogue.where(),
                      fmt::format("bearings.{}.catalogue = \"{}\" replaces what the layers below say of \"{}\": {}.",
                                  name, catalogue.text(), entry_under, fmt::join(gone, ", ")),
                      "Write again beside it what is meant for this bearing, too."});
}

bool is_touchdown(const Node& bearing) {
  const Node* type = bearing.is_table() ? bearing.find("type") : nullptr;
  return type && type->is_text() && type->text() == "touchdown";
}

}  // namespace

std::vector<fs::path> catalogue_folders(const fs::path& case_file) {
  std::vector<fs::path> folders;
  if (const char* chosen = std::getenv("ROTORDROP_PARAMS")) folders.push_back(fs::path(chosen) / "bearings");
  folders.push_back(case_file.parent_path() / "bearings");
  folders.push_back(params_folder() / "bearings");
  return folders;
}

void load_catalogue_bearings(Node& tree, const fs::path& file, const Node& base, LayerNotes& notes) {
  Node* bearings = tree.find("bearings");
  if (!bearings || !bearings->is_table()) return;
  const Node* under = base.find("bearings");
  for (auto& entry : bearings->entries()) {
    const Node* same = under ? under->find(entry.key) : nullptr;
    if (!same || !same->is_table() || !entry.value.is_table()) {
      load_entry(entry.value, "bearings." + entry.key, file, notes.faults);
      continue;
    }
    // The name that is there already brings nothing new: what the layers below say besides stays.
    const Node *name = entry.value.find("catalogue"), *name_under = same->find("catalogue");
    if (name && name_under && to_text(*name) == to_text(*name_under)) continue;
    const bool is_named = name && name->is_text();
    load_entry(entry.value, "bearings." + entry.key, file, notes.faults);  // the entry is another table now
    if (is_named && name_under && name_under->is_text())
      tell_what_goes(entry.key, entry.value, *same, name_under->text(), notes.warnings);
    keep_set(entry.value, *same);
  }
}

void load_common_catalogue(Node& tree, const fs::path& file, Faults& faults) {
  Node* bearings = tree.find("bearings");
  if (!bearings || !bearings->is_table()) return;
  for (const char* key : {"catalogue", "count"}) {
    const Node* found = bearings->find(key);
    if (!found || found->is_table()) continue;  // a bearing of that name
    const Node common = *found;
    const SourcePosition where = position_of(*bearings, key);
    const bool is_catalogue = key == std::string_view("catalogue");
    const fs::path folder_of = common.where().line == 0 ? file : fs::path(common.where().file.text());
    for (auto& entry : bearings->entries()) {
      if (!is_touchdown(entry.value) || entry.value.has(key)) continue;
      entry.value.set(key, common, where);
      if (is_catalogue) load_entry(entry.value, "bearings", folder_of, faults);
    }
  }
}

}  // namespace rotordrop
