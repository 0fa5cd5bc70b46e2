#pragma once
#include "model/ports.h"

namespace rotordrop {

/// Heat that rolling balls give to both contacts [W]; they take the sum from their bulk.
template <class Real>
struct ContactHeatOf {
  Real inner = 0, outer = 0;
  [[nodiscard]] Real from_balls() const { return inner + outer; }
};
using ContactHeat = ContactHeatOf<double>;

/// Contacts without capacity, whose temperatures are T = T_0 + Z q with q the heat that balls give to them:
///   q_inner = G_ib (T_b - T_inner) + G_io (T_outer - T_inner),   q_outer alike.
/// @param inner, outer  T_0: with every other heat [K]; @param balls  T_b [K]
/// @param Z_ii, Z_io, Z_oo  [K/W]
template <class Real>
ContactHeatOf<Real> contact_heat(const BallConductionOf<Real>& G, const Real& inner, const Real& outer,
                                 const Real& balls, const Real& Z_ii, const Real& Z_io, const Real& Z_oo) {
  // (1 + L Z) q = L-weighted differences of T_0, L = [[G_ib + G_io, -G_io], [-G_io, G_ob + G_io]].
  const Real through = G.inner_to_outer * (outer - inner);
  const Real q_i = G.inner_to_ball * (balls - inner) + through, q_o = G.outer_to_ball * (balls - outer) - through;
  const Real L_ii = G.inner_to_ball + G.inner_to_outer, L_oo = G.outer_to_ball + G.inner_to_outer,
             L_io = -G.inner_to_outer;
  const Real a = 1. + L_ii * Z_ii + L_io * Z_io, b = L_ii * Z_io + L_io * Z_oo, c = L_io * Z_ii + L_oo * Z_io,
             d = 1. + L_io * Z_io + L_oo * Z_oo;
  const Real inverse = 1. / (a * d - b * c);
  return {(d * q_i - b * q_o) * inverse, (a * q_o - c * q_i) * inverse};
}

}  // namespace rotordrop
