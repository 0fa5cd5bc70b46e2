#include "study/many/distribution.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace rotordrop {
namespace {

const boost::math::normal& standard() {
  static const boost::math::normal distribution;
  return distribution;
}
double standard_quantile(double p) { return boost::math::quantile(standard(), p); }
double standard_cdf(double x) { return boost::math::cdf(standard(), x); }

}  // namespace

double Distribution::quantile(double p) const {
  switch (kind) {
    case Kind::uniform:
      return lower + p * (upper - lower);
    case Kind::log_uniform:
      return lower * std::exp(p * std::log(upper / lower));
    case Kind::normal:
      return mean + deviation * standard_quantile(p);
    case Kind::truncated_normal: {
      // In the tail that is nearer, so that a far truncation keeps its digits.
      const double a = (lower - mean) / deviation, b = (upper - mean) / deviation;
      const double sign = a > 0. ? -1. : 1.;
      const double low = standard_cdf(sign * a), high = standard_cdf(sign * b);
      const double x = mean + deviation * sign * standard_quantile(low + p * (high - low));
      return std::clamp(x, lower, upper);
    }
    case Kind::triangular: {
      const double width = upper - lower, at_mode = (mode - lower) / width;
      return p < at_mode ? lower + std::sqrt(p * width * (mode - lower))
                         : upper - std::sqrt((1. - p) * width * (upper - mode));
    }
    case Kind::values:
      break;
  }
  return values.at(index(p)).number();
}

std::size_t Distribution::index(double p) const {
  const std::size_t n = values.size();
  if (weights.empty()) return std::min(n - 1, static_cast<std::size_t>(p * static_cast<double>(n)));
  double sum = 0.;
  for (std::size_t i = 0; i < n; ++i)
    if (p < (sum += weights[i])) return i;
  return n - 1;
}

std::vector<double> Distribution::levels(std::size_t n) const {
  std::vector<double> result;
  const bool is_range = kind == Kind::uniform || kind == Kind::log_uniform;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = is_range ? (n == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1))
                              : (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    result.push_back(is_range && p == 1. ? upper : quantile(p));
  }
  return result;
}

std::string name_of(Distribution::Kind kind) {
  switch (kind) {
    case Distribution::Kind::values:
      return "discrete";
    case Distribution::Kind::uniform:
      return "uniform";
    case Distribution::Kind::log_uniform:
      return "log-uniform";
    case Distribution::Kind::normal:
      return "normal";
    case Distribution::Kind::truncated_normal:
      return "truncated-normal";
    case Distribution::Kind::triangular:
      return "triangular";
  }
  return "";
}

}  // namespace rotordrop
