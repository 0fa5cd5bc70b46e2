// Rows whose balls have inertia: the forces of BallRow from each ball's own balance.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/real.h"
#include "base/wide_vectors.h"
#include "bearing/row/ball_row.h"
#include "bearing/row/ball_row_bending.h"
#include "bearing/row/ball_terms.h"
#include "laws/skidding.h"

namespace rotordrop {
namespace {

/// What a row's balls have in common.
struct RowOfBalls {
  std::size_t n_balls;
  double added_i, added_o;  // to the contacts' deflections
  double cage_speed;
};

/// All that is put in but the waves.
/// @tparam tilts    of a ring that moves in all five ways; one that only translates leaves out the terms of tilt and axial motion
/// @tparam is_bent  of bent rings
template <bool tilts, bool is_bent>
ROTORDROP_KERNEL void place_grooves(const RowPlaceOf<double>& given, const RowOfBalls& given_row, const double* cosine,
                                    const double* sine, const Widening* bent, InertialBalls& w) {
  const RowPlaceOf<double> p = given;  // copies that no store can change
  const auto [n_balls, added_i, added_o, cage_speed] = given_row;
  const auto &e = p.e, &v = p.v;
  auto [e_y, e_z, v_y, v_z] = at_row<tilts>(p);
  // The cage carries the balls past the grooves, too.
  v_y += cage_speed * e_z;
  v_z -= cage_speed * e_y;
  const double turn_y = v.psi_y + cage_speed * e.psi_z, turn_z = v.psi_z - cage_speed * e.psi_y;
#pragma omp simd
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const double c = cosine[j], s = sine[j];
    w.is_ball[j] = j < n_balls ? 1. : 0.;
    w.added_i[j] = added_i;
    w.added_o[j] = added_o;
    w.added_i_rate[j] = w.added_o_rate[j] = 0.;
    w.B_r[j] = p.radial + e_y * c + e_z * s;
    w.B_r_rate[j] = v_y * c + v_z * s;
    w.B_x[j] = p.axial;
    w.B_x_rate[j] = 0.;
    if constexpr (tilts) {
      w.B_x[j] += e.x + p.arm * (e.psi_y * s - e.psi_z * c);
      w.B_x_rate[j] = v.x + p.arm * (turn_y * s - turn_z * c);
    }
    if constexpr (is_bent) {
      w.B_r[j] += bent->width[j];
      w.B_r_rate[j] += bent->rate[j] + cage_speed * bent->slope[j];
    }
  }
}

/// Sums over a row's balls, kept element by element.
struct ForceSums {
  Octet fx, fy, fz, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, elastic_outer, cage, largest,
      largest_outer;
};

/// @param hardness  K^(2/3) of both contacts in series: K delta^0.5 of the ball without inertia that has the same load is hardness * u
template <bool tilts, bool is_bent, bool is_split>
ROTORDROP_KERNEL void sum_forces(const RowPlaceOf<double>& given, const double* cosine, const double* sine,
                                 const InertialBalls& w, double hardness, Widening* bent, BallRowOutput& out) {
  const RowPlaceOf<double> p = given;
  const auto &e = p.e, &v = p.v;
  const auto [e_y, e_z, v_y, v_z] = at_row<tilts>(p);
  const double damping = p.damping * hardness;
  ForceSums sum;
  const std::size_t n = whole_vectors(w.n);
  for (std::size_t first = 0; first < n; first += vector_length) {
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const std::size_t j = first + l;
      const double c = cosine[j], s = sine[j], i_r = w.i_r[j], i_x = w.i_x[j];
      const double is_ball = w.is_ball[j], u = is_ball * w.u_i[j], Q_o = is_ball * w.Q_o[j];
      double r_rate = v_y * c + v_z * s, r_turn = e_z * c - e_y * s;
      if constexpr (is_bent) {
        r_rate += bent->rate[j];
        r_turn += bent->slope[j];
      }
      double rate = i_r * r_rate;
      if constexpr (tilts) rate += i_x * (v.x + p.arm * (v.psi_y * s - v.psi_z * c));
      const double elastic = u * u * u, F = larger(elastic + damping * u * rate, 0.);
      double F_radial = F * i_r, F_axial = F * i_x, pull_radial = elastic * i_r, pull_axial = elastic * i_x;
      if constexpr (is_split) {
        const double T = is_ball * w.T_i[j];
        F_radial -= T * i_x;
        F_axial += T * i_r;
        pull_radial -= T * i_x;
        pull_axial += T * i_r;
      }
      if constexpr (is_bent) bent->force[j] = F_radial;
      sum.fy[l] -= F_radial * c;
      sum.fz[l] -= F_radial * s;
      sum.fx[l] -= F_axial;
      sum.cage[l] += pull_radial * r_turn;
      if constexpr (tilts) {
        sum.my[l] += F_radial * p.position * s - F_axial * p.arm * s;
        sum.mz[l] += F_axial * p.arm * c - F_radial * p.position * c;
        sum.cage[l] += pull_axial * p.arm * (e.psi_y * c + e.psi_z * s);
      }
      sum.dissipated[l] += (F - elastic) * rate;
      sum.elastic_radial[l] += pull_radial;
      sum.elastic_axial[l] += pull_axial;
      sum.elastic_normal[l] += elastic;
      sum.elastic_outer[l] += Q_o;
      sum.largest[l] = larger(sum.largest[l], F);
      sum.largest_outer[l] = larger(sum.largest_outer[l], Q_o);
    }
  }
  out.force_x = sum.fx.sum();
  out.force_y = sum.fy.sum();
  out.force_z = sum.fz.sum();
  out.moment_y = tilts ? sum.my.sum() : 0.;
  out.moment_z = tilts ? sum.mz.sum() : 0.;
  p.turn_back(out.force_y, out.force_z);
  if constexpr (tilts) p.turn_back(out.moment_y, out.moment_z);
  out.damping_power = sum.dissipated.sum();
  out.elastic_radial = sum.elastic_radial.sum();
  out.elastic_axial = sum.elastic_axial.sum();
  const double inner = sum.elastic_normal.sum(), outer = sum.elastic_outer.sum();
  out.elastic_normal = 0.5 * (inner + outer);
  out.elastic_outer_surplus = 0.5 * (outer - inner);
  out.inner_loads = inner;
  out.outer_loads = outer;
  out.cage_torque = sum.cage.sum();
  out.largest_load = sum.largest.largest();
  out.largest_outer_load = sum.largest_outer.largest();
}

