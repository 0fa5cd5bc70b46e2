#include "base/node.h"

#include "base/units.h"

#include <algorithm>

namespace rotordrop {

Node::Node(bool value, SourcePosition where) : value_(value), where_(std::move(where)) {}
Node::Node(int value, SourcePosition where) : value_(std::int64_t{value}), where_(std::move(where)) {}
Node::Node(std::int64_t value, SourcePosition where) : value_(value), where_(std::move(where)) {}
Node::Node(double value, SourcePosition where) : value_(value), where_(std::move(where)) {}
Node::Node(const char* value, SourcePosition where) : value_(std::string(value)), where_(std::move(where)) {}
Node::Node(std::string value, SourcePosition where) : value_(std::move(value)), where_(std::move(where)) {}

Node Node::array() { return array(Array()); }

Node Node::array(Array items, SourcePosition where) {
  Node node;
  node.value_ = std::move(items);
  node.where_ = std::move(where);
  return node;
}

Node Node::table(SourcePosition where) {
  Node node;
  node.value_ = Table{};
  node.where_ = std::move(where);
  return node;
}

Node Node::table(std::initializer_list<std::pair<std::string, Node>> entries) {
  Node node = table();
  for (const auto& [key, value] : entries) node.set(key, value);
  return node;
}

double Node::number() const { return is(Kind::integer) ? static_cast<double>(integer()) : std::get<double>(value_); }

const Node::Entry* Node::entry(std::string_view key) const {
  if (!is_table()) return nullptr;
  const auto found = std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.key == key; });
  return found == entries().end() ? nullptr : &*found;
}

const Node* Node::find(std::string_view key) const {
  const Entry* found = entry(key);
  return found ? &found->value : nullptr;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::set(std::string key, Node value, SourcePosition where_key) {
  const Entry* before = entry(key);
  std::string comment = before && before->where == where_key ? before->comment : "";
  return set(Entry{std::move(key), std::move(where_key), std::move(value), std::move(comment)});
}

Node& Node::set(Entry entry) {
  for (Entry& own : entries())
    if (own.key == entry.key) return (own = std::move(entry)).value;
  return entries().emplace_back(std::move(entry)).value;
}

void Node::erase(std::string_view key) {
  std::erase_if(entries(), [&](const Entry& entry) { return entry.key == key; });
}

namespace {

/// Follows a dotted path as far as it exists: the entry of its last key, or nullptr and the last table on the way.
std::pair<const Node::Entry*, const Node*> follow(const Node& table, std::string_view path) {
  if (!table.is_table()) return {nullptr, &table};
  for (const Node::Entry& entry : table.entries()) {
    if (entry.key == path) return {&entry, &table};
    if (path.starts_with(entry.key) && path.substr(entry.key.size()).starts_with('.'))
      return follow(entry.value, path.substr(entry.key.size() + 1));
  }
  return {nullptr, &table};
}

}  // namespace

SourcePosition position_of(const Node& table, std::string_view key) {
  const auto [entry, last_table] = follow(table, key);
  return entry ? entry->where : last_table->where();
}

SourcePosition position_of_value(const Node& table, std::string_view key) {
  const auto [entry, last_table] = follow(table, key);
  return entry ? entry->value.where() : last_table->where();
}

Node merged(const Node& defaults, const Node& over) {
  if (!defaults.is_table() || !over.is_table()) return over;
  Node result = defaults;
  result.set_where(over.where());
  for (const Node::Entry& entry : over.entries()) {
    if (const Node* base = defaults.find(entry.key))
      result.set(Node::Entry{entry.key, entry.where, merged(*base, entry.value), entry.comment});
    else
      result.entries().push_back(entry);  // keys of a table differ: no search, which takes long among thousands
  }
  return result;
}

std::string to_text(const Node& node) {
  const auto joined = [](const auto& range, const auto& text_of) {
    std::string result;
    for (const auto& item : range) result += (result.empty() ? "" : ", ") + text_of(item);
    return result;
  };
  switch (node.kind()) {
    case Node::Kind::null:
      return "null";
    case Node::Kind::boolean:
      return node.boolean() ? "true" : "false";
    case Node::Kind::integer:
      return std::to_string(node.integer());
    case Node::Kind::real:
      return shortest(node.number());
    case Node::Kind::text:
      return node.text();
    case Node::Kind::array:
      return "[" + joined(node.items(), to_text) + "]";
    case Node::Kind::table:
      return "{" + joined(node.entries(), [](const Node::Entry& e) { return e.key + " = " + to_text(e.value); }) + "}";
  }
  return "";
}

std::string kind_name(const Node& node) {
  switch (node.kind()) {
    case Node::Kind::null:
      return "empty (null)";
    case Node::Kind::boolean:
      return "a boolean";
    case Node::Kind::integer:
      return "an integer";
    case Node::Kind::real:
      return "a number";
    case Node::Kind::text:
      return "a text";
    case Node::Kind::array:
      return "an array";
    case Node::Kind::table:
      return "a table";
  }
  return "";
}

}  // namespace rotordrop
