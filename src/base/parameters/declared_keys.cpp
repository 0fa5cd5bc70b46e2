#include "base/parameters/declared_keys.h"

#include <algorithm>
#include <cctype>

#include "base/utf8.h"

namespace rotordrop {
namespace {

std::string fault_of_key(const Declaration& d) {
  if (auto fault = fault_of_name("a key", d.key); !fault.empty()) return fault;
  for (const auto* text : {&d.help, &d.source})
    if (!is_utf8(*text)) return "what is said of the key \"" + d.key + "\" is no UTF-8";
  for (const auto* unit : {&d.unit, &d.argument_unit})
    if (!unit->empty() && !(is_utf8(*unit) && is_unit(*unit)))
      return "the unit of the key \"" + d.key + "\" is not known";
  return d.nested ? fault_of_keys(*d.nested, {}) : "";
}

}  // namespace

std::string fault_of_name(const std::string& what, const std::string& name) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (!name.empty() && std::all_of(name.begin(), name.end(), is_plain)) return "";
  return what + " cannot be called \"" + (is_utf8(name) ? name : "...") + "\": use letters, digits, _ and -";
}

std::string fault_of_keys(const SectionDeclaration& section, const std::vector<std::string>& taken) {
  if (!is_utf8(section.help)) return "what is said of its table is no UTF-8";
  std::vector<std::string> known = taken;
  for (const Declaration& d : section.declarations) {
    if (auto fault = fault_of_key(d); !fault.empty()) return fault;
    if (std::find(known.begin(), known.end(), d.key) != known.end()) return "the key \"" + d.key + "\" is taken";
    known.push_back(d.key);
  }
  return "";
}

}  // namespace rotordrop
