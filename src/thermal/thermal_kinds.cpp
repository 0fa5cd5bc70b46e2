#include "thermal/thermal_kinds.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "base/parameters/declared_keys.h"
#include "base/utf8.h"
#include "thermal/circuit/lumped_kind.h"
#include "thermal/section/fe_kind.h"
#include "thermal/thermal_parameters.h"

namespace rotordrop {
namespace {

struct Registry {
  std::mutex lock;
  std::deque<ThermalKind> kinds = {lumped_kind(), fe_kind()};  // grows without moving what it holds
};
Registry& registry() {
  static Registry kinds;
  return kinds;
}

}  // namespace

std::vector<const ThermalKind*> thermal_kinds() {
  const std::lock_guard lock(registry().lock);
  std::vector<const ThermalKind*> all;
  for (const auto& kind : registry().kinds) all.push_back(&kind);
  return all;
}

const ThermalKind* thermal_kind(const std::string& name) {
  for (const auto* kind : thermal_kinds())
    if (kind->name == name) return kind;
  return nullptr;
}

std::vector<std::string> thermal_kind_names() {
  std::vector<std::string> names;
  for (const auto* kind : thermal_kinds()) names.push_back(kind->name);
  return names;
}

void check_thermal_kind(const ThermalKind& kind) {
  if (const auto fault = fault_of_name("a thermal model", kind.name); !fault.empty())
    throw std::invalid_argument(fault);
  const auto words = driver_words();
  // Its name is a word of thermal.driver, a table in [thermal], a group of the results and a key of each bearing's summary.
  if (std::find(words.begin(), words.end(), kind.name) != words.end() || thermal_section().erased()->find(kind.name) ||
      is_group_of_results(kind.name))
    throw std::invalid_argument("a thermal model cannot be called \"" + kind.name +
                                "\": the name is taken, by a key of [thermal] or by what results hold; choose another "
                                "of letters, digits, _ and -");
  const std::string called = "thermal model \"" + kind.name + "\": ";
  if (!kind.make && !kind.read) throw std::invalid_argument("nothing makes the thermal model \"" + kind.name + "\"");
  if (!kind.group.empty() && kind.group != "/" + kind.name + "/")
    throw std::invalid_argument(called + "its group cannot be another than /" + kind.name + "/: leave it empty");
  if (kind.is_unmarked || kind.meshes_sections)
    throw std::invalid_argument(called + "is_unmarked and meshes_sections are of the program's own models");
  for (const auto* text : {&kind.title, &kind.word, &kind.mark})
    if (!is_utf8(*text)) throw std::invalid_argument(called + "its title, word or mark is no UTF-8");
  if (!kind.section) return;
  if (const std::string fault = fault_of_keys(*kind.section, {}); !fault.empty())
    throw std::invalid_argument(called + fault);
}

void add_thermal_kind(ThermalKind kind) {
  check_thermal_kind(kind);
  if (kind.title.empty()) kind.title = "thermal model \"" + kind.name + "\"";
  if (kind.word.empty()) kind.word = kind.title;
  if (kind.mark.empty()) kind.mark = kind.name;
  if (kind.group.empty()) kind.group = "/" + kind.name + "/";
  const std::lock_guard lock(registry().lock);
  registry().kinds.push_back(std::move(kind));
}

}  // namespace rotordrop
