#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rotordrop {

/// x^n for one n, from tables: x = 2^e c (1 + r) with the middle c of one of 128 pieces of [1, 2), so that |r| < 1/256, and
///
///   x^n = 2^(n e) c^n (1 + r)^n,   the last by its binomial series to r^5.
///
/// Relative error below 1e-15 for 0 <= n <= 3. Outside the tables, and for other n, it is the library's power: of 0, of infinity, of what is not a
/// number and below 1e-29 or beyond 4e9. What waits for a power waits half as long as for the library's (benchmarks/).
class PowerTable {
 public:
  explicit PowerTable(long double n);
  /// Whether the tables have it. Of a number below zero they do not: its sign is the highest bit.
  [[nodiscard, gnu::always_inline]] inline bool has(double x) const { return row_of(x) < n_rows_; }
  [[nodiscard, gnu::always_inline]] inline double power(double x) const {
    if (!has(x)) return std::pow(x, n_);
    const std::uint64_t mantissa = std::bit_cast<std::uint64_t>(x) & 0x000fffffffffffffULL;
    const Piece& piece = pieces_[mantissa >> (52 - 7)];
    const double m = std::bit_cast<double>(mantissa | one), c = std::bit_cast<double>((mantissa & highest_7) | middle);
    const double r = (m - c) * piece.inverse, r_2 = r * r;
    const double series =
        (binomial_[0] + binomial_[1] * r) + r_2 * ((binomial_[2] + binomial_[3] * r) + r_2 * binomial_[4]);
    const double at_middle = binary_[row_of(x)] * piece.power;
    return at_middle + at_middle * r * series;
  }

 private:
  struct Piece {
    double inverse, power;  // 1/c, c^n
  };
  static constexpr std::uint64_t one = 0x3ff0000000000000ULL, highest_7 = 0x000fe00000000000ULL,
                                 middle = one | 0x0000100000000000ULL;
  static constexpr int smallest = -96, most_rows = 128;
  [[nodiscard, gnu::always_inline]] static inline std::uint64_t row_of(double x) {
    return (std::bit_cast<std::uint64_t>(x) >> 52) - (1023 + smallest);
  }

  double n_;
  std::uint64_t n_rows_;                  // none: all powers are the library's
  std::array<double, 5> binomial_;        // n over 1 to 5
  std::array<Piece, 128> pieces_;         // of [1, 2)
  std::array<double, most_rows> binary_;  // 2^(n e) from e = smallest on
};

extern const PowerTable cube_roots;
/// As std::cbrt, with a relative error below 1e-15.
[[nodiscard, gnu::always_inline]] inline double cbrt(double x) {
  return cube_roots.has(x) ? cube_roots.power(x) : std::cbrt(x);
}

}  // namespace rotordrop
