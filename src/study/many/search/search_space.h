#pragma once
#include <vector>

#include "study/many/design.h"
#include "study/many/journal.h"

namespace rotordrop {

/// Whether a value lies in a range, but for rounding by units.
bool is_in_range(const Distribution& range, double value);

/// Where a search moves, and the drops of one evaluation. A place is one number in [0, 1] for each searched parameter: its part of the range
/// (of the logarithms, for a range with scale = "log").
class SearchSpace {
 public:
  /// @throws InputError if the parameters that are not searched have no sample
  explicit SearchSpace(const Study& study);

  [[nodiscard]] std::size_t n_dimensions() const { return study_.searched.size(); }
  /// Rows of the sample of what is not searched; 1 if everything is.
  [[nodiscard]] std::size_t n_rows() const { return sample_.n_rows; }
  [[nodiscard]] std::size_t n_drops() const;
  [[nodiscard]] const VariedParameter& parameter(std::size_t dimension) const;

  /// Values of the searched parameters at a place, SI.
  [[nodiscard]] std::vector<double> values(const std::vector<double>& place) const;
  /// The place of these values.
  [[nodiscard]] std::vector<double> place(const std::vector<double>& values) const;
  /// Places where searches start [n][n_dimensions].
  [[nodiscard]] std::vector<std::vector<double>> starts(std::size_t n) const;
  /// The rows of one evaluation, or of several.
  [[nodiscard]] Design rows_at(const std::vector<std::vector<double>>& values) const;
  /// The first start and the corners of the box, as rows that can be checked.
  [[nodiscard]] Design corners() const;

 private:
  const Study& study_;
  std::vector<std::size_t> drawn_;
  Design sample_;
};

/// Number of an evaluation's first drop in the journal.
inline std::size_t first_drop(std::size_t search, std::size_t evaluation, std::size_t n_evaluations,
                              std::size_t n_drops) {
  return (search * n_evaluations + evaluation) * n_drops;
}

/// The design that a search has made so far: its evaluations in their order. Points are numbered anew, from 0.
Design design_of_search(const Study& study, Journal::Content& content);

/// Design of a study's directory: as its file says, or as its search went.
Design design_of(const Study& study, Journal::Content& content);

}  // namespace rotordrop
