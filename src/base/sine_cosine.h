#pragma once
#include <cmath>

namespace rotordrop {

struct SineCosine {
  double sine, cosine;
};

/// Both of an angle [rad], without table or call, to 2.3e-16 up to a million radians; beyond as the library has them.
[[gnu::always_inline]] inline SineCosine sine_cosine(double angle) {
  if (!(std::fabs(angle) < 1e6)) return {std::sin(angle), std::cos(angle)};
  // k quarter turns in three parts of which the first two have 33 bits: k times them is exact. Adding 1.5 * 2^52 rounds to an integer.
  constexpr double round = 6755399441055744.;
  const double k = (angle * 0.63661977236758134308 + round) - round;
  const double x =
      ((angle - k * 1.57079632673412561417) - k * 6.07710050630396597660e-11) - k * 2.02226624879595063154e-21;
  // On +-pi/4. Polynomials of FDLIBM's __kernel_sin and __kernel_cos (Sun Microsystems, 1993).
  const double z = x * x;
  const double s = x + x * z *
                           (-1.66666666666666324348e-01 +
                            z * (8.33333333332248946124e-03 +
                                 z * (-1.98412698298579493134e-04 +
                                      z * (2.75573137070700676789e-06 +
                                           z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const double c = 1. - 0.5 * z +
                   z * z *
                       (4.16666666666666019037e-02 +
                        z * (-1.38888888888741095749e-03 +
                             z * (2.48015872894767294178e-05 +
                                  z * (-2.75573143513906633035e-07 +
                                       z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const auto quarter = static_cast<unsigned>(static_cast<int>(k));
  const double sine = quarter & 1U ? c : s, cosine = quarter & 1U ? s : c;
  return {quarter & 2U ? -sine : sine, (quarter + 1U) & 2U ? -cosine : cosine};
}

}  // namespace rotordrop
