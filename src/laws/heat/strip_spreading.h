#pragma once
#include <vector>

namespace rotordrop {

/// A second slab behind the first, of the same material and width: a ring's housing.
struct SlabBehind {
  double resistance = 0;  ///< between the two [m^2 K/W]
  double thickness = 0;   ///< 0: none
};

/// Resistance of heat that enters a slab at strips and spreads over its width [K m/W], for a unit of length along the strips: mean of the strips over mean of the
/// surface, the heat shared equally by the strips,
///   sum over n >= 1 of 2 (c_n sin(l a)/(l a))^2 F_n / (k W l),   l = n pi / W,  c_n: mean of cos(l x) over the strips' middles,
///   F_n = (1 + y tanh(l t)) / (y + tanh(l t)),   1/y = k l r + coth(l t_2) of a slab behind, y = 0 without one: F_n = coth(l t).
/// Steady; what the far side gives off is uniform over the width, and the ends give nothing off. Exact for slabs (separation of variables).
/// @param width, thickness  W, t [m]
/// @param middles           of the strips, from one end [m], within the width
/// @param half_width        a [m]
double strip_spreading(double width, double thickness, const std::vector<double>& middles, double half_width,
                       double conductivity, const SlabBehind& behind = {});

}  // namespace rotordrop
