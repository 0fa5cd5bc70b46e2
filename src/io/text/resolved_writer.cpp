#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "io/text/parameter_writers.h"
#include "io/text/toml_text.h"

// The parameters of a case as they were resolved.
namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

class ResolvedWriter {
 public:
  explicit ResolvedWriter(std::function<std::string(const SourcePosition&)> source_of)
      : source_of_(std::move(source_of)) {}
  /// @param shared  for a named table of variants: the values that come from its parent table
  void section(const SectionDeclaration& section, const Node& table, const std::string& path,
               const Node& shared = Node(), const std::string& path_of_shared = "") {
    for (const Declaration& d : section.declarations) {
      const Node* given = table.find(d.key);
      const Node* from_parent = shared.find(d.key);
      if (is_one_value(d) || is_empty_list(d, given ? given : from_parent))
        value(d, given, from_parent, position_of(given ? table : shared, d.key), path_of_shared);
    }
    for (const Declaration& d : section.declarations) {
      const Node* given = table.find(d.key);
      const Node* from_parent = shared.find(d.key);
      if (given && from_parent)
        tables(d, merged(*from_parent, *given), joined_path(path, d.key), "");
      else if (given)
        tables(d, *given, joined_path(path, d.key), "");
      else if (from_parent)
        tables(d, *from_parent, joined_path(path, d.key), fmt::format("  # from [{}]", path_of_shared));
      else if (d.fallback || (d.kind == Kind::table && d.required))
        tables(d, d.fallback ? *d.fallback : Node::table(), joined_path(path, d.key), "  # default");
    }
  }
  void header(const std::string& header) { text_ += (text_.empty() ? "" : "\n") + header + "\n"; }
  const std::string& text() const { return text_; }

 private:
  static bool is_empty_list(const Declaration& d, const Node* given) {
    return d.kind == Kind::list && given && given->is_array() && given->items().empty();
  }
  void value(const Declaration& d, const Node* given, const Node* from_parent, const SourcePosition& where,
             const std::string& path_of_shared) {
    const auto source = [&](const char* prefix) { return source_of_ ? prefix + source_of_(where) : ""; };
    if (given)
      text_ += fmt::format("{} = {}{}\n", toml_key(d.key), toml_value(*given), source("  # from "));
    else if (from_parent)
      text_ += fmt::format("{} = {}  # from [{}]{}\n", toml_key(d.key), toml_value(*from_parent), path_of_shared,
                           source(", "));
    else if (d.fallback)
      text_ += fmt::format("{} = {}  # default\n", toml_key(d.key), toml_value(*d.fallback));
  }
  void tables(const Declaration& d, const Node& node, const std::string& path, const std::string& mark) {
    if (d.kind == Kind::table) {
      header(fmt::format("[{}]{}", path, mark));
      section(*d.nested, node, path);
    } else if (d.kind == Kind::list && node.is_array()) {
      for (const Node& item : node.items()) {
        header(fmt::format("[[{}]]{}", path, mark));
        section(*d.nested, item, path);
      }
    } else if (d.kind == Kind::tables && node.is_table()) {
      if (node.entries().empty())  // given as empty: that is not the default
        header(fmt::format("[{}]{}", path, mark));
      for (const Node::Entry& entry : node.entries()) {
        header(fmt::format("[{}]{}", joined_path(path, entry.key), mark));
        section(*d.nested, entry.value, joined_path(path, entry.key));
      }
    } else if (d.kind == Kind::variants && node.is_table()) {
      for (const Node::Entry& entry : node.entries())
        if (const VariantDeclaration* chosen = variant_of(d, entry.value); chosen && !is_variant_default(d, entry)) {
          header(fmt::format("[{}]", joined_path(path, entry.key)));
          const std::string tag_mark = entry.value.has(d.tag_key) ? "" : "  # default";
          text_ += fmt::format("{} = {}{}\n", toml_key(d.tag_key), quoted_text(chosen->tag), tag_mark);
          section(without_tag(*chosen->section, d.tag_key), entry.value, joined_path(path, entry.key),
                  variant_defaults(node, *chosen), path);
        }
    }
  }
  /// A section may declare the key that selects it, too; it is written once.
  static SectionDeclaration without_tag(SectionDeclaration section, const std::string& tag_key) {
    std::erase_if(section.declarations, [&](const Declaration& d) { return d.key == tag_key; });
    return section;
  }

  const std::function<std::string(const SourcePosition&)> source_of_;
  std::string text_;
};

}  // namespace

std::string write_resolved(const std::vector<ErasedSection>& sections, const Node& tree,
                           const std::function<std::string(const SourcePosition&)>& source_of) {
  ResolvedWriter writer(source_of);
  for (const ErasedSection& section : top_level_first(sections)) {
    if (section->name.empty()) {
      writer.section(*section, tree, "");
      continue;
    }
    const std::string path = toml_key(section->name);
    writer.header(fmt::format("[{}]", path));
    const Node* given = tree.find(section->name);
    writer.section(*section, given ? *given : Node::table(), path);
  }
  return writer.text();
}

}  // namespace rotordrop
