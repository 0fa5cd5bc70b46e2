#pragma once
// Contact fatigue of ball bearings from the loads of their balls: ISO 281's load-life rule with Palmgren-Miner's sum.
//
// Under a constant radial load F with half the circle loaded (no clearance, no preload) the most loaded ball carries
//   Q_max = F / (Z cos(alpha) J_r),  J_r = 1/(2 pi) integral of cos^(5/2) over the loaded half = 0.2288   (Stribeck's 4.37)
// and in a turn of the inner ring each of the Z balls passes the load (1 - gamma)/2 times, gamma = D cos(alpha) / d_m. ISO 281 defines the rating C as
// the load that 90 % of all bearings bear for 1e6 turns, and the life under F as (C/F)^p with p = 3. So one passage with the peak Q has the share
//   (Q / Q_C)^3 / (1e6 Z (1 - gamma)/2),  Q_C = Q_max(C)
// of that life, and shares add up (Palmgren, Miner). A load cycle of the range Q is taken as such a passage. For what ISO 281 is made for the sum is
// its life exactly; a test says so.
//
// Loads that do not swing, of preload, thrust or speed, make no cycles, but balls that roll under them tire the raceways as well. On half a circle loaded
// the mean of Q^3 around the row is J_3 = 1/(2 pi) integral of cos^(9/2) = 0.1780 of Q_max^3, and that takes one turn's share; so a turn with the loads
// Q_j has the share
//   mean of Q_j^3 / (J_3 Q_C^3) / 1e6.
// Under a radial load on half the circle it is the same as by cycles, under thrust alone it is ISO 281's P = Y F_a (Y = 0.407 cot(alpha), ISO 0.4). Both
// count what happens to the same raceways, one as if balls stood under a load that swings, one as if they rolled under loads that stand: the larger
// counts.
// Balls with inertia press their outer race more than the inner one. Each race has a life of its own, and shares of a row's races join as those of rows do.
// With the same load on both they are as 1 and (Q_ci / Q_co)^3, the ratio of the races' ratings (Lundberg & Palmgren 1947; ISO/TS 16281 has it within 0.2 %):
//   Q_ci / Q_co = [f_i (2 f_o - 1) / (f_o (2 f_i - 1))]^0.41 [(1 - gamma) / (1 + gamma)]^1.72.
namespace rotordrop {

inline constexpr double load_life_exponent = 3.;  ///< p of ball bearings, ISO 281

/// One row of a bearing or set, with the rating of that row by itself.
struct RatedRow {
  int n_balls = 0;                                          ///< Z
  double ball_diameter = 0;                                 ///< D [m]
  double pitch_diameter = 0;                                ///< d_m [m]
  double contact_angle = 0;                                 ///< alpha [rad]
  double rating = 0;                                        ///< C of this row [N]
  double inner_conformity = 0.52, outer_conformity = 0.52;  ///< f_i, f_o, of races whose loads differ
};

/// Rating of one of n equal rows with the rating C together: C / n^0.7 (ISO 281, rows of ball bearings).
double rating_of_row(double C, int n_rows);

/// Q_C [N]
double ball_load_at_rating(const RatedRow& row);

/// Share of a row's life. @param sum_of_cubes  of all cycles' ranges, of all of its balls [N^3]
double life_share(const RatedRow& row, double sum_of_cubes);

/// The sum of cubes whose life_share() is that of rolling. @param cubes  sum of all balls' Q^3, integrated over turns of the inner ring [N^3]
double cycles_of_rolling(const RatedRow& row, double cubes);

/// Share of a row's life from the shares by the loads of either race: of equal ones the same.
double of_both_races(const RatedRow& row, double by_inner_loads, double by_outer_loads);

/// Share of a bearing's life from those of its rows: (sum D^e)^(1/e) with Weibull's exponent e = 10/9 of ball bearings (ISO 281).
/// Adding a row: combined = together(combined, share of the row).
double together(double share, double other);

}  // namespace rotordrop
