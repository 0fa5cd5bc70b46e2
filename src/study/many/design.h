#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "study/many/study_file.h"

namespace rotordrop {

/// Which evaluation of which search a step is; both from 0.
struct SearchStep {
  std::size_t search = 0, evaluation = 0;
};

/// The rows of a study's design, in their order.
struct Design {
  DesignKind kind = DesignKind::grid;
  std::size_t n_rows = 0, n_drawn = 0;
  std::size_t n_blocks =
      0;  ///< of Saltelli's design: rows A, B, A with parameter 1 of B, ...; of Morris's: trajectories
  std::vector<int> morris_levels;  ///< [n_drawn] of Morris's design
  std::vector<double>
      unit;  ///< [n_rows, n_drawn] coordinates in the unit cube of sampled designs; of Morris's: k / (levels - 1)
  std::vector<double> cells;  ///< [n_rows, n_drawn] value in SI, or index into `nodes` where that is not empty
  std::vector<std::vector<Node>> nodes;  ///< [n_drawn] values by index; empty: numbers

  std::vector<SearchStep> steps;  ///< of a search: evaluations in their order
  std::size_t rows_per_step = 1;  ///< of a search

  [[nodiscard]] Node value(std::size_t row, std::size_t drawn) const;
  /// Of a search: the evaluation to which a row belongs.
  [[nodiscard]] const SearchStep& step_of(std::size_t row) const { return steps[row / rows_per_step]; }
};

/// Value of a key in the case itself, in SI; none if the case gives none.
std::optional<Node> own_value(const Study& study, const DeclaredKey& key);

/// @throws InputError if the design would have more than 10 million drops, or its correlations contradict each other
Design make_design(const Study& study);

/// One drop of a study.
struct StudyPoint {
  std::size_t row = 0;  ///< of the design
  int replicate = 0;
  std::vector<Node> values;            ///< of each parameter, drawn or derived
  std::vector<std::string> overrides;  ///< KEY=VALUE, as `rotordrop run --set` takes them
};

/// Number of drops: rows times replicates.
std::size_t n_points(const Study& study, const Design& design);
StudyPoint point_of(const Study& study, const Design& design, std::size_t index);

}  // namespace rotordrop
