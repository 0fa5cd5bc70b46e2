#include "bearing/row/inertial_balls.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/real.h"
#include "base/wide_vectors.h"
#include "laws/ball_balance.h"

// Loops over the balls of a row, compiled for several kinds of machine as those of ball_row_kernels.cpp are.
namespace rotordrop {
namespace {

// By value: references to temporaries keep the compiler from making vectors.
ROTORDROP_KERNEL double limited(double value, double low, double high) {
  const double above = value > low ? value : low;
  return above < high ? above : high;
}

struct Row {
  double K_i, K_o, l_i, l_o, g, F_0;
  double k;  // 0.4 sigma
  Row(const InertialRow& r, double force)
      : K_i(1. / (r.c_i * std::sqrt(r.c_i))),
        K_o(1. / (r.c_o * std::sqrt(r.c_o))),
        l_i(r.l_i),
        l_o(r.l_o),
        g(r.g),
        F_0(force),
        k(0.4 * r.inner_gyroscopic_share) {}
};

/// The ball's centre: deflection of the outer contact, outer normal.
struct Place {
  double delta_o, x, r;
};
struct Surroundings {
  double B_x, B_r, added_i, added_o;
};

/// Turns a unit vector by about an angle; its length stays one to the digits when the angle is small, and comes back to one later when it is not.
struct Normal {
  double x, r;
};
ROTORDROP_KERNEL Normal turned(double angle, double x, double r) {
  const double a2 = angle * angle, shrink = 1. - a2 * (0.5 - 0.375 * a2);
  const double new_x = (x + angle * r) * shrink, new_r = (r - angle * x) * shrink;
  const double fix = 1.5 - 0.5 * (new_x * new_x + new_r * new_r);
  return {new_x * fix, new_r * fix};
}

/// What acts on a ball along (n) and across (t) the outer normal, and how that changes as the outer normal turns (a) and the outer length
/// grows (x).
/// @tparam is_split  part of the gyroscopic traction acts at the inner race
template <bool is_split>
struct Balance {
  double L_o, delta_i, Q_i, Q_o, S_i, S_o, i_x, i_r, c, s, by_L_i;
  double F, f_i, f_o, f_a, f_x;  // and its relative change with the inner and the outer angle, and with turn and length
  double h_n, h_t, force_n, force_t;
  double angle_a, angle_x;  // of the inner contact
  double R_n_a, R_t_a, R_n_x, R_t_x, inverse_det;

