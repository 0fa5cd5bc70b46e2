#pragma once
#include <array>

namespace rotordrop {

/// Unbalance that a balance grade permits, U_per = m e_per with e_per = G / omega [kg m].
/// Source: ISO 21940-11:2016, balance quality grades G = e_per omega.
/// @param mass   of the rotor [kg]
/// @param grade  G [m/s]; G2.5 is 2.5e-3 m/s
/// @param speed  omega [rad/s], > 0
double permissible_unbalance(double mass, double grade, double speed);

/// Parts of an unbalance in two planes A and B, by the lever about the centre of gravity G, as ISO 21940-11 allots it to the bearing planes:
/// U_A = U (x_B - x_G) / (x_B - x_A), U_B = U (x_G - x_A) / (x_B - x_A). In phase they act like U at the centre of gravity.
/// @param x_G  between x_A and x_B [m]
std::array<double, 2> unbalance_in_planes(double U, double x_A, double x_B, double x_G);

}  // namespace rotordrop
