#include "case/keys/case_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/parameters/declaration.h"
#include "base/parameters/suggestion.h"
#include "case/case.h"

namespace rotordrop {
namespace {

using Kind = Declaration::Kind;

bool is_key_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

[[noreturn]] void refuse(const std::string& key, const SourcePosition& where) {
  throw InputError(where, fmt::format("\"{}\" is not the name of a parameter.", key),
                   "Write names such as contact.friction_coefficient or rotor.unbalance[0].me; entries of lists count "
                   "from 0.");
}

[[noreturn]] void unknown(const std::string& key, const std::string& word, const std::string& path,
                          std::vector<std::string> known, const SourcePosition& where) {
  std::sort(known.begin(), known.end());
  throw InputError(
      where, fmt::format("unknown key \"{}\": {} has no \"{}\".", key, path.empty() ? "a case" : path, word),
      suggestion(word, known, fmt::format("Known there: {}.", fmt::join(known, ", ")), path.empty() ? "" : path + "."));
}

std::vector<std::string> names_in(const SectionDeclaration& section) {
  std::vector<std::string> names;
  for (const auto& d : section.declarations) names.push_back(d.key);
  return names;
}

std::vector<std::string> names_in(const Node* table) {
  std::vector<std::string> names;
  if (table && table->is_table())
    for (const auto& entry : table->entries())
      if (entry.value.is_table()) names.push_back(entry.key);
  return names;
}

/// The node of one more step below, or nullptr.
const Node* below(const Node* node, const KeyStep& step) {
  node = node ? node->find(step.key) : nullptr;
  for (const std::size_t i : step.entries)
    node = node && node->is_array() && i < node->items().size() ? &node->items()[i] : nullptr;
  return node;
}

void require_entry(const std::string& key, const KeyStep& step, const Node* list, const SourcePosition& where) {
  const std::size_t n = list && list->is_array() ? list->items().size() : 0;
  if (step.entries.empty())
    throw InputError(where, fmt::format("\"{}\": {} is a list.", key, step.key),
                     fmt::format("Name an entry of it, such as {}[0]; the case has {}.", step.key, n));
  if (step.entries.front() >= n)
    throw InputError(where, fmt::format("\"{}\": the case has no entry {} of {}.", key, step.entries.front(), step.key),
                     n == 0 ? fmt::format("Its list {} is empty.", step.key)
                            : fmt::format("Entries count from 0: {} to {}.", 0, n - 1));
}

bool has_entries(const Declaration& d) {
  return d.kind == Kind::quantities || d.kind == Kind::matrix || d.kind == Kind::function || d.kind == Kind::custom;
}

DeclaredKey found(const std::string& key, const ErasedSection& root, const Declaration& d, const KeyStep& step) {
  DeclaredKey result{key, root, d, !step.entries.empty(), d.unit, d.quantity_kind};
  if (d.kind == Kind::function && step.entries.size() == 2 && step.entries[1] == 0) result.unit = d.argument_unit;
  if (result.unit.empty() && (d.kind == Kind::quantities || d.kind == Kind::quantity)) result.unit = "1";
  return result;
}

}  // namespace

bool DeclaredKey::is_quantity() const {
  if (declaration.kind == Kind::quantity) return true;
  return is_entry && (declaration.kind == Kind::quantities || declaration.kind == Kind::matrix ||
                      declaration.kind == Kind::function || (declaration.kind == Kind::custom && !unit.empty()));
}

std::vector<KeyStep> steps_of(const std::string& key, const SourcePosition& where) {
  std::vector<KeyStep> steps;
  std::size_t at = 0;
  while (true) {
    KeyStep step;
    while (at < key.size() && is_key_character(key[at])) step.key += key[at++];
    if (step.key.empty()) refuse(key, where);
    while (at < key.size() && key[at] == '[') {
      const auto end = key.find(']', at);
      if (end == std::string::npos) refuse(key, where);
      std::size_t entry = 0;
      const auto parsed = std::from_chars(key.data() + at + 1, key.data() + end, entry);
      if (parsed.ec != std::errc() || parsed.ptr != key.data() + end) refuse(key, where);
      step.entries.push_back(entry);
      at = end + 1;
    }
    steps.push_back(std::move(step));
    if (at == key.size()) return steps;
    if (key[at++] != '.') refuse(key, where);
  }
}

DeclaredKey declared_key(const std::string& key, const Node& tree, const SourcePosition& where) {
  const auto steps = steps_of(key, where);
  const ErasedSection root = case_sections().front();
  ErasedSection section = root;
  const Node* node = &tree;
  std::string path;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const KeyStep& step = steps[i];
    const Declaration* d = section->find(step.key);
    if (!d) unknown(key, step.key, path, names_in(*section), where);
    const bool is_last = i + 1 == steps.size();
    path += (path.empty() ? "" : ".") + step.key;
    const Node* parent = node;
    node = parent ? parent->find(step.key) : nullptr;
    const auto take_name = [&]() -> const KeyStep& {
      if (is_last) unknown(key, "", path, names_in(node), where);
      const KeyStep& name = steps[++i];
      const Node* named = node ? node->find(name.key) : nullptr;
      if (!named) unknown(key, name.key, path, names_in(node), where);
      node = named;
      path += "." + name.key;
      return name;
    };
    switch (d->kind) {
      case Kind::table:
        section = d->nested;
        break;
      case Kind::list:
        require_entry(key, step, node, where);
        node = &node->items()[step.entries.front()];
        section = d->nested;
        break;
      case Kind::tables:
        take_name();
        section = d->nested;
        break;
      case Kind::variants: {
        if (!is_last)
          for (const auto& variant : d->variants)
            if (const auto* shared = variant.section->find(steps[i + 1].key);
                shared && variant.takes_defaults && i + 2 == steps.size())
              return found(key, root, *shared, steps[i + 1]);
        take_name();
        const VariantDeclaration* chosen = variant_of(*d, *node);
        if (!chosen) unknown(key, steps[i].key, path, {}, where);
        section = chosen->section;
        break;
      }
      default: {
        if (!is_last && d->kind != Kind::custom)
          throw InputError(where, fmt::format("\"{}\": {} is a value, so it has no keys.", key, path));
        if (!step.entries.empty() && !has_entries(*d))
          throw InputError(where, fmt::format("\"{}\": {} is not a list.", key, path));
        DeclaredKey result = found(key, root, *d, step);
        if (!is_last) result.unit.clear();
        return result;
      }
    }
  }
  throw InputError(where, fmt::format("\"{}\" is a table, so it has no value.", key),
                   fmt::format("Name a key in it: {}.", fmt::join(names_in(*section), ", ")));
}

