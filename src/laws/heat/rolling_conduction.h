#pragma once
// Heat conduction between a ball and its two races, at rest and while it rolls.
#include "base/real.h"

namespace rotordrop {

/// What heat conduction needs to know of a material at its surface.
struct ConductingBody {
  double conductivity = 0;         ///< k [W/(m K)]
  double volumetric_capacity = 0;  ///< rho c [J/(m^3 K)]
};

/// Conductance of an elliptic spot of one temperature on a half space, spot to the body far away [W/K], by u = Q^(1/3) of its load Q and the speed U [m/s] at
/// which it travels over the surface along its semi-minor axis b:
///   g = sqrt(G0^2 + Ginf^2),   G0 = 2 pi k a / K(m), m = 1 - (b/a)^2   (at rest),
///   Ginf = 2.7895 e a sqrt(b U),  e = sqrt(k rho c)                    (each chord 2 y heats for 2 y / U: integral of 2 e U sqrt(t/pi)).
/// With a = a_1 u and b = a/ellipticity: G0 = rest u, Ginf^2 = rolling U u^3.
/// Valid for any Peclet number: exact at rest and at high speed; between, within 4.9 % of the steady field of a moving spot (round ones; 2.1 % from
/// an ellipticity of 3 on; validation/rolling_conduction.py). At rest in the sense of G0 takes a^2/(k/rho c), some 10 ms.
template <class Real>
struct SpotConductionOf {
  Real rest = 0;     ///< G0 / u [W/(K N^(1/3))]
  Real rolling = 0;  ///< Ginf^2 / (u^3 U) [W^2 s/(K^2 N m)]
  /// g / u
  [[nodiscard]] Real per_root(const Real& root, const Real& speed) const {
    return sqrt(rest * rest + rolling * speed * root);
  }
};
using SpotConduction = SpotConductionOf<double>;
/// @param axis_factor  a_1: semi-major axis over the cube root of the load [m/N^(1/3)]
/// @param ellipticity  a/b >= 1
SpotConduction spot_conduction(const ConductingBody& body, double axis_factor, double ellipticity);

/// Race, film and ball in series at one contact.
template <class Real>
struct ContactConductionOf {
  SpotConductionOf<Real> race, ball;
  Real film = 0;  ///< k_oil pi a b / (h u^2) of a film of thickness h [W/(K N^(2/3))]; 0: dry
  /// [W/K] of one ball under a load of cube root `root` [N^(1/3)], rolling at `speed` >= 0 [m/s]; nothing without load.
  [[nodiscard]] Real conductance(const Real& root, const Real& speed) const {
    const Real r = race.per_root(root, speed), b = ball.per_root(root, speed);
    const Real per_root = r * b / (r + b);
    const Real dry = root * per_root;
    return select(root <= 0., Real(0.), select(film > 0., dry / (1. + per_root / (film * root)), dry));
  }
};
using ContactConduction = ContactConductionOf<double>;
/// @param film_thickness  [m]; 0: dry
ContactConduction contact_conduction(const ConductingBody& race, const ConductingBody& ball, double axis_factor,
                                     double ellipticity, double film_thickness, double film_conductivity);

/// Conductances between inner race, outer race and the bulk of balls, of a few balls together [W/K].
template <class Real>
struct BallConductancesOf {
  Real inner_to_ball = 0, outer_to_ball = 0;
  Real inner_to_outer = 0;  ///< through the balls' tracks, without warming the balls
  void add(const BallConductancesOf& other) {
    inner_to_ball += other.inner_to_ball;
    outer_to_ball += other.outer_to_ball;
    inner_to_outer += other.inner_to_outer;
  }
};
using BallConductances = BallConductancesOf<double>;

/// The balls of a row between their races. Heat passes from a race into the ball's track, which holds none: from there into the other race, or
/// through 1/into_ball into the ball's bulk. The star of three conductances as a triangle.
template <class Real>
struct RowConductionOf {
  ContactConductionOf<Real> inner, outer;
  Real into_ball = 0;  ///< of one ball [W/K]

  /// n balls alike.
  [[nodiscard]] BallConductancesOf<Real> of_balls(const Real& n, const Real& inner_root, const Real& outer_root,
                                                  const Real& speed) const {
    const Real G_i = inner.conductance(inner_root, speed), G_o = outer.conductance(outer_root, speed);
    const Real factor = n / (G_i + G_o + into_ball);
    return {factor * G_i * into_ball, factor * G_o * into_ball, factor * G_i * G_o};
  }
  /// A row by the sums of its loads and of their cube roots, as if they were those of n = S_1^1.5 / S_3^0.5 equal balls and none besides. Exact for
  /// equal loads; for loads as cos^1.5 over half the circumference within 3 % (tests/unit/laws). Balls without load at the inner race conduct at
  /// the outer one alone.
  [[nodiscard]] BallConductancesOf<Real> of_row(const Real& inner_roots, const Real& inner_loads,
                                                const Real& outer_roots, const Real& outer_loads,
                                                const Real& speed) const {
    const Real nothing = 0.;
    const auto root = [&](const Real& roots, const Real& loads) {
      return select(loads > 0., sqrt(loads / roots), nothing);
    };
    const Real u_i = root(inner_roots, inner_loads), u_o = root(outer_roots, outer_loads);
    const Real n_i = select(u_i > 0., inner_roots / u_i, nothing), n_o = select(u_o > 0., outer_roots / u_o, nothing);
    const Real both = smaller(n_i, n_o);
    BallConductancesOf<Real> sum;
    if (any(both > 0.)) sum = of_balls(both, u_i, u_o, speed);
    // Pressed outwards by their inertia alone.
    if (any(n_o > both)) sum.add(of_balls(n_o - both, nothing, u_o, speed));
    return sum;
  }
};
using RowConduction = RowConductionOf<double>;

/// Conductance from the track of a ball into its bulk [W/K], the bulk warming evenly: heat spread over a band of half width a around the ball,
///   2 pi^2 k r / (ln(r/a) + 0.43),
/// for a track that repeats itself; 20 pi k r if the ball's axis wanders and the whole surface takes part (uniform flux into a sphere).
double repeating_track_conductance(double conductivity, double ball_radius, double half_width);
double wandering_track_conductance(double conductivity, double ball_radius);

}  // namespace rotordrop