/// Calls what(tilts, is_bent), both known to the compiler.
template <class What>
void with_motion(bool tilts, bool is_bent, const What& what) {
  using Yes = std::true_type;
  using No = std::false_type;
  if (tilts)
    is_bent ? what(Yes{}, Yes{}) : what(Yes{}, No{});
  else
    is_bent ? what(No{}, Yes{}) : what(No{}, No{});
}

ROTORDROP_KERNEL void sum_load_roots(const InertialBalls& w, double u_per_root_o, BallRowOutput& out) {
  double inner = 0, outer = 0;
#pragma omp simd reduction(+ : inner, outer)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    inner += w.is_ball[j] * w.u_i[j];
    outer += w.is_ball[j] * u_per_root_o * std::sqrt(w.deflection_o[j]);
  }
  out.inner_load_roots = inner;
  out.outer_load_roots = outer;
}

ROTORDROP_KERNEL void sum_tractions(const InertialBalls& w, const TractionInputOf<double>& with, double u_per_root_o,
                                    RowTractions& out) {
  const auto [F_c, share, edges] = with;
  double inner = 0., outer = 0., gyroscopic = 0., demand = 0., truncation = 0.;
#pragma omp simd reduction(+ : inner, outer, gyroscopic) reduction(max : demand, truncation)
  for (std::size_t j = 0; j < whole_vectors(w.n); ++j) {
    const double is_ball = w.is_ball[j], u = w.u_i[j], Q_i = u * u * u, Q_o = w.Q_o[j];
    const double T_g = is_ball * gyroscopic_traction(F_c, w.o_x[j]);
    const double inner_beyond = edges.inner.beyond(w.i_x[j], w.i_r[j], u);
    const double outer_beyond = edges.outer.beyond(w.o_x[j], w.o_r[j], u_per_root_o * std::sqrt(w.deflection_o[j]));
    inner += is_ball * Q_i;
    outer += is_ball * Q_o;
    gyroscopic += T_g;
    // A ball that the inner race does not reach lies in the bottom of the outer groove, where T_g is roundoff.
    const double inner_demand = Q_i > least_share_of_load * Q_o ? share * T_g / Q_i : 0.;
    demand = std::max(demand, std::max(inner_demand, (1. - share) * T_g / Q_o));
    truncation = std::max(truncation, is_ball * std::max(u > 0. ? inner_beyond : 0., outer_beyond));
  }
  out.inner_load = inner;
  out.outer_load = outer;
  out.gyroscopic = (1. - share) * gyroscopic;
  out.inner_gyroscopic = share * gyroscopic;
  out.largest_gyroscopic_over_load = demand;
  out.centrifugal = F_c;
  out.truncation = std::min(truncation, 1.);
}

}  // namespace

