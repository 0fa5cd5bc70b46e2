#include "bearing/inertial_balls.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/wide_vectors.h"
#include "laws/ball_balance.h"

// Loops over the balls of a row, compiled for several kinds of machine as the row kernels of ball_row.cpp are. Bodies are inlined templates, so
// that single and double precision share them.
#define ROTORDROP_INLINE inline __attribute__((always_inline))

namespace rotordrop {
namespace {

template <class Real>
struct Ball {
  Real u_i, u_o, i_x, i_r, o_x, o_r;
};
template <class Real>
struct Row {
  Real c_i, c_o, l_i, l_o, g, F_0;
};

// Within 1e-5 of the cubic root; for starts.
template <class Real>
ROTORDROP_INLINE Real rough_cubic_root(Real value) {
  const float x = static_cast<float>(value);
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
  float y = std::bit_cast<float>(static_cast<std::int32_t>(bits * (1.f / 3.f) + 709921077.f));
  const float cube = y * y * y;
  y = y * (cube + 2.f * x) / (2.f * cube + x);
  return static_cast<Real>(y);
}

/// Linear system of a ball: what its unknowns do to its four equations.
template <class Real>
struct System {
  Real L_i, L_o, c, s, F, Q_i, Q_o;
  Real angle_a, angle_x;  // change of the inner angle by that of the outer one, and by the outer length
  Real R_n_a, R_t_a, R_n_x, R_t_x, inverse_det;
  Real S_i, F_by_i, inverse_L_i;
  Real h_n, h_t;

