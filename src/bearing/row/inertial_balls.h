#pragma once
// A row of balls with inertia, all at once: the balance of laws/ball_balance.h for vectors of balls (inertial_terms.h, inertial_kernels.h).
//
// Newton's method starts from a function of the state alone: a table made once, or a closed guess between the ball without inertia and the one that
// lies in the bottom of the outer groove. Every ball takes its own steps until at most 2e-5 of its load is left, and the last one squares that.
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "base/pair_lines.h"

namespace rotordrop {

/// Constants of a row.
template <class Real>
struct InertialRowOf {
  Real K_i, K_o;                ///< of each contact [N/m^1.5]
  Real l_i, l_o;                ///< groove radius less ball radius [m]
  Real g;                       ///< ball over pitch diameter
  Real inner_gyroscopic_share;  ///< sigma of laws/ball_balance.h
  Real c_i, c_o;                ///< K^(-2/3) of each contact [m/N^(2/3)]
  Real root_K_i, root_K_o;      ///< K^(1/3) of each contact
  Real hardness;                ///< K^(2/3) of both in series
  Real B_x, B_r;                ///< of the undisplaced row [m]
  // How places move with what tables of starts do not have, to first order: shifts of B_r by growth of B_x and of the deflections, and relative
  // growth of the outer normal's part along the axis.
  Real shift_by_axial, shift_by_added;  ///< B_x / B_r, 1 / cos of the angle of B
  Real turn_by_axial, turn_by_added;    ///< 1 / B_x, 1 / |B| [1/m]
};
using InertialRow = InertialRowOf<double>;
InertialRow inertial_row(double K_i, double K_o, double l_i, double l_o, double g, double inner_gyroscopic_share,
                         double B_x, double B_r);

/// How many steps of Newton's method the balls of a row took.
struct NewtonSteps {
  int most = 0;                ///< of a vector of balls, the last one included
  bool by_scalar_law = false;  ///< some did not arrive: each of them by laws/ball_balance.h
};

/// Balls in balance, as arrays; those of the input are filled by the caller, up to n, a multiple of 8.
struct InertialBalls {
  static constexpr std::size_t capacity = 256;
  using Array = std::array<double, capacity>;
  InertialBalls() {}  // leaves everything unwritten: only what is used is
  std::size_t n;
  // In: groove centres' distance B; what adds to the deflection of each contact.
  alignas(64) Array B_x, B_r, added_i, added_o;
  // Out: inner and outer load; the ball's place: outer deflection, outer normal along the axis.
  alignas(64) Array Q_i, Q_o, delta_o, o_x;
  NewtonSteps steps;
};

/// Places (delta_o, o_x) of a row's balls over B_r at two speeds: by straight lines between entries, which lie InertialStarts::per_step apart, and between
/// the speeds' forces of inertia.
struct InertialStart {
  PairLines lines;
  double last;  ///< entry up to which the lines may be asked; minus infinity: nowhere
};
/// Of each lane its own.
template <class Real>
struct InertialStartsOf {
  PairLinesOf<Real::n_numbers> lines;
  Real last;
  void set(int lane, const InertialStart& start) {
    lines.lane[lane] = start.lines;
    last.set(lane, start.last);
  }
};

/// Places of a row's balls at one B_x over B_r and the ring's speed, made once: a start that is near without any memory of what was before.
class InertialStarts {
 public:
  /// @param force_per_speed2  F_0 / omega^2 [N s^2/rad^2]
  InertialStarts(const InertialRow& row, double force_per_speed2);
  /// Places at about this speed.
  [[nodiscard]] InertialStart at(double F_0) const;
  /// No places at all.
  [[nodiscard]] static InertialStart nowhere();

 private:
  // 50 um to either side, more than rings move in their balls; speeds to 2500 rad/s. Beyond, the closed guess serves.
  static constexpr std::size_t n_radii = 512, n_speeds = 193;
  static constexpr double last_speed = 2500.;
  static constexpr double radius_step = 2. * 50e-6 / (n_radii - 1), speed_step = last_speed / (n_speeds - 1);

 public:
  static constexpr double per_step = 1. / radius_step;     ///< entries per metre
  static constexpr double reach = 50e-6;                   ///< of the first entry below the undisplaced row's B_r [m]
  static constexpr std::size_t line_length = 2 * n_radii;  ///< numbers

 private:
  double per_force_;           // square of the speed, in lines, per F_0 [1/N]
  std::vector<float> places_;  // [n_speeds][n_radii][delta_o, o_x]
};

/// The same: those of an earlier call with these numbers, as long as anything holds them. Rows of many drops share them.
std::shared_ptr<const InertialStarts> shared_starts(const InertialRow& row, double force_per_speed2);

/// Brings all balls into balance.
/// @param F_0     m d_m omega^2 / 2, > 0 [N]
/// @param starts  those of this row if all balls have its B_x; else nullptr
void balance_balls(const InertialRow& row, double F_0, InertialBalls& balls, const InertialStarts* starts = nullptr);

/// A ball's place by the careful scalar law: where contacts carry next to nothing, the vectors' start is too far off now and then.
struct CarefulPlace {
  double delta_o, o_x, o_r;
};
CarefulPlace careful_place(const InertialRow& row, double F_0, double B_x, double B_r, double added_i, double added_o);

}  // namespace rotordrop
