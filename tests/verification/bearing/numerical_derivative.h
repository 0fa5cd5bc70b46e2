#pragma once
#include <array>

namespace rotordrop::testing {

/// f'(0) by central differences of order 8 with step h; the error is f^(9) h^8 / 630 and roundoff of about eps |f| / h.
template <class Function>
double derivative(Function f, double h) {
  constexpr std::array<double, 4> weight{4. / 5., -1. / 5., 4. / 105., -1. / 280.};
  double sum = 0.;
  for (int k = 4; k >= 1; --k) sum += weight[static_cast<std::size_t>(k - 1)] * (f(k * h) - f(-k * h));
  return sum / h;
}

}  // namespace rotordrop::testing
