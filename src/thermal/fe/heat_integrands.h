#pragma once

// What the integrals of the heat operator consist of.
#include <deal.II/lac/vector.h>

#include <cmath>
#include <vector>

#include "model/assembled_heat.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// Heat that convection takes off a surface [W/m2], and its slope.
inline double loss(const HeatConvection& law, double T) {
  const double rise = T - law.ambient;
  if (law.exponent == 0.) return law.coefficient * rise;
  return rise > 0. ? law.coefficient * std::pow(rise, 1. + law.exponent) : 0.;
}
inline double loss_slope(const HeatConvection& law, double T) {
  const double rise = T - law.ambient;
  if (law.exponent == 0.) return law.coefficient;
  return rise > 0. ? law.coefficient * (1. + law.exponent) * std::pow(rise, law.exponent) : 0.;
}
/// Whether properties of a body depend on temperature.
inline bool is_curved(const HeatBody& body) {
  return !body.conductivity.is_constant() || !body.heat_capacity.is_constant();
}

/// The weights that are not 0.
inline HeatMean mean_by(const dealii::Vector<double>& weights) {
  HeatMean mean;
  for (unsigned int i = 0; i < weights.size(); ++i) {
    if (weights(i) == 0.) continue;
    mean.unknowns.push_back(i);
    mean.weights.push_back(weights(i));
  }
  return mean;
}

/// A field at a point, from the shape functions there.
inline double interpolated(const dealii::Vector<double>& T, const std::vector<unsigned int>& dofs,
                           const std::vector<double>& shape) {
  double sum = 0.;
  for (std::size_t i = 0; i < dofs.size(); ++i) sum += T(dofs[i]) * shape[i];
  return sum;
}

}  // namespace rotordrop