  ROTORDROP_KERNEL Balance(const Row& row, const Place& p, const Surroundings& at) {
    L_o = row.l_o + p.delta_o - at.added_o;
    const double v_x = at.B_x - L_o * p.x, v_r = at.B_r - L_o * p.r, v_n = v_x * p.x + v_r * p.r,
                 v_t = v_x * p.r - v_r * p.x, square = v_x * v_x + v_r * v_r + 1e-18, L_i = std::sqrt(square);
    by_L_i = L_i * (1. / square);  // does not wait for the root
    delta_i = L_i - row.l_i + at.added_i;
    i_x = v_x * by_L_i;
    i_r = v_r * by_L_i;
    c = v_n * by_L_i;
    s = v_t * by_L_i;
    // Both of the ratio are L_i times as large, and need not wait for the normal.
    const double above = L_i - row.g * v_r, by_below = 1. / larger(L_i + v_n, 1e-3 * L_i), ratio = above * by_below;
    F = row.F_0 * ratio * ratio;
    f_o = -2. * v_t * by_below;
    f_i = 2. * row.g * v_x / above - f_o;

    const double reached = larger(delta_i, 0.), root_i = std::sqrt(reached), root_o = std::sqrt(p.delta_o);
    S_i = 1.5 * row.K_i * root_i;
    S_o = 1.5 * row.K_o * root_o;
    Q_i = row.K_i * root_i * reached;
    Q_o = row.K_o * root_o * p.delta_o;
    h_n = p.r;
    h_t = -1.4 * p.x;
    if constexpr (is_split) {
      h_n -= row.k * p.x * s;
      h_t += row.k * p.x * (1. + c);
    }
    force_n = Q_i * c - Q_o + F * h_n;
    force_t = Q_i * s + F * h_t;

    // The inner contact's stiffness is S_i along its normal and Q_i / L_i across it.
    const double across = Q_i * by_L_i, more_c = (S_i - across) * c;
    const double K_nn = across + more_c * c, K_nt = more_c * s, K_tt = S_i + across - K_nn;
    angle_a = -L_o * c * by_L_i;
    angle_x = s * by_L_i;
    f_a = f_i * angle_a + f_o;
    f_x = f_i * angle_x;
    // The force of inertia, F (-0.4 o_x o_r, 1 + 0.4 o_x^2), turns with the outer angle: 0.4 F (o_x n - o_r t).
    R_n_a = F * (f_a * h_n + 0.4 * p.x) - L_o * K_nt;
    R_t_a = F * (f_a * h_t - 0.4 * p.r) - (L_o * K_tt + Q_o);
    R_n_x = F * (f_x * h_n) - (K_nn + S_o);
    R_t_x = F * (f_x * h_t) - K_nt;
    if constexpr (is_split) {
      // From F (-0.4 x t) at the outer race to F (-(0.4 - k) x t + k x t_i), t_i = (i_r, -i_x) across the inner normal.
      const double T = F * row.k * p.x;
      R_n_a += F * row.k * (-p.x - p.r * s) - T * angle_a * c;
      R_t_a += F * row.k * (p.r + p.r * c) - T * angle_a * s;
      R_n_x -= T * angle_x * c;
      R_t_x -= T * angle_x * s;
    }
    inverse_det = 1. / (R_n_a * R_t_x - R_t_a * R_n_x);
  }
  /// Turn and growth of the outer length that cancel the forces.
  [[nodiscard]] ROTORDROP_KERNEL double turn() const { return (force_t * R_n_x - force_n * R_t_x) * inverse_det; }
  [[nodiscard]] ROTORDROP_KERNEL double growth() const { return (force_n * R_t_a - force_t * R_n_a) * inverse_det; }
  /// Deflection of the inner contact after them.
  [[nodiscard]] ROTORDROP_KERNEL double next_delta_i(double turn, double growth) const {
    return delta_i - L_o * s * turn - c * growth;
  }
  /// 0 if no more than `enough` of the loads is left; 1 if more is, or no number any more; or if the ball got past the inner groove's centre, where
  /// forces balance, too, under loads of no meaning.
  [[nodiscard]] ROTORDROP_KERNEL double is_left(double enough) const {
    // Without && and ||, which would keep loops from becoming vectors: past the centre nothing is enough.
    const double past = larger(-c, 0.) * Q_i, allowed = past > 0. ? -1. : enough * (Q_o + F);
    const double left = std::abs(force_n) + std::abs(force_t);
    return left <= allowed ? 0. : 1.;
  }
};

/// Between the ball without inertia and the ball in the bottom of the outer groove: the moment of its forces about the outer groove's centre
/// shares B_x out to the two normals, what remains of B_r is compression.
ROTORDROP_KERNEL Place guess(const Row& row, double c_i, double c_o, double bottom, const Surroundings& at) {
  const double distance = std::sqrt(at.B_x * at.B_x + at.B_r * at.B_r), added = at.added_i + at.added_o;
  const double delta = larger(distance - row.l_i - row.l_o + added, 0.), soft = c_i + c_o;
  const double Q = delta * std::sqrt(delta) / (soft * std::sqrt(soft));
  const double ratio = 0.5 * (1. - row.g * at.B_r / distance);
  const double F = row.F_0 * ratio * ratio;
  const double Q_guess = Q + 0.7 * F;
  const double share = Q_guess / (2. * Q_guess + 1.4 * F);
  const double o_x = limited(at.B_x * share / row.l_o, -0.95, 0.95);
  const double i_x = limited(at.B_x * (1. - share) / row.l_i, -0.95, 0.95);
  const double o_r = std::sqrt(1. - o_x * o_x), i_r = std::sqrt(1. - i_x * i_x);
  const double both = (at.B_r - row.l_o * o_r - row.l_i * i_r) * 2. / (o_r + i_r) + added;
  return {larger(both * c_o / soft, bottom), o_x, o_r};
}

ROTORDROP_KERNEL void guess_all(const Row& constants, double c_i, double c_o, double bottom, InertialBalls& w) {
  const Row row = constants;  // a copy that no store can change
#pragma omp simd
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const auto p = guess(row, c_i, c_o, bottom, {w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j]});
    w.delta_o[j] = p.delta_o;
    w.o_x[j] = p.x;
    w.o_r[j] = p.r;
  }
}

