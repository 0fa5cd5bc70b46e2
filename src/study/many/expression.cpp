#include "study/many/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace rotordrop {

struct Expression::Term {
  using Child = std::shared_ptr<const Term>;
  std::function<double(const std::vector<double>&)> value;
};

namespace {

using Term = Expression::Term;
using Child = std::shared_ptr<const Term>;
using Values = std::vector<double>;

Child make(std::function<double(const Values&)> value) { return std::make_shared<const Term>(Term{std::move(value)}); }

/// Recursive descent; a formula is short.
class Parser {
 public:
  Parser(const std::string& text, std::vector<std::string>& names) : text_(text), names_(names) {}

  /// Whether a character may stand in a name without quotes.
  static bool belongs(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '[' || c == ']';
  }

  Child parse() {
    constexpr std::size_t longest =
        10'000;  // each sign and operator takes a step down when a formula is read and when it is evaluated
    if (text_.size() > longest) fail("more than 10000 characters");
    Child all = sum();
    if (skip() != '\0') fail("unexpected \"" + text_.substr(at_, 10) + "\"");
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw std::invalid_argument(what); }

  char skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (skip() != c) return false;
    ++at_;
    return true;
  }

  Child sum() {
    Child left = product();
    while (true) {
      if (take('+'))
        left = make([left, right = product()](const Values& v) { return left->value(v) + right->value(v); });
      else if (take('-'))
        left = make([left, right = product()](const Values& v) { return left->value(v) - right->value(v); });
      else
        return left;
    }
  }
  Child product() {
    Child left = sign();
    while (true) {
      if (take('*'))
        left = make([left, right = sign()](const Values& v) { return left->value(v) * right->value(v); });
      else if (take('/'))
        left = make([left, right = sign()](const Values& v) { return left->value(v) / right->value(v); });
      else
        return left;
    }
  }
  Child sign() {
    if (take('-')) return make([inner = sign()](const Values& v) { return -inner->value(v); });
    if (take('+')) return sign();
    return power();
  }
  Child power() {
    Child base = atom();
    if (!take('^')) return base;
    return make([base, exponent = sign()](const Values& v) { return std::pow(base->value(v), exponent->value(v)); });
  }
  Child atom() {
    if (++depth_ > 100) fail("too many parentheses");
    const char c = skip();
    Child result;
    if (take('(')) {
      result = sum();
      if (!take(')')) fail("a parenthesis is not closed");
    } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      char* end = nullptr;
      const double number = std::strtod(text_.c_str() + at_, &end);
      at_ = static_cast<std::size_t>(end - text_.c_str());
      if (end == text_.c_str() || !std::isfinite(number)) fail("a number is malformed");
      if (at_ < text_.size() && belongs(text_[at_])) fail_within_name();
      result = make([number](const Values&) { return number; });
    } else if (c == '\'' || c == '"') {
      result = number_called(quoted_name(c));
    } else if (std::isalpha(static_cast<unsigned char>(c)) || c == '_') {
      result = named(name());
    } else {
      fail(c == '\0' ? "it ends too early" : std::string("unexpected \"") + c + "\"");
    }
    --depth_;
    return result;
  }
  /// A number that goes on as a name does, as in bearings.DE-1.peak_contact_force.
  [[noreturn]] void fail_within_name() const {
    const auto is_of_word = [](char c) { return belongs(c) || c == '-'; };
    std::size_t begin = at_, end = at_;
    while (begin > 0 && is_of_word(text_[begin - 1])) --begin;
    while (end < text_.size() && is_of_word(text_[end])) ++end;
    const std::string word = text_.substr(begin, end - begin);
    fail("\"" + word + "\" is neither a number nor a name; if it is one, write it in quotes: '" + word + "',");
  }
  std::string quoted_name(char quote) {
    const std::size_t begin = ++at_, end = text_.find(quote, begin);
    if (end == std::string::npos) fail("a name in quotes is not closed");
    if (end == begin) fail("a name in quotes is empty");
    at_ = end + 1;
    return text_.substr(begin, end - begin);
  }
  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  Child named(const std::string& word) {
    if (skip() == '(') return function(word);
    if (word == "pi") return make([](const Values&) { return std::numbers::pi; });
    return number_called(word);
  }
  Child number_called(const std::string& word) {
    const auto found = std::find(names_.begin(), names_.end(), word);
    const auto index = static_cast<std::size_t>(found - names_.begin());
    if (found == names_.end()) names_.push_back(word);
    return make([index](const Values& v) { return v.at(index); });
  }
  Child function(const std::string& word) {
    using F = double (*)(double);
    static constexpr std::array<std::pair<const char*, F>, 7> functions{{{"sqrt", std::sqrt},
                                                                         {"exp", std::exp},
                                                                         {"log", std::log},
                                                                         {"sin", std::sin},
                                                                         {"cos", std::cos},
                                                                         {"tan", std::tan},
                                                                         {"abs", std::fabs}}};
    take('(');
    std::vector<Child> arguments{sum()};
    while (take(',')) arguments.push_back(sum());
    if (!take(')')) fail("a parenthesis is not closed");
    if (word == "min" || word == "max")
      return make([arguments, is_min = word == "min"](const Values& v) {
        double result = arguments.front()->value(v);
        for (const auto& argument : arguments) {
          const double next = argument->value(v);
          if (std::isnan(next)) return next;
          result = is_min ? std::min(result, next) : std::max(result, next);
        }
        return result;
      });
    for (const auto& [name, f] : functions)
      if (word == name) {
        if (arguments.size() != 1) fail(word + " takes one argument");
        return make([inner = arguments.front(), g = f](const Values& v) { return g(inner->value(v)); });
      }
    fail("unknown function \"" + word + "\"; known: sqrt, exp, log, sin, cos, tan, abs, min, max");
  }

  const std::string& text_;
  std::vector<std::string>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Expression::Expression(std::string text) : text_(std::move(text)) { root_ = Parser(text_, names_).parse(); }
Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::Expression(const Expression& other) = default;
Expression& Expression::operator=(const Expression& other) = default;

std::string advice_on_quotes(const Expression& formula, const std::vector<std::string>& known) {
  const std::string& text = formula.text();
  for (const auto& name : known) {
    if (std::all_of(name.begin(), name.end(), Parser::belongs)) continue;
    const auto at = text.find(name);
    if (at == std::string::npos || (at > 0 && (text[at - 1] == '\'' || text[at - 1] == '"'))) continue;
    return "Write this name in quotes, since - would be a minus: '" + name + "'.";
  }
  return "";
}

double Expression::value(const std::vector<double>& values) const { return root_->value(values); }

}  // namespace rotordrop
