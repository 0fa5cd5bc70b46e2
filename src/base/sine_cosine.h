#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

namespace rotordrop {

template <class Real>
struct SineCosineOf {
  Real sine, cosine;
};
using SineCosine = SineCosineOf<double>;

/// An angle less its whole quarter turns, and sine and cosine of what is left; for numbers and for vectors of them.
namespace quarter_turns {
inline constexpr double per_radian = 0.63661977236758134308;
/// A quarter turn in three parts of which the first two have 33 bits: up to a million times them is exact.
template <class Real>
[[gnu::always_inline]] inline Real rest(const Real& angle, const Real& quarters) {
  return ((angle - quarters * 1.57079632673412561417) - quarters * 6.07710050630396597660e-11) -
         quarters * 2.02226624879595063154e-21;
}
/// On +-pi/4. Polynomials of FDLIBM's __kernel_sin and __kernel_cos (Sun Microsystems, 1993).
template <class Real>
[[gnu::always_inline]] inline Real sine(const Real& x) {
  const Real z = x * x;
  return x + x * z *
                 (-1.66666666666666324348e-01 +
                  z * (8.33333333332248946124e-03 +
                       z * (-1.98412698298579493134e-04 +
                            z * (2.75573137070700676789e-06 +
                                 z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
}
template <class Real>
[[gnu::always_inline]] inline Real cosine(const Real& x) {
  const Real z = x * x;
  return 1. - 0.5 * z +
         z * z *
             (4.16666666666666019037e-02 +
              z * (-1.38888888888741095749e-03 +
                   z * (2.48015872894767294178e-05 +
                        z * (-2.75573143513906633035e-07 +
                             z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
}
}  // namespace quarter_turns

/// Both of an angle of up to a million radians, to 2.3e-16, without table, call or branch: for loops over vectors, too.
[[gnu::always_inline]] inline SineCosine sine_cosine_within(double angle) {
  constexpr double round = 6755399441055744.;  // adding 1.5 * 2^52 rounds to an integer and leaves it in the low bits
  const double shifted = angle * quarter_turns::per_radian + round;
  const double x = quarter_turns::rest(angle, shifted - round);
  const double s = quarter_turns::sine(x), c = quarter_turns::cosine(x);
  const auto quarter = std::bit_cast<std::uint64_t>(shifted);
  const double sine = (quarter & 1U) != 0 ? c : s, cosine = (quarter & 1U) != 0 ? s : c;
  return {(quarter & 2U) != 0 ? -sine : sine, ((quarter + 1U) & 2U) != 0 ? -cosine : cosine};
}

/// Both of an angle [rad]; beyond a million radians as the library has them.
[[gnu::always_inline]] inline SineCosine sine_cosine(double angle) {
  if (!(std::fabs(angle) < 1e6)) return {std::sin(angle), std::cos(angle)};
  return sine_cosine_within(angle);
}

}  // namespace rotordrop
