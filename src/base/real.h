#pragma once
#include <cmath>

#include "base/power_table.h"

// Words of formulas that are written once for one drop (Real = double) and for eight in lanes (Real = Drops<width>, base/drops.h). A formula
// that chooses says select(condition, a, b) and has both at hand; whole parts of it may be left out where no lane needs them: if (any(condition)).

namespace rotordrop {

using std::abs;
using std::exp;
using std::pow;
using std::sqrt;
using std::tanh;

/// 1/sqrt(x), x > 0
[[gnu::always_inline]] inline double inverse_root(double x) { return 1. / sqrt(x); }
/// A root and its inverse.
template <class Real>
struct RootOf {
  Real root, inverse;
};
/// @param x > 0. The quotient does not wait for the root.
[[gnu::always_inline]] inline RootOf<double> root_and_inverse(double x) {
  const double root = sqrt(x);
  return {root, root * (1. / x)};
}

/// What goes with a scalar.
template <class Real>
struct RealTraits;
template <>
struct RealTraits<double> {
  using Mask = bool;
  static constexpr bool is_in_lanes = false;
};
/// What comparing two of them gives.
template <class Real>
using MaskOf = typename RealTraits<Real>::Mask;

[[gnu::always_inline]] inline double select(bool condition, double a, double b) { return condition ? a : b; }
[[gnu::always_inline]] inline bool select(bool condition, bool a, bool b) { return condition ? a : b; }
/// Whether a condition holds in any lane.
[[gnu::always_inline]] inline bool any(bool condition) { return condition; }
/// The larger one; what is not a number in the first place stays so.
[[gnu::always_inline]] inline double larger(double a, double b) { return a < b ? b : a; }
[[gnu::always_inline]] inline double smaller(double a, double b) { return b < a ? b : a; }

}  // namespace rotordrop
