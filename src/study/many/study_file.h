#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/case_family.h"
#include "case/keys/case_keys.h"
#include "case/keys/dotted_names.h"
#include "case/limits.h"
#include "study/drop/summary_parts.h"
#include "study/many/distribution.h"
#include "study/many/expression.h"
#include "study/many/search/fit_keys.h"
#include "study/many/search/minimise_keys.h"
#include "study/many/surrogate/surrogate_keys.h"

namespace rotordrop {

/// One parameter of [vary]: what is drawn once and set into one key of the case or several.
struct VariedParameter {
  std::string name;  ///< as the file has it: a key of the case, or a name of its own for several keys
  std::vector<DeclaredKey> keys;
  Distribution distribution;
  std::optional<std::size_t> levels;    ///< of a grid or one-at-a-time
  std::optional<Node> reference;        ///< of one-at-a-time
  std::optional<Expression> formula;    ///< derived from other parameters: not drawn
  std::vector<std::size_t> formula_of;  ///< which of the study's parameters the formula's names are
  SourcePosition where;

  [[nodiscard]] const std::string& unit() const { return keys.front().unit; }
  /// Whether values are numbers; else texts or booleans.
  [[nodiscard]] bool is_numeric() const;
};

enum class DesignKind {
  grid,
  list,
  one_at_a_time,
  latin_hypercube,
  sobol_sequence,
  saltelli,
  morris,
  monte_carlo,
  search
};
std::string name_of(DesignKind kind);

/// [design].
struct DesignParameters {
  DesignKind kind = DesignKind::latin_hypercube;
  std::optional<int> size;  ///< rows; rows of each of Saltelli's two samples; trajectories of Morris
  int seed = 1;
  std::optional<int> levels;  ///< of a range in a grid or one-at-a-time (5), of the grid of Morris (4)
  bool scramble = true;
};

/// A result made from others by a formula.
struct DerivedResult {
  std::string name;
  Expression formula;
  std::string unit;
  SourcePosition where;
};

/// [choose]: which level of a parameter is best by a quantile of a result.
struct Choice {
  std::string parameter, result;
  double quantile = 0.95;
  SourcePosition where;
};

enum class FailurePolicy { go_on, stop, retry };

struct RankCorrelation {
  std::size_t first = 0, second = 0;  ///< of the drawn parameters
  double value = 0;                   ///< Spearman's
};

/// A study as read: what is varied, how, how often, and what is asked.
struct Study {
  std::filesystem::path file, case_file;
  std::string name;
  std::vector<std::string> set;             ///< overrides of every point
  Case base;                                ///< the case with `set`
  std::shared_ptr<const CaseFamily> cases;  ///< the cases of its points
  std::vector<VariedParameter> parameters;
  DesignParameters design;
  int n_replicates = 1;
  double replicate_spread = 1e-9;  ///< [m]
  std::vector<Limit> limits;
  std::vector<DerivedResult> derived;
  std::optional<Choice> choice;
  std::vector<RankCorrelation> correlations;
  std::optional<MinimiseParameters> minimise;
  std::optional<Fit> fit;
  std::optional<SurrogateParameters> surrogate;
  std::vector<std::string> surrogate_results;
  std::vector<std::size_t> searched;      ///< of a search: which of the drawn parameters it changes
  std::vector<std::string> keep_results;  ///< patterns; empty: all numbers
  std::vector<std::string> keep_series;   ///< datasets of results.h5
  SummaryParts parts;                     ///< that what is kept needs; known after probe_results()
  FailurePolicy on_failure = FailurePolicy::go_on;
  std::optional<bool> lanes_asked;  ///< none: as the first point can
  bool lanes = false;               ///< points that are alike run side by side; known after choose_lanes()
  std::string text;                 ///< of the file

  /// Whether its points follow from one another, instead of from a design.
  [[nodiscard]] bool is_search() const { return minimise.has_value() || fit.has_value(); }
  /// Evaluations of each of its searches, at most.
  [[nodiscard]] std::size_t evaluations_of_search() const;
  [[nodiscard]] std::size_t n_searches() const;
  /// Parameters that are drawn, as positions in `parameters`.
  [[nodiscard]] std::vector<std::size_t> drawn() const;
};

/// Reads and checks a study file, without its points. @throws InputError with all faults
/// @param overrides  keys of the case, for every point
/// @param case_file  instead of the one that the study names; empty: that one
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 const std::filesystem::path& case_file = {});

/// Declarations of a study file.
std::vector<ErasedSection> study_sections();

}  // namespace rotordrop
