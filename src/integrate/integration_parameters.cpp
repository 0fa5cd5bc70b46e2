#include "integrate/integration_parameters.h"

namespace rotordrop {

Section<IntegrationParameters> integration_section() {
  using P = IntegrationParameters;
  using M = IntegrationMethod;
  Section<P> s("integration", "Time integration.");
  s.choice("method", &P::method,
           {{"tsitouras", M::tsitouras},
            {"bogacki-shampine", M::bogacki_shampine},
            {"runge-kutta-4", M::runge_kutta_4},
            {"dormand-prince", M::dormand_prince},
            {"fehlberg-8", M::fehlberg_8},
            {"adams", M::adams}},
           {.fallback = "tsitouras",
            .help = "tsitouras (5th order), bogacki-shampine (3rd, for low accuracy), dormand-prince (5th), fehlberg-8 "
                    "(8th) and "
                    "adams (multistep) control their error; runge-kutta-4 has a fixed step."});
  s.quantity("step", &P::step,
             {.unit = "s",
              .range = between(1e-9, 1e-3),
              .source = "docs/theory/convergence.md",
              .help = "Fixed step of runge-kutta-4 (5 us if not given), or longest step of the other methods (50 us), "
                      "so that no impact is skipped."});
  s.quantity("tolerance", &P::tolerance,
             {.range = between(1e-13, 1e-2),
              .fallback = "3e-7",
              .source = "docs/theory/convergence.md",
              .help = "Relative local error of the error-controlled methods; absolute: this times each state's typical "
                      "size. Not used with a fixed step."});
  return s;
}

double step_or_bound(const IntegrationParameters& p) {
  return p.step.value_or(p.method == IntegrationMethod::runge_kutta_4 ? 5e-6 : 50e-6);
}

}  // namespace rotordrop
