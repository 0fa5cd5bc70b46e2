#pragma once
// Friction of a rotating body in the gas around it.

namespace rotordrop {

/// Torque coefficient C of a smooth cylinder that rotates in free gas; torque C pi rho omega^2 r^4 L.
///
///   C = 4 / Re                                                  laminar, exact for an infinitely long cylinder
///   1 / sqrt(C) = -0.6 + 4.07 log10(Re sqrt(C))                 turbulent; the larger of both holds
///
/// Source: Theodorsen & Regier, NACA Report 793 (1944). Valid: smooth surface, Mach number below about 1, Re up to 7e6.
/// @param reynolds  Re = omega r^2 / nu, > 0
double free_cylinder_coefficient(double reynolds);

/// The same of a cylinder in a concentric casing at rest, with C = C_M / 2 and C_M by the radial gap g:
///
///   10 (g/r)^0.3 / Re (Re < 64),  2 (g/r)^0.3 / Re^0.6 (to 500),  1.03 (g/r)^0.3 / Re^0.5 (to 1e4),  0.065 (g/r)^0.3 / Re^0.2 beyond
///
/// Source: Bilgen & Boulos, J. Fluids Eng. 95 (1973) 122. Valid: smooth walls, no axial flow; the pieces meet within 6 %.
/// @param reynolds      Re = omega r g / nu, > 0
/// @param gap_over_radius  g/r, > 0
double enclosed_cylinder_coefficient(double reynolds, double gap_over_radius);

/// Torque coefficient C of one face of a smooth disc that rotates in free gas; torque 1/2 C rho omega^2 r^5.
/// 1.935 / Re^0.5 up to Re = 3e5 (laminar), 0.073 / Re^0.2 beyond.
/// Source: von Karman (1921); Schlichting, Boundary-Layer Theory.
/// @param reynolds  Re = omega r^2 / nu, > 0
double disc_face_coefficient(double reynolds);

}  // namespace rotordrop