ROTORDROP_KERNEL std::uint64_t together(float delta_o, float o_x) {
  return std::bit_cast<std::uint32_t>(delta_o) | static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(o_x)) << 32;
}
ROTORDROP_KERNEL float delta_o_of(std::uint64_t place) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(place));
}
ROTORDROP_KERNEL float o_x_of(std::uint64_t place) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(place >> 32));
}

/// Places by straight lines in a table over B_r, with what adds to the deflections, which is nearly a shift of B_r.
/// @param last  the table's last entry. @return the largest entry that was asked for, of those beyond `last` too
ROTORDROP_KERNEL float look_up(const std::uint64_t* places, double first, double per_step, float last,
                               InertialBalls& w) {
  float farthest = 0.f;
#pragma omp simd simdlen(8) reduction(max : farthest)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const auto asked = static_cast<float>((w.B_r[j] + w.added_i[j] + w.added_o[j] - first) * per_step);
    farthest = asked > farthest ? asked : farthest;
    // Below the first entry balls are free, or nearly so.
    const float above = asked > 0.f ? asked : 0.f, at = above < last ? above : last;
    const auto k = static_cast<std::int32_t>(at);
    const float part = at - static_cast<float>(k);
    const std::uint64_t here = places[k], next = places[k + 1];
    const float x = o_x_of(here) + part * (o_x_of(next) - o_x_of(here));
    w.delta_o[j] = delta_o_of(here) + part * (delta_o_of(next) - delta_o_of(here));
    w.o_x[j] = x;
    w.o_r[j] = std::sqrt(1.f - x * x);
  }
  return farthest;
}

template <bool is_split>
ROTORDROP_KERNEL double step_all(const Row row, double enough, InertialBalls& w) {
  double n_left = 0.;
#pragma omp simd reduction(+ : n_left)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const Place p{w.delta_o[j], w.o_x[j], w.o_r[j]};
    const Balance<is_split> b(row, p, {w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j]});
    n_left += b.is_left(enough);
    const auto next = turned(limited(b.turn(), -0.5, 0.5), p.x, p.r);
    w.delta_o[j] = larger(p.delta_o + b.growth(), 0.1 * p.delta_o);
    w.o_x[j] = next.x;
    w.o_r[j] = next.r;
  }
  return n_left;
}

