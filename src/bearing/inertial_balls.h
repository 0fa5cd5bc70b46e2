#pragma once
// A row of balls with inertia, all at once: the balance of laws/ball_balance.h for vectors of balls.
//
// Unknowns of a ball are both contact angles, as unit normals, and u = Q^(1/3) of both contacts: delta = K^(-2/3) u^2 and Q = u^3 have no roots.
// Two equations say that the vectors (l_o + delta_o) n_o and (l_i + delta_i) n_i together reach from groove centre to groove centre, two that the
// forces on the ball cancel. Newton's method on these four needs two divisions a step. The start is a function of the state alone: from a
// table made once, or a closed guess between the ball without inertia and the one that lies in the bottom of the outer groove. First steps are in single
// precision, the last ones in double, until what is left is below 2e-5 before a step, which squares it.
#include <array>
#include <cstddef>

namespace rotordrop {

/// Constants of a row.
struct InertialRow {
  double c_i = 0, c_o = 0;  ///< K^(-2/3) of each contact [m/N^(2/3)]
  double l_i = 0, l_o = 0;  ///< groove radius less ball radius [m]
  double g = 0;             ///< ball over pitch diameter
};

/// Arrays of a row; those of the input are filled by the caller, up to n, a multiple of 8.
struct InertialBalls {
  static constexpr std::size_t capacity = 256;
  using Array = std::array<double, capacity>;
  InertialBalls() {}  // leaves everything unwritten: only what is used is
  std::size_t n;
  // In: groove centres' distance B; what adds to the deflection of each contact; 0 for balls that fill up the row, else 1.
  alignas(64) Array B_x, B_r, added_i, added_o, is_ball;
  // Out: loads' cubic roots, normals, force of inertia on the ball.
  alignas(64) Array u_i, u_o, i_x, i_r, o_x, o_r, F;
  alignas(64) Array is_free;  // 1: the inner race does not reach the ball
  int steps;                  ///< of Newton's method, in double precision
  bool is_by_scalar_law;      ///< the steps did not arrive: each ball by laws/ball_balance.h
};

/// Solutions of a row at one B_x over B_r and the ring's speed, made once: a start that is near without any memory of what was before.
class InertialStarts {
 public:
  /// @param B_x, B_r  of the undisplaced row [m]; @param force_per_speed2  F_0 / omega^2 [N s^2/rad^2]
  InertialStarts(const InertialRow& row, double B_x, double B_r, double force_per_speed2);
  static constexpr std::size_t n_radii = 64, n_speeds = 24;

 private:
  friend void balance_balls(const InertialRow&, double, InertialBalls&, const InertialStarts*);
  using Table = std::array<std::array<float, n_radii>, 4>;  // u_i, u_o, sin of both angles
  [[nodiscard]] bool column(double F_0, Table& at_speed) const;
  double first_radius_, radius_step_, speed_step_, force_per_speed2_;
  std::array<Table, n_speeds> tables_;  // at 1, 2, ... speed steps
};

/// Brings all balls into balance.
/// @param F_0     m d_m omega^2 / 2, > 0 [N]
/// @param starts  those of this row if all balls have its B_x; else nullptr
void balance_balls(const InertialRow& row, double F_0, InertialBalls& balls, const InertialStarts* starts = nullptr);

/// How a row's balls move with their surroundings: for the work of the forces of inertia on them.
struct BallMotion {
  using Array = InertialBalls::Array;
  alignas(64) Array B_x_rate, B_r_rate, added_i_rate, added_o_rate;  ///< in [m/s]
};
struct BallWork {
  double power = 0;            ///< of the forces of inertia on the balls as they move [W]
  double per_radial = 0;       ///< work per growth of B_r [N]
  double per_ball_growth = 0;  ///< work per growth of the balls' radius [N]
  double per_force = 0;        ///< work per relative change of F_0 [J]
};
BallWork inertia_work(const InertialRow& row, double F_0, const InertialBalls& balls, const BallMotion& motion);

}  // namespace rotordrop