// Below a nano-newton the closed form of balls without inertia has the same digits; the balance would have none to work on.
double BallRow::inertia_force(const BallRowInput& in) const {
  constexpr double negligible = 1e-9;
  if (!geometry_.has_inertia) return 0.;
  const double F_0 = 0.5 * geometry_.ball_mass * geometry_.pitch_diameter * in.ring_speed * in.ring_speed;
  return F_0 > negligible ? F_0 : 0.;
}

void BallRow::place_balls(const BallRowInput& in, const RowPlaceOf<double>& place, bool tilts, InertialBalls& w,
                          Widening& bent) const {
  w.n = n_padded_;
  const RowOfBalls row{n_balls(), in.ball_growth - in.inner_strain * numbers_.strains.inner.groove,
                       in.ball_growth - in.outer_strain * numbers_.strains.outer.groove, in.cage_speed};
  const bool is_bent = !in.shape.empty();
  if (is_bent) widen(in, bent);
  with_motion(tilts, is_bent, [&](auto tilts_too, auto bends) {
    wide<place_grooves<tilts_too, bends>>(place, row, cosine_.data(), sine_.data(), &bent, w);
  });
  for (const auto& wave : waves_) {
    const bool inner = wave.wave.on_inner_race;
    const double argument = wave.wave.order * (in.cage_angle - (inner ? in.ring_angle : 0.)) + wave.wave.phase;
    const double travel = wave.wave.order * (in.cage_speed - (inner ? in.ring_speed : 0.));
    const double c = wave.wave.amplitude * std::cos(argument), s = wave.wave.amplitude * std::sin(argument);
    auto& added = inner ? w.added_i : w.added_o;
    auto& rate = inner ? w.added_i_rate : w.added_o_rate;
    for (std::size_t j = 0; j < n_balls(); ++j) {
      added[j] += wave.sine[j] * c + wave.cosine[j] * s;
      rate[j] += travel * (wave.cosine[j] * c - wave.sine[j] * s);
    }
  }
}

BallWork BallRow::balance(const BallRowInput& in, double F_0, const RowPlaceOf<double>& place, bool tilts,
                          InertialBalls& w, Widening& bent) const {
  place_balls(in, place, tilts, w, bent);
  const auto& e = in.displacement;
  const bool has_one_axial = !tilts || (e.x == 0. && e.psi_y == 0. && e.psi_z == 0.);
  return balance_balls(inertial_, F_0, w, has_one_axial ? starts_.get() : nullptr);
}

void BallRow::evaluate_inertial(const BallRowInput& in, double F_0, bool tilts, BallRowOutput& out,
                                RowTractions* tractions) const {
  InertialBalls w;
  Widening bent;
  const RowPlaceOf<double> place = row_place(numbers_, in, 0.);
  const BallWork work = balance(in, F_0, place, tilts, w, bent);
  const bool is_bent = !in.shape.empty();
  const double hardness = 1. / (inertial_.c_i + inertial_.c_o), u_per_root_o = 1. / std::sqrt(inertial_.c_o);
  with_motion(tilts, is_bent, [&](auto tilts_too, auto bends) {
    if (geometry_.inner_gyroscopic_share != 0.)
      wide<sum_forces<tilts_too, bends, true>>(place, cosine_.data(), sine_.data(), w, hardness, &bent, out);
    else
      wide<sum_forces<tilts_too, bends, false>>(place, cosine_.data(), sine_.data(), w, hardness, &bent, out);
  });
  if (is_bent) press_shapes(in, bent);
  out.waviness_power = 0.;
  if (!waves_.empty())
    for (std::size_t j = 0; j < n_balls(); ++j)
      out.waviness_power += w.u_i[j] * w.u_i[j] * w.u_i[j] * w.added_i_rate[j] + w.Q_o[j] * w.added_o_rate[j];

  // The forces of inertia follow no potential: what they do as the balls move is work of the prescribed motion of cage and balls. What they do as
  // parts grow belongs to the work of growth.
  out.inertia_power = work.power;
  out.inertia_per_speed = work.per_force * 2. / in.ring_speed;  // F_0 goes with the square of the speed
  out.elastic_radial += work.per_radial;
  out.elastic_axial += work.per_axial;
  out.elastic_normal += 0.5 * work.per_ball_growth;
  out.elastic_outer_surplus += work.per_outer - 0.5 * work.per_ball_growth;

  if (geometry_.conducts) wide<sum_load_roots>(w, u_per_root_o, out);
  if (tractions)
    wide<sum_tractions>(w,
                        {numbers_.centrifugal_force(in),
                         geometry_.inner_gyroscopic_share,
                         {{geometry_.inner, 1.}, {geometry_.outer, 1.}}},
                        u_per_root_o, *tractions);
}

}  // namespace rotordrop
