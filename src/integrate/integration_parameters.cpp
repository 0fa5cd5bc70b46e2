#include "integrate/integration_parameters.h"

#include <fmt/format.h>

namespace rotordrop {

Section<IntegrationParameters> integration_section() {
  using P = IntegrationParameters;
  Section<P> s("integration", "Time integration.");
  std::vector<std::pair<std::string, IntegrationMethod>> methods;
  std::string help;
  for (const auto& [method, name, words, make] : integration_methods) {
    methods.emplace_back(name, method);
    help += fmt::format("{}{}: {}", help.empty() ? "" : "; ", name, words);
  }
  s.choice("method", &P::method, std::move(methods), {.fallback = "tsitouras", .help = help + "."});
  s.quantity("step", &P::step,
             {.unit = "s",
              .range = between(1e-9, 1e-3),
              .usual = between(1e-8, 2e-4),
              .source = "docs/theory/convergence.md",
              .help = "Fixed step of runge-kutta-4 (5 us if not given), or longest step of the other methods (50 us), "
                      "so that no impact is skipped."});
  s.quantity(
      "exponential_above", &P::exponential_above,
      {.unit = "Hz",
       .range = positive(),
       .usual = between(3e3, 1e6),
       .fallback = "20 kHz",
       .source = "docs/theory/convergence.md",
       .help = "Of a rotor with modes above this frequency none bounds the step: the program's own methods "
               "(tsitouras, bogacki-shampine, sofroniou-spaletta, two-step-runge-kutta) integrate them by "
               "exponentials where they turn by more than half a radian in a step. Not if a mode has less than 2e-4 "
               "of critical damping."});
  s.quantity("tolerance", &P::tolerance,
             {.range = between(1e-13, 1e-2),
              .usual = at_most(1e-5),
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
