#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parameters/wording.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_text.h"

// All parameters with their defaults, annotated.
namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

/// Comments begin with "# ", keys and tables that are only shown begin with "#".
class DefaultsWriter {
 public:
  void section(const SectionDeclaration& section, const std::string& path, bool is_shown_only) {
    for (const Declaration& d : section.declarations)
      if (is_one_value(d) || d.fallback) value(d, is_shown_only);
    for (const Declaration& d : section.declarations) tables(d, joined_path(path, d.key), is_shown_only);
  }
  void header(const std::string& header, const std::string& help, bool is_shown_only) {
    comment(help);
    text_ += fmt::format("{}{}\n\n", is_shown_only ? "#" : "", header);
  }
  const std::string& text() const { return text_; }

 private:
  void value(const Declaration& d, bool is_shown_only) {
    comment(fmt::format("{}{}[{}]", d.help, d.help.empty() ? "" : "  ", type_text(d)));
    if (!d.source.empty()) comment("source: " + d.source);
    if (d.fallback)
      text_ += fmt::format("{}{} = {}\n\n", is_shown_only ? "#" : "", toml_key(d.key), toml_value(*d.fallback));
    else
      text_ += fmt::format("#{} = {}  # {}\n\n", toml_key(d.key), example(d), d.required ? "required" : "optional");
  }
  void tables(const Declaration& d, const std::string& path, bool is_shown_only) {
    if (d.kind == Kind::table) {
      header(fmt::format("[{}]{}", path, d.required ? "" : "  # optional table"), d.help, is_shown_only || !d.required);
      section(*d.nested, path, is_shown_only || !d.required);
    } else if (d.kind == Kind::list) {
      header(fmt::format("[[{}]]  # {}", path, times(d)), d.help, true);
      section(*d.nested, path, true);
    } else if (d.kind == Kind::tables) {
      header(fmt::format("[{}.NAME]  # {}", path, times(d)), d.help, true);
      section(*d.nested, path + ".NAME", true);
    } else if (d.kind == Kind::variants) {
      comment(d.help);
      for (const VariantDeclaration& variant : d.variants) {
        header(fmt::format("[{}.NAME]  # {}", path, times(d)), variant.section->help, true);
        if (variant.takes_defaults)
          comment(fmt::format("Keys set in [{}] itself apply to every such table that does not set them.", path));
        const bool is_fallback = d.fallback_tag == variant.tag;
        text_ += fmt::format("#{} = {}{}\n\n", toml_key(d.tag_key), quoted_text(variant.tag),
                             is_fallback ? "" : "  # required");
        section(*variant.section, path + ".NAME", true);
      }
    }
  }
  static std::string times(const Declaration& d) {
    return d.min_count == 0 ? "any number of these" : fmt::format("at least {} of these", d.min_count);
  }
  static std::string example(const Declaration& d) {
    const auto one = [&] {
      const std::string text = example_of(d.unit, d.quantity_kind);
      return bare_number(text) ? text : quoted_text(text);
    };
    switch (d.kind) {
      case Kind::quantity:
        return one();
      case Kind::integer:
        return std::isfinite(d.range.lower) ? fmt::format("{}", std::ceil(d.range.lower)) : "1";
      case Kind::boolean:
        return "true";
      case Kind::choice:
        return quoted_text(d.choices.front());
      case Kind::quantities: {
        std::string items;
        for (std::size_t i = 0; i < std::max<std::size_t>(d.min_count, 1); ++i) items += (i == 0 ? "" : ", ") + one();
        return "[" + items + "]";
      }
      case Kind::matrix:
        return fmt::format("[[{0}, {0}], [{0}, {0}]]", one());
      case Kind::function:
        return fmt::format("[[0.0, {}]]", one());
      default:
        return "\"\"";
    }
  }
  /// Breaks lines at 120 columns.
  void comment(const std::string& text) {
    std::string line = "#";
    std::size_t start = 0;
    while (start < text.size()) {
      const std::size_t end = std::min(text.find_first_of(" \n", start), text.size());
      if (line.size() + 1 + end - start > 120) {
        text_ += line + "\n";
        line = "#";
      }
      if (end == start && line == "#") {  // no double space at the start of a line
        start = end + 1;
        continue;
      }
      line += " " + text.substr(start, end - start);
      start = end + 1;
    }
    if (line != "#") text_ += line + "\n";
  }

  std::string text_;
};

}  // namespace

std::string write_defaults(const std::vector<ErasedSection>& sections) {
  DefaultsWriter writer;
  for (const ErasedSection& section : top_level_first(sections)) {
    const std::string path = section->name.empty() ? "" : toml_key(section->name);
    if (!path.empty()) writer.header(fmt::format("[{}]", path), section->help, false);
    writer.section(*section, path, false);
  }
  return writer.text();
}

}  // namespace rotordrop
