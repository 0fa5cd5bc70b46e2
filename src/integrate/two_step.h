#pragma once
// A two-step Runge-Kutta method of order 4 with three evaluations a step: besides its own stages, a step sees the rate at the start of the one before.
//
// With r the step over the one before, that rate lies at -1/r. Stages that are exact for linear rates, and weights for cubic ones, leave one condition
// of order 4:  sum_i b_i e_i = 0,  where e_i = sum_j a_ij c_j^2 - c_i^3 / 3 is what a stage makes of quadratic rates.
// Class of methods: Jackiewicz & Tracogna, SIAM Journal on Numerical Analysis 32 (1995) 1390-1427. Nodes, stages and the estimate of the error are
// ours; docs/theory/convergence.md says how they were found.
#include "integrate/embedded_tableau.h"

namespace rotordrop {

/// Sets stages and weights for a step.
/// @param ratio  the step over the one before; 0: there is none, and what is left is an ordinary method of order 3 with the same nodes
constexpr void set_two_step(EmbeddedTableau& method, double ratio) {
  const double r = ratio, c_2 = method.c[2], c_3 = method.c[3];
  const double from_second = 1. + c_2 * r, from_third = 1. + c_3 * r;
  // The cubic through the rates at -1/r, 0, c_2 and c_3.
  const double b_past = -r * r * r * (1. / 4. - (c_2 + c_3) / 3. + c_2 * c_3 / 2.) / (from_second * from_third);
  const double b_2 = (r / 4. + (1. - c_3 * r) / 3. - c_3 / 2.) / (c_2 * (c_2 - c_3) * from_second);
  const double b_3 = (r / 4. + (1. - c_2 * r) / 3. - c_2 / 2.) / (c_3 * (c_3 - c_2) * from_third);
  method.a[4] = {b_past, 1. - b_past - b_2 - b_3, b_2, b_3};
  // The line through the rates at -1/r and 0.
  const double a_past = -r * c_2 * c_2 / 2.;
  method.a[2] = {a_past, c_2 - a_past};
  // The third stage makes up for what the second leaves of quadratic rates.
  const double r_e_2 = -c_2 * c_2 / 2. - r * c_2 * c_2 * c_2 / 3., r_e_3 = -b_2 / b_3 * r_e_2;
  const double a_2 = (c_3 * c_3 / 2. + r * c_3 * c_3 * c_3 / 3. + r_e_3) / (c_2 * from_second);
  const double a_past_3 = r * (c_2 * a_2 - c_3 * c_3 / 2.);
  method.a[3] = {a_past_3, c_3 - a_past_3 - a_2, a_2};
}

/// Sets a method for a step; only one that sees the step before it depends on either. @param before  [s]; 0: there is none
constexpr void fit_to_step(EmbeddedTableau& method, double step, double before) {
  if (sees_past(method)) set_two_step(method, before > 0. ? step / before : 0.);
}

/// As it starts.
inline constexpr EmbeddedTableau two_step_runge_kutta = [] {
  // The error is a third difference of the rates at 0, 2/5, 4/5 and 1. Its size is set so that a tolerance of 1e-6 keeps the orbit of the reference drop
  // as near as it does with Sofroniou & Spaletta's pair, and its energy within 1e-5 J.
  EmbeddedTableau method{.n_stages = 5,
                         .order = 4,
                         .powers = 0,
                         .c = {0., 0., 0.4, 0.8, 1.},
                         .a = {},
                         .e = {0., -1. / 64., 5. / 96., -5. / 64., 1. / 24.},
                         .start = 1,
                         .control_beta = 0.4 / 4.,
                         .fitted = {0, 0, 0b11, 0b11, 0b1111}};
  set_two_step(method, 0.);
  return method;
}();

}  // namespace rotordrop
