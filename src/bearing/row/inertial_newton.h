#pragma once
// Newton's method for balls of a row with inertia.
#include <algorithm>
#include <cstddef>

#include "base/gather.h"
#include "bearing/row/inertial_in_plane.h"

namespace rotordrop {

/// Balls on their way to their balance: one of each drop in lanes, or several of a row.
template <class Real>
struct BallInBalance {
  BallSurroundings<Real> at;
  BallPlace<Real> place;
  Real nearly;        // from what is left at this place, over the loads, one step more arrives
  Real is_ball;       // 0 for balls that fill up the row, else 1
  MaskOf<Real> left;  // have not arrived
  BalancedBall<Real> ball;
};

/// One loop over the balls for each part of a step, so that processors have several in work at a time. What a ball does depends on its own state
/// alone: its neighbours in a vector may take more steps, not it.
/// @tparam Forces  BallForces<is_split, Real> or BallForcesInPlane<Real>
/// @tparam Starts  InertialStart for all balls, or InertialStartsOf<Real>
template <class Forces, class Real, class Starts>
class Newton {
 public:
  using Balls = BallInBalance<Real>;
  /// @param force   F_0 of the row [N]; @param is_turning  whether there is any: who stands is left alone
  Newton(const InertialRowOf<Real>& row, const Real& force, const Starts& starts, const MaskOf<Real>& is_turning)
      : row_{row, select(is_turning, force, Real(1.))}, starts_(starts), is_turning_(is_turning) {}

  /// A place near the balance, from the surroundings alone.
  [[gnu::always_inline]] inline void start(Balls& ball) const {
    const BallSurroundings<Real>& at = ball.at;
    const InertialRowOf<Real>& row = row_.constants;
    const Real axial = at.B_x - row.B_x, added = at.added_i + at.added_o;
    const Real B_r = at.B_r + axial * row.shift_by_axial + added * row.shift_by_added;
    const Real asked = (B_r - row.B_r + InertialStarts::reach) * InertialStarts::per_step;
    const MaskOf<Real> is_known = asked <= Real(starts_.last), is_beyond = !is_known;
    ball.nearly = select(is_known, Real(nearly_from_table), Real(nearly_from_guess));
    if (!any(is_known)) {
      ball.place = guess(at);
      return;
    }
    // Below the first entry balls are free, or nearly so.
    const Real within = select(is_known, larger(asked, Real(0.)), Real(0.));
    const auto [delta_o, o_x] = between_entries(starts_.lines, within);
    BallPlace<Real>& p = ball.place;
    p = {delta_o, 0., 1.};
    if constexpr (!Forces::is_in_plane) {
      p.x = o_x * (1. + axial * row.turn_by_axial + added * row.turn_by_added);
      p.x = limited(p.x, -0.95, 0.95);
      p.r = sqrt(1. - p.x * p.x);
    }
    if (any(is_beyond)) p = select_place(is_known, p, guess(at));
  }
  /// Brings balls from their start into balance.
  [[gnu::always_inline]] inline NewtonSteps balance(Balls* balls, std::size_t n) const {
    NewtonSteps steps{1, false};
    MaskOf<Real> all_left = false;
    for (Balls* v = balls; v != balls + n; ++v) {
      const Forces forces(row_, v->place, v->at);
      v->left = forces.is_left(v->nearly) & is_turning_;
      v->place = forces.next(v->place);
      all_left |= v->left;
    }
    if (any(all_left)) steps.most += approach(balls, n);
    all_left = false;
    for (Balls* v = balls; v != balls + n; ++v) {
      const Forces forces(row_, v->place, v->at);
      v->left = forces.is_left(enough) & is_turning_;
      v->ball = balanced_ball(forces, row_, v->place, v->is_ball);
      all_left |= v->left;
    }
    ++steps.most;
    if (any(all_left)) finish(balls, n, steps);
    return steps;
  }
  /// One step more, for energies: their differences are compared with powers.
  void refine(Balls* balls, std::size_t n) const {
    for (Balls* v = balls; v != balls + n; ++v) {
      v->place = Forces(row_, v->place, v->at).next(v->place);
      v->ball = balanced_ball(Forces(row_, v->place, v->at), row_, v->place, v->is_ball);
    }
  }

 private:
  // Newton's method squares what is left at each step. From farther off it must come nearer, since the work that the last step finds is behind by one square.
  static constexpr double enough = 2e-5, nearly_from_table = 1e-3, nearly_from_guess = 3e-4;
  static constexpr int most = 20;

  [[nodiscard, gnu::noinline]] BallPlace<Real> guess(const BallSurroundings<Real>& at) const {
    return guessed_place(row_, at);
  }
  /// More steps for those that have not arrived. @return how many
  [[gnu::noinline]] int approach(Balls* balls, std::size_t n) const {
    bool has_more = true;
    int steps = 0;
    for (; has_more && steps < most; ++steps) {
      has_more = false;
      for (Balls* v = balls; v != balls + n; ++v)
        if (any(v->left)) {
          const Forces forces(row_, v->place, v->at);
          v->place = select_place(v->left, forces.next(v->place), v->place);
          v->left = v->left & forces.is_left(v->nearly);
          has_more |= any(v->left);
        }
    }
    return steps;
  }
  /// The same after the last step; who does not arrive at all gets its place by the scalar law.
  [[gnu::noinline]] void finish(Balls* balls, std::size_t n, NewtonSteps& steps) const {
    int longest = 0;
    for (Balls* v = balls; v != balls + n; ++v)
      if (any(v->left)) {
        v->nearly = enough;
        longest = std::max(longest, approach(v, 1));
        for (int lane = 0; lane < Real::n_numbers; ++lane)
          if (v->left[lane]) {
            steps.by_scalar_law = true;
            place_carefully(*v, lane);
          }
        v->ball = balanced_ball(Forces(row_, v->place, v->at), row_, v->place, v->is_ball);
      }
    steps.most += longest;
  }
  void place_carefully(Balls& v, int lane) const {
    const CarefulPlace p = careful_place(of_lane<InertialRowOf>(row_.constants, lane), row_.F_0[lane], v.at.B_x[lane],
                                         v.at.B_r[lane], v.at.added_i[lane], v.at.added_o[lane]);
    v.place.delta_o.set(lane, p.delta_o);
    v.place.x.set(lane, p.o_x);
    v.place.r.set(lane, p.o_r);
  }

  BalancedRowOf<Real> row_;
  Starts starts_;
  MaskOf<Real> is_turning_;
};

}  // namespace rotordrop
