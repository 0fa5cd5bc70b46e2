#pragma once
// The integrators behind make_integrator(), one file each.
#include "integrate/integrator.h"

namespace rotordrop {

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
                                             std::span<const double> state, double end_time);
std::unique_ptr<Integrator> make_adams(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
                                       std::span<const double> state, double end_time);

}  // namespace rotordrop
