#include "bearing/row/inertial_balls.h"

#include <algorithm>
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

/// Places by straight lines in a table over B_r, from its first to its last entry.
ROTORDROP_KERNEL void look_up(const float* delta_o, const float* o_x, double first, double per_step, double last,
                              InertialBalls& w) {
#pragma omp simd simdlen(8)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const auto at = static_cast<float>(limited((w.B_r[j] + w.added_i[j] + w.added_o[j] - first) * per_step, 0., last));
    const auto k = static_cast<std::int32_t>(at);
    const float part = at - static_cast<float>(k);
    const float x = o_x[k] + part * (o_x[k + 1] - o_x[k]);
    w.delta_o[j] = delta_o[k] + part * (delta_o[k + 1] - delta_o[k]);
    w.o_x[j] = x;
    w.o_r[j] = std::sqrt(1.f - x * x);
  }
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

/// Least and largest B_r of a row, with what adds to the deflections, which is nearly a shift of B_r.
struct Reach {
  double least, largest;
};
ROTORDROP_KERNEL Reach reach(const InertialBalls& w) {
  double least = 1e300, largest = -1e300;
#pragma omp simd reduction(min : least) reduction(max : largest)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const double radius = w.B_r[j] + w.added_i[j] + w.added_o[j];
    least = std::min(least, radius);
    largest = std::max(largest, radius);
  }
  return {least, largest};
}

/// Between three tables one step apart, by a parabola: centrifugal forces go with the square of the speed.
ROTORDROP_KERNEL void blend(const float* t_0, const float* t_1, const float* t_2, float part, std::size_t first,
                            std::size_t last, float* out) {
  const float w_0 = 0.5f * (1.f - part) * (2.f - part), w_1 = part * (2.f - part), w_2 = 0.5f * part * (part - 1.f);
#pragma omp simd simdlen(8)
  for (std::size_t k = whole_vectors(first); k < whole_vectors(last); ++k)
    out[k] = w_0 * t_0[k] + w_1 * t_1[k] + w_2 * t_2[k];
}

/// Places from the row's table. @return false if the table does not have them
bool start_from(const InertialStarts& starts, double F_0, InertialBalls& w) {
  const auto [least, largest] = wide<reach>(w);
  const double per_step = 1. / starts.radius_step(), end = static_cast<double>(InertialStarts::n_radii) - 1.001;
  const double low = (least - starts.first_radius()) * per_step, high = (largest - starts.first_radius()) * per_step;
  // Below the first entry balls are free, or nearly so.
  if (!(high <= end && low <= end)) return false;
  const auto entry = [&](double at) { return static_cast<std::size_t>(std::max(at, 0.)); };
  InertialStarts::Table table;
  if (!starts.at_speed(F_0, entry(low) / 8 * 8, (entry(high) + 2 + 7) / 8 * 8, table)) return false;
  wide<look_up>(table[0].data(), table[1].data(), starts.first_radius(), per_step, end, w);
  return true;
}

}  // namespace

InertialStarts::InertialStarts(const InertialRow& row, double B_x, double B_r, double force_per_speed2)
    : force_per_speed2_(force_per_speed2) {
  // 50 um to either side, more than rings move in their balls; speeds to 2500 rad/s. Beyond, the closed guess serves.
  const double reach = 50e-6;
  radius_step_ = 2. * reach / static_cast<double>(n_radii - 1);
  first_radius_ = B_r - reach;
  speed_step_ = 2500. / static_cast<double>(n_speeds - 1);
  const auto ball = contacts(row, 0., 0., force_per_speed2);
  for (std::size_t s = 0; s < n_speeds; ++s)
    for (std::size_t k = 0; k < n_radii; ++k) {
      const double speed = std::max(speed_step_ * static_cast<double>(s), 1.);
      const BallBalance b = ball_balance(ball, B_x, first_radius_ + radius_step_ * static_cast<double>(k), 0., speed);
      tables_[s][0][k] = static_cast<float>(row.c_o * std::cbrt(b.load_o * b.load_o));
      tables_[s][1][k] = static_cast<float>(b.sin_o);
    }
}

bool InertialStarts::at_speed(double F_0, std::size_t first, std::size_t last, Table& places) const {
  const double at = std::sqrt(F_0 / force_per_speed2_) / speed_step_;
  if (!(at < static_cast<double>(n_speeds - 2))) return false;
  const auto s = static_cast<std::size_t>(at);
  for (std::size_t q = 0; q < 2; ++q)
    wide<blend>(tables_[s][q].data(), tables_[s + 1][q].data(), tables_[s + 2][q].data(),
                static_cast<float>(at - static_cast<double>(s)), first, last, places[q].data());
  return true;
}

BallWork balance_balls(const InertialRow& constants, double F_0, InertialBalls& w, const InertialStarts* starts) {
  const Row row(constants, F_0);
  if (!(starts && start_from(*starts, F_0, w))) {
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
