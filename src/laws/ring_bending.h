#pragma once
// In-plane bending of a bearing ring in harmonics around it: u_r = a cos(n theta) + b sin(n theta), n >= 2.
#include <vector>

namespace rotordrop {

/// A ball groove: an arc in the section of a ring.
struct RingGroove {
  double position = 0;       ///< of its deepest point along the axis, from the ring's middle [m]
  double centre_radius = 0;  ///< distance of the arc's centre from the axis [m]
  double radius = 0;         ///< of the arc [m]
};

/// Section of a ring and its material: a rectangle between two radii, less its grooves.
struct RingSection {
  double inner_radius = 0, outer_radius = 0;  ///< [m]
  double width = 0;                           ///< of all rings that bend together [m]
  std::vector<RingGroove> grooves;
  bool has_grooves_outside = true;  ///< of an inner ring; an outer ring has them in its inner surface
  double E = 0, nu = 0, rho = 0;    ///< [Pa], [1], [kg/m^3]

  /// Least thickness of the wall under the grooves [m]; negative if a groove breaks through.
  [[nodiscard]] double least_wall() const;
};

/// One harmonic of a free ring: energies k a^2 / 2 and m a'^2 / 2 of each of its two shapes, cos and sin.
struct RingHarmonic {
  int n = 2;
  double stiffness = 0;  ///< k [N/m]
  double mass = 0;       ///< m [kg]
  /// Natural frequency of the free ring [Hz].
  [[nodiscard]] double frequency() const;
};

/// Harmonics 2 to `highest` by finite elements of the section, whose displacements go with cos and sin of n theta around the ring:
/// three-dimensional elasticity, so that shear, extension and the anticlastic bending of wide rings are in. a is the mean of the radial
/// displacement over the section's mass. Each shape is the static one under a load spread evenly over that mass: the local flattening under a
/// concentrated load is that of its contact law. Its frequency lies above the exact one of the mode by less than 0.2 % for n up to 6.
/// Valid:  linear elasticity; a ring that turns slowly against its bending waves. Grooves must leave a wall.
/// @param highest     >= 2
/// @param refinement  elements are smaller by this factor; 1 gives stiffness to 0.7 % up to n = 12, to 0.3 % up to n = 6
std::vector<RingHarmonic> ring_harmonics(const RingSection& section, int highest, int refinement = 1);

}  // namespace rotordrop