template <bool is_split>
ROTORDROP_KERNEL double finish_all(const Row row, double u_per_root_i, double enough, InertialBalls& w,
                                   BallWork& sums) {
  double n_left = 0., power = 0., per_radial = 0., per_axial = 0., per_ball_growth = 0., per_outer = 0., per_force = 0.;
#pragma omp simd reduction(+ : n_left, power, per_radial, per_axial, per_ball_growth, per_outer, per_force)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const Place p{w.delta_o[j], w.o_x[j], w.o_r[j]};
    const Balance<is_split> b(row, p, {w.B_x[j], w.B_r[j], w.added_i[j], w.added_o[j]});
    n_left += b.is_left(enough);
    const double a = b.turn(), x = b.growth();
    w.u_i[j] = u_per_root_i * std::sqrt(larger(b.next_delta_i(a, x), 0.));
    w.Q_o[j] = b.Q_o + b.S_o * x;
    w.deflection_o[j] = p.delta_o + x;
    const auto i = turned(b.angle_a * a + b.angle_x * x, b.i_x, b.i_r);
    w.i_x[j] = i.x;
    w.i_r[j] = i.r;

    // The forces of inertia and the gyroscopic tractions work on the ball's motion, the inner one on what the ring moves past it. What a force along n or t would make of it, by the transposed matrix; then what moves the
    // groove along and across the inner normal makes such forces.
    const double F = w.is_ball[j] * b.F, f_n = F * b.h_n, f_t = F * b.h_t;
    const double by_n = (f_n * b.R_t_a - f_t * b.L_o * b.R_t_x) * b.inverse_det;
    const double by_t = (f_t * b.L_o * b.R_n_x - f_n * b.R_n_a) * b.inverse_det;
    double push_n = b.F * b.f_i * b.h_n - b.Q_i * b.s, push_t = b.F * b.f_i * b.h_t + b.Q_i * b.c, T = 0.;
    if constexpr (is_split) {
      const double T_i = b.F * row.k * p.x;
      push_n -= T_i * b.c;
      push_t -= T_i * b.s;
      w.T_i[j] = T_i + row.k * b.F * ((b.f_a * a + b.f_x * x) * p.x + a * p.r);
      T = w.is_ball[j] * T_i;
    }
    const double gap_n = b.S_i * (b.c * by_n + b.s * by_t);
    const double gap_t = b.by_L_i * (push_n * by_n + push_t * by_t) - T;
    const double radial = gap_n * b.i_r - gap_t * b.i_x, axial = gap_n * b.i_x + gap_t * b.i_r;
    const double outer = gap_n * b.c - (gap_t + T) * b.s - f_n;
    power += axial * w.B_x_rate[j] + radial * w.B_r_rate[j] + gap_n * w.added_i_rate[j] + outer * w.added_o_rate[j];
    per_radial += radial;
    per_axial += axial;
    per_ball_growth += gap_n + outer;
    per_outer += outer;
    per_force += f_n * by_n + f_t * by_t;
  }
  sums = {power, per_radial, per_axial, per_ball_growth, per_outer, per_force};
  return n_left;
}

/// One step of Newton's method. @return balls that had more than `enough` left over before the step
ROTORDROP_KERNEL double step(const Row& row, double enough, InertialBalls& w) {
  return row.k != 0. ? step_all<true>(row, enough, w) : step_all<false>(row, enough, w);
}

/// The last step: what comes out of the balance, and the work. @return balls that had more than `enough` left over before it
ROTORDROP_KERNEL double finish(const Row& row, double u_per_root_i, double enough, InertialBalls& w, BallWork& sums) {
  return row.k != 0. ? finish_all<true>(row, u_per_root_i, enough, w, sums)
                     : finish_all<false>(row, u_per_root_i, enough, w, sums);
}

BallContacts contacts(const InertialRow& row, double added_i, double added_o, double force_per_speed2) {
  return {1. / (row.c_i * std::sqrt(row.c_i)),
          1. / (row.c_o * std::sqrt(row.c_o)),
          row.l_i - added_i,
          row.l_o - added_o,
          2. * force_per_speed2,
          row.g,
          1.,
          row.inner_gyroscopic_share};
}

/// The careful law for one ball; where contacts carry next to nothing, the vectors' start is too far off now and then.
void place_one(const InertialRow& row, double F_0, std::size_t j, InertialBalls& w) {
  const BallBalance b = ball_balance(contacts(row, w.added_i[j], w.added_o[j], F_0), w.B_x[j], w.B_r[j], 0., 1.);
  w.delta_o[j] = row.c_o * std::cbrt(b.load_o * b.load_o);
  w.o_x[j] = b.sin_o;
  w.o_r[j] = b.cos_o;
}

}  // namespace

