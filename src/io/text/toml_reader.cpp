#include "io/text/toml_reader.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <tuple>

#include "base/trimmed.h"
#include "base/utf8.h"
#include "io/text/comments.h"
#include "io/text/input_file.h"
#include "io/text/parameter_keys.h"
#include "io/text/toml_mistakes.h"

namespace rotordrop {

namespace {

/// How positions are made from toml++'s: in a file as they are, for an option of the command line all the same.
struct PositionsOf {
  SharedText file;
  bool has_lines = true;

  SourcePosition operator()(const toml::source_region& region) const {
    if (!has_lines) return {file, 0, 0};
    return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }
};

Node converted(const toml::node& from, const PositionsOf& position);

Node converted_table(const toml::table& from, const PositionsOf& position) {
  struct Item {
    const toml::key* key;
    const toml::node* value;
  };
  std::vector<Item> items;
  require_table_size(from.size(), position(from.source()));
  for (const auto& [key, value] : from) items.push_back({&key, &value});
  // toml++ sorts keys by name; we keep the order of the file.
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    const auto place = [](const Item& item) {
      return std::tuple(item.key->source().begin.line, item.key->source().begin.column);
    };
    return place(a) < place(b);
  });
  Node table = Node::table(position(from.source()));
  for (const Item& item : items) {
    const SourcePosition where = position(item.key->source());
    require_printable_key(item.key->str(), where);
    table.entries().push_back({std::string(item.key->str()), where, converted(*item.value, position)});
  }
  return table;
}

Node converted(const toml::node& from, const PositionsOf& position) {
  const SourcePosition where = position(from.source());
  if (const auto* table = from.as_table()) return converted_table(*table, position);
  if (const auto* array = from.as_array()) {
    Node::Array items;
    for (const toml::node& item : *array) items.push_back(converted(item, position));
    return Node::array(std::move(items), where);
  }
  if (const auto* text = from.as_string()) {
    if (text->get().find('\0') != std::string::npos)
      throw InputError(where, "this text holds a NUL character.", "Take out \\u0000.");
    return Node(text->get(), where);
  }
  if (const auto* integer = from.as_integer()) return Node(integer->get(), where);
  if (const auto* real = from.as_floating_point()) return Node(real->get(), where);
  if (const auto* boolean = from.as_boolean()) return Node(boolean->get(), where);
  throw InputError(where, "dates and times have no meaning here.", "If it is meant as text, put it in quotes.");
}

SourcePosition position_of_error(const toml::parse_error& error, const std::string& file) {
  return PositionsOf{file}(error.source());
}

/// Gives keys the comments of their lines.
void add_comments(Node& node, const std::vector<std::string_view>& comments) {
  if (node.is_array())
    for (Node& item : node.items()) add_comments(item, comments);
  if (!node.is_table()) return;
  for (Node::Entry& entry : node.entries()) {
    const auto line = static_cast<std::size_t>(entry.where.line);
    if (line >= 1 && line <= comments.size()) entry.comment = comments[line - 1];
    add_comments(entry.value, comments);
  }
}

std::vector<std::string_view> comments_of_lines(std::string_view text) {
  std::vector<std::string_view> comments;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find('\n', begin), text.size());
    comments.push_back(split_comment(text.substr(begin, end - begin)).second);
    begin = end + 1;
  }
  return comments;
}

/// Line of the first letter that is no UTF-8, from 1; 0 if all is.
int first_line_not_utf8(std::string_view text) {
  const std::size_t at = first_not_utf8(text);
  return at == std::string_view::npos ? 0 : 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
}

/// Refuses what is another kind of file.
void require_toml(std::string_view text, const std::string& file) {
  const auto refuse = [&](int line, const std::string& what, const std::string& advice) {
    throw InputError({file, line, line > 0 ? 1 : 0}, what, advice);
  };
  if (text.starts_with("\x89HDF"))
    refuse(0, "this is a file of results (HDF5), not a parameter file.",
           "parameters.toml beside it is the case from which they are; `rotordrop rerun` takes results.");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
      (text.size() > 3 && text[1] == '\0' && text[3] == '\0'))
    refuse(0, "this file is in UTF-16.", "Save it as UTF-8.");
  if (const auto first = text.find_first_not_of(" \t\r\n"); first != std::string_view::npos && text[first] == '{')
    refuse(0, "this file is in JSON; a parameter file is in TOML.",
           "The geometry of a rotor is named in the case: [rotor] geometry = \"FILE.json\".");
  if (file.ends_with(".csv"))
    refuse(0, "this file is a table (CSV), not a parameter file.",
           "A shaft as a table becomes a case by `rotordrop new FOLDER --from FILE.csv`.");
  if (const int line = first_line_not_utf8(text); line > 0)
    refuse(line, "this line has a letter that is no UTF-8.",
           "Save the file as UTF-8; it may be in Latin-1 or in the code page of a Windows editor.");
}

Node parsed_toml(std::string_view text, const PositionsOf& position) {
  require_shallow_toml(text, position.file.text());
  Node tree = converted_table(toml::parse(text, position.file.text()), position);
  if (position.has_lines) add_comments(tree, comments_of_lines(text));
  return tree;
}