  /// @param inner_length  from the ball's centre to that of the inner groove
  ROTORDROP_INLINE System(const Row<Real>& row, const Ball<Real>& b, Real inner_length, Real added_o) {
    const Real one = 1, two = 2;
    L_i = inner_length;
    L_o = row.l_o + row.c_o * b.u_o * b.u_o - added_o;
    Q_i = b.u_i * b.u_i * b.u_i;
    Q_o = b.u_o * b.u_o * b.u_o;
    c = b.i_x * b.o_x + b.i_r * b.o_r;
    s = b.i_x * b.o_r - b.i_r * b.o_x;
    const Real above = one - row.g * b.i_r, below = one + c;
    const Real inverse = one / (L_i * below * above);
    inverse_L_i = inverse * below * above;
    const Real inverse_below = inverse * L_i * above, inverse_above = inverse * L_i * below;
    F = row.F_0 * (above * inverse_below) * (above * inverse_below);
    F_by_i = two * F * (row.g * b.i_x * inverse_above + s * inverse_below);
    const Real F_by_o = -two * F * s * inverse_below;
    S_i = Real(1.5) * b.u_i / row.c_i;
    const Real S_o = Real(1.5) * b.u_o / row.c_o;
    h_n = b.o_r;
    h_t = Real(-1.4) * b.o_x;
    angle_a = -L_o * c * inverse_L_i;
    angle_x = s * inverse_L_i;
    const Real stretch_a = -L_o * s, stretch_x = -c;
    const Real F_a = F_by_i * angle_a + F_by_o, F_x = F_by_i * angle_x;
    // The force of inertia, F (-0.4 o_x o_r, 1 + 0.4 o_x^2), turns with the outer angle: (-0.4 (o_r^2 - o_x^2), 0.8 o_x o_r) F.
    const Real turn_x = Real(-0.4) * (b.o_r * b.o_r - b.o_x * b.o_x), turn_r = Real(0.8) * b.o_x * b.o_r;
    R_n_a = S_i * stretch_a * c - Q_i * s * angle_a + F_a * h_n + F * (turn_x * b.o_x + turn_r * b.o_r);
    R_t_a = S_i * stretch_a * s + Q_i * c * angle_a - Q_o + F_a * h_t + F * (turn_x * b.o_r - turn_r * b.o_x);
    R_n_x = S_i * stretch_x * c - Q_i * s * angle_x - S_o + F_x * h_n;
    R_t_x = S_i * stretch_x * s + Q_i * c * angle_x + F_x * h_t;
    inverse_det = one / (R_n_a * R_t_x - R_t_a * R_n_x);
  }
  /// Turn of the outer normal (a) and change of the outer length (x) that answer a gap in the geometry (along and across the inner normal)
  /// and a left-over force.
  ROTORDROP_INLINE void solve(Real gap_n, Real gap_t, Real force_n, Real force_t, Real& a, Real& x) const {
    const Real turn = gap_t * inverse_L_i;
    const Real n = force_n + S_i * gap_n * c - Q_i * s * turn + F_by_i * turn * h_n;
    const Real t = force_t + S_i * gap_n * s + Q_i * c * turn + F_by_i * turn * h_t;
    a = (t * R_n_x - n * R_t_x) * inverse_det;
    x = (n * R_t_a - t * R_n_a) * inverse_det;
  }
};

/// One Newton step; returns the force left before it, of the outer load.
template <class Real>
ROTORDROP_INLINE Real step(const Row<Real>& row, Ball<Real>& b, Real B_x, Real B_r, Real added_i, Real added_o) {
  const Real one = 1, half = Real(0.5);
  const System<Real> s(row, b, row.l_i + row.c_i * b.u_i * b.u_i - added_i, added_o);
  const Real gap_x = B_x - s.L_o * b.o_x - s.L_i * b.i_x, gap_r = B_r - s.L_o * b.o_r - s.L_i * b.i_r;
  const Real gap_n = gap_x * b.i_x + gap_r * b.i_r, gap_t = gap_x * b.i_r - gap_r * b.i_x;
  const Real force_n = s.Q_i * s.c - s.Q_o + s.F * s.h_n, force_t = s.Q_i * s.s + s.F * s.h_t;
  Real a, x;
  s.solve(gap_n, gap_t, force_n, force_t, a, x);
  const Real turn = gap_t * s.inverse_L_i + s.angle_a * a + s.angle_x * x;
  const Real stretch = gap_n - s.L_o * s.s * a - s.c * x;
  // Rotations that keep the normals' length exactly; all four divisions in one.
  const Real h = std::clamp(half * a, -half, half), k = std::clamp(half * turn, -half, half);
  const Real p = one + h * h, q = one + k * k;
  const Real inverse = one / (p * q * b.u_i * b.u_o);
  const Real du_o = x * half / row.c_o * (inverse * p * q * b.u_i),
             du_i = stretch * half / row.c_i * (inverse * p * q * b.u_o);
  const Real inverse_p = inverse * q * b.u_i * b.u_o, inverse_q = inverse * p * b.u_i * b.u_o;
  const Real left =
      std::abs(force_n) + std::abs(force_t) + s.S_i * (std::abs(gap_n)) + s.Q_i * std::abs(gap_t) * s.inverse_L_i;
  const Real load = s.Q_o + s.F;
  b.u_o = std::max(b.u_o + du_o, Real(0.3) * b.u_o);
  b.u_i = std::max(b.u_i + du_i, Real(0.2) * b.u_i);
  const Real o_x = ((one - h * h) * b.o_x + 2 * h * b.o_r) * inverse_p,
             o_r = ((one - h * h) * b.o_r - 2 * h * b.o_x) * inverse_p;
  const Real i_x = ((one - k * k) * b.i_x + 2 * k * b.i_r) * inverse_q,
             i_r = ((one - k * k) * b.i_r - 2 * k * b.i_x) * inverse_q;
  b.o_x = o_x;
  b.o_r = o_r;
  b.i_x = i_x;
  b.i_r = i_r;
  return left / load;
}

/// Between the ball without inertia and the ball in the bottom of the outer groove: the moment of its forces about the outer groove's centre
/// shares B_x out to the two normals, what remains of B_r is compression.
template <class Real>
ROTORDROP_INLINE Ball<Real> start(const Row<Real>& row, Real B_x, Real B_r, Real added, Real series) {
  const Real one = 1, small = Real(1e-12);
  const Real distance = std::sqrt(B_x * B_x + B_r * B_r);
  const Real delta = std::max(distance - row.l_i - row.l_o + added, Real(0));
  const Real Q = series * delta * std::sqrt(delta);
  const Real ratio = Real(0.5) * (one - row.g * B_r / distance);
  const Real F = row.F_0 * ratio * ratio;
  const Real Q_guess = Q + Real(0.35) * F;
  const Real share = Q_guess / (2 * Q_guess + Real(1.4) * F);
  Ball<Real> b;
  b.o_x = std::clamp(B_x * share / row.l_o, Real(-0.95), Real(0.95));
  b.i_x = std::clamp(B_x * (one - share) / row.l_i, Real(-0.95), Real(0.95));
  b.o_r = std::sqrt(one - b.o_x * b.o_x);
  b.i_r = std::sqrt(one - b.i_x * b.i_x);
  const Real both = std::max((B_r - row.l_o * b.o_r - row.l_i * b.i_r) * 2 / (b.o_r + b.i_r) + added, small);
  const Real mean = both / (row.c_i + row.c_o);
  const Real q = mean * std::sqrt(mean);
  const Real Q_i = std::max(q - Real(0.5) * F * b.o_r, Real(0.02) * F + Real(0.05) * q);
  b.u_o = rough_cubic_root(Q_i + F * b.o_r);
  b.u_i = std::max(rough_cubic_root(Q_i), Real(1e-3) * b.u_o + Real(1e-9));
  return b;
}

struct Single {
  static constexpr std::size_t capacity = InertialBalls::capacity;
  using Array = std::array<float, capacity>;
  Single() {}
  alignas(64) Array B_x, B_r, added_i, added_o, u_i, u_o, i_x, i_r, o_x, o_r;
};

ROTORDROP_WIDE_VECTORS
void start_all(const Row<float>& row, float series, std::size_t n, const InertialBalls& in, Single& f) {
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) {
    f.B_x[j] = static_cast<float>(in.B_x[j]);
    f.B_r[j] = static_cast<float>(in.B_r[j]);
    f.added_i[j] = static_cast<float>(in.added_i[j]);
    f.added_o[j] = static_cast<float>(in.added_o[j]);
    const auto b = start<float>(row, f.B_x[j], f.B_r[j], f.added_i[j] + f.added_o[j], series);
    f.u_i[j] = b.u_i;
    f.u_o[j] = b.u_o;
    f.i_x[j] = b.i_x;
    f.i_r[j] = b.i_r;
    f.o_x[j] = b.o_x;
    f.o_r[j] = b.o_r;
  }
}

/// @return balls that had more than `enough` left over before the step (or no number any more)
ROTORDROP_WIDE_VECTORS
float step_single(const Row<float>& row, std::size_t n, float enough, Single& f) {
  float n_left = 0;
#pragma omp simd reduction(+ : n_left)
  for (std::size_t j = 0; j < n; ++j) {
    Ball<float> b{f.u_i[j], f.u_o[j], f.i_x[j], f.i_r[j], f.o_x[j], f.o_r[j]};
    const float left = step<float>(row, b, f.B_x[j], f.B_r[j], f.added_i[j], f.added_o[j]);
    n_left += left <= enough ? 0 : 1;
    f.u_i[j] = b.u_i;
    f.u_o[j] = b.u_o;
    f.i_x[j] = b.i_x;
    f.i_r[j] = b.i_r;
    f.o_x[j] = b.o_x;
    f.o_r[j] = b.o_r;
  }
  return n_left;
}

ROTORDROP_WIDE_VECTORS
void widen(std::size_t n, const Single& f, InertialBalls& w) {
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) {
    // Rounding has left the normals a little off unit length; to first order of that they are brought back.
    const double i_x = f.i_x[j], i_r = f.i_r[j], o_x = f.o_x[j], o_r = f.o_r[j];
    const double fix_i = 1.5 - 0.5 * (i_x * i_x + i_r * i_r), fix_o = 1.5 - 0.5 * (o_x * o_x + o_r * o_r);
    w.u_i[j] = f.u_i[j];
    w.u_o[j] = f.u_o[j];
    w.i_x[j] = i_x * fix_i;
    w.i_r[j] = i_r * fix_i;
    w.o_x[j] = o_x * fix_o;
    w.o_r[j] = o_r * fix_o;
  }
}

