#include "bearing/inertial_balls.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/wide_vectors.h"
#include "laws/ball_balance.h"

// Loops over the balls of a row, compiled for several kinds of machine as the row kernels of ball_row.cpp are. Bodies are inlined templates, so
// that single and double precision share them.
#define ROTORDROP_INLINE inline __attribute__((always_inline))

namespace rotordrop {
namespace {

// By value: references to temporaries keep the compiler from making vectors.
template <class Real>
ROTORDROP_INLINE Real larger(Real a, Real b) {
  return a > b ? a : b;
}
template <class Real>
ROTORDROP_INLINE Real limited(Real value, Real low, Real high) {
  const Real above = value > low ? value : low;
  return above < high ? above : high;
}

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
  const auto bits = static_cast<float>(__builtin_bit_cast(std::int32_t, x));
  float y = __builtin_bit_cast(float, static_cast<std::int32_t>(bits * (1.f / 3.f) + 709921077.f));
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
  Real S_i, F_by_i, inverse_L_i, inverse_u_i, inverse_u_o;
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
    // Five divisions in one.
    const Real angles = below * above, loads = b.u_i * b.u_o;
    const Real inverse = one / (L_i * angles * loads);
    inverse_L_i = inverse * angles * loads;
    const Real by_angles = inverse * L_i * loads;
    const Real inverse_below = by_angles * above, inverse_above = by_angles * below;
    const Real by_loads = inverse * L_i * angles;
    inverse_u_i = by_loads * b.u_o;
    inverse_u_o = by_loads * b.u_i;
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

/// Turns a unit vector by about an angle; its length stays one to the digits when the angle is small, and comes back to one later when it is not.
template <class Real>
struct Normal {
  Real x, r;
};
template <class Real>
ROTORDROP_INLINE Normal<Real> turned(Real angle, Real x, Real r) {
  const Real a2 = angle * angle, shrink = Real(1) - a2 * (Real(0.5) - Real(0.375) * a2);
  const Real new_x = (x + angle * r) * shrink, new_r = (r - angle * x) * shrink;
  const Real fix = Real(1.5) - Real(0.5) * (new_x * new_x + new_r * new_r);
  return {new_x * fix, new_r * fix};
}

/// One Newton step; positive if more than `enough` of the loads was left before it.
template <class Real>
ROTORDROP_INLINE Real step(const Row<Real>& row, Ball<Real>& b, Real B_x, Real B_r, Real added_i, Real added_o,
                           Real enough) {
  const Real half = Real(0.5);
  const System<Real> s(row, b, row.l_i + row.c_i * b.u_i * b.u_i - added_i, added_o);
  const Real gap_x = B_x - s.L_o * b.o_x - s.L_i * b.i_x, gap_r = B_r - s.L_o * b.o_r - s.L_i * b.i_r;
  const Real gap_n = gap_x * b.i_x + gap_r * b.i_r, gap_t = gap_x * b.i_r - gap_r * b.i_x;
  const Real force_n = s.Q_i * s.c - s.Q_o + s.F * s.h_n, force_t = s.Q_i * s.s + s.F * s.h_t;
  Real a, x;
  s.solve(gap_n, gap_t, force_n, force_t, a, x);
  const Real turn = gap_t * s.inverse_L_i + s.angle_a * a + s.angle_x * x;
  const Real stretch = gap_n - s.L_o * s.s * a - s.c * x;
  const Real du_o = x * half / row.c_o * s.inverse_u_o, du_i = stretch * half / row.c_i * s.inverse_u_i;
  const Real left =
      std::abs(force_n) + std::abs(force_t) + s.S_i * (std::abs(gap_n)) + s.Q_i * std::abs(gap_t) * s.inverse_L_i;
  const Real load = s.Q_o + s.F;
  b.u_o = larger(b.u_o + du_o, Real(0.3) * b.u_o);
  b.u_i = larger(b.u_i + du_i, Real(0.2) * b.u_i);
  const auto o = turned(limited(a, -half, half), b.o_x, b.o_r), i = turned(limited(turn, -half, half), b.i_x, b.i_r);
  b.o_x = o.x;
  b.o_r = o.r;
  b.i_x = i.x;
  b.i_r = i.r;
  return left - enough * load;
}

/// Between the ball without inertia and the ball in the bottom of the outer groove: the moment of its forces about the outer groove's centre
/// shares B_x out to the two normals, what remains of B_r is compression.
template <class Real>
ROTORDROP_INLINE Ball<Real> start(const Row<Real>& row, Real B_x, Real B_r, Real added, Real series) {
  const Real one = 1, small = Real(1e-12);
  const Real distance = std::sqrt(B_x * B_x + B_r * B_r);
  const Real delta = larger<Real>(distance - row.l_i - row.l_o + added, Real(0));
  const Real Q = series * delta * std::sqrt(delta);
  const Real ratio = Real(0.5) * (one - row.g * B_r / distance);
  const Real F = row.F_0 * ratio * ratio;
  const Real Q_guess = Q + Real(0.7) * F;
  const Real share = Q_guess / (2 * Q_guess + Real(1.4) * F);
  Ball<Real> b;
  b.o_x = limited(B_x * share / row.l_o, Real(-0.95), Real(0.95));
  b.i_x = limited(B_x * (one - share) / row.l_i, Real(-0.95), Real(0.95));
  b.o_r = std::sqrt(one - b.o_x * b.o_x);
  b.i_r = std::sqrt(one - b.i_x * b.i_x);
  const Real both = larger<Real>((B_r - row.l_o * b.o_r - row.l_i * b.i_r) * 2 / (b.o_r + b.i_r) + added, small);
  const Real mean = both / (row.c_i + row.c_o);
  const Real q = mean * std::sqrt(mean);
  const Real Q_i = larger<Real>(q - Real(0.5) * F * b.o_r, Real(0.02) * F + Real(0.05) * q);
  b.u_o = rough_cubic_root(Q_i + F * b.o_r);
  b.u_i = larger<Real>(rough_cubic_root(Q_i), Real(1e-3) * b.u_o + Real(1e-9));
  return b;
}

struct Single {
  static constexpr std::size_t capacity = InertialBalls::capacity;
  using Array = std::array<float, capacity>;
  Single() {}
  alignas(64) Array B_x, B_r, added_i, added_o, u_i, u_o, i_x, i_r, o_x, o_r;
};

// Filled up to whole vectors of single precision with copies of the last ball.
std::size_t narrow(const InertialBalls& w, Single& f) {
  const std::size_t n = (w.n + 15) / 16 * 16;
  for (std::size_t j = 0; j < w.n; ++j) {
    f.B_x[j] = static_cast<float>(w.B_x[j]);
    f.B_r[j] = static_cast<float>(w.B_r[j]);
    f.added_i[j] = static_cast<float>(w.added_i[j]);
    f.added_o[j] = static_cast<float>(w.added_o[j]);
  }
  for (std::size_t j = w.n; j < n; ++j) {
    f.B_x[j] = f.B_x[w.n - 1];
    f.B_r[j] = f.B_r[w.n - 1];
    f.added_i[j] = f.added_i[w.n - 1];
    f.added_o[j] = f.added_o[w.n - 1];
  }
  return n;
}

ROTORDROP_WIDE_VECTORS
void start_all(const Row<float>& constants, float series, std::size_t n, Single& f) {
  const Row<float> row = constants;  // a copy that no store can change
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) {
    const auto b = start<float>(row, f.B_x[j], f.B_r[j], f.added_i[j] + f.added_o[j], series);
    f.u_i[j] = b.u_i;
    f.u_o[j] = b.u_o;
    f.i_x[j] = b.i_x;
    f.i_r[j] = b.i_r;
    f.o_x[j] = b.o_x;
    f.o_r[j] = b.o_r;
  }
}

/// As start_all, by straight lines in a table over B_r. @return balls beyond its ends
ROTORDROP_WIDE_VECTORS
float look_up(const float* u_i, const float* u_o, const float* i_x, const float* o_x, float first, float per_step,
              float last, std::size_t n, Single& f) {
  float n_beyond = 0;
#pragma omp simd reduction(+ : n_beyond)
  for (std::size_t j = 0; j < n; ++j) {
    // What adds to the deflections is nearly a shift of B_r.
    const float at = (f.B_r[j] + f.added_i[j] + f.added_o[j] - first) * per_step;
    const float inside = limited(at, 0.f, last);
    n_beyond += at == inside ? 0.f : 1.f;
    const auto k = static_cast<std::int32_t>(inside);
    const float part = inside - static_cast<float>(k);
    f.u_i[j] = u_i[k] + part * (u_i[k + 1] - u_i[k]);
    f.u_o[j] = u_o[k] + part * (u_o[k + 1] - u_o[k]);
    const float x_i = i_x[k] + part * (i_x[k + 1] - i_x[k]), x_o = o_x[k] + part * (o_x[k + 1] - o_x[k]);
    f.i_x[j] = x_i;
    f.o_x[j] = x_o;
    f.i_r[j] = std::sqrt(1.f - x_i * x_i);
    f.o_r[j] = std::sqrt(1.f - x_o * x_o);
  }
  return n_beyond;
}

/// @return balls that had more than `enough` left over before the step (or no number any more)
ROTORDROP_WIDE_VECTORS
float step_single(const Row<float>& constants, std::size_t n, float enough, Single& f) {
  const Row<float> row = constants;
  float n_left = 0;
#pragma omp simd reduction(+ : n_left)
  for (std::size_t j = 0; j < n; ++j) {
    Ball<float> b{f.u_i[j], f.u_o[j], f.i_x[j], f.i_r[j], f.o_x[j], f.o_r[j]};
    const float left = step<float>(row, b, f.B_x[j], f.B_r[j], f.added_i[j], f.added_o[j], enough);
    n_left += left <= 0.f ? 0.f : 1.f;
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
double step_double(const Row<double>& constants, double enough, InertialBalls& w) {
  const Row<double> row = constants;
  double n_left = 0;
#pragma omp simd reduction(+ : n_left)
  for (std::size_t j = 0; j < w.n; ++j) {
    Ball<double> b{w.u_i[j], w.u_o[j], w.i_x[j], w.i_r[j], w.o_x[j], w.o_r[j]};
    const double left = step<double>(row, b, w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j], enough);
    n_left += left <= 0. ? 0. : 1.;
    w.u_i[j] = b.u_i;
    w.u_o[j] = b.u_o;
    w.i_x[j] = b.i_x;
    w.i_r[j] = b.i_r;
    w.o_x[j] = b.o_x;
    w.o_r[j] = b.o_r;
  }
  return n_left;
}

struct Bottoms {
  Bottoms() {}
  alignas(64) InertialBalls::Array u, i_x, i_r, is_free;
};

/// Balls that the inner race does not reach lie in the bottom of the outer groove. Their orbit speed has the direction of the inner race's
/// groove, as that of loaded ones, so that nothing jumps when they part.
ROTORDROP_WIDE_VECTORS
void lie_down(const InertialRow& constants, double F_0, const InertialBalls& w, Bottoms& b) {
  const InertialRow row = constants;
  const double root_F_0 = std::cbrt(F_0);
  std::fill_n(b.i_x.begin(), w.n, 0.);
  std::fill_n(b.i_r.begin(), w.n, 1.);
  std::fill_n(b.u.begin(), w.n, root_F_0 * std::cbrt(0.25 * (1. - row.g) * (1. - row.g)));
  double* const bu = b.u.data();
  double* const bx = b.i_x.data();
  double* const br = b.i_r.data();
  double* const bf = b.is_free.data();
  for (int round = 0; round < 3; ++round)
#pragma omp simd
    for (std::size_t j = 0; j < w.n; ++j) {
      const double v_x = w.B_x[j], v_r = w.B_r[j] - (row.l_o + row.c_o * bu[j] * bu[j] - w.added_o[j]);
      const double length = std::sqrt(v_x * v_x + v_r * v_r) + 1e-12, inverse = 1. / length;
      bx[j] = v_x * inverse;
      br[j] = v_r * inverse;
      const double ratio = (1. - row.g * br[j]) / larger(1. + br[j], 1e-3), F = F_0 * ratio * ratio;
      // One step towards the cubic root of F from the last round's; together they converge.
      const double u = bu[j], cube = u * u * u;
      bu[j] = u * (cube + 2. * F) / (2. * cube + F);
      bf[j] = length < row.l_i - w.added_i[j] ? 1. : 0.;
    }
}

/// Balls that the inner race may not reach; the others surely are.
ROTORDROP_WIDE_VECTORS
double count_suspects(const InertialRow& row, double bottom, InertialBalls& w) {
  double count = 0;
#pragma omp simd reduction(+ : count)
  for (std::size_t j = 0; j < w.n; ++j) {
    const double v_r = w.B_r[j] - row.l_o - bottom + w.added_o[j], reach = row.l_i - w.added_i[j] + bottom;
    const double is_suspect = w.B_x[j] * w.B_x[j] + v_r * v_r < reach * reach ? 1. : 0.;
    w.is_free[j] = is_suspect;
    count += is_suspect;
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

InertialStarts::InertialStarts(const InertialRow& row, double B_x, double B_r, double force_per_speed2)
    : force_per_speed2_(force_per_speed2) {
  // 50 um to either side, more than rings move in their balls; speeds to 2500 rad/s. Beyond, the closed guess serves.
  const double reach = 50e-6;
  radius_step_ = 2. * reach / static_cast<double>(n_radii - 1);
  first_radius_ = B_r - reach;
  speed_step_ = 2500. / static_cast<double>(n_speeds);
  for (std::size_t s = 0; s < n_speeds; ++s)
    for (std::size_t k = 0; k < n_radii; ++k) {
      const double speed = speed_step_ * static_cast<double>(s + 1);
      const BallContacts contacts{1. / (row.c_i * std::sqrt(row.c_i)),
                                  1. / (row.c_o * std::sqrt(row.c_o)),
                                  row.l_i,
                                  row.l_o,
                                  2. * force_per_speed2,
                                  row.g,
                                  1.};
      const BallBalance b =
          ball_balance(contacts, B_x, first_radius_ + radius_step_ * static_cast<double>(k), 0., speed);
      const double u_o = std::cbrt(b.load_o);
      const std::array<double, 4> values = {std::max(std::cbrt(b.load_i), 0.25 * u_o), u_o, b.sin_i, b.sin_o};
      for (std::size_t q = 0; q < 4; ++q) tables_[s][q][k] = static_cast<float>(values[q]);
    }
}

bool InertialStarts::column(double F_0, Table& at_speed) const {
  const double at = std::sqrt(F_0 / force_per_speed2_) / speed_step_ - 1.;
  if (!(at >= 0. && at < static_cast<double>(n_speeds - 1))) return false;
  const auto s = static_cast<std::size_t>(at);
  const auto part = static_cast<float>(at - static_cast<double>(s));
  const float *low = tables_[s][0].data(), *high = tables_[s + 1][0].data();
  float* out = at_speed[0].data();
  for (std::size_t k = 0; k < 4 * n_radii; ++k) out[k] = low[k] + part * (high[k] - low[k]);
  return true;
}

void balance_balls(const InertialRow& row, double F_0, InertialBalls& w, const InertialStarts* starts) {
  const double u_bottom = std::cbrt(0.25 * F_0 * (1. - row.g) * (1. - row.g)), bottom = row.c_o * u_bottom * u_bottom;
  const bool has_suspects = count_suspects(row, bottom, w) > 0.;
  // Free balls stand aside on a place with plain answers until the others are done.
  InertialBalls::Array B_x, B_r;
  Bottoms lying;
  if (has_suspects) {
    lie_down(row, F_0, w, lying);
    for (std::size_t j = 0; j < w.n; ++j) {
      if (w.is_free[j] == 0.) continue;
      w.is_free[j] = lying.is_free[j];
      if (w.is_free[j] == 0.) continue;
      B_x[j] = w.B_x[j];
      B_r[j] = w.B_r[j];
      w.B_x[j] = 0.3 * (row.l_i + row.l_o);
      w.B_r[j] = row.l_i + row.l_o + bottom;
    }
  }

  const double soft = row.c_i + row.c_o, series = 1. / (soft * std::sqrt(soft));
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const Row<float> single{to_float(row.c_i), to_float(row.c_o), to_float(row.l_i),
                          to_float(row.l_o), to_float(row.g),   to_float(F_0)};
  const Row<double> whole{row.c_i, row.c_o, row.l_i, row.l_o, row.g, F_0};
  Single f;
  const std::size_t n_single = narrow(w, f);
  InertialStarts::Table table;
  const bool is_near = starts && starts->column(F_0, table) &&
                       look_up(table[0].data(), table[1].data(), table[2].data(), table[3].data(),
                               to_float(starts->first_radius_), to_float(1. / starts->radius_step_),
                               static_cast<float>(InertialStarts::n_radii) - 1.001f, n_single, f) == 0.f;
  if (!is_near) start_all(single, to_float(series), n_single, f);
  // Newton's method squares what is left at each step.
  for (int k = 0; k < 9; ++k)
    if (step_single(single, n_single, 1e-2f, f) == 0.f) break;
  widen(w.n, f, w);
  double n_left = 1.;
  for (w.steps = 0; w.steps < 12 && n_left > 0.; ++w.steps) n_left = step_double(whole, 2e-5, w);
  w.is_by_scalar_law = n_left > 0.;
  if (w.is_by_scalar_law)
    for (std::size_t j = 0; j < w.n; ++j) balance_one(row, F_0, j, w);

  if (has_suspects)
    for (std::size_t j = 0; j < w.n; ++j) {
      if (w.is_free[j] == 0.) continue;
      w.B_x[j] = B_x[j];
      w.B_r[j] = B_r[j];
      w.u_i[j] = 0.;
      w.u_o[j] = lying.u[j];
      w.i_x[j] = lying.i_x[j];
      w.i_r[j] = lying.i_r[j];
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
    // The system divides by u_i, which free balls do not have; their answer does not depend on it.
    const double u_i = larger(w.u_i[j], 1e-12 * w.u_o[j]);
    const Ball<double> b{u_i, w.u_o[j], w.i_x[j], w.i_r[j], w.o_x[j], w.o_r[j]};
    const double L_o = row.l_o + row.c_o * b.u_o * b.u_o - w.added_o[j];
    const double L_i = (w.B_x[j] - L_o * b.o_x) * b.i_x + (w.B_r[j] - L_o * b.o_r) * b.i_r;
    const System<double> s(row, b, L_i, w.added_o[j]);
    const double f_n = s.F * s.h_n, f_t = s.F * s.h_t;
    // Work per unit of what opens the geometry (along and across the inner normal) and of what grows at the outer contact.
    const auto work = [&](double gap_n, double gap_t, double force_n, double force_t, double outer)
        __attribute__((always_inline)) {
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
