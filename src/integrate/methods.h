#pragma once
// The integrators, one file each, and the choice by the case's method.
#include <array>
#include <memory>
#include <span>

namespace rotordrop {

class Integrator;
class OdeSystem;
struct IntegrationParameters;

enum class IntegrationMethod {
  tsitouras,
  bogacki_shampine,
  sofroniou_spaletta,
  two_step_runge_kutta,
  runge_kutta_4,
  dormand_prince,
  fehlberg_8,
  adams
};

/// Shortest step of an error-controlled method over its longest: a method that needs less is stuck, not careful.
inline constexpr double shortest_step = 1e-7;

using IntegratorMaker = std::unique_ptr<Integrator>(const OdeSystem& system, const IntegrationParameters& parameters,
                                                    double start_time, std::span<const double> state, double end_time);
IntegratorMaker make_runge_kutta, make_embedded_pair, make_adams;

/// What `integration.method` may be.
struct MethodKind {
  IntegrationMethod method;
  const char *name, *words;
  IntegratorMaker* make;
};
/// A new method is one more line here.
inline constexpr std::array integration_methods{
    MethodKind{IntegrationMethod::tsitouras, "tsitouras", "5th order, controls its error", make_embedded_pair},
    MethodKind{IntegrationMethod::bogacki_shampine, "bogacki-shampine",
               "3rd order, for low accuracy, controls its error", make_embedded_pair},
    MethodKind{IntegrationMethod::sofroniou_spaletta, "sofroniou-spaletta", "4th order, controls its error",
               make_embedded_pair},
    MethodKind{IntegrationMethod::two_step_runge_kutta, "two-step-runge-kutta",
               "4th order with three evaluations a step, controls its error", make_embedded_pair},
    MethodKind{IntegrationMethod::runge_kutta_4, "runge-kutta-4", "4th order, with a fixed step", make_runge_kutta},
    MethodKind{IntegrationMethod::dormand_prince, "dormand-prince", "5th order, controls its error", make_runge_kutta},
    MethodKind{IntegrationMethod::fehlberg_8, "fehlberg-8", "8th order, controls its error", make_runge_kutta},
    MethodKind{IntegrationMethod::adams, "adams", "multistep, controls its error", make_adams},
};

}  // namespace rotordrop
