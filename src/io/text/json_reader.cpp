#include "io/text/json_reader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

#include "io/text/input_file.h"

namespace rotordrop {

namespace {

/// Walks through JSON text beside the parser, which does not tell where its tokens begin. It may rely on the text being
/// valid as far as the parser has come.
class TokenScanner {
 public:
  TokenScanner(std::string_view text, std::string file) : text_(text), where_{std::move(file), 1, 1} {
    if (text_.starts_with("\xEF\xBB\xBF"))  // byte order mark
      at_ = 3;
  }

  /// Where the next token other than a comma or colon begins; goes on to its end.
  SourcePosition next() {
    while (at_ < text_.size() && std::string_view(" \t\r\n,:").find(text_[at_]) != std::string_view::npos) advance();
    const SourcePosition start = where_;
    if (at_ >= text_.size()) return start;
    if (text_[at_] == '"')
      skip_string();
    else if (std::string_view("{}[]").find(text_[at_]) != std::string_view::npos)
      advance();
    else
      while (at_ < text_.size() && std::string_view(" \t\r\n,:]}").find(text_[at_]) == std::string_view::npos)
        advance();
    return start;
  }

  /// The place of a byte, counted from 0.
  SourcePosition place_of(std::size_t byte) {
    while (at_ < std::min(byte, text_.size())) advance();
    return where_;
  }

 private:
  void advance() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++where_.line;
      where_.column = 1;
    } else if ((c & 0xC0) != 0x80) {  // the further bytes of a UTF-8 character are in the same column
      ++where_.column;
    }
  }
  void skip_string() {
    advance();
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] == '\\') advance();
      if (at_ < text_.size()) advance();
    }
    if (at_ < text_.size()) advance();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  SourcePosition where_;
};

/// Builds the tree from the parser's events. The names are those of nlohmann::json_sax.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::string& file) : text_(text), file_(file), scanner_(text, file) {}

  bool null() {
    Node node;
    node.set_where(scanner_.next());
    return add(std::move(node));
  }
  bool boolean(bool value) { return add(Node(value, scanner_.next())); }
  bool number_integer(std::int64_t value) { return add(Node(value, scanner_.next())); }
  bool number_unsigned(std::uint64_t value) {
    const SourcePosition where = scanner_.next();
    if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      return add(Node(static_cast<double>(value), where));
    return add(Node(static_cast<std::int64_t>(value), where));
  }
  bool number_float(double value, const std::string&) { return add(Node(value, scanner_.next())); }
  bool string(std::string& value) {
    const SourcePosition where = scanner_.next();
    if (value.find('\0') != std::string::npos)
      faults_.add(where, "this text holds a NUL character.", "Take out \\u0000.");
    return add(Node(value, where));
  }
  bool binary(nlohmann::json::binary_t&) { return false; }  // does not occur in text
  bool start_object(std::size_t) { return open(Node::table(scanner_.next())); }
  bool start_array(std::size_t) { return open(Node::array({}, scanner_.next())); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    const SourcePosition where = scanner_.next();
    require_printable_key(name, where);
    require_table_size(open_.back().node.entries().size(), open_.back().node.where());
    if (open_.back().node.has(name)) faults_.add(where, fmt::format("key \"{}\" occurs twice in this object.", name));
    open_.back().key = name;
    open_.back().where_key = where;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
    // The parser counts the bytes that it has read, including the one that it did not expect.
    const SourcePosition where = TokenScanner(text_, file_).place_of(position == 0 ? 0 : position - 1);
    faults_.add(where, fmt::format("this is not valid JSON: {}.", shortened(error.what())));
    return false;
  }

  Node result() {
    faults_.throw_if_any();
    return std::move(root_).value_or(Node());
  }

 private:
  struct Open {
    Node node;
    std::string key;
    SourcePosition where_key;
  };

  bool open(Node node) {
    if (open_.size() > deepest_input) {
      faults_.add(node.where(), fmt::format("objects or arrays are nested more than {} deep here.", deepest_input),
                  "No rotor needs that; check the file.");
      return false;
    }
    open_.push_back({std::move(node), "", {}});
    return true;
  }
  bool close() {
    scanner_.next();
    Node node = std::move(open_.back().node);
    open_.pop_back();
    return add(std::move(node));
  }
  bool add(Node node) {
    if (open_.empty())
      root_ = std::move(node);
    else if (Open& parent = open_.back(); parent.node.is_array())
      parent.node.items().push_back(std::move(node));
    else
      parent.node.set(parent.key, std::move(node), parent.where_key);
    return true;
  }
  /// Without the parser's number of the error and its own count of lines: "syntax error while parsing value -
  /// unexpected ..."
  static std::string shortened(std::string message) {
    if (const auto bracket = message.find("] "); message.starts_with('[') && bracket != std::string::npos)
      message.erase(0, bracket + 2);
    const auto start = message.find(": ");
    return start == std::string::npos ? message : message.substr(start + 2);
  }

  std::string_view text_;
  std::string file_;
  TokenScanner scanner_;
  std::vector<Open> open_;
  std::optional<Node> root_;
  Faults faults_;
};

}  // namespace

Node parse_json(std::string_view text, const std::string& file) {
  TreeBuilder builder(text, file);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  return builder.result();
}

Node read_json(const std::filesystem::path& path) { return parse_json(read_input_file(path), path.string()); }

}  // namespace rotordrop
