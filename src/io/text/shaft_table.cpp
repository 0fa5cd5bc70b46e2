#include "io/text/shaft_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/parameters/suggestion.h"
#include "base/trimmed.h"
#include "base/units.h"
#include "io/text/input_file.h"

namespace rotordrop {
namespace {

/// A word of the table and its place.
struct Cell {
  std::string text;
  SourcePosition where;
};
using Row = std::vector<Cell>;

constexpr std::string_view blanks_of_lines = " \t\r";

void require_utf8(std::string_view line, const SourcePosition& where) {
  bool is_text = line.find('\0') == std::string_view::npos;
  try {
    static_cast<void>(nlohmann::json(line).dump());
  } catch (const nlohmann::json::exception&) {  // it writes UTF-8 only
    is_text = false;
  }
  if (!is_text) throw InputError(where, "this line is not text in UTF-8.", "Save the table as CSV in UTF-8.");
}

Row cells_of(std::string_view line, char separator, const SourcePosition& where) {
  Row row;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(separator, from), line.size());
    const std::string_view bare = trimmed(line.substr(from, to - from), blanks_of_lines);
    const std::size_t start = bare.empty() ? from : static_cast<std::size_t>(bare.data() - line.data());
    row.push_back({std::string(bare), {where.file, where.line, static_cast<int>(start) + 1}});
    from = to + 1;
  }
  return row;
}

/// Rows that hold something. Where the first has semicolons or tabulators, these separate, and a comma is part of a number, which is refused.
std::vector<Row> rows_of(const std::filesystem::path& file) {
  std::string text = read_input_file(file);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError({file.string(), 0, 0}, "this file is text in UTF-16.", "Save the table as CSV in UTF-8.");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<Row> rows;
  char separator = 0;
  int number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = std::string_view(text).substr(start, end - start);
    start = end + 1;
    const SourcePosition where{file.string(), ++number, 1};
    require_utf8(line, where);
    if (trimmed(line, blanks_of_lines).starts_with('#')) continue;
    if (separator == 0)
      separator = line.find(';') != std::string_view::npos    ? ';'
                  : line.find('\t') != std::string_view::npos ? '\t'
                                                              : ',';
    Row row = cells_of(line, separator, where);
    if (std::any_of(row.begin(), row.end(), [](const Cell& cell) { return !cell.text.empty(); }))
      rows.push_back(std::move(row));
  }
  return rows;
}

bool is_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* one) { return word == one; });
}

/// "length [mm]": a column and its unit, which may be empty.
struct Column {
  std::string name, unit;
};

std::vector<Column> columns_of(const Row& header, Faults& faults) {
  const std::vector<std::string> known{"length", "outer_diameter", "bore", "E",  "nu",
                                       "rho",    "mass",           "Ip",   "Id", "name"};
  std::vector<Column> columns;
  for (const Cell& cell : header) {
    Column column{cell.text, ""};
    if (const auto bracket = cell.text.find('['); bracket != std::string::npos) {
      column.name = trimmed(std::string_view(cell.text).substr(0, bracket));
      column.unit = trimmed(std::string_view(cell.text).substr(bracket + 1, cell.text.find(']') - bracket - 1));
    }
    const bool is_filler = cell.text.empty();  // a spreadsheet fills lines up
    const bool needs_unit = column.name != "nu" && column.name != "name";
    if (!is_filler && std::find(known.begin(), known.end(), column.name) == known.end())
      faults.add(cell.where, fmt::format("unknown column \"{}\".", column.name),
                 is_of(column.name, {"od", "OD", "D", "diameter"}) ? std::string("Did you mean \"outer_diameter\"?")
                 : is_of(column.name, {"id", "ID", "d", "id_"})    ? std::string("Did you mean \"bore\"?")
                                                                   : suggestion(column.name, known));
    else if (!is_filler && needs_unit && column.unit.empty())
      faults.add(cell.where, fmt::format("the column {} names no unit.", column.name),
                 "Write it in brackets, such as length [mm], E [GPa], mass [kg], Ip [kg m2].");
    else if (!is_filler &&
             std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == column.name; }))
      faults.add(cell.where, fmt::format("there are two columns {}.", column.name));
    columns.push_back(std::move(column));
  }
  for (const char* needed : {"length", "outer_diameter"})
    if (std::none_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == needed; }))
      faults.add(header.front().where, fmt::format("the column {} is missing.", needed),
                 "The first line names the columns, such as: length [mm], outer_diameter [mm], bore [mm]");
  return columns;
}

Node steel() { return Node::table({{"E", 2.0e11}, {"nu", 0.3}, {"rho", 7800.}}); }

/// A number with its column's unit, as a case has it.
Node quantity(const Cell& cell, const std::string& unit) {
  char* end = nullptr;
  const double number = std::strtod(cell.text.c_str(), &end);
  const bool is_number = *end == '\0';
  if (unit.empty() && is_number) return Node(number, cell.where);
  const bool has_own_unit = !is_number && std::isalpha(static_cast<unsigned char>(cell.text.back())) != 0;
  return Node(unit.empty() || has_own_unit ? cell.text : cell.text + " " + unit, cell.where);
}

