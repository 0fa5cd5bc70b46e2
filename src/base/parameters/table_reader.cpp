#include "base/parameters/table_reader.h"

#include "base/parameters/suggestion.h"
#include "base/parameters/wording.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

std::vector<std::string> keys_of(const SectionDeclaration& section) {
  std::vector<std::string> keys;
  for (const Declaration& d : section.declarations) keys.push_back(d.key);
  return keys;
}

std::string name_of_table(std::string_view path) {
  return path.empty() ? "at the top level" : fmt::format("in [{}]", path);
}

/// The tables of the whole input that know a key, as "[bearings.NAME]".
void find_tables_with(std::string_view key, const SectionDeclaration& section, const std::string& path,
                      std::vector<std::string>& found) {
  const std::string table = path.empty() ? "the top level" : fmt::format("[{}]", path);
  if (section.find(key) && std::find(found.begin(), found.end(), table) == found.end()) found.push_back(table);
  const ReadContext here{.path = path};
  for (const Declaration& d : section.declarations) {
    const std::string inner = here.name_of(d.key) + (d.kind == Kind::tables || d.kind == Kind::variants ? ".NAME" : "");
    if (d.nested) find_tables_with(key, *d.nested, inner, found);
    for (const VariantDeclaration& variant : d.variants) find_tables_with(key, *variant.section, inner, found);
  }
}

std::string advice_on_unknown(const std::string& word, std::vector<std::string> known, const ReadContext& here) {
  std::string advice;
  if (const std::string close = suggestion(word, known, ""); !close.empty())
    advice = close + "  ";
  else if (here.root) {
    std::vector<std::string> tables;
    find_tables_with(word, *here.root, here.root->name, tables);
    if (!tables.empty()) advice = fmt::format("It is known in {}.  ", fmt::join(tables, " and "));
  }
  std::sort(known.begin(), known.end());
  return advice + fmt::format("Known here: {}.", fmt::join(known, ", "));
}

/// Of a table that has keys of named ones: "[TB1]" is meant as [bearings.TB1].
std::string advice_on_misplaced(const Node::Entry& entry, const ReadContext& here) {
  if (!here.root || !entry.value.is_table() || entry.value.entries().empty()) return "";
  for (const Declaration& d : here.root->declarations)
    for (const VariantDeclaration& variant : d.variants) {
      const auto& keys = entry.value.entries();
      const auto n_known = std::count_if(keys.begin(), keys.end(), [&](const Node::Entry& key) {
        return key.key == d.tag_key || variant.section->find(key.key);
      });
      if (2 * n_known > static_cast<std::ptrdiff_t>(keys.size()))
        return fmt::format("Its keys are those of [{0}.NAME]: write [{0}.{1}].  ", d.key, entry.key);
    }
  return "";
}

}  // namespace

std::string ReadContext::name_of(std::string_view key) const {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

namespace detail {

bool is_readable_list(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is_array()) {
    add_type_fault(node, name, fmt::format("an array of tables: [[{}]] or [{{...}}, ...]", name), faults);
    return false;
  }
  if (node.items().size() < d.min_count) {
    faults.add(node.where(),
               fmt::format("{} has {} entries; it must have at least {}.", name, node.items().size(), d.min_count),
               d.help);
    return false;
  }
  return true;
}

bool is_readable_map(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is_table()) {
    add_type_fault(node, name, fmt::format("a table of named tables: [{}.NAME]", name), faults);
    return false;
  }
  std::size_t n_tables = 0;
  for (const Node::Entry& entry : node.entries())
    n_tables += d.kind != Kind::variants || !is_variant_default(d, entry) ? 1 : 0;
  if (n_tables < d.min_count)
    faults.add(node.where(),
               fmt::format("[{}] holds {} named tables; it must hold at least {}.", name, n_tables, d.min_count),
               fmt::format("Write one as [{}.NAME]. {}", name, d.help));
  return true;
}

