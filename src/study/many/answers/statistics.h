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
/// Unbiased standard deviation; 0 of values that do not vary by more than roundoff, and of fewer than two.
double deviation_of(const std::vector<double>& values);
/// Part of the variance that lies within groups, 0 to 1, by the components of variance of a one-way analysis:
///
///   W / (W + B),  B = max(0, (MSB - W)/n0),  n0 = (N - sum n_i^2/N)/(a - 1)
///
/// with the mean squares W within and MSB between a groups of n_i values, N in all. Source: Searle, Linear Models (1971), 10.3.
/// None where it is not known: values do not vary, fewer than two groups have some, or none has two.
std::optional<double> share_within(const std::vector<std::vector<double>>& groups);
/// Quantile of sorted values by linear interpolation (Hyndman & Fan's type 7).
double quantile_of(const std::vector<double>& sorted, double probability);
/// With the distribution-free interval between order statistics whose binomial coverage is at least 95 %.
Estimate quantile_estimate(const std::vector<double>& sorted, double probability);
/// Clopper & Pearson's interval of a probability: `hits` of n independent trials. With replicates `hits` need not be a whole number.
Estimate probability_estimate(double hits, double n);

}  // namespace rotordrop