ROTORDROP_WIDE_VECTORS
double step_double(const Row<double>& row, double enough, InertialBalls& w) {
  double n_left = 0;
#pragma omp simd reduction(+ : n_left)
  for (std::size_t j = 0; j < w.n; ++j) {
    Ball<double> b{w.u_i[j], w.u_o[j], w.i_x[j], w.i_r[j], w.o_x[j], w.o_r[j]};
    const double left = step<double>(row, b, w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j]);
    n_left += left <= enough ? 0 : 1;
    w.u_i[j] = b.u_i;
    w.u_o[j] = b.u_o;
    w.i_x[j] = b.i_x;
    w.i_r[j] = b.i_r;
    w.o_x[j] = b.o_x;
    w.o_r[j] = b.o_r;
  }
  return n_left;
}

/// A ball that the inner race does not reach lies in the bottom of the outer groove. Its orbit speed has the direction of the inner race's
/// groove, as that of a loaded one, so that nothing jumps when they part.
struct Bottom {
  double u, i_x, i_r;
  bool is_free;
};
Bottom lie_down(const InertialRow& row, double F_0, double B_x, double B_r, double added_i, double added_o) {
  Bottom b{0., 0., 1., true};
  double F = 0.25 * F_0 * (1. - row.g) * (1. - row.g), length = row.l_i;
  for (int round = 0; round < 5; ++round) {
    b.u = std::cbrt(F);
    const double v_r = B_r - (row.l_o + row.c_o * b.u * b.u - added_o);
    length = std::max(std::sqrt(B_x * B_x + v_r * v_r), 1e-9);
    b.i_x = B_x / length;
    b.i_r = v_r / length;
    const double ratio = (1. - row.g * b.i_r) / std::max(1. + b.i_r, 1e-3);
    F = F_0 * ratio * ratio;
  }
  b.is_free = length < row.l_i - added_i;
  return b;
}

