#pragma once
// Friction with sticking: an elastic-plastic bristle between two surfaces that press on each other.
//
// z: deflection of the bristle in the plane of contact (t around the axis, x along it) [m]; v: slip speed; L = mu N: largest friction force.
//   z_max = L / k                                     where the bristle slips fully
//   w     = v kappa z_max / sqrt((kappa z_max)^2 + v^2)       slip that bends the bristle: v itself while slow
//   z'    = w - a max(w . e, 0) e - kappa max(|z| - z_max, 0) e - (1 - a) (V / l) z,        e = z / |z|
//   a     = 0 up to 0.8 z_max, s^2 (3 - 2 s) with s = (|z|/z_max - 0.8) / 0.2 above, 1 from z_max on
//   F     = k min(|z|, z_max) f e + b (k / kappa) w,          f = 1, but |w|/|v| while v bends the bristle back
//   b     = 1, or as much as keeps |F| at L: friction is never above it
// Below 0.8 L the bristle is a spring: what rests stays, without drift (Dupont, Hayward, Armstrong & Altpeter, IEEE Trans. Autom. Control 47
// (2002) 787). In sliding |z| = z_max along v and F = L: the regularised law's. Where slip is fast at once, as in an impact, |w| = kappa z_max and F = L
// from the first instant on, while the bristle still bends. The rate kappa bounds how fast a bristle yields, so that slip at tens
// of metres per second is no stiffer than slip near rest; a has no slope at either end, as Dupont's sine: with one at z_max a bristle that slides
// would be stiff (10 kappa for s^2) and bound an integrator's steps. In surfaces that roll through the contact with the speed V the bristles leave it
// after its length l: then a lasting force creeps, as in rolling contact (Carter 1926).
// Passive: F . v - k z . z' >= 0 at every instant, term by term, whatever N does; that is the heat, and k z^2 / 2 is stored.
#include <algorithm>
#include <cmath>

namespace rotordrop {

struct StickingFriction {
  double stiffness = 0;                         ///< k [N/m], > 0
  double contact_length = 1;                    ///< l, along the rolling direction [m], > 0
  static constexpr double rate = 1e5;           ///< kappa [1/s]
  static constexpr double elastic_share = 0.8;  ///< of L, taken without any slip

  struct Vector {
    double t = 0, x = 0;
  };
  struct Result {
    Vector force;            ///< F, along the slip [N]
    Vector bristle_rate;     ///< z' [m/s]
    double stored_rate = 0;  ///< k z . z' [W]
  };

  /// @param bristle z [m]; @param slip v [m/s]; @param limit L = mu N, >= 0 [N]; @param through_speed V, >= 0 [m/s]
  [[nodiscard]] Result evaluate(const Vector& z, const Vector& v, double limit, double through_speed) const {
    constexpr double nothing = 1e-60;
    const double z_max = limit / stiffness, length = std::sqrt(z.t * z.t + z.x * z.x);
    const double e_t = z.t / (length + nothing), e_x = z.x / (length + nothing);
    const double cap = rate * z_max;
    const double yielding = cap / std::sqrt(cap * cap + v.t * v.t + v.x * v.x + nothing);
    const double w_t = yielding * v.t, w_x = yielding * v.x;
    double a = 1.;
    if (length < z_max) {
      const double beyond = std::max(length / z_max - elastic_share, 0.) / (1. - elastic_share);
      a = beyond * beyond * (3. - 2. * beyond);
    }
    const double along = w_t * e_t + w_x * e_x;
    const double plastic = a * std::max(along, 0.), over = rate * std::max(length - z_max, 0.);
    // A straightened bristle rests at an atom's fraction: one that decayed for ever would become slow denormal numbers.
    const double bent = length > 1e-18 ? 1. : 0.;
    const double leaving = bent * (1. - a) * through_speed / contact_length;
    const double bending_t = w_t - plastic * e_t, bending_x = w_x - plastic * e_x;
    Result r;
    r.bristle_rate = {bending_t - bent * over * e_t - leaving * z.t, bending_x - bent * over * e_x - leaving * z.x};
    const double spring = stiffness * std::min(length, z_max) * (along < 0. ? yielding : 1.);
    const double damping = stiffness / rate;
    r.force = within(limit, {spring * e_t, spring * e_x}, {damping * w_t, damping * w_x});
    r.stored_rate = stiffness * (z.t * r.bristle_rate.t + z.x * r.bristle_rate.x);
    return r;
  }
  /// A spring's force, at most the limit, and as much of a damper's that both together are not above it.
  [[nodiscard]] static Vector within(double limit, const Vector& spring, const Vector& damper) {
    const double square = damper.t * damper.t + damper.x * damper.x, both = spring.t * damper.t + spring.x * damper.x;
    const double left = limit * limit - (spring.t * spring.t + spring.x * spring.x);
    double share = 1.;
    if (square > 0. && 2. * both + square > left) {
      const double room = std::max(left, 0.), root = std::sqrt(both * both + square * room);
      share = both > 0. ? room / (both + root) : (root - both) / square;
    }
    return {spring.t + share * damper.t, spring.x + share * damper.x};
  }
  [[nodiscard]] double energy(const Vector& z) const { return 0.5 * stiffness * (z.t * z.t + z.x * z.x); }
};

}  // namespace rotordrop
