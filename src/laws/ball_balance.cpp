#include "laws/ball_balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

/// Of lengths and forces, whose squares are far from any overflow.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

double cubed_root_squared(double x) { return std::cbrt(x * x); }

/// Deflection under a load's 2/3rd power, K^(-2/3).
double softness(double K) { return 1. / cubed_root_squared(K); }

/// Both contacts in line: the closed form without inertia.
BallBalance without_inertia(const BallContacts& b, double B_x, double B_r, double growth) {
  BallBalance r;
  const double distance = length(B_x, B_r);
  r.sin_i = r.sin_o = B_x / distance;
  r.cos_i = r.cos_o = B_r / distance;
  const double delta = std::max(distance - b.l_i - b.l_o + 2. * growth, 0.);
  const double soft = softness(b.K_i) + softness(b.K_o), K = 1. / (soft * std::sqrt(soft));
  const double Q = K * delta * std::sqrt(delta);
  r.load_i = r.load_o = Q;
  r.energy = 0.4 * Q * delta;
  const double along = 1.5 * K * std::sqrt(delta), across = Q / distance;
  r.stiffness[0] = along * r.sin_i * r.sin_i + across * r.cos_i * r.cos_i;
  r.stiffness[1] = r.stiffness[2] = (along - across) * r.sin_i * r.cos_i;
  r.stiffness[3] = along * r.cos_i * r.cos_i + across * r.sin_i * r.sin_i;
  return r;
}

// State of the Newton iteration: the ball's centre in polar coordinates about the outer groove's centre.
struct Place {
  double delta_o, n_x, n_r;
};

/// What acts on the ball at a place, in the directions along (n) and across (t = (n_r, -n_x)) the outer normal, and its derivatives by
/// delta_o and by the outer contact angle.
struct Balance {
  double R_n, R_t, R_n_d, R_t_d, R_n_a, R_t_a;
  double Q_i, Q_o, S_i, L_o, L_i, i_x, i_r, c, s, orbit, F, F_by_i, F_by_o, H_n, H_t;  // orbit: omega_m / omega
};

Balance balance(const BallContacts& b, const Place& p, double B_x, double B_r, double growth, double F_0) {
  Balance e{};
  e.L_o = b.l_o + p.delta_o - growth;
  const double v_x = B_x - e.L_o * p.n_x, v_r = B_r - e.L_o * p.n_r;
  e.L_i = std::max(length(v_x, v_r), 1e-9);
  e.i_x = v_x / e.L_i;
  e.i_r = v_r / e.L_i;
  const double delta_i = std::max(e.L_i - b.l_i + growth, 0.), root_i = std::sqrt(delta_i);
  const double root_o = std::sqrt(std::max(p.delta_o, 0.));
  e.Q_i = b.K_i * root_i * delta_i;
  e.S_i = 1.5 * b.K_i * root_i;
  e.Q_o = b.K_o * root_o * p.delta_o;
  const double S_o = 1.5 * b.K_o * root_o;
  // cos and sin of phi_i - phi_o.
  e.c = e.i_x * p.n_x + e.i_r * p.n_r;
  e.s = e.i_x * p.n_r - e.i_r * p.n_x;
  // Past the inner groove's centre, where that race cannot drive it, the ball rolls as fast as on this side.
  const double g = b.diameter_ratio, above = 1. - g * std::fabs(e.i_r), below = 1. + std::fabs(e.c);
  const double c_turned = std::copysign(e.s, e.s * e.c) / below;
  e.orbit = above / below;
  e.F = F_0 * e.orbit * e.orbit;
  e.F_by_i = 2. * e.F * (g * std::copysign(e.i_x, e.i_x * e.i_r) / above + c_turned);
  e.F_by_o = -2. * e.F * c_turned;
  // F_c e_r + T_o + T_i = F (H_n n + H_t t): the centrifugal force has (n_r, -n_x), friction at the outer race (0, -0.4 (1 - sigma) n_x), at the
  // inner one 0.4 sigma n_x (-s, c).
  const double k = 0.4 * b.inner_gyroscopic_share;
  e.H_n = p.n_r - k * p.n_x * e.s;
  e.H_t = -(1.4 - k) * p.n_x + k * p.n_x * e.c;
  e.R_n = e.Q_i * e.c - e.Q_o + e.F * e.H_n;
  e.R_t = e.Q_i * e.s + e.F * e.H_t;
  // By delta_o the centre moves along n, by the angle along L_o t; phi_i changes by -t_i . motion / L_i.
  const double angle_d = e.s / e.L_i, angle_a = -e.c * e.L_o / e.L_i;
  const double Q_d = -e.S_i * e.c, Q_a = -e.S_i * e.s * e.L_o;
  const double F_d = e.F_by_i * angle_d, F_a = e.F_by_i * angle_a + e.F_by_o;
  const double T_c = k * p.n_x * e.c * e.F, T_s = k * p.n_x * e.s * e.F;
  e.R_n_d = Q_d * e.c - (e.Q_i * e.s + T_c) * angle_d - S_o + F_d * e.H_n;
  e.R_t_d = Q_d * e.s + (e.Q_i * e.c - T_s) * angle_d + F_d * e.H_t;
  e.R_n_a = Q_a * e.c - (e.Q_i * e.s + T_c) * (angle_a - 1.) + F_a * e.H_n - e.F * (p.n_x + k * p.n_r * e.s);
  e.R_t_a = Q_a * e.s + (e.Q_i * e.c - T_s) * (angle_a - 1.) + F_a * e.H_t - e.F * p.n_r * (1.4 - k - k * e.c);
  return e;
}

