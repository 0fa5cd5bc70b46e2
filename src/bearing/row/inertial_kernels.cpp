#include "bearing/row/inertial_kernels.h"

#include "bearing/row/ball_row_bending.h"
#include "bearing/row/inertial_sums.h"
#include "bearing/row/row_vectors.h"

// Compiled for every level of vectors, with ROTORDROP_LANE_FACTORY the name of the function that gives the kernels.
namespace rotordrop {
namespace {

constexpr std::size_t most_vectors = BallRow::max_balls / at_once;

template <GrooveMotion motion, bool is_split>
using NewtonFor = Newton<BallForcesOf<motion, is_split, Balls>, Balls, InertialStart>;

ROTORDROP_KERNEL InertialRowOf<Balls> in_all_lanes(const InertialRow& r) {
  return {r.K_i,
          r.K_o,
          r.l_i,
          r.l_o,
          r.g,
          r.inner_gyroscopic_share,
          r.c_i,
          r.c_o,
          r.root_K_i,
          r.root_K_o,
          r.hardness,
          r.B_x,
          r.B_r,
          r.shift_by_axial,
          r.shift_by_added,
          r.turn_by_axial,
          r.turn_by_added};
}
template <GrooveMotion motion, bool is_bent>
ROTORDROP_KERNEL RowAtInstant<motion, is_bent, Balls> at_instant(const InertialInput& in,
                                                                 const RowPlaceOf<Balls>& place) {
  return {place, in_all_lanes(*in.row), in.added_i, in.added_o, in.cage_speed, in.waves != nullptr, in.sums_roots};
}

template <bool is_bent>
ROTORDROP_KERNEL BallInRow<Balls> in_row(const InertialInput& in, std::size_t j) {
  BallInRow<Balls> ball;
  ball.cosine = Balls::load(in.cosine + j);
  ball.sine = Balls::load(in.sine + j);
  if constexpr (is_bent)
    ball.bent = {Balls::load(&in.bent->width[j]), Balls::load(&in.bent->rate[j]), Balls::load(&in.bent->slope[j])};
  if (in.waves) ball.waves = some_of(*in.waves, j);
  return ball;
}

/// Brings a row's balls into balance. @param balls  [most_vectors]
template <GrooveMotion motion, bool is_bent, bool is_split>
ROTORDROP_KERNEL NewtonFor<motion, is_split> balance_row(const InertialInput& in,
                                                         const RowAtInstant<motion, is_bent, Balls>& row,
                                                         BallInBalance<Balls>* balls) {
  const NewtonFor<motion, is_split> newton(in_all_lanes(*in.row), in.F_0, in.starts, true);
  for (std::size_t j = 0; j < in.n; j += at_once) {
    auto& ball = balls[j / at_once];
    ball.at = row.surroundings(in_row<is_bent>(in, j));
    newton.start(ball);
    ball.is_ball = Balls::load(in.is_ball + j);
  }
  newton.balance(balls, in.n / at_once);
  return newton;
}

ROTORDROP_KERNEL InertialSums<double> over_lanes(const InertialSums<Sum>& sum, bool sums_roots) {
  double a[8], b[8];
  Sum::sum_lanes({sum.fx, sum.fy, sum.fz, sum.dissipated, sum.radial, sum.axial, sum.inner, sum.outer}, a);
  Sum::sum_lanes({sum.cage, sum.power, sum.by_inner, sum.by_outer, sum.per_force, sum.waviness, sum.my, sum.mz}, b);
  return {.fx = a[0],
          .fy = a[1],
          .fz = a[2],
          .dissipated = a[3],
          .radial = a[4],
          .axial = a[5],
          .inner = a[6],
          .outer = a[7],
          .cage = b[0],
          .power = b[1],
          .by_inner = b[2],
          .by_outer = b[3],
          .per_force = b[4],
          .waviness = b[5],
          .my = b[6],
          .mz = b[7],
          .inner_roots = sums_roots ? sum.inner_roots.sum() : 0.,
          .outer_roots = sums_roots ? sum.outer_roots.sum() : 0.,
          .largest = largest(sum.largest),
          .largest_outer = largest(sum.largest_outer)};
}

template <GrooveMotion motion, bool is_bent, bool is_split>
void sum_balls(const InertialInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  const auto row = at_instant<motion, is_bent>(in, place);
  BallInBalance<Balls> balls[most_vectors];
  balance_row<motion, is_bent, is_split>(in, row, balls);
  InertialSums<Sum> all_forces;
  TractionSumsOf<Sum> all_tractions;
  TractionInputOf<Balls> traction_input;
  if (with) traction_input = in_all_lanes(*with);
  for (std::size_t first = 0; first < vector_length; first += at_once) {
    InertialSums<Balls> forces;
    TractionSumsOf<Balls> traction_sums;
    for (std::size_t j = first; j < in.n; j += vector_length) {
      const auto& ball = balls[j / at_once];
      const Balls F_radial = row.template add_forces<is_split>(in_row<is_bent>(in, j), ball, forces);
      if constexpr (is_bent) F_radial.store(&in.bent->force[j]);
      if (with) row.add_tractions(traction_input, ball, traction_sums);
    }
    put_part(forces, first, all_forces);
    if (with) put_part(traction_sums, first, all_tractions);
  }
  put<motion == GrooveMotion::all>(over_lanes(all_forces, in.sums_roots), in.place, out);
  if (with) put(over_lanes(all_tractions), *with, *tractions);
}

template <GrooveMotion motion, bool is_bent>
void sum_chosen(const InertialInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  if constexpr (motion != GrooveMotion::in_plane)
    if (in.row->inner_gyroscopic_share != 0.) return sum_balls<motion, is_bent, true>(in, out, with, tractions);
  sum_balls<motion, is_bent, false>(in, out, with, tractions);
}
template <GrooveMotion motion>
void sum_chosen(const InertialInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  in.bent ? sum_chosen<motion, true>(in, out, with, tractions) : sum_chosen<motion, false>(in, out, with, tractions);
}

Balls inner_load(const BalancedBall<Balls>& ball) { return ball.u * ball.u * ball.u; }

/// @param use  is called with the balls in their balance
template <bool is_bent, bool is_split, class Use>
void with_balanced(const InertialInput& in, const Use& use) {
  BallInBalance<Balls> balls[most_vectors];
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  const auto newton =
      balance_row<GrooveMotion::all, is_bent, is_split>(in, at_instant<GrooveMotion::all, is_bent>(in, place), balls);
  newton.refine(balls, in.n / at_once);
  use(balls);
}
template <class Use>
void with_balanced(const InertialInput& in, const Use& use) {
  if (in.row->inner_gyroscopic_share != 0.)
    in.bent ? with_balanced<true, true>(in, use) : with_balanced<false, true>(in, use);
  else
    in.bent ? with_balanced<true, false>(in, use) : with_balanced<false, false>(in, use);
}

void loads(const InertialInput& in, double* Q_i, double* Q_o) {
  with_balanced(in, [&](const BallInBalance<Balls>* balls) {
    for (std::size_t j = 0; j < in.n; j += at_once) {
      inner_load(balls[j / at_once].ball).store(Q_i + j);
      balls[j / at_once].ball.Q_o.store(Q_o + j);
    }
  });
}

double energy(const InertialInput& in) {
  Octet all;
  const InertialRowOf<Balls> row = in_all_lanes(*in.row);
  with_balanced(in, [&](const BallInBalance<Balls>* balls) {
    for (std::size_t first = 0; first < vector_length; first += at_once) {
      Balls sum = 0.;
      for (std::size_t j = first; j < in.n; j += vector_length) sum += elastic_work(row, balls[j / at_once].ball);
      sum.store(&all[first]);
    }
  });
  return 0.4 * all.sum();
}

template <bool is_split>
void balance_all(const InertialRow& row, double F_0, const InertialStart& starts, InertialBalls& w) {
  const NewtonFor<GrooveMotion::all, is_split> newton(in_all_lanes(row), F_0, starts, true);
  BallInBalance<Balls> balls[most_vectors];
  for (std::size_t j = 0; j < w.n; j += at_once) {
    auto& v = balls[j / at_once];
    v.at = {Balls::load(&w.B_x[j]), Balls::load(&w.B_r[j]), Balls::load(&w.added_i[j]), Balls::load(&w.added_o[j])};
    newton.start(v);
    v.is_ball = 1.;
  }
  w.steps = newton.balance(balls, w.n / at_once);
  for (std::size_t j = 0; j < w.n; j += at_once) {
    const auto& v = balls[j / at_once];
    inner_load(v.ball).store(&w.Q_i[j]);
    v.ball.Q_o.store(&w.Q_o[j]);
    v.place.delta_o.store(&w.delta_o[j]);
    v.place.x.store(&w.o_x[j]);
  }
}
void balance(const InertialRow& row, double F_0, const InertialStart& starts, InertialBalls& balls) {
  row.inner_gyroscopic_share != 0. ? balance_all<true>(row, F_0, starts, balls)
                                   : balance_all<false>(row, F_0, starts, balls);
}

constexpr InertialKernels kernels{sum_chosen<GrooveMotion::in_plane>,
                                  sum_chosen<GrooveMotion::translating>,
                                  sum_chosen<GrooveMotion::all>,
                                  loads,
                                  energy,
                                  balance};

}  // namespace

const InertialKernels& ROTORDROP_LANE_FACTORY() { return kernels; }

}  // namespace rotordrop
