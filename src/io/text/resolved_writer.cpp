#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/units.h"
#include "io/text/comments.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_text.h"

// The parameters of a case as they were resolved.
namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

constexpr const char* default_mark = "default";

/// Where a table of parameters stands.
struct Place {
  std::string path;                         ///< of its header: "rotor.unbalance"
  std::string name;                         ///< the same with entries of lists counted: "rotor.unbalance[0]"
  const std::string* of_program = nullptr;  ///< source of values that the program gives; may be empty

  [[nodiscard]] Place below(const std::string& key) const {
    return {joined_path(path, key), joined_path(name, key), of_program};
  }
};

/// A quantity as a number, in the unit of its declaration; what cannot be read as one stays as it is.
Node in_si(const Node& value, const std::string& unit, QuantityKind kind) {
  if (value.is_array()) {
    Node::Array items;
    for (const Node& item : value.items()) items.push_back(in_si(item, unit, kind));
    return Node::array(std::move(items));
  }
  if (value.is_number()) return Node(value.number());
  const auto read = value.is_text() ? convert_to_si(value.text(), unit, kind) : Conversion{};
  return value.is_text() && read ? Node(read.value) : value;
}

Node in_si(const Node& value, const Declaration& d) {
  if (d.kind == Kind::quantity || d.kind == Kind::quantities || d.kind == Kind::matrix)
    return in_si(value, d.unit, d.quantity_kind);
  if (d.kind != Kind::function) return value;
  if (!value.is_array()) return in_si(value, d.unit, d.quantity_kind);
  Node::Array pairs;
  for (const Node& pair : value.items())
    pairs.push_back(pair.is_array() && pair.items().size() == 2
                        ? Node::array({in_si(pair.items()[0], d.argument_unit, kind_of(d.argument_unit)),
                                       in_si(pair.items()[1], d.unit, d.quantity_kind)})
                        : pair);
  return Node::array(std::move(pairs));
}

class Resolver {
 public:
  explicit Resolver(bool is_in_si) : is_in_si_(is_in_si) {}

  /// @param shared  for a named table of variants: the values that come from its parent table
  void section(const SectionDeclaration& section, const Node& table, const Place& place, const Node& shared = Node(),
               const std::string& path_of_shared = "") {
    for (const Declaration& d : section.declarations) {
      const Node::Entry* given = table.entry(d.key);
      const Node::Entry* from_parent = shared.entry(d.key);
      if (is_one_value(d) || is_empty_list(d, given ? given : from_parent))
        value(d, given, from_parent, place, path_of_shared);
    }
    for (const Declaration& d : section.declarations) {
      const Node::Entry* entry = table.entry(d.key);
      const Node* given = entry ? &entry->value : nullptr;
      const Node* from_parent = shared.find(d.key);
      const Place below = place.below(d.key);
      if (given && from_parent)
        tables(d, merged(*from_parent, *given), below, "");
      else if (given)
        tables(d, *given, below, own_mark(*entry));
      else if (from_parent)
        tables(d, *from_parent, below, fmt::format("  # from [{}]", path_of_shared));
      else if (d.fallback || (d.kind == Kind::table && d.required))
        tables(d, d.fallback ? *d.fallback : Node::table(), below, "  # default");
    }
  }
  void header(const std::string& header) { result_.text += (result_.text.empty() ? "" : "\n") + header + "\n"; }
  [[nodiscard]] ResolvedParameters& result() { return result_; }

