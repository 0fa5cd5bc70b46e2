#pragma once

namespace rotordrop {

/// (exp(f) - 1 - f) / f^2 by Taylor's series to f^13 of exp(f), for |f| <= ln(2)/2; for numbers and for vectors of them.
template <class Real>
[[gnu::always_inline]] inline Real exponential_tail(Real f) {
  Real sum = f * (1. / 6227020800.) + 1. / 479001600.;
  sum = sum * f + 1. / 39916800.;
  sum = sum * f + 1. / 3628800.;
  sum = sum * f + 1. / 362880.;
  sum = sum * f + 1. / 40320.;
  sum = sum * f + 1. / 5040.;
  sum = sum * f + 1. / 720.;
  sum = sum * f + 1. / 120.;
  sum = sum * f + 1. / 24.;
  sum = sum * f + 1. / 6.;
  return sum * f + 0.5;
}

}  // namespace rotordrop
