#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rotordrop {

/// A formula over named numbers, in SI: + - * / ^, parentheses, sqrt, exp, log, sin, cos, tan, abs, min, max, pi. Names may hold dots and
/// entries of lists: "0.5 * bearings.TB1.rows[0].truncation". In quotes, single or double, they may hold anything: "2 * 'bearings.DE-1.friction_heat'".
class Expression {
 public:
  /// @throws std::invalid_argument with what is wrong, for text that is no formula
  explicit Expression(std::string text);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  Expression(const Expression& other);
  Expression& operator=(const Expression& other);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Names that it uses, each once.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Its value; `value_of` is asked for each of names(), in their order.
  [[nodiscard]] double value(const std::vector<double>& values) const;

  struct Term;

 private:
  std::string text_;
  std::vector<std::string> names_;
  std::shared_ptr<const Term> root_;
};

/// What to do if the text of a formula has one of these names without the quotes that it needs; empty: it has none.
std::string advice_on_quotes(const Expression& formula, const std::vector<std::string>& known);

}  // namespace rotordrop
