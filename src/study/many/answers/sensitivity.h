#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "study/many/answers/statistics.h"

namespace rotordrop {

/// Sobol indices of one parameter.
struct SobolIndices {
  Estimate first, total;
};
/// Answers of Saltelli's design, blocks in rows: A, B, A with parameter 1 of B, ... A block with a NaN is left out.
/// First order by Saltelli et al. 2010 (table 2 b), total by Jansen 1999; percentile intervals of `n_resamples` bootstrap samples of blocks.
struct SobolResult {
  std::vector<SobolIndices> parameters;
  std::size_t n_blocks = 0, n_left_out = 0;
};
SobolResult sobol_indices(const std::vector<double>& y, std::size_t n_parameters, std::uint64_t seed,
                          std::size_t n_resamples = 500);

/// How first indices follow from a sample.
enum class FirstBy {
  /// Squares of differences of neighbours by a parameter, half of whose mean is the variance that the others leave (von Neumann 1941, Rice 1984). The products of neighbours of
  /// Gamboa, Gremaud, Klein & Lagnoux (2022) are the same but for the ends, which they join, and are too small by that. Neighbours by one parameter must
  /// know nothing of each other's other ones: Latin hypercubes, independent points. Points of a Sobol' sequence are laid out against each other and do not serve.
  ranks,
  /// Variance of the means of classes with equally many points by a parameter (Plischke, Borgonovo & Smith 2013). About as many classes as points in
  /// each, a power of two: in each class of a Sobol' sequence the other parameters fill their ranges evenly. A parameter with no more values than classes
  /// has its values for classes. Where points scatter it is too large by up to classes / points, and its interval reaches down by that.
  classes
};

/// First indices from a sample; points with a NaN drop out. Intervals: 1.96 standard errors by the delete-half jackknife, since repeated points of a bootstrap
/// would be each other's neighbours; up by what half as many points miss, if that is more.
class FirstIndices {
 public:
  /// @param x  [parameters][points]
  FirstIndices(FirstBy by, std::vector<std::vector<double>> x, std::uint64_t seed, std::size_t n_halves = 200);
  /// @param y  [points]
  [[nodiscard]] std::vector<Estimate> first(const std::vector<double>& y) const;

 private:
  FirstBy by_;
  std::vector<std::vector<std::size_t>> orders_;   ///< points by each parameter
  std::vector<std::vector<std::size_t>> levels_;   ///< which of its values a point has, of each parameter, rising
  std::vector<std::vector<std::uint8_t>> halves_;  ///< points in each half
};

/// Elementary effects of one parameter (Morris 1991, Campolongo et al. 2007), per range of the parameter.
struct MorrisEffects {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double mean = unknown;
  Estimate mean_magnitude{unknown, {}, {}};  ///< mu*
  double deviation = unknown;                ///< sigma; of two effects at least
  std::size_t n = 0;                         ///< effects whose both ends are there
};
/// @param unit  [rows, parameters] of the design; @param y [rows], NaN where there is none
std::vector<MorrisEffects> morris_effects(const std::vector<double>& unit, const std::vector<double>& y,
                                          std::size_t n_parameters, std::uint64_t seed, std::size_t n_resamples = 500);

}  // namespace rotordrop
