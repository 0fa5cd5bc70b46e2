#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace rotordrop {

namespace {

constexpr std::size_t page_width = 120;

/// Breaks a line at spaces where it would pass the page; every line starts with the indent.
std::string indented(const std::string& text, const std::string& indent) {
  std::string result;
  std::size_t start = 0;
  while (start < text.size()) {
    std::size_t end = std::min(text.find('\n', start), text.size());
    std::size_t next = end + 1;
    if (indent.size() + end - start > page_width) {
      const std::size_t space = text.rfind(' ', start + page_width - indent.size());
      if (space != std::string::npos && space > start) {
        end = space;
        next = space + 1;
      }
    }
    result += "\n" + indent + text.substr(start, end - start);
    start = next;
  }
  return result;
}

/// A text of which nobody reads the middle; whole letters of UTF-8.
std::string shortened(std::string text) {
  constexpr std::size_t longest = 10'000, n_begin = 1000, n_end = 500;
  if (text.size() <= longest) return text;
  const auto is_within_letter = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0u) == 0x80u; };
  std::size_t begin = n_begin, end = text.size() - n_end;
  while (is_within_letter(begin)) --begin;
  while (is_within_letter(end)) --end;
  return fmt::format("{} ... ({} characters) ... {}", text.substr(0, begin), end - begin, text.substr(end));
}

/// Files in the order in which they were first named, each by line and column.
std::vector<Fault> sorted(std::vector<Fault> faults) {
  std::map<std::string, std::size_t> files;
  for (const Fault& fault : faults) files.emplace(fault.where.file.text(), files.size());
  const auto place = [&](const Fault& fault) {
    return std::tuple(files.at(fault.where.file.text()), fault.where.line, fault.where.column);
  };
  std::stable_sort(faults.begin(), faults.end(), [&](const Fault& a, const Fault& b) { return place(a) < place(b); });
  return faults;
}

std::string rendered_all(const std::vector<Fault>& faults) {
  constexpr std::size_t at_most = 100;  // nobody reads more before mending these
  std::string result;
  for (std::size_t i = 0; i < std::min(at_most, faults.size()); ++i)
    result += (result.empty() ? "" : "\n\n") + rendered(faults[i]);
  if (faults.size() > at_most) result += fmt::format("\n\nerror: and {} more faults", faults.size() - at_most);
  return result;
}

}  // namespace

std::string to_string(const SourcePosition& where) {
  if (where.line == 0) return where.file.text();
  return fmt::format("{}:{}:{}", where.file.text(), where.line, where.column);
}

void Faults::add(Fault fault) {
  // Of thousands, which take long to compare, the first hundred are shown: one that is there twice is no matter.
  constexpr std::size_t n_compared = 1000;
  fault.message = shortened(std::move(fault.message));
  fault.advice = shortened(std::move(fault.advice));
  if (faults_.size() > n_compared || std::find(faults_.begin(), faults_.end(), fault) == faults_.end())
    faults_.push_back(std::move(fault));
}

void Faults::add(SourcePosition where, std::string message, std::string advice) {
  add(Fault{std::move(where), std::move(message), std::move(advice), {}});
}

void Faults::add(const std::vector<Fault>& others) {
  for (const Fault& fault : others) add(fault);
}

void Faults::add(const Faults& others) { add(others.faults_); }

void Faults::throw_if_any() const {
  if (!faults_.empty()) throw InputError(*this);
}

InputError::InputError(std::vector<Fault> sorted_faults)
    : std::runtime_error(rendered_all(sorted_faults)), faults_(std::move(sorted_faults)) {}

InputError InputError::with(std::vector<Fault> sorted_faults) { return InputError(std::move(sorted_faults)); }

InputError::InputError(const Faults& faults) : InputError(sorted({faults.begin(), faults.end()})) {}

InputError::InputError(SourcePosition where, std::string message, std::string advice)
    : InputError(
          std::vector<Fault>{{std::move(where), shortened(std::move(message)), shortened(std::move(advice)), {}}}) {}

std::string rendered(const Fault& fault) {
  const std::string where = fault.where.is_known() ? to_string(fault.where) + ": " : "";
  return "error: " + where + fault.message + indented(fault.advice, "       ");
}

}  // namespace rotordrop
