#pragma once
// The integrators behind make_integrator(), one file each: their makers, and the choice by the case's method.
#include "integrate/integrator.h"

namespace rotordrop {

/// Shortest step of an error-controlled method over its longest: a method that needs less is stuck, not careful.
inline constexpr double shortest_step = 1e-7;

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters,
                                             double start_time, std::span<const double> state, double end_time);
std::unique_ptr<Integrator> make_embedded_pair(const OdeSystem& system, const IntegrationParameters& parameters,
                                               double start_time, std::span<const double> state, double end_time);
std::unique_ptr<Integrator> make_adams(const OdeSystem& system, const IntegrationParameters& parameters,
                                       double start_time, std::span<const double> state, double end_time);

/// A new method is one more line here.
inline std::unique_ptr<Integrator> make_method(const OdeSystem& system, const IntegrationParameters& parameters,
                                               double start_time, std::span<const double> state, double end_time) {
  using M = IntegrationMethod;
  const M method = parameters.method;
  if (method == M::adams) return make_adams(system, parameters, start_time, state, end_time);
  if (method == M::tsitouras || method == M::bogacki_shampine)
    return make_embedded_pair(system, parameters, start_time, state, end_time);
  return make_runge_kutta(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
