#pragma once
#include <bit>
#include <cstdint>

namespace rotordrop {

/// exp(x) = power exp(rest), for loops over vectors: no branch, no library call.
struct SplitExponential {
  double power;  ///< 2^n
  double rest;   ///< |rest| <= ln(2) / 2
};
/// @param x  of a power that is a normal number: |x| up to 700
[[gnu::always_inline]] inline SplitExponential split_exponential(double x) {
  // Adding 1.5 * 2^52 rounds to an integer and leaves it in the low bits; ln 2 in two parts, the first with 32 bits.
  const double rounded = x * 1.4426950408889634074 + 6755399441055744.;
  const double n = rounded - 6755399441055744.;
  return {std::bit_cast<double>((std::bit_cast<std::uint64_t>(rounded) + 1023U) << 52),
          (x - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10};
}

}  // namespace rotordrop
