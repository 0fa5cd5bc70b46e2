#pragma once
// Approach of a journal and the bore that it lies in, from their bodies.
#include "laws/hertz.h"

namespace rotordrop {

/// Journal in a bore, pressed together over a length.
struct JournalInBore {
  ElasticMaterial journal, ring;
  double journal_radius = 0;        ///< [m]
  double journal_inner_radius = 0;  ///< of a hollow journal [m]; 0: solid
  double bore_radius = 0;           ///< [m], > journal_radius
  double ring_wall = 0;             ///< depth of the ring's material under the bore [m], > 0
  double length = 0;                ///< over which they touch [m], > 0
};

/// Half-width of the contact [m] under a force [N]; Hertz (line_contact_half_width).
double journal_contact_half_width(const JournalInBore& bodies, double force);

/// Approach of the journal's axis and the ring's material below the contact [m] under a force [N], >= 0.
///
///   solid journal, from the contact to its axis:  delta_j = P (1 - nu^2) / (pi E) (2 ln(4 R_j / a) - 1)
///   ring, or wall of a hollow journal, from the contact to the depth d:
///     delta = 2 P (1 - nu^2) / (pi E) [asinh(s) - nu / (1 - nu) (s sqrt(1 + s^2) - s^2)],   s = d / a
///
/// the second the integral of the strain under Hertz' pressure on a half-space along the normal. Bending of the ring as a hoop is not part of it.
/// Source: Johnson (1985), eqs. 5.56 and 4.46; for d >> a the second is his 5.55.
/// Valid:  plane strain, no friction, a below the radii; a ring's wall on an elastic rest.
double line_contact_approach(const JournalInBore& bodies, double force);

/// K of F = K delta^n [N/m^n] that has the approach of the bodies at one force [N].
double fitted_contact_stiffness(double force, double approach, double exponent);

}  // namespace rotordrop
