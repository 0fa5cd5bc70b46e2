#pragma once
// Where the growth of a bearing's rings counts, and how much each surface grows per kelvin.
//
// A ball is pressed by the displacements u of the two races' contact points along the contact normal n, and by its own diameter:
//   d(delta) = (u_in - u_out) . n + 2 eps_b,
// u with its radial and its axial part. The points lie at r = d_m/2 -+ (d/2) cos phi_0 and x = x_row -+ s (d/2) sin phi_0, a distance d apart
// along n. Under one temperature everywhere u = alpha T (position), so that d(delta) = -alpha T d + alpha T d = 0.

namespace rotordrop {

/// Radii at which the radial growth of the raceways is taken, and the width over which the axial one counts.
struct RaceSurfaces {
  double inner = 0, outer = 0;  ///< [m]
  double width = 0;             ///< W, all rows; 0: axial growth is left out [m]
};
/// The contact points.
RaceSurfaces contact_point_surfaces(double ball_diameter, double pitch_diameter, double contact_angle, double width);

struct GrowthDimensions {
  double ring_expansion = 0, ball_expansion = 0, shaft_expansion = 0;  ///< alpha [1/K]
  double shaft_radius = 0, bore_radius = 0, ball_radius = 0;           ///< [m]
  RaceSurfaces races;
  bool is_housed = true;  ///< the outer ring sits in its housing, which holds it
};

/// Growth of a bearing's surfaces per kelvin of the mean temperature of the part that carries them [m/K]: alpha times the radius, or the width.
struct GrowthPerRise {
  double bore = 0, inner_race = 0;  ///< per rise of the inner ring
  double outer_race = 0;  ///< per mean rise of outer ring and housing together, or of a ring that is not housed
  double shaft = 0, ball = 0;
  double inner_width = 0;  ///< per rise of the inner ring
  double outer_width = 0;  ///< per rise of the outer ring itself
  bool is_housed = true;   ///< which rise the outer race's is of
};
/// @param constraint  1 for free rings, 1 + nu for rings under plane strain
GrowthPerRise growth_per_rise(const GrowthDimensions& dimensions, double constraint = 1.);

}  // namespace rotordrop