/// Balls that the inner race may not reach; the others surely are.
ROTORDROP_WIDE_VECTORS
double count_suspects(const InertialRow& row, double bottom, InertialBalls& w) {
  double count = 0;
#pragma omp simd reduction(+ : count)
  for (std::size_t j = 0; j < w.n; ++j) {
    const double v_r = w.B_r[j] - row.l_o - bottom + w.added_o[j], reach = row.l_i - w.added_i[j] + bottom;
    const double is_suspect = w.B_x[j] * w.B_x[j] + v_r * v_r < reach * reach ? 1. : 0.;
    w.is_free[j] = std::max(is_suspect, 1. - w.is_ball[j]);
    count += w.is_free[j];
  }
  return count;
}

/// The careful law for one ball; where contacts carry next to nothing, the vectors' start is too far off now and then.
void balance_one(const InertialRow& row, double F_0, std::size_t j, InertialBalls& w) {
  const BallContacts contacts{1. / (row.c_i * std::sqrt(row.c_i)),
                              1. / (row.c_o * std::sqrt(row.c_o)),
                              row.l_i - w.added_i[j],
                              row.l_o - w.added_o[j],
                              2. * F_0,
                              row.g,
                              1.};
  const BallBalance b = ball_balance(contacts, w.B_x[j], w.B_r[j], 0., 1.);
  w.u_i[j] = std::cbrt(b.load_i);
  w.u_o[j] = std::cbrt(b.load_o);
  w.i_x[j] = b.sin_i;
  w.i_r[j] = b.cos_i;
  w.o_x[j] = b.sin_o;
  w.o_r[j] = b.cos_o;
}

ROTORDROP_WIDE_VECTORS
void inertia_forces(const InertialRow& row, double F_0, InertialBalls& w) {
#pragma omp simd
  for (std::size_t j = 0; j < w.n; ++j) {
    const double ratio = (1. - row.g * w.i_r[j]) / (1. + w.i_x[j] * w.o_x[j] + w.i_r[j] * w.o_r[j]);
    w.F[j] = F_0 * ratio * ratio;
  }
}

}  // namespace

