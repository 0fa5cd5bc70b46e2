#include "base/parameters/suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace rotordrop {

namespace {

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string closest_name(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 100;  // of what somebody may have typed as a name
  if (word.size() > longest) return "";
  const std::string given = lower_case(word);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(given.size() < 4 ? 1 : 2, given.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(given, lower_case(name));
    if (distance < best_distance && distance < std::max(given.size(), name.size())) {
      best = name;
      best_distance = distance;
    }
  }
  if (!best.empty()) return best;
  // "friction" for "friction_coefficient": the only name that it begins.
  std::vector<std::string> longer;
  for (const std::string& name : names)
    if (given.size() >= 3 && lower_case(name).starts_with(given)) longer.push_back(name);
  return longer.size() == 1 ? longer.front() : "";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known, const std::string& rest,
                       std::string_view path) {
  const std::string close = closest_name(word, known);
  if (close.empty()) return rest;
  return fmt::format("Did you mean \"{}{}\"?{}{}", path, close, rest.empty() ? "" : "  ", rest);
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  return suggestion(word, known, fmt::format("Known: {}.", fmt::join(known, ", ")));
}

}  // namespace rotordrop