bool is_readable_table(const Node& node, const std::string& path, Faults& faults) {
  if (node.is_table()) return true;
  faults.add(
      node.where(), fmt::format("{} is {}; it must be a table.", path.empty() ? "the input" : path, kind_name(node)),
      path.empty() || path.find('#') != std::string::npos ? ""
                                                          : fmt::format("Write [{}] and its keys below it.", path));
  return false;
}

void report_unknown_keys(const Node& table, const SectionDeclaration& section, const ReadContext& here,
                         Faults& faults) {
  constexpr std::size_t most = 20;  // of a table that is another program's, or none
  std::size_t n_unknown = 0;
  SourcePosition last;
  for (const Node::Entry& entry : table.entries()) {
    if (section.find(entry.key) || (here.also_known_key && *here.also_known_key == entry.key)) continue;
    if (++n_unknown > most) {
      last = entry.where;
      continue;
    }
    std::vector<std::string> known = keys_of(section);
    if (here.also_known_key) known.push_back(*here.also_known_key);
    faults.add(entry.where, fmt::format("unknown key \"{}\" {}.", entry.key, name_of_table(here.path)),
               (here.path.empty() ? advice_on_misplaced(entry, here) : "") +
                   advice_on_unknown(entry.key, std::move(known), here));
  }
  if (n_unknown > most)
    faults.add(last, fmt::format("{} more keys {} are unknown.", n_unknown - most, name_of_table(here.path)),
               "Check whether this is the file that was meant.");
}

namespace {

void report_missing_key(const Node& table, const Declaration& d, const ReadContext& here, Faults& faults) {
  std::string needs;
  switch (d.kind) {
    case Kind::quantity:
      needs = needed_quantity(d) + (d.range.is_any() ? "" : ", " + to_string(d.range, d.unit));
      break;
    case Kind::quantities:
      needs = fmt::format("a list of {} values, each {}", count_text(d), needed_quantity(d));
      break;
    case Kind::integer:
      needs = "an " + type_text(d);
      break;
    case Kind::choice:
      needs = "one of " + quoted(d.choices, ", ");
      break;
    default:
      needs = type_text(d);
  }
  faults.add(table.where(), fmt::format("missing key \"{}\" {}.", d.key, name_of_table(here.path)),
             (needs.empty() ? "" : fmt::format("It must be {}.  ", needs)) + d.help);
}

}  // namespace

void report_missing_keys(const Node& table, const std::vector<const Declaration*>& missing,
                         const std::string& if_incomplete, const ReadContext& here, Faults& faults) {
  constexpr std::size_t many = 4;  // something else is wrong with such a table
  if (missing.size() < many) {
    for (const Declaration* d : missing) report_missing_key(table, *d, here, faults);
    return;
  }
  std::vector<std::string> keys;
  for (const Declaration* d : missing) keys.push_back(d->key);
  faults.add(table.where(),
             fmt::format("{} keys are missing {}: {}.", keys.size(), name_of_table(here.path), fmt::join(keys, ", ")),
             if_incomplete + (if_incomplete.empty() ? "" : "  ") + "`rotordrop defaults` says what each is.");
}

/// A named table whose name is a key that such tables can have: it would be taken for the default of that key, and left out.
void report_name_that_is_a_key(const Node::Entry& entry, const Declaration& d, const ReadContext& here,
                               Faults& faults) {
  using enum Declaration::Kind;
  if (!entry.value.is_table()) return;
  for (const VariantDeclaration& variant : d.variants) {
    const Declaration* key = variant.takes_defaults ? variant.section->find(entry.key) : nullptr;
    if (!key) continue;
    const bool can_be_table = key->kind == table || key->kind == tables || key->kind == variants || key->kind == custom;
    const bool fits_the_key = key->nested && std::ranges::all_of(entry.value.entries(), [&](const Node::Entry& inner) {
                                return key->nested->find(inner.key);
                              });
    if (can_be_table && (fits_the_key || !entry.value.find(d.tag_key))) return;
    faults.add(entry.where,
               fmt::format("[{}] cannot have this name: \"{}\" is a key of tables with {} = \"{}\".",
                           here.name_of(entry.key), entry.key, d.tag_key, variant.tag),
               fmt::format("Choose another, such as [{}].", here.name_of(entry.key + "_1")));
    return;
  }
}

