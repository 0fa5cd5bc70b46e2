#include "integrate/integration_parameters.h"

namespace rotordrop {

Section<IntegrationParameters> integration_section() {
  using P = IntegrationParameters;
  using M = IntegrationMethod;
  Section<P> s("integration", "Time integration.");
  s.choice("method", &P::method,
           {{"runge-kutta-4", M::runge_kutta_4}, {"dormand-prince", M::dormand_prince}, {"fehlberg-8", M::fehlberg_8}, {"adams", M::adams}},
           {.fallback = "runge-kutta-4",
            .help = "runge-kutta-4: fixed step; dormand-prince (5th order), fehlberg-8 (8th) and adams (multistep): error-controlled."});
  s.quantity("step", &P::step,
             {.unit = "s", .range = between(1e-9, 1e-3), .fallback = "5 us", .source = "docs/convergence.md",
              .help = "Step of the fixed-step method. Not used by the others."});
  s.quantity("tolerance", &P::tolerance,
             {.range = between(1e-13, 1e-2), .fallback = "1e-8",
              .help = "Relative local error of the error-controlled methods; absolute: this times each state's typical size. Not used with a fixed step."});
  s.quantity("maximum_step", &P::maximum_step,
             {.unit = "s", .range = between(1e-9, 1e-2), .fallback = "10 us", .source = "MODEL: smooth contact needs a step bound",
              .help = "Longest step of the error-controlled methods, so that no impact is stepped over."});
  return s;
}

}  // namespace rotordrop
