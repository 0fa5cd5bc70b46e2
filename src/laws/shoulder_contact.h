#pragma once
#include "laws/hertz.h"

namespace rotordrop {

/// Mean displacement of a flat annulus on an elastic half space per newton that is spread evenly over it [m/N].
///
///   w/F = 4 (1 - nu^2) / (pi E (b^2 - a^2)^2) [ 4 (a^3 + b^3) / (3 pi) - a^2 b 2F1(1/2, -1/2; 2; m) ],   m = (a/b)^2,
///   2F1(1/2, -1/2; 2; m) = 4 / (3 pi m) [ (1 + m) E(m) - (1 - m) K(m) ],   K, E complete, of the parameter m.
///
/// It follows from Hankel's transform of Boussinesq's solution: the mean is an integral of the squared transform of the pressure, (b J_1(k b) - a J_1(k a))^2 / k^2 (Johnson,
/// Contact Mechanics, 1985, section 3.4, for a = 0: 16 (1 - nu^2) / (3 pi^2 E b)).
///
/// @param inside, outside  radii a >= 0 and b > a [m]
double annulus_compliance(double inside, double outside, const ElasticMaterial& material);

/// Shortening of a hollow cylinder per newton along its axis [m/N]: length / (E area).
/// @param inside, outside  radii [m]; @param length [m]
double sleeve_compliance(double inside, double outside, double length, const ElasticMaterial& material);

}  // namespace rotordrop