void balance_balls(const InertialRow& row, double F_0, InertialBalls& w) {
  const double u_bottom = std::cbrt(0.25 * F_0 * (1. - row.g) * (1. - row.g)), bottom = row.c_o * u_bottom * u_bottom;
  const bool has_suspects = count_suspects(row, bottom, w) > 0.;
  // Free balls, and those that only fill up the row, stand aside on a place with plain answers until the others are done.
  InertialBalls::Array B_x, B_r;
  std::array<Bottom, InertialBalls::capacity> lying;
  if (has_suspects)
    for (std::size_t j = 0; j < w.n; ++j) {
      if (w.is_free[j] == 0.) continue;
      if (w.is_ball[j] != 0.) {
        lying[j] = lie_down(row, F_0, w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j]);
        if (!lying[j].is_free) w.is_free[j] = 0.;
        if (!lying[j].is_free) continue;
      }
      B_x[j] = w.B_x[j];
      B_r[j] = w.B_r[j];
      w.B_x[j] = 0.3 * (row.l_i + row.l_o);
      w.B_r[j] = row.l_i + row.l_o + bottom;
    }

  const double soft = row.c_i + row.c_o, series = 1. / (soft * std::sqrt(soft));
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const Row<float> single{to_float(row.c_i), to_float(row.c_o), to_float(row.l_i),
                          to_float(row.l_o), to_float(row.g),   to_float(F_0)};
  const Row<double> whole{row.c_i, row.c_o, row.l_i, row.l_o, row.g, F_0};
  Single f;
  start_all(single, to_float(series), w.n, w, f);
  // Newton's method squares what is left at each step.
  for (int k = 0; k < 12; ++k)
    if (step_single(single, w.n, 3e-3f, f) == 0.f) break;
  widen(w.n, f, w);
  double n_left = 1.;
  for (w.steps = 0; w.steps < 8 && n_left > 0.; ++w.steps) n_left = step_double(whole, 2e-5, w);
  w.is_by_scalar_law = n_left > 0.;
  if (w.is_by_scalar_law)
    for (std::size_t j = 0; j < w.n; ++j) balance_one(row, F_0, j, w);

  if (has_suspects)
    for (std::size_t j = 0; j < w.n; ++j) {
      if (w.is_free[j] == 0. || w.is_ball[j] == 0.) continue;
      w.B_x[j] = B_x[j];
      w.B_r[j] = B_r[j];
      w.u_i[j] = 0.;
      w.u_o[j] = lying[j].u;
      w.i_x[j] = lying[j].i_x;
      w.i_r[j] = lying[j].i_r;
      w.o_x[j] = 0.;
      w.o_r[j] = 1.;
    }
  inertia_forces(row, F_0, w);
}

ROTORDROP_WIDE_VECTORS
BallWork inertia_work(const InertialRow& constants, double F_0, const InertialBalls& w, const BallMotion& motion) {
  const Row<double> row{constants.c_i, constants.c_o, constants.l_i, constants.l_o, constants.g, F_0};
  double power = 0., per_radial = 0., per_ball_growth = 0., per_force = 0.;
#pragma omp simd reduction(+ : power, per_radial, per_ball_growth, per_force)
  for (std::size_t j = 0; j < w.n; ++j) {
    const Ball<double> b{w.u_i[j], w.u_o[j], w.i_x[j], w.i_r[j], w.o_x[j], w.o_r[j]};
    const double L_o = row.l_o + row.c_o * b.u_o * b.u_o - w.added_o[j];
    const double L_i = (w.B_x[j] - L_o * b.o_x) * b.i_x + (w.B_r[j] - L_o * b.o_r) * b.i_r;
    const System<double> s(row, b, L_i, w.added_o[j]);
    const double f_n = s.F * s.h_n, f_t = s.F * s.h_t;
    // Work per unit of what opens the geometry (along and across the inner normal) and of what grows at the outer contact.
    const auto work = [&](double gap_n, double gap_t, double force_n, double force_t, double outer) {
      double a, x;
      s.solve(gap_n, gap_t, force_n, force_t, a, x);
      return w.is_ball[j] * (f_n * (x - outer) + f_t * s.L_o * a);
    };
    const double x = motion.B_x_rate[j], r = motion.B_r_rate[j], o = motion.added_o_rate[j];
    power += work(x * b.i_x + r * b.i_r + o * s.c + motion.added_i_rate[j], x * b.i_r - r * b.i_x - o * s.s, 0., 0., o);
    per_radial += work(b.i_r, -b.i_x, 0., 0., 0.);
    per_ball_growth += work(1. + s.c, -s.s, 0., 0., 1.);
    per_force += work(0., 0., f_n, f_t, 0.);
  }
  return {power, per_radial, per_ball_growth, per_force};
}

}  // namespace rotordrop
