// Rows whose balls have inertia: the forces of BallRow from each ball's own balance.
#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row.h"
#include "bearing/row/ball_row_bending.h"
#include "laws/skidding.h"

namespace rotordrop {
namespace {

struct Place {
  const double* cosine;
  const double* sine;
  double cage_cosine, cage_sine;
  double radial, axial, arm, position;
  RingDisplacement e, v;
  Widening* bent;  // of bent rings
};

template <bool is_bent>
ROTORDROP_KERNEL void place_all(const Place& given, double cage_speed, InertialBalls& w) {
  const Place p = given;  // a copy that no store can change
  const RingDisplacement e = p.e, v = p.v;
  const double arm = p.arm, xr = p.position;
#pragma omp simd
  for (std::size_t j = 0; j < w.n; ++j) {
    const double c = p.cage_cosine * p.cosine[j] - p.cage_sine * p.sine[j];
    const double s = p.cage_sine * p.cosine[j] + p.cage_cosine * p.sine[j];
    const double y = e.y + xr * e.psi_z, z = e.z - xr * e.psi_y;
    w.B_r[j] = p.radial + y * c + z * s;
    w.B_x[j] = p.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    w.B_r_rate[j] = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s + cage_speed * (z * c - y * s);
    w.B_x_rate[j] = v.x + arm * (v.psi_y * s - v.psi_z * c + cage_speed * (e.psi_y * c + e.psi_z * s));
    if constexpr (is_bent) {
      w.B_r[j] += p.bent->width[j];
      w.B_r_rate[j] += p.bent->rate[j] + cage_speed * p.bent->slope[j];
    }
  }
}
ROTORDROP_KERNEL void place_grooves(const Place& p, double cage_speed, InertialBalls& w) {
  place_all<false>(p, cage_speed, w);
}
ROTORDROP_KERNEL void place_bent_grooves(const Place& p, double cage_speed, InertialBalls& w) {
  place_all<true>(p, cage_speed, w);
}

/// @param hardness  K^(2/3) of both contacts in series: K delta^0.5 of the ball without inertia that has the same load is hardness * u
template <bool is_split, bool is_bent>
ROTORDROP_KERNEL void sum_all(const Place& given, const InertialBalls& w, double damping, double hardness,
                              BallRowOutput& out) {
  const Place p = given;
  double fy = 0, fz = 0, fx = 0, my = 0, mz = 0, dissipated = 0, elastic_radial = 0, elastic_normal = 0, cage = 0;
  double elastic_axial = 0, elastic_outer = 0, largest = 0, largest_outer = 0;
  const RingDisplacement e = p.e, v = p.v;
  const double arm = p.arm, xr = p.position;
#pragma omp simd reduction(+ : fy, fz, fx, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, elastic_outer, cage) reduction(max : largest, largest_outer)
  for (std::size_t j = 0; j < w.n; ++j) {
    const double c = p.cage_cosine * p.cosine[j] - p.cage_sine * p.sine[j];
    const double s = p.cage_sine * p.cosine[j] + p.cage_cosine * p.sine[j];
    const double u = w.u_i[j], is_ball = w.is_ball[j];
    double r_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s;
    const double x_rate = v.x + arm * (v.psi_y * s - v.psi_z * c);
    double r_turn = (e.z - xr * e.psi_y) * c - (e.y + xr * e.psi_z) * s;
    if constexpr (is_bent) {
      r_rate += p.bent->rate[j];
      r_turn += p.bent->slope[j];
    }
    const double x_turn = arm * (e.psi_y * c + e.psi_z * s);
    const double rate = w.i_r[j] * r_rate + w.i_x[j] * x_rate;
    const double elastic = is_ball * u * u * u, Q_o = is_ball * w.Q_o[j];
    const double F = std::max(elastic + is_ball * damping * hardness * u * rate, 0.);
    double F_radial = F * w.i_r[j], F_axial = F * w.i_x[j];
    double pull_radial = elastic * w.i_r[j], pull_axial = elastic * w.i_x[j];
    if constexpr (is_split) {
      const double T = is_ball * w.T_i[j], T_radial = -T * w.i_x[j], T_axial = T * w.i_r[j];
      F_radial += T_radial;
      F_axial += T_axial;
      pull_radial += T_radial;
      pull_axial += T_axial;
    }
    if constexpr (is_bent) p.bent->force[j] = F_radial;
    fy -= F_radial * c;
    fz -= F_radial * s;
    fx -= F_axial;
    my += F_radial * xr * s - F_axial * arm * s;
    mz += F_axial * arm * c - F_radial * xr * c;
    dissipated += (F - elastic) * rate;
    elastic_radial += pull_radial;
    elastic_axial += pull_axial;
    elastic_normal += 0.5 * (elastic + Q_o);
    elastic_outer += Q_o;
    cage += pull_radial * r_turn + pull_axial * x_turn;
    largest = std::max(largest, F);
    largest_outer = std::max(largest_outer, Q_o);
  }
  out.force_x = fx;
  out.force_y = fy;
  out.force_z = fz;
  out.moment_y = my;
  out.moment_z = mz;
  out.damping_power = dissipated;
  out.elastic_radial = elastic_radial;
  out.elastic_axial = elastic_axial;
  out.elastic_normal = elastic_normal;
  out.elastic_outer_surplus = elastic_outer - elastic_normal;
  out.cage_torque = cage;
  out.largest_load = largest;
  out.largest_outer_load = largest_outer;
}

ROTORDROP_KERNEL void sum_forces(const Place& p, const InertialBalls& w, bool is_split, double damping, double hardness,
                                 BallRowOutput& out) {
  if (is_split)
    sum_all<true, false>(p, w, damping, hardness, out);
  else
    sum_all<false, false>(p, w, damping, hardness, out);
}
ROTORDROP_KERNEL void sum_bent_forces(const Place& p, const InertialBalls& w, bool is_split, double damping,
                                      double hardness, BallRowOutput& out) {
  if (is_split)
    sum_all<true, true>(p, w, damping, hardness, out);
  else
    sum_all<false, true>(p, w, damping, hardness, out);
}

/// Q^(1/3) without a branch, for vectors: Halley's iteration from Q^(1/4), to 1e-7 for loads from 0.1 N to 1 MN, 6 % at 1e-5 N.
inline double cube_root(double Q) {
  double y = 1.7 * std::sqrt(std::sqrt(Q)) + 1e-30;
  for (int i = 0; i < 3; ++i) {
    const double cube = y * y * y;
    y *= (cube + 2. * Q) / (2. * cube + Q + 1e-90);
  }
  return y;
}

ROTORDROP_KERNEL void sum_load_roots(const InertialBalls& w, BallRowOutput& out) {
  double inner_roots = 0, outer_roots = 0, inner = 0, outer = 0;
#pragma omp simd reduction(+ : inner_roots, outer_roots, inner, outer)
  for (std::size_t j = 0; j < w.n; ++j) {
    const double u = w.is_ball[j] * w.u_i[j], Q_o = w.is_ball[j] * w.Q_o[j];
    inner_roots += u;
    inner += u * u * u;
    outer_roots += cube_root(Q_o);
    outer += Q_o;
  }
  out.inner_load_roots = inner_roots;
  out.outer_load_roots = outer_roots;
  out.inner_loads = inner;
  out.outer_loads = outer;
}

}  // namespace

// Below a nano-newton the closed form of balls without inertia has the same digits; the balance would have none to work on.
double BallRow::inertia_force(const BallRowInput& in) const {
  constexpr double negligible = 1e-9;
  if (!geometry_.has_inertia) return 0.;
  const double F_0 = 0.5 * geometry_.ball_mass * geometry_.pitch_diameter * in.ring_speed * in.ring_speed;
  return F_0 > negligible ? F_0 : 0.;
}

void BallRow::place_balls(const BallRowInput& in, InertialBalls& w, Widening& bent) const {
  w.n = n_padded_;
  const auto n = static_cast<std::size_t>(geometry_.n_balls);
  std::fill_n(w.is_ball.begin(), n, 1.);
  std::fill_n(w.is_ball.begin() + geometry_.n_balls, n_padded_ - n, 0.);
  const Grooves at = numbers_.grown(in);
  std::fill_n(w.added_i.begin(), n_padded_, in.ball_growth - in.inner_strain * numbers_.strains.inner.groove);
  std::fill_n(w.added_o.begin(), n_padded_, in.ball_growth - in.outer_strain * numbers_.strains.outer.groove);
  std::fill_n(w.added_i_rate.begin(), n_padded_, 0.);
  std::fill_n(w.added_o_rate.begin(), n_padded_, 0.);
  for (const auto& wave : waves_) {
    const bool inner = wave.wave.on_inner_race;
    const double argument = wave.wave.order * (in.cage_angle - (inner ? in.ring_angle : 0.)) + wave.wave.phase;
    const double travel = wave.wave.order * (in.cage_speed - (inner ? in.ring_speed : 0.));
    const double c = wave.wave.amplitude * std::cos(argument), s = wave.wave.amplitude * std::sin(argument);
    auto& added = inner ? w.added_i : w.added_o;
    auto& rate = inner ? w.added_i_rate : w.added_o_rate;
    for (std::size_t j = 0; j < n; ++j) {
      added[j] += wave.sine[j] * c + wave.cosine[j] * s;
      rate[j] += travel * (wave.cosine[j] * c - wave.sine[j] * s);
    }
  }
  const bool is_bent = !in.shape.empty();
  if (is_bent) widen(in, bent);
  const Place place{cosine_.data(), sine_.data(),       in.cage_cosine,  in.cage_sine, at.radial, at.axial,
                    at.arm,         geometry_.position, in.displacement, in.rate,      &bent};
  is_bent ? wide<place_bent_grooves>(place, in.cage_speed, w) : wide<place_grooves>(place, in.cage_speed, w);
}

BallWork BallRow::balance(const BallRowInput& in, double F_0, InertialBalls& w, Widening& bent) const {
  place_balls(in, w, bent);
  const auto& e = in.displacement;
  const bool only_translates = e.x == 0. && e.psi_y == 0. && e.psi_z == 0.;
  return balance_balls(inertial_, F_0, w, only_translates ? starts_.get() : nullptr);
}

void BallRow::evaluate_inertial(const BallRowInput& in, double F_0, BallRowOutput& out, RowTractions* tractions) const {
  InertialBalls w;
  Widening bent;
  const BallWork work = balance(in, F_0, w, bent);
  const bool is_bent = !in.shape.empty();
  const Place place{cosine_.data(),       sine_.data(),       in.cage_cosine,  in.cage_sine, 0.,   0.,
                    numbers_.grooves.arm, geometry_.position, in.displacement, in.rate,      &bent};
  const bool is_split = geometry_.inner_gyroscopic_share != 0.;
  const double hardness = 1. / (inertial_.c_i + inertial_.c_o);
  is_bent ? wide<sum_bent_forces>(place, w, is_split, numbers_.damping, hardness, out)
          : wide<sum_forces>(place, w, is_split, numbers_.damping, hardness, out);
  if (is_bent) press_shapes(in, bent);
  out.waviness_power = 0.;
  if (!waves_.empty())
    for (std::size_t j = 0; j < static_cast<std::size_t>(geometry_.n_balls); ++j)
      out.waviness_power += w.u_i[j] * w.u_i[j] * w.u_i[j] * w.added_i_rate[j] + w.Q_o[j] * w.added_o_rate[j];

  // The forces of inertia follow no potential: what they do as the balls move is work of the prescribed motion of cage and balls. What they do as
  // parts grow belongs to the work of growth.
  out.inertia_power = work.power;
  out.inertia_per_speed = work.per_force * 2. / in.ring_speed;  // F_0 goes with the square of the speed
  out.elastic_radial += work.per_radial;
  out.elastic_axial += work.per_axial;
  out.elastic_normal += 0.5 * work.per_ball_growth;
  out.elastic_outer_surplus += work.per_outer - 0.5 * work.per_ball_growth;

  if (geometry_.conducts) wide<sum_load_roots>(w, out);

  if (!tractions) return;
  *tractions = {};
  const double F_c = numbers_.centrifugal_force(in);
  tractions->centrifugal = F_c;
  for (std::size_t j = 0; j < static_cast<std::size_t>(geometry_.n_balls); ++j) {
    const double T_g = gyroscopic_traction(F_c, w.o_x[j]);
    const double Q_i = w.u_i[j] * w.u_i[j] * w.u_i[j], share = geometry_.inner_gyroscopic_share;
    tractions->truncation = std::max({tractions->truncation, geometry_.inner.truncation(Q_i, w.i_x[j], w.i_r[j]),
                                      geometry_.outer.truncation(w.Q_o[j], w.o_x[j], w.o_r[j])});
    tractions->inner_load += Q_i;
    tractions->outer_load += w.Q_o[j];
    tractions->inner_gyroscopic += share * T_g;
    tractions->gyroscopic += (1. - share) * T_g;
    // A ball that the inner race does not reach lies in the bottom of the outer groove, where T_g is roundoff.
    const double inner_demand = Q_i > least_share_of_load * w.Q_o[j] ? share * T_g / Q_i : 0.;
    tractions->largest_gyroscopic_over_load =
        std::max({tractions->largest_gyroscopic_over_load, inner_demand, (1. - share) * T_g / w.Q_o[j]});
  }
}

}  // namespace rotordrop
