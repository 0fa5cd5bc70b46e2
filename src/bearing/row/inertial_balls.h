#pragma once
// A row of balls with inertia, all at once: the balance of laws/ball_balance.h for vectors of balls.
//
// Unknowns of a ball are its place, in polar coordinates about the outer groove's centre: the deflection of the outer contact and the outer
// normal. The inner contact follows, and two equations say that the forces on the ball cancel; a ball that the inner race does not reach is one
// without an inner load. Newton's method starts from a function of the state alone: a table made once, or a closed guess between the ball without
// inertia and the one that lies in the bottom of the outer groove. The last step squares what was left, at most 2e-5 of the load; the matrix that
// it solves gives the work of the forces of inertia too.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rotordrop {

/// Constants of a row.
struct InertialRow {
  double c_i = 0, c_o = 0;            ///< K^(-2/3) of each contact [m/N^(2/3)]
  double l_i = 0, l_o = 0;            ///< groove radius less ball radius [m]
  double g = 0;                       ///< ball over pitch diameter
  double inner_gyroscopic_share = 0;  ///< sigma of laws/ball_balance.h
};

/// Arrays of a row; those of the input are filled by the caller, up to n, a multiple of 8.
struct InertialBalls {
  static constexpr std::size_t capacity = 256;
  /// A little longer than a row can be, lest all arrays fall on the same lines of the cache.
  using Array = std::array<double, capacity + 8>;
  InertialBalls() {}  // leaves everything unwritten: only what is used is
  std::size_t n;
  // In: groove centres' distance B; what adds to the deflection of each contact; their rates; 0 for balls that fill up the row, else 1.
  alignas(64) Array B_x, B_r, added_i, added_o, B_x_rate, B_r_rate, added_i_rate, added_o_rate, is_ball;
  // Out: cubic root of the inner load, 0 for a ball that the inner race does not reach; inner normal; outer load and deflection; with a share of the gyroscopic
  // traction at the inner race, that traction on the ball along (i_r, -i_x), else unwritten.
  alignas(64) Array u_i, i_x, i_r, Q_o, deflection_o, T_i;
  // The ball's place before the last step.
  alignas(64) Array delta_o, o_x, o_r;
  int steps;              ///< of Newton's method, the last one included
  bool is_by_scalar_law;  ///< the steps did not arrive: each ball by laws/ball_balance.h
};

/// What a row's forces of inertia do as balls move with their surroundings.
struct BallWork {
  double power = 0;            ///< of the forces of inertia on the balls as they move [W]
  double per_radial = 0;       ///< work per growth of B_r [N]
  double per_axial = 0;        ///< work per growth of B_x [N]
  double per_ball_growth = 0;  ///< work per growth of the balls' radius [N]
  double per_outer = 0;        ///< the outer contacts' part of that [N]
  double per_force = 0;        ///< work per relative change of F_0 [J]
};

/// Places of a row's balls at one B_x over B_r and the ring's speed, made once: a start that is near without any memory of what was before.
class InertialStarts {
 public:
  /// @param B_x, B_r  of the undisplaced row [m]; @param force_per_speed2  F_0 / omega^2 [N s^2/rad^2]
  InertialStarts(const InertialRow& row, double B_x, double B_r, double force_per_speed2);
  /// Sets the balls' places at about this speed. @return false if the table does not have them
  bool place(double F_0, InertialBalls& balls) const;

 private:
  // 50 um to either side, more than rings move in their balls; speeds to 2500 rad/s. Beyond, the closed guess serves.
  static constexpr std::size_t n_radii = InertialBalls::capacity, n_speeds = 768;
  static constexpr double reach = 50e-6, last_speed = 2500.;
  static constexpr double radius_step = 2. * reach / (n_radii - 1), speed_step = last_speed / (n_speeds - 1);
  /// delta_o and the outer normal's o_x, both as float, in one number: what is looked up together lies together.
  using Place = std::uint64_t;
  double first_radius_, force_per_speed2_;
  std::vector<Place> places_;  // [n_speeds][n_radii]
};

/// Brings all balls into balance.
/// @param F_0     m d_m omega^2 / 2, > 0 [N]
/// @param starts  those of this row if all balls have its B_x; else nullptr
BallWork balance_balls(const InertialRow& row, double F_0, InertialBalls& balls,
                       const InertialStarts* starts = nullptr);

}  // namespace rotordrop