void report_unknown_defaults(const Node& table, const Declaration& d, const ReadContext& here, Faults& faults) {
  const auto is_known = [&](const std::string& key) {
    return std::any_of(d.variants.begin(), d.variants.end(), [&](const VariantDeclaration& variant) {
      return variant.takes_defaults && variant.section->find(key);
    });
  };
  for (const Node::Entry& entry : table.entries()) {
    report_name_that_is_a_key(entry, d, here, faults);
    if (!is_variant_default(d, entry) || is_known(entry.key)) continue;
    std::vector<std::string> known;
    for (const VariantDeclaration& variant : d.variants)
      if (variant.takes_defaults)
        for (std::string& key : keys_of(*variant.section))
          if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(std::move(key));
    faults.add(entry.where, fmt::format("unknown key \"{}\" {}.", entry.key, name_of_table(here.path)),
               known.empty() ? fmt::format("[{}] holds only tables: [{}.NAME].", here.path, here.path)
                             : advice_on_unknown(entry.key, std::move(known), here));
  }
}

void report_unknown_variant(const Node::Entry& entry, const Node& among, const Declaration& d, const ReadContext& here,
                            Faults& faults) {
  std::vector<std::string> tags;
  for (const VariantDeclaration& variant : d.variants) tags.push_back(variant.tag);
  const std::string path = here.name_of(entry.key);
  const std::string allowed = "It must be one of " + quoted(tags, ", ") + ".";
  const Node* tag = entry.value.find(d.tag_key);
  if (!tag) {
    // A name that is nearly that of a sound table: a slip rather than one more.
    std::vector<std::string> others;
    for (const Node::Entry& other : among.entries())
      if (other.key != entry.key && other.value.is_table() && variant_of(d, other.value)) others.push_back(other.key);
    faults.add(entry.where, fmt::format("missing key \"{}\" {}.", d.tag_key, name_of_table(path)),
               suggestion(entry.key, others, allowed + "  " + d.help, here.path + "."));
    return;
  }
  faults.add(tag->where(), fmt::format("{}.{} = {} is not known.", path, d.tag_key, to_text(*tag)),
             tag->is_text() ? suggestion(tag->text(), tags, allowed) : allowed);
}

namespace {

void collect_positions(const Node& node, std::vector<SourcePosition>& positions) {
  positions.push_back(node.where());
  if (node.is_array())
    for (const Node& item : node.items()) collect_positions(item, positions);
  if (node.is_table())
    for (const Node::Entry& entry : node.entries()) {
      positions.push_back(entry.where);
      collect_positions(entry.value, positions);
    }
}

std::string with_path_replaced(std::string message, const std::string& from, const std::string& to) {
  for (std::size_t at = message.find(from); at != std::string::npos; at = message.find(from, at + to.size()))
    message.replace(at, from.size(), to);
  return message;
}

}  // namespace

void add_without_repeating_defaults(const Faults& from_one_table, const Node& defaults,
                                    const std::string& path_of_table, const std::string& path_of_defaults,
                                    Faults& faults) {
  std::vector<SourcePosition> shared;
  for (const Node::Entry& entry : defaults.entries()) {
    shared.push_back(entry.where);
    collect_positions(entry.value, shared);
  }
  for (Fault fault : from_one_table) {
    if (fault.where.is_known() && std::find(shared.begin(), shared.end(), fault.where) != shared.end())
      fault.message = with_path_replaced(fault.message, path_of_table, path_of_defaults);
    faults.add(std::move(fault));
  }
}

}  // namespace detail

}  // namespace rotordrop
