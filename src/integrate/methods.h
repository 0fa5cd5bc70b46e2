#pragma once
// The integrators behind make_integrator(), one file each.
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

}  // namespace rotordrop