std::optional<Node> value_of_key(const DeclaredKey& key, const Node& tree) {
  const auto steps = steps_of(key.name, {});
  const Node* node = &tree;
  for (const auto& step : steps) node = below(node, step);
  if (node) return *node;
  if (steps.size() == 3 && steps.front().key == "bearings") {  // [bearings] may give it for all
    if (const Node* all = tree.find("bearings"))
      if (const Node* shared = below(all, steps.back()); shared && !shared->is_table()) return *shared;
  }
  if (!key.declaration.fallback) return {};
  const Node* fallback = &*key.declaration.fallback;
  for (const std::size_t i : steps.back().entries)
    fallback = fallback && fallback->is_array() && i < fallback->items().size() ? &fallback->items()[i] : nullptr;
  return fallback ? std::optional(*fallback) : std::nullopt;
}

void set_key(Node& tree, const std::string& key, Node value, const SourcePosition& where) {
  const auto steps = steps_of(key, where);
  Node* node = &tree;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const KeyStep& step = steps[i];
    if (!node->is_table()) throw InputError(where, fmt::format("\"{}\": nothing can be set there.", key));
    const bool is_last = i + 1 == steps.size();
    if (is_last && step.entries.empty()) {
      node->set(step.key, std::move(value), where);
      return;
    }
    Node* next = node->find(step.key);
    if (!next && step.entries.empty()) next = &node->set(step.key, Node::table(where), where);
    if (!next) {
      const DeclaredKey declared = declared_key(key, tree, where);
      if (!is_last || !declared.declaration.fallback) require_entry(key, step, nullptr, where);
      next = &node->set(step.key, *declared.declaration.fallback, where);
    }
    for (const std::size_t entry : step.entries) {
      require_entry(key, {step.key, {entry}}, next, where);
      next = &next->items()[entry];
    }
    if (is_last) {
      *next = std::move(value);
      return;
    }
    node = next;
  }
}

}  // namespace rotordrop
