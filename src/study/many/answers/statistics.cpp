#include "study/many/answers/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <numeric>

namespace rotordrop {
namespace {

constexpr double tail = 0.025;  // of each side of a 95 % interval

}  // namespace

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

bool varies(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  for (const double v : values)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  return high - low > 1e-12 * std::max(std::abs(low), std::abs(high));
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2 || !varies(values)) return 0.;
  const double mean = mean_of(values);
  double sum = 0.;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::optional<double> share_within(const std::vector<std::vector<double>>& groups) {
  std::vector<double> all;
  double n_groups = 0., within = 0., sum_of_squared_sizes = 0.;
  for (const auto& group : groups) {
    if (group.empty()) continue;
    const auto n = static_cast<double>(group.size());
    const double s = deviation_of(group);
    n_groups += 1.;
    within += s * s * (n - 1.);
    sum_of_squared_sizes += n * n;
    all.insert(all.end(), group.begin(), group.end());
  }
  const auto n_all = static_cast<double>(all.size());
  if (n_groups < 2. || n_all == n_groups || !varies(all)) return {};
  const double mean = mean_of(all);
  double between = 0.;
  for (const auto& group : groups)
    if (!group.empty()) between += static_cast<double>(group.size()) * std::pow(mean_of(group) - mean, 2);
  const double W = within / (n_all - n_groups), MSB = between / (n_groups - 1.);
  const double n0 = (n_all - sum_of_squared_sizes / n_all) / (n_groups - 1.);
  const double B = std::max(0., (MSB - W) / n0);
  return W + B > 0. ? std::optional(W / (W + B)) : std::nullopt;
}

double quantile_of(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  if (i + 1 >= sorted.size()) return sorted.back();
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[i + 1] - sorted[i]);
}

Estimate quantile_estimate(const std::vector<double>& sorted, double p) {
  Estimate result{quantile_of(sorted, p), {}, {}};
  // P(x_(r) <= quantile <= x_(s)) = P(r <= K < s) of a binomial K; x_(1) is the smallest.
  const auto n = static_cast<double>(sorted.size());
  const boost::math::binomial count(n, p);
  std::size_t r = 0, s = sorted.size() + 1;
  // Nothing of the binomial lies further out than this.
  const double first = std::floor(n * p - 10. * std::sqrt(n * p * (1. - p)) - 10.);
  for (auto k = static_cast<std::size_t>(std::max(0., first)); k <= sorted.size(); ++k) {
    const double below = boost::math::cdf(count, static_cast<double>(k));
    if (below <= tail) r = k + 1;
    if (below >= 1. - tail) {
      s = k + 1;
      break;
    }
  }
  if (r >= 1 && r <= sorted.size()) result.low = sorted[r - 1];
  if (s <= sorted.size()) result.high = sorted[s - 1];
  return result;
}

Estimate probability_estimate(double hits, double n) {
  Estimate result{hits / n, 0., 1.};
  if (hits > 0.) result.low = boost::math::ibeta_inv(hits, n - hits + 1., tail);
  if (hits < n) result.high = boost::math::ibeta_inv(hits + 1., n - hits, 1. - tail);
  return result;
}

}  // namespace rotordrop
