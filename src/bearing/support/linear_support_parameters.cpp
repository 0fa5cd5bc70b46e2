#include "bearing/support/linear_support_parameters.h"

namespace rotordrop {

Section<LinearSupportParameters> linear_support_section() {
  using P = LinearSupportParameters;
  Section<P> s("linear", "Massless spring and damper between rotor and ground.");
  s.integer("node", &P::node, {.range = at_least(1), .help = "Rotor node at which the support sits, numbered from 1."});
  s.matrix("stiffness", &P::stiffness,
           {.unit = "N/m",
            .usual = between(-stiffest_support, stiffest_support),
            .help = "[[K_yy, K_yz], [K_zy, K_zz]]: force on the rotor = -K x. Need not be symmetric."});
  s.matrix("damping", &P::damping,
           {.unit = "N s/m",
            .fallback = {{"0", "0"}, {"0", "0"}},
            .help = "[[C_yy, C_yz], [C_zy, C_zz]]: force on the rotor = -C v."});
  return s;
}

}  // namespace rotordrop
