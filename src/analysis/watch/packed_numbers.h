#pragma once
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace rotordrop {

/// Numbers to which pointers lead, as a checkpoint holds them.
template <class Pointers>
[[nodiscard]] std::vector<double> packed_numbers(const Pointers& numbers) {
  std::vector<double> values;
  for (const double* number : numbers) values.push_back(*number);
  return values;
}

/// Puts them back. @throws std::invalid_argument if there are not as many
template <class Pointers>
void unpack_numbers(const std::vector<double>& values, const Pointers& numbers) {
  if (values.size() != numbers.size()) throw std::invalid_argument("a checkpoint of another kind");
  for (std::size_t k = 0; k < values.size(); ++k) *numbers[k] = values[k];
}

}  // namespace rotordrop