/// From the ball without inertia; one that the inner race would not reach lies in the bottom of the outer groove.
Place starting_place(const BallContacts& b, double B_x, double B_r, double growth, double F_0) {
  const double distance = length(B_x, B_r);
  const double delta = std::max(distance - b.l_i - b.l_o + 2. * growth, 0.);
  const double soft_i = softness(b.K_i), soft_o = softness(b.K_o);
  Place p{delta * soft_o / (soft_i + soft_o), B_x / distance, B_r / distance};
  const double ratio = 0.5 * (1. - b.diameter_ratio * p.n_r), F = F_0 * ratio * ratio;
  const double bottom = cubed_root_squared(F / b.K_o);
  if (length(B_x, B_r - (b.l_o + bottom - growth)) < b.l_i - growth) return {bottom, 0., 1.};
  const double Q = b.K_o * p.delta_o * std::sqrt(p.delta_o);
  p.delta_o = cubed_root_squared((Q + F * std::max(p.n_r, 0.)) / b.K_o);
  return p;
}

/// Where a function that falls from a to b is zero; the nearer end if it is not between them.
template <class Function>
double falling_root(double a, double b, const Function& f) {
  for (int halvings = 0; halvings < 60 && a < b; ++halvings) {
    const double middle = 0.5 * (a + b);
    (f(middle) > 0. ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// For balls that are wedged in so loosely that Newton's method jumps between a ball pressed hard and one that is not touched: the outer deflection
/// that balances forces along the outer normal, for each outer angle between the bottom of the groove and the direction of B; and the angle at which
/// they balance across, too.
Place place_by_halving(const BallContacts& b, double B_x, double B_r, double growth, double F_0) {
  const auto at_angle = [&](double angle) {
    Place p{0., std::copysign(std::sin(angle), B_x), std::cos(angle)};
    double most = cubed_root_squared(F_0 / b.K_o);
    const auto pressed = [&](double delta_o) { return balance(b, {delta_o, p.n_x, p.n_r}, B_x, B_r, growth, F_0).R_n; };
    while (pressed(most) > 0.) most *= 2.;
    p.delta_o = falling_root(0., most, pressed);
    return p;
  };
  const double end = std::min(std::atan2(std::fabs(B_x), B_r), 0.5 * std::numbers::pi);
  return at_angle(falling_root(0., end, [&](double angle) {
    return std::copysign(1., B_x) * balance(b, at_angle(angle), B_x, B_r, growth, F_0).R_t;
  }));
}

}  // namespace

BallBalance ball_balance(const BallContacts& b, double B_x, double B_r, double growth, double speed, double share) {
  const double F_0 = centrifugal_force(share * b.mass, b.pitch_diameter, speed);
  if (F_0 == 0.) return without_inertia(b, B_x, B_r, growth);
  Place p = starting_place(b, B_x, B_r, growth, F_0);
  Balance e = balance(b, p, B_x, B_r, growth, F_0);
  double left = length(e.R_n, e.R_t);
  int iterations = 0;
  for (; iterations < 60 && left > 1e-14 * (e.Q_o + e.F); ++iterations) {
    const double det = e.R_n_d * e.R_t_a - e.R_n_a * e.R_t_d;
    const double along = -(e.R_n * e.R_t_a - e.R_n_a * e.R_t) / det;
    const double turn = std::clamp(-(e.R_n_d * e.R_t - e.R_n * e.R_t_d) / det, -0.7, 0.7);
    Place next;
    next.delta_o = std::max(p.delta_o + along, 0.1 * p.delta_o);
    const double x = p.n_x + turn * p.n_r, r = p.n_r - turn * p.n_x, norm = length(x, r);
    next.n_x = x / norm;
    next.n_r = r / norm;
    const Balance after = balance(b, next, B_x, B_r, growth, F_0);
    const double left_after = length(after.R_n, after.R_t);
    // At the end of the digits, the better of the last two.
    if (left < 1e-10 * (e.Q_o + e.F) && left_after >= left) break;
    p = next;
    e = after;
    left = left_after;
  }

  if (!(left <= 1e-9 * (e.Q_o + e.F))) {
    p = place_by_halving(b, B_x, B_r, growth, F_0);
    e = balance(b, p, B_x, B_r, growth, F_0);
    left = length(e.R_n, e.R_t);
  }

  BallBalance result;
  result.load_i = e.Q_i;
  result.load_o = e.Q_o;
  result.sin_i = e.i_x;
  result.cos_i = e.i_r;
  result.sin_o = p.n_x;
  result.cos_o = p.n_r;
  result.orbit_speed = speed * e.orbit;
  result.centrifugal_force = e.F;
  result.gyroscopic_moment = 0.2 * e.F * p.n_x * b.diameter_ratio * b.pitch_diameter;  // T d / 2
  const double k = 0.4 * b.inner_gyroscopic_share;
  result.inner_traction = k * e.F * p.n_x;
  const double delta_i = std::max(e.L_i - b.l_i + growth, 0.);
  result.energy = 0.4 * (e.Q_i * delta_i + e.Q_o * p.delta_o);
  result.residual = left;
  result.iterations = iterations;

  // The inner pull G = Q_i n_i + T_i t_i depends on B - P and, through the balance, P on B:  R_P P' + R_B B' = 0.
  const double det = e.R_n_d * e.R_t_a - e.R_n_a * e.R_t_d;
  for (int axis = 0; axis < 2; ++axis) {
    const double b_x = axis == 0 ? 1. : 0., b_r = 1. - b_x;
    const double by_B_stretch = b_x * e.i_x + b_r * e.i_r;
    const double by_B_angle = (b_x * e.i_r - b_r * e.i_x) / e.L_i;
    const double Q = e.S_i * by_B_stretch, F = e.F_by_i * by_B_angle;
    const double T = result.inner_traction;
    const double R_n = Q * e.c - (e.Q_i * e.s + T * e.c) * by_B_angle + F * e.H_n;
    const double R_t = Q * e.s + (e.Q_i * e.c - T * e.s) * by_B_angle + F * e.H_t;
    const double along = -(R_n * e.R_t_a - e.R_n_a * R_t) / det;
    const double turn = -(e.R_n_d * R_t - R_n * e.R_t_d) / det;
    const double v_x = b_x - along * p.n_x - turn * e.L_o * p.n_r, v_r = b_r - along * p.n_r + turn * e.L_o * p.n_x;
    const double stretch = v_x * e.i_x + v_r * e.i_r, swing = (v_x * e.i_r - v_r * e.i_x) / e.L_i;
    const double T_more = k * ((e.F_by_i * swing + e.F_by_o * turn) * p.n_x + e.F * turn * p.n_r);
    const double outwards = e.S_i * stretch - T * swing, across = e.Q_i * swing + T_more;
    result.stiffness[axis] = outwards * e.i_x + across * e.i_r;
    result.stiffness[2 + axis] = outwards * e.i_r - across * e.i_x;
  }
  return result;
}

}  // namespace rotordrop
