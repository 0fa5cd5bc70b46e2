#pragma once
// The keys of [materials.NAME], declared once for drops and for heat conduction.
#include "base/parameters/section.h"

namespace rotordrop {

/// Adds the keys to the section of a struct with the members E, nu, rho, k, c, alpha [SI] and the tables k_table, c_table, pairs of
/// temperature [K] and value. A member that is a std::optional may be left out.
/// @param lowest_density  [kg/m3]; lower values are mistakes of the unit
template <class P>
void add_material_keys(Section<P>& s, double lowest_density) {
  s.quantity("E", &P::E,
             {.unit = "Pa", .range = between(1e8, 2e12), .usual = between(1e9, 1.3e12), .help = "Young's modulus."});
  s.quantity("nu", &P::nu, {.range = between(0, 0.499), .help = "Poisson's ratio."});
  s.quantity(
      "rho", &P::rho,
      {.unit = "kg/m3", .range = between(lowest_density, 3e4), .usual = between(1000, 2.3e4), .help = "Density."});
  s.quantity("k", &P::k,
             {.unit = "W/(m K)", .range = positive(), .usual = between(0.1, 2500), .help = "Thermal conductivity."});
  s.quantity("c", &P::c,
             {.unit = "J/(kg K)", .range = positive(), .usual = between(100, 5000), .help = "Specific heat capacity."});
  s.function(
      "k_table", &P::k_table,
      {.unit = "W/(m K)",
       .argument_unit = "K",
       .range = positive(),
       .help = "Conductivity over temperature, instead of k: linear between the pairs, constant outside. In a drop "
               "meshed rings and housing use it at their temperature (thermal.fe.coupling = \"windowed\"); parts "
               "without a mesh use its value at run.ambient."});
  s.function("c_table", &P::c_table,
             {.unit = "J/(kg K)",
              .argument_unit = "K",
              .range = positive(),
              .help = "Specific heat capacity over temperature, instead of c; used like k_table."});
  s.quantity("alpha", &P::alpha,
             {.unit = "1/K",
              .range = between(-1e-3, 1e-3),
              .usual = between(-1e-5, 5e-5),
              .help = "Linear thermal expansion coefficient."});
}

}  // namespace rotordrop
