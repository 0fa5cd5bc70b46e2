#pragma once

#include "base/errors.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rotordrop {

/// A value of an input file, with its place in that file: null, boolean, integer, real, text, array or table.
/// Tables keep the order of the file and know the place of every key. Readers of TOML and JSON make it; sections read
/// it.
class Node {
 public:
  enum class Kind { null, boolean, integer, real, text, array, table };
  struct Entry;
  using Array = std::vector<Node>;
  using Table = std::vector<Entry>;

  Node() = default;
  Node(bool value, SourcePosition where = {});
  Node(int value, SourcePosition where = {});
  Node(std::int64_t value, SourcePosition where = {});
  Node(double value, SourcePosition where = {});
  Node(const char* value, SourcePosition where = {});
  Node(std::string value, SourcePosition where = {});
  static Node array();
  static Node array(Array items, SourcePosition where = {});
  static Node table(SourcePosition where = {});
  static Node table(std::initializer_list<std::pair<std::string, Node>> entries);

  Kind kind() const { return static_cast<Kind>(value_.index()); }
  bool is(Kind kind) const { return this->kind() == kind; }
  bool is_table() const { return is(Kind::table); }
  bool is_array() const { return is(Kind::array); }
  bool is_text() const { return is(Kind::text); }
  bool is_number() const { return is(Kind::integer) || is(Kind::real); }

  // Values; each throws std::bad_variant_access for another kind.
  bool boolean() const { return std::get<bool>(value_); }
  std::int64_t integer() const { return std::get<std::int64_t>(value_); }
  double number() const;  ///< of an integer or a real
  const std::string& text() const { return std::get<std::string>(value_); }
  const Array& items() const { return std::get<Array>(value_); }
  Array& items() { return std::get<Array>(value_); }
  const Table& entries() const { return std::get<Table>(value_); }
  Table& entries() { return std::get<Table>(value_); }

  /// The value of a key of this table; nullptr if there is none, or if this is no table.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Adds or replaces a key of this table. Returns the stored value. What stands behind the key stays if its place does.
  Node& set(std::string key, Node value, SourcePosition where_key = {});
  Node& set(Entry entry);
  /// A key with what belongs to it; nullptr if there is none, or if this is no table.
  const Entry* entry(std::string_view key) const;
  void erase(std::string_view key);

  /// Where the value stands; for a table "[contact]", its header.
  const SourcePosition& where() const { return where_; }
  void set_where(SourcePosition where) { where_ = std::move(where); }

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> value_;
  SourcePosition where_;
};

struct Node::Entry {
  std::string key;
  SourcePosition where;  ///< of the key
  Node value;
  std::string comment = {};  ///< what its author wrote behind it, on its line
};

/// Where a key of this table stands; the place of the table itself if the key is not given. A dotted path such as
/// "support.mass" goes down into sub-tables.
SourcePosition position_of(const Node& table, std::string_view key);

/// Where the value of a key stands, otherwise as position_of. Prefer it for faults about a value.
SourcePosition position_of_value(const Node& table, std::string_view key);

/// `over` on top of `defaults`: tables are merged key by key, everything else is replaced. Positions are kept.
Node merged(const Node& defaults, const Node& over);

/// The value as messages show it: -5 um, 0.1, true, [1, 2], {a = 1}.
std::string to_text(const Node& node);

/// "a boolean", "an integer", "a number", "a text", "an array", "a table", "empty (null)".
std::string kind_name(const Node& node);

}  // namespace rotordrop