/// Makes the tree section by section.
class Sections {
 public:
  explicit Sections(const std::vector<Column>& columns) : columns_(columns) { add_node({}); }

  void add(const Row& row, bool is_last, Faults& faults) {
    if (row.size() != columns_.size()) {
      faults.add(
          row.front().where, fmt::format("this row has {} values, the header {} columns.", row.size(), columns_.size()),
          "Numbers have decimal points, not commas. A value that is not given is left empty between its separators.");
      return;
    }
    std::map<std::string, std::pair<const Cell*, const Column*>> given;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k].text.empty()) continue;
      if (columns_[k].name.empty()) faults.add(row[k].where, "this value stands in a column without a name.");
      given[columns_[k].name] = {&row[k], &columns_[k]};
    }
    const auto value = [&](const char* name) { return quantity(*given.at(name).first, given.at(name).second->unit); };
    add_mass(row, given, value);
    if (is_last && !given.contains("length")) return;
    for (const char* needed : {"length", "outer_diameter"})
      if (!given.contains(needed)) {
        faults.add(row.front().where, fmt::format("this section has no {}.", needed),
                   "Only a last row may have none; it carries a mass at the right end.");
        return;
      }
    const Node length = value("length");
    const Conversion read = convert_to_si(length.text(), "m", QuantityKind::plain, "length");
    if (!read || !(read.value > 0.)) {
      faults.add(length.where(), read ? "the length of a section must be larger than 0." : read.error, read.advice);
      return;
    }
    x_ += read.value;
    Node element = Node::table(row.front().where);
    element.set("n1", Node(n_nodes_, row.front().where));
    element.set("n2", Node(n_nodes_ + 1, row.front().where));
    element.set("od", value("outer_diameter"), given.at("outer_diameter").first->where);
    if (given.contains("bore")) element.set("bore", value("bore"), given.at("bore").first->where);
    add_material(element, given, value);
    elements_.push_back(std::move(element));
    add_node(row.front().where);
  }

  Node tree(const SourcePosition& where) && {
    Node tree = Node::table(where);
    tree.set("material", steel(), where);
    tree.set("materials", std::move(materials_), where);
    tree.set("nodes", Node::array(std::move(nodes_), where), where);
    tree.set("elements", Node::array(std::move(elements_), where), where);
    tree.set("mass_points", Node::array(std::move(masses_), where), where);
    return tree;
  }

 private:
  void add_node(const SourcePosition& where) {
    Node node = Node::table(where);
    node.set("id", Node(++n_nodes_, where));
    node.set("x", Node(x_, where));
    nodes_.push_back(std::move(node));
  }

  template <class Given, class Value>
  void add_mass(const Row& row, const Given& given, const Value& value) {
    if (!given.contains("mass") && !given.contains("Ip") && !given.contains("Id")) return;
    Node mass = Node::table(row.front().where);
    mass.set("node", Node(n_nodes_, row.front().where));
    mass.set("mass", given.contains("mass") ? value("mass") : Node(0., row.front().where));
    for (const char* key : {"Ip", "Id"})
      if (given.contains(key)) mass.set(key, value(key), given.at(key).first->where);
    if (given.contains("name")) mass.set("name", Node(given.at("name").first->text, given.at("name").first->where));
    masses_.push_back(std::move(mass));
  }

  /// A section that names E, nu or rho is of a material of its own; steel gives what it leaves out.
  template <class Given, class Value>
  void add_material(Node& element, const Given& given, const Value& value) {
    if (!given.contains("E") && !given.contains("nu") && !given.contains("rho")) return;
    const std::string name = fmt::format("section {}", n_nodes_);
    Node material = steel();
    for (const char* key : {"E", "nu", "rho"})
      if (given.contains(key)) material.set(key, value(key), given.at(key).first->where);
    materials_.set(name, std::move(material));
    element.set("material", Node(name, element.where()));
  }

  const std::vector<Column>& columns_;
  int n_nodes_ = 0;
  double x_ = 0.;  ///< of the last node [m]
  Node materials_ = Node::table();
  Node::Array nodes_, elements_, masses_;
};

}  // namespace

Node read_shaft_table(const std::filesystem::path& file) {
  const SourcePosition where{file.string(), 0, 0};
  const auto rows = rows_of(file);
  if (rows.size() < 2)
    throw InputError(where, "the table needs a line that names its columns, and one for each section of the shaft.",
                     "For example: length [mm], outer_diameter [mm]");
  Faults faults;
  const auto columns = columns_of(rows.front(), faults);
  faults.throw_if_any();
  Sections sections(columns);
  for (std::size_t i = 1; i < rows.size(); ++i) sections.add(rows[i], i + 1 == rows.size(), faults);
  faults.throw_if_any();
  return std::move(sections).tree(where);
}

}  // namespace rotordrop