InertialStarts::InertialStarts(const InertialRow& row, double B_x, double B_r, double force_per_speed2)
    : first_radius_(B_r - reach), force_per_speed2_(force_per_speed2), places_(n_speeds * n_radii) {
  // At some speeds by the balance; centrifugal forces go with the square of the speed, so a parabola through three of them tells the speeds between.
  constexpr std::size_t n_known = 33, between = (n_speeds + n_known - 3) / (n_known - 2);
  std::vector<std::array<double, n_radii>> delta_o(n_known), o_x(n_known);
  InertialBalls w;
  w.n = n_radii;
  for (auto* zero : {&w.added_i, &w.added_o, &w.B_x_rate, &w.B_r_rate, &w.added_i_rate, &w.added_o_rate})
    zero->fill(0.);
  w.is_ball.fill(1.);
  w.B_x.fill(B_x);
  for (std::size_t j = 0; j < n_radii; ++j) w.B_r[j] = first_radius_ + radius_step * static_cast<double>(j);
  for (std::size_t s = 0; s < n_known; ++s) {
    const double speed = std::max(speed_step * static_cast<double>(s * between), 1.);
    balance_balls(row, force_per_speed2 * speed * speed, w);
    std::copy_n(w.delta_o.begin(), n_radii, delta_o[s].begin());
    std::copy_n(w.o_x.begin(), n_radii, o_x[s].begin());
  }
  for (std::size_t s = 0; s < n_speeds; ++s) {
    const std::size_t k = std::min(s / between, n_known - 3);
    const double part = static_cast<double>(s) / static_cast<double>(between) - static_cast<double>(k);
    const double w_0 = 0.5 * (1. - part) * (2. - part), w_1 = part * (2. - part), w_2 = 0.5 * part * (part - 1.);
    const auto at = [&](const std::vector<std::array<double, n_radii>>& of, std::size_t j) {
      return static_cast<float>(w_0 * of[k][j] + w_1 * of[k + 1][j] + w_2 * of[k + 2][j]);
    };
    for (std::size_t j = 0; j < n_radii; ++j) places_[s * n_radii + j] = together(at(delta_o, j), at(o_x, j));
  }
}

bool InertialStarts::place(double F_0, InertialBalls& balls) const {
  const double speed = std::sqrt(F_0 / force_per_speed2_) * (1. / speed_step) + 0.5;
  if (!(speed < static_cast<double>(n_speeds))) return false;
  const Place* places = &places_[static_cast<std::size_t>(speed) * n_radii];
  constexpr float last = n_radii - 1.001f;
  return wide<look_up>(places, first_radius_, 1. / radius_step, last, balls) <= last;
}

BallWork balance_balls(const InertialRow& constants, double F_0, InertialBalls& w, const InertialStarts* starts) {
  const Row row(constants, F_0);
  if (!(starts && starts->place(F_0, w))) {
    const double least = 0.5 * constants.c_o * std::cbrt(0.0625 * F_0 * F_0);
    wide<guess_all>(row, constants.c_i, constants.c_o, least, w);
  }
  // Newton's method squares what is left at each step.
  constexpr double nearly = 6e-3, enough = 2e-5;
  constexpr int most = 20;
  w.steps = 1;
  while (wide<step>(row, nearly, w) > 0. && w.steps < most) ++w.steps;
  BallWork work;
  const double u_per_root_i = 1. / std::sqrt(constants.c_i);
  const auto is_left = [&] {
    ++w.steps;
    return wide<finish>(row, u_per_root_i, enough, w, work) > 0.;
  };
  bool has_more = is_left();
  while (has_more && w.steps < most) {
    wide<step>(row, enough, w);
    has_more = is_left();
  }
  w.is_by_scalar_law = has_more;
  if (has_more) {
    for (std::size_t j = 0; j < w.n; ++j) place_one(constants, F_0, j, w);
    wide<finish>(row, u_per_root_i, enough, w, work);
  }
  return work;
}

}  // namespace rotordrop
