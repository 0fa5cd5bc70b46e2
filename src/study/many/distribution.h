#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/node.h"

namespace rotordrop {

/// How one varied parameter is distributed, or which values it takes.
struct Distribution {
  enum class Kind { values, uniform, log_uniform, normal, truncated_normal, triangular };
  Kind kind = Kind::values;
  std::vector<Node> values;     ///< of Kind::values, in the order of the file; numbers in SI
  std::vector<double> weights;  ///< of `values`, summing to 1; empty: equal
  double lower = 0, upper = 0;  ///< SI; of all but `normal`
  double mean = 0, deviation = 0, mode = 0;

  [[nodiscard]] bool is_continuous() const { return kind != Kind::values; }
  [[nodiscard]] bool has_ends() const { return is_continuous() && kind != Kind::normal; }
  /// Value of a continuous distribution at a probability in (0, 1), SI.
  [[nodiscard]] double quantile(double probability) const;
  /// Index of the discrete value at a probability in (0, 1).
  [[nodiscard]] std::size_t index(double probability) const;
  /// Evenly spaced levels: of a range from end to end (evenly in the logarithm if log-uniform), of other distributions at the middles of
  /// n equally probable parts.
  [[nodiscard]] std::vector<double> levels(std::size_t n) const;
};

/// "uniform", "log-uniform", ... as a study file names it.
std::string name_of(Distribution::Kind kind);

}  // namespace rotordrop