 private:
  static bool is_empty_list(const Declaration& d, const Node::Entry* given) {
    return d.kind == Kind::list && given && given->value.is_array() && given->value.items().empty();
  }
  /// In a parameters.toml that is read again.
  static bool is_marked_default(const Node::Entry& entry) { return entry.comment == default_mark; }
  /// The mark of a table that rotordrop wrote there.
  static std::string own_mark(const Node::Entry& entry) {
    const bool is_own = is_marked_default(entry) || entry.comment.starts_with(origin_mark);
    return is_own ? "  # " + entry.comment : "";
  }
  static std::string origin_in(const Node::Entry& entry, const Place& place) {
    std::string origin = origin_text(entry);
    if (!entry.where.is_known() && place.of_program && !place.of_program->empty()) origin += ": " + *place.of_program;
    return origin;
  }
  void line(const std::string& key, const Node& value, const std::string& comment) {
    result_.text +=
        fmt::format("{} = {}{}{}\n", toml_key(key), toml_value(value), comment.empty() ? "" : "  # ", comment);
  }
  void value(const Declaration& d, const Node::Entry* given, const Node::Entry* from_parent, const Place& place,
             const std::string& path_of_shared) {
    const Node::Entry* entry = given ? given : from_parent;
    if (entry && !(d.fallback && is_marked_default(*entry) && toml_value(entry->value) == toml_value(*d.fallback))) {
      const std::string parent = given ? "" : fmt::format("[{}]", path_of_shared);
      std::string origin = parent.empty() ? "" : parent + ", ";
      origin += origin_in(*entry, place);
      line(d.key, is_in_si_ ? in_si(entry->value, d) : entry->value,
           origin.empty() ? "" : std::string(origin_mark) + origin);
      result_.given.push_back(
          {joined_path(place.name, d.key), entry->value, std::move(origin), d.fallback, d.unit, d.help});
    } else if (d.fallback) {
      line(d.key, is_in_si_ ? in_si(*d.fallback, d) : *d.fallback, default_mark);
      ++result_.n_defaults;
    }
  }
  /// The key that selects a variant.
  void tag(const Declaration& d, const Node::Entry& named, const VariantDeclaration& chosen, const Place& place) {
    const Node::Entry* given = named.value.entry(d.tag_key);
    if (!given || (is_marked_default(*given) && d.fallback_tag == chosen.tag)) {
      line(d.tag_key, Node(chosen.tag), default_mark);
      ++result_.n_defaults;
      return;
    }
    std::string origin = origin_in(*given, place);
    line(d.tag_key, Node(chosen.tag), std::string(origin_mark) + origin);
    result_.given.push_back({joined_path(place.name, d.tag_key), given->value, std::move(origin), {}, "", ""});
  }
  void tables(const Declaration& d, const Node& node, const Place& place, const std::string& mark) {
    if (d.kind == Kind::table) {
      header(fmt::format("[{}]{}", place.path, mark));
      section(*d.nested, node, place);
    } else if (d.kind == Kind::list && node.is_array()) {
      std::size_t n = 0;
      for (const Node& item : node.items()) {
        header(fmt::format("[[{}]]{}", place.path, mark));
        section(*d.nested, item, {place.path, fmt::format("{}[{}]", place.name, n++), place.of_program});
      }
    } else if (d.kind == Kind::tables && node.is_table()) {
      if (node.entries().empty())  // given as empty: that is not the default
        header(fmt::format("[{}]{}", place.path, mark));
      for (const Node::Entry& entry : node.entries()) {
        Place below = place.below(entry.key);
        below.of_program = &d.source;
        header(fmt::format("[{}]{}", below.path, mark));
        section(*d.nested, entry.value, below);
      }
    } else if (d.kind == Kind::variants && node.is_table()) {
      for (const Node::Entry& entry : node.entries())
        if (const VariantDeclaration* chosen = variant_of(d, entry.value); chosen && !is_variant_default(d, entry)) {
          const Place below = place.below(entry.key);
          header(fmt::format("[{}]", below.path));
          tag(d, entry, *chosen, below);
          section(without_tag(*chosen->section, d.tag_key), entry.value, below, variant_defaults(node, *chosen),
                  place.path);
        }
    }
  }
  /// A section may declare the key that selects it, too; it is written once.
  static SectionDeclaration without_tag(SectionDeclaration section, const std::string& tag_key) {
    std::erase_if(section.declarations, [&](const Declaration& d) { return d.key == tag_key; });
    return section;
  }

  ResolvedParameters result_;
  bool is_in_si_ = false;
};

ResolvedParameters resolved(const std::vector<ErasedSection>& sections, const Node& tree, bool is_in_si) {
  Resolver resolver(is_in_si);
  for (const ErasedSection& section : top_level_first(sections)) {
    if (section->name.empty()) {
      resolver.section(*section, tree, {});
      continue;
    }
    const std::string path = toml_key(section->name);
    resolver.header(fmt::format("[{}]", path));
    const Node* given = tree.find(section->name);
    resolver.section(*section, given ? *given : Node::table(), {path, path});
  }
  return std::move(resolver.result());
}

}  // namespace

ResolvedParameters resolve(const std::vector<ErasedSection>& sections, const Node& tree) {
  return resolved(sections, tree, false);
}

std::string resolved_in_si(const std::vector<ErasedSection>& sections, const Node& tree) {
  return resolved(sections, tree, true).text;
}

}  // namespace rotordrop
