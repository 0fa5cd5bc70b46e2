#pragma once
// Sums over the points of an arc of contact: the hot loops of drops with bent bores, compiled for several kinds of machine. Their arrays are contiguous along
// the arc, so that every loop is one over vectors.
#include <array>
#include <cstddef>

#include "bearing/bent_rings.h"

namespace rotordrop {

/// A quantity at the points of an arc, unwritten.
struct ArcValues {
  ArcValues() {}
  alignas(64) std::array<double, n_arc_points> at;
};

/// Rotor in a bent bore.
struct ArcPlace {
  double ey, ez, vy, vz, gap;    // rotor's centre from the ring's, their velocity
  const double *cosine, *sine;   // of the azimuths, from the arc's first point on
  const double* shapes;          // of the first shape there; the others follow at the distance `stride`
  std::size_t stride, n_shapes;  // n_shapes is even: cosine and sine of each harmonic
  std::size_t n;                 // points, in whole vectors
  const double *shape, *rate;    // coefficients [m], [m/s]
  const double* waves;           // what waves of the bore add to the overlap [m]; nullptr: none
};
/// Where surfaces overlap.
struct ArcOverlap {
  double deepest;           // the largest overlap [m]; none is positive: they are apart
  std::size_t first, last;  // whole vectors of points with all that overlap: first to last - 1
};
/// Overlap [m] at each point, negative where there is none, and its rate [m/s] from `first` to `last` - 1 of what is returned, elsewhere unwritten.
ArcOverlap arc_overlaps(const ArcPlace& place, ArcValues& overlap, ArcValues& rate);

/// Force of a point over its overlap d: d^exponent (f_0 + f_1 d + f_2 d^2 + f_3 d^3), with Hunt and Crossley's damping.
struct ArcForce {
  double exponent, f_0, f_1, f_2, f_3;  // of ArcContact, for one point
  double damping;                       // 1.5 lambda [s/m]
};
/// Sums of the points' forces.
struct ArcSums {
  double y, z, normal, elastic, damping;  // [N], [W]
};
/// Forces at the points where surfaces overlap, with and without damping.
ArcSums arc_forces(const ArcForce& law, const ArcPlace& place, const ArcValues& overlap, const ArcValues& rate,
                   const ArcOverlap& where, ArcValues& normal, ArcValues& elastic);

/// Sum of the points' energies d^exponent (w_0 + w_1 d + w_2 d^2 + w_3 d^3) [J].
double arc_energies(double exponent, const std::array<double, 4>& w, const ArcValues& overlap, std::size_t n);

}  // namespace rotordrop
