#pragma once
#include <bit>
#include <cstdint>

#include "base/exponential_series.h"
#include "base/split_exponential.h"

namespace rotordrop {

/// x^a for loops over vectors: no branch, no library call. Relative error below 1e-13 for x from 1e-300 to 1 and |a| up to 3; not a number
/// stays so. x must not be zero or negative.
[[gnu::always_inline]] inline double vector_power(double x, double a) {
  // x = 2^e m with m between sqrt(1/2) and sqrt(2); ln m = 2 artanh(r), r = (m - 1) / (m + 1).
  constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcdULL, one = 0x3ff0000000000000ULL;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t shifted = bits + (one - root_half);
  // The exponent as a number without a conversion of integers: 2^52 + biased exponent, less 2^52 + 1023.
  const double e = std::bit_cast<double>((shifted >> 52) | 0x4330000000000000ULL) - 4503599627371519.;
  const double m = std::bit_cast<double>((shifted & 0x000fffffffffffffULL) + root_half);
  const double r = (m - 1.) / (m + 1.), q = r * r;
  double series = 1. / 21.;
  series = series * q + 1. / 19.;
  series = series * q + 1. / 17.;
  series = series * q + 1. / 15.;
  series = series * q + 1. / 13.;
  series = series * q + 1. / 11.;
  series = series * q + 1. / 9.;
  series = series * q + 1. / 7.;
  series = series * q + 1. / 5.;
  series = series * q + 1. / 3.;
  const double logarithm = e * 0.69314718055994530942 + 2. * (r + r * q * series);
  const auto [power, f] = split_exponential(a * logarithm);
  const double sum = (exponential_tail(f) * f + 1.) * f + 1.;
  return sum * power + (x - x);
}

}  // namespace rotordrop
