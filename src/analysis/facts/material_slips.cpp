#include "analysis/facts/material_slips.h"

#include <fmt/format.h>

#include <cmath>

namespace rotordrop {
namespace {

constexpr double least_capacity = 0.8e6, most_capacity = 6e6;  // rho c of solids, with a margin [J/(m3 K)]
constexpr double lightest_metal_of_machines = 6500.;           // estimate; zirconia, which insulates, has 6050 [kg/m3]
constexpr double least_conductivity = 5.;                      // of metals; nickel alloys have 10 [W/(m K)]
constexpr double slowest_sound = 2000.;                        // sqrt(E/rho); lead has 1200, tin 2600, steel 5000 [m/s]

}  // namespace

std::vector<MaterialSlip> material_slips(const std::string& name, const MaterialFacts& m) {
  std::vector<MaterialSlip> found;
  if (m.c) {
    const double capacity = m.rho * *m.c;
    if (capacity < least_capacity || capacity > most_capacity)
      found.push_back(
          {"c",
           fmt::format("{} has rho c = {:.4g} kg/m3 times {:.4g} J/(kg K) = {:.3g} MJ/(m3 K); solids have 1 to 4.5.",
                       name, m.rho, *m.c, capacity * 1e-6),
           "Check density and heat capacity: steel has 7850 kg/m3 and 460 to 510 J/(kg K)."});
  }
  if (m.rho > lightest_metal_of_machines) {
    if (m.k && *m.k < least_conductivity)
      found.push_back({"k",
                       fmt::format("{} has {:.5g} kg/m3, as metals have, but k = {:.4g} W/(m K); metals conduct more "
                                   "than {:.4g}.",
                                   name, m.rho, *m.k, least_conductivity),
                       "A bare number is in W/(m K): steel has 15 to 70."});
    if (m.E && std::sqrt(*m.E / m.rho) < slowest_sound)
      found.push_back({"E",
                       fmt::format("{} has {:.5g} kg/m3, as metals have, but E = {:.4g} GPa; metals of machines "
                                   "have more than {:.3g} GPa at that density.",
                                   name, m.rho, *m.E * 1e-9, slowest_sound * slowest_sound * m.rho * 1e-9),
                       "A bare number is in Pa: steel has 2.1e11, or \"210 GPa\"."});
  }
  return found;
}

}  // namespace rotordrop
