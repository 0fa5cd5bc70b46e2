#pragma once
#include <optional>
#include <vector>

namespace rotordrop {

/// An estimate with its 95 % confidence interval; an end that the sample cannot give is missing.
struct Estimate {
  double value = 0;
  std::optional<double> low, high;
};

double mean_of(const std::vector<double>& values);
/// Whether values differ by more than roundoff. Those that are no numbers are passed over.
bool varies(const std::vector<double>& values);
/// Unbiased standard deviation; 0 of fewer than two values.
double deviation_of(const std::vector<double>& values);
/// Quantile of sorted values by linear interpolation (Hyndman & Fan's type 7).
double quantile_of(const std::vector<double>& sorted, double probability);
/// With the distribution-free interval between order statistics whose binomial coverage is at least 95 %.
Estimate quantile_estimate(const std::vector<double>& sorted, double probability);
/// Clopper & Pearson's interval of a probability: `hits` of n independent trials. With replicates `hits` need not be a whole number.
Estimate probability_estimate(double hits, double n);

}  // namespace rotordrop
