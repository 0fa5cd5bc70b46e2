#include "analysis/facts/material_slips.h"

#include <fmt/format.h>

#include <cmath>

namespace rotordrop {
namespace {

constexpr double least_capacity = 0.8e6, most_capacity = 6e6;  // rho c of solids, with a margin [J/(m3 K)]
constexpr double lightest_metal_of_machines = 6500.;           // estimate; zirconia, which insulates, has 6050 [kg/m3]
constexpr double least_conductivity = 5.;                      // of metals; nickel alloys have 10 [W/(m K)]
constexpr double most_conductivity = 430.;                     // of metals: silver [W/(m K)]
constexpr double lightest_mineral = 2500.;                     // estimate; plastics with fillers have less [kg/m3]
constexpr double least_of_minerals = 0.5;                      // glass conducts 1, zirconia 2.5 [W/(m K)]
constexpr double softest_of_minerals = 10e9;                   // magnesium and lead have 45 and 16 [Pa]
constexpr double least_ratio = 0.05;                           // Poisson's; cork has 0, beryllium 0.03, glass 0.2
constexpr double least_expansion = 3e-7;                       // fused silica has 5e-7, Invar 1.2e-6 [1/K]
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
  const auto add_of_density = [&](const char* key, const char* others, const std::string& value,
                                  const std::string& theirs, const char* hint) {
    found.push_back(
        {key, fmt::format("{} has {:.5g} kg/m3, as {} have, but {}; {}.", name, m.rho, others, value, theirs), hint});
  };
  if (m.rho > lightest_metal_of_machines) {
    if (m.k && *m.k < least_conductivity)
      add_of_density("k", "metals", fmt::format("k = {:.4g} W/(m K)", *m.k),
                     fmt::format("metals conduct more than {:.4g}", least_conductivity),
                     "A bare number is in W/(m K): steel has 15 to 70.");
    if (m.k && *m.k > most_conductivity)
      add_of_density("k", "metals", fmt::format("k = {:.4g} W/(m K)", *m.k),
                     fmt::format("silver, the best of them, conducts {:.4g}", most_conductivity),
                     "A bare number is in W/(m K): steel has 15 to 70.");
    if (m.E && std::sqrt(*m.E / m.rho) < slowest_sound)
      add_of_density("E", "metals", fmt::format("E = {:.4g} GPa", *m.E * 1e-9),
                     fmt::format("metals of machines have more than {:.3g} GPa at that density",
                                 slowest_sound * slowest_sound * m.rho * 1e-9),
                     "A bare number is in Pa: steel has 2.1e11, or \"210 GPa\".");
  }
  if (m.rho > lightest_mineral && m.rho <= lightest_metal_of_machines) {
    if (m.k && *m.k < least_of_minerals)
      add_of_density("k", "ceramics and metals", fmt::format("k = {:.4g} W/(m K)", *m.k),
                     fmt::format("they conduct more than {:.4g}", least_of_minerals),
                     "A bare number is in W/(m K): silicon nitride has 20 to 35.");
    if (m.E && *m.E < softest_of_minerals)
      add_of_density("E", "ceramics and metals", fmt::format("E = {:.4g} GPa", *m.E * 1e-9),
                     fmt::format("they have more than {:.4g} GPa", softest_of_minerals * 1e-9),
                     "A bare number is in Pa: silicon nitride has 3.1e11, or \"310 GPa\".");
  }
  // Zero is meant: a limit case.
  if (m.nu && *m.nu > 0. && *m.nu < least_ratio)
    found.push_back({"nu", fmt::format("{} has nu = {:.4g}; most metals have 0.25 to 0.35.", name, *m.nu),
                     "Poisson's ratio has no unit and is no percentage."});
  if (m.alpha && *m.alpha != 0. && std::fabs(*m.alpha) < least_expansion)
    found.push_back({"alpha",
                     fmt::format("{} has alpha = {:.4g} 1/K; even Invar has 1.2e-6, steel 11e-6.", name, *m.alpha),
                     "A bare number is in 1/K: 11 um/(m K) are 11e-6."});
  return found;
}

}  // namespace rotordrop