/// @param text       of the file at `path`
/// @param including  the files from the first one to the one that names this
Node read_with_bases(std::string_view text, const std::filesystem::path& path,
                     std::vector<std::filesystem::path> including, const CompleteLayer& complete) {
  Node tree = parse_toml(text, path.string());
  const Node* base = tree.find("base");
  if (!base) {
    if (complete) complete(tree, path, Node::table());
    return tree;
  }
  if (!base->is_text())
    throw InputError(base->where(),
                     fmt::format("base is {}; it must be the name of a file in quotes.", kind_name(*base)));

  const std::filesystem::path base_path = (path.parent_path() / base->text()).lexically_normal();
  const SourcePosition where_base = base->where();
  including.push_back(std::filesystem::weakly_canonical(path));
  const auto again = std::find(including.begin(), including.end(), std::filesystem::weakly_canonical(base_path));
  if (again != including.end()) {
    std::string chain;
    for (auto file = again; file != including.end(); ++file) chain += file->filename().string() + " -> ";
    throw InputError(where_base,
                     fmt::format("base \"{}\" refers back to a file that is already being read.", base->text()),
                     fmt::format("The chain of bases is {}{}.", chain, again->filename().string()));
  }
  tree.erase("base");
  const Node under = read_with_bases(read_input_file(base_path, where_base), base_path, std::move(including), complete);
  if (complete) complete(tree, path, under);
  return merged(under, tree);
}

// ---------------------------------------------------------------------------------------------------------------
// overrides

constexpr const char* example_of_set =
    "Write it as --set contact.friction_coefficient=0.05; quote it for the shell if it has spaces.";

/// The keys of "a.b.'c d'"; nothing if it is no key of TOML.
std::optional<std::vector<std::string>> keys_of_path(const std::string& path) {
  if (path.find('\n') != std::string::npos) return {};
  require_shallow_toml(path, "--set");
  try {
    const toml::table parsed = toml::parse(path + " = 0");
    std::vector<std::string> keys;
    const toml::table* table = &parsed;
    while (table) {
      if (table->size() != 1) return {};
      const auto only = table->begin();  // must outlive what it points to: it holds the pair itself
      keys.emplace_back(only->first.str());
      table = only->second.as_table();
    }
    return keys;
  } catch (const toml::parse_error&) {
    return {};
  }
}

Node override_value(const std::string& text, const std::string& name) {
  try {
    const Node tree = parsed_toml("value = " + text, {name, false});
    if (tree.entries().size() == 1 && tree.has("value")) return *tree.find("value");
  } catch (const toml::parse_error& error) {
    // What looks like a list, a table or a quoted text is meant as one: its mistake must not become a text.
    if (std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
      throw InputError({name}, toml_mistake("value = " + text, 1, error.description()).message,
                       fmt::format("The value was: {}", text));
  } catch (const InputError&) {
    // A date: here it is a text.
  }
  return Node(text, {name});
}

}  // namespace

Node parse_toml(std::string_view text, const std::string& file) {
  require_toml(text, file);
  try {
    return parsed_toml(text, {file});
  } catch (const toml::parse_error& error) {
    const auto mistake = toml_mistake(text, static_cast<int>(error.source().begin.line), error.description());
    throw InputError(position_of_error(error, file), mistake.message, mistake.advice);
  }
}

Node read_toml(const std::filesystem::path& path, const CompleteLayer& complete) {
  return read_with_bases(read_input_file(path), path, {}, complete);
}

Node read_toml_text(std::string_view text, const std::filesystem::path& path, const CompleteLayer& complete) {
  return read_with_bases(text, path, {}, complete);
}

Setting read_setting(std::string_view assignment) {
  const auto equals = assignment.find('=');
  const std::string path(trimmed(assignment.substr(0, equals)));
  const std::string text(equals == std::string_view::npos ? "" : trimmed(assignment.substr(equals + 1)));
  if (const auto parts = assignments_in(assignment); parts.size() > 1) {
    std::string each;
    for (const auto& part : parts) each += " --set " + shell_quoted(part);
    throw InputError({fmt::format("--set {}", assignment)},
                     "this sets several parameters; each needs a --set of its own.", "Write it as:" + each);
  }
  if (path.empty() || text.empty())
    throw InputError({fmt::format("--set {}", assignment)}, "this is not a parameter setting; it must be KEY=VALUE.",
                     example_of_set);
  return {path, override_value(text, fmt::format("--set {}", path))};
}

void apply_setting(Node& tree, const Setting& setting) {
  const auto& [path, value] = setting;
  const SourcePosition where{value.where().file, 0, 0};
  const auto keys = keys_of_path(path);
  if (!keys)
    throw InputError(where, fmt::format("\"{}\" is not the name of a parameter.", path),
                     path.find('*') != std::string::npos
                         ? "A name with * stands in quotes: limits.\"bearings.*.static_safety\".min."
                     : where.file.text().starts_with("--set") ? example_of_set
                                                              : "Write names such as contact.friction_coefficient.");

  Node* table = &tree;
  for (std::size_t i = 0; i + 1 < keys->size(); ++i) {
    Node* next = table->find((*keys)[i]);
    table = next ? next : &table->set((*keys)[i], Node::table(where), where);
    if (!table->is_table())
      throw InputError(where, fmt::format("\"{}\" is {}, so nothing can be set in it.", (*keys)[i], kind_name(*table)),
                       table->where().is_known() ? fmt::format("It is given at {}.", to_string(table->where())) : "");
  }
  const Node* before = table->find(keys->back());
  table->set(keys->back(), before ? merged(*before, value) : value, where);
}

void apply_override(Node& tree, std::string_view assignment) { apply_setting(tree, read_setting(assignment)); }

}  // namespace rotordrop
