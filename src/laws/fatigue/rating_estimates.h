#pragma once
namespace rotordrop {

/// Ratings of all rows together [N].
struct RatingEstimates {
  double static_load = 0;   ///< C0
  double dynamic_load = 0;  ///< C
};

/// Of radial and angular-contact ball bearings by ISO 76 and ISO 281, with one factor f0 = 15 N/mm2 and f_c = 55 N/mm^1.8 for all proportions, where
/// the tables of the standards have 12 to 16.5 and 40 to 60: within some 30 %, to tell a wrong unit or bearing, not to rate one.
///   C0 = f0 i Z D^2 cos(alpha)   (ISO 76:2006, 5.1)
///   C = 1.3 f_c (i cos(alpha))^0.7 Z^(2/3) D^1.8, beyond 25.4 mm with 3.647 D^1.4   (ISO 281:2007, 5.1)
/// @param ball_diameter  D [m]
/// @param contact_angle  alpha [rad]
[[nodiscard]] RatingEstimates estimated_ratings(int rows, int balls_per_row, double ball_diameter,
                                                double contact_angle);

}  // namespace rotordrop
