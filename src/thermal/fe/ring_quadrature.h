#pragma once
// What the operators of heat and elasticity integrate with, in the half plane (x, r).
#include <deal.II/fe/fe_values.h>

#include <numbers>
#include <vector>

namespace rotordrop {

using Indices = std::vector<dealii::types::global_dof_index>;
inline const auto cell_flags =
    dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values;
inline const auto face_flags = dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values;

/// 2 pi r times the quadrature's weight.
inline double weight(const dealii::FEValuesBase<2>& fe, unsigned int q) {
  return 2. * std::numbers::pi * fe.quadrature_point(q)[1] * fe.JxW(q);
}

}  // namespace rotordrop
