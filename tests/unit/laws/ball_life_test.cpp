// Rainflow: the worked example of ASTM E1049-85, section 5.4.4 (figure 6): -2, 1, -3, 5, -1, 3, -4, 4, -2 has the cycles
//   range 3: 1/2, 4: 1 1/2, 6: 1/2, 8: 1, 9: 1/2.
// Life: for what ISO 281 is made for the sum over all balls' cycles is ISO 281's life. Under a constant radial load F the ball at azimuth psi from the load
// carries Q_max cos(psi)^1.5 on the loaded half, with equilibrium F = sum Q cos(psi) cos(alpha), and L10 = (C/F)^3 1e6 turns. The cage turns (1 - gamma)/2
// times as fast as the inner ring.
#include "laws/fatigue/ball_life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "laws/fatigue/rainflow.h"

namespace rotordrop {
namespace {

using Counts = std::map<double, double>;

Counts counted(const std::vector<double>& history) {
  Counts counts;
  Rainflow rainflow;
  const auto count = [&](double range, double cycles) { counts[range] += cycles; };
  for (const double value : history) rainflow.follow(value, count);
  rainflow.finish(count);
  return counts;
}

TEST(Rainflow, CountsTheWorkedExampleOfAstmE1049) {
  EXPECT_EQ(counted({-2, 1, -3, 5, -1, 3, -4, 4, -2}), (Counts{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1.}, {9, 0.5}}));
}

TEST(Rainflow, DoesNotSeeWhatLiesBetweenReversals) {
  EXPECT_EQ(counted({-2, -2, -1, 1, 0.5, 0.5, -3, 0, 2, 5, 5, 4, -1, 3, 3, -4, 4, 1, -2}),
            (Counts{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1.}, {9, 0.5}}));
}

TEST(Rainflow, CountsSmallCyclesWithinALargeOne) {
  // Down and up by 1 on the way up, and on the way down: one large cycle in two halves, and two small ones.
  EXPECT_EQ(counted({0, 6, 5, 10, 4, 5, 0}), (Counts{{1, 2.}, {10, 1.}}));
}

TEST(Rainflow, HasNoCyclesWithoutReversals) {
  EXPECT_TRUE(counted({}).empty());
  EXPECT_TRUE(counted({3, 3, 3}).empty());
  EXPECT_EQ(counted({0, 1, 2}), (Counts{{2, 0.5}}));
}

TEST(Rainflow, KeepsOnlyWhatIsOpen) {
  Rainflow rainflow;
  double sum = 0.;
  for (int k = 0; k < 10000; ++k) rainflow.follow(k % 2 == 0 ? 0. : 1. + k % 7, [&](double, double n) { sum += n; });
  EXPECT_LE(rainflow.open().size(), 20u);
  EXPECT_NEAR(sum, 5000., 10.) << "a cycle for two values";
}

/// Sum of cubes of all balls' cycles of a row under a constant radial load.
double sum_of_cubes(const RatedRow& row, double F, int cage_turns) {
  // Q_max of the load distribution from the equilibrium of many balls, not from the constant of the header.
  double mean = 0.;
  const int n = 20000;
  for (int k = 0; k < n; ++k) mean += std::pow(std::max(std::cos(2. * std::numbers::pi * k / n), 0.), 2.5) / n;
  const double Q_max = F / (row.n_balls * std::cos(row.contact_angle) * mean);
  double sum = 0.;
  const auto count = [&](double range, double cycles) { sum += cycles * range * range * range; };
  for (int j = 0; j < row.n_balls; ++j) {
    Rainflow rainflow;
    for (int k = 0; k <= 720 * cage_turns; ++k) {
      const double c = std::cos((k - 360) * std::numbers::pi / 360.);  // begins and ends unloaded
      rainflow.follow(Q_max * std::pow(std::max(c, 0.), 1.5), count);
    }
    rainflow.finish(count);
  }
  return sum;
}

TEST(BallLife, IsThatOfIso281UnderAConstantRadialLoad) {
  for (const RatedRow& row :
       {RatedRow{14, 11.906e-3, 90e-3, 0., 39.7e3}, RatedRow{23, 9.525e-3, 85e-3, 0.4363, 33e3}}) {
    const double F = 6e3, gamma = row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter;
    const int cage_turns = 5;
    const double turns = cage_turns / (0.5 * (1. - gamma));
    const double expected = turns / 1e6 * std::pow(F / row.rating, 3);
    // The load of the ball under the rating has a constant of nine digits, and enters cubed: 7e-9.
    EXPECT_NEAR(life_share(row, sum_of_cubes(row, F, cage_turns)), expected, 1e-8 * expected);
  }
}

TEST(BallLife, OfRollingIsThatOfIso281UnderRadialLoadAndUnderThrust) {
  const RatedRow row{23, 9.525e-3, 85e-3, 25. * std::numbers::pi / 180., 33e3};
  const double turns = 1e4, Z = row.n_balls, cosine = std::cos(row.contact_angle);
  // A radial load: cubes of many balls' loads, with Q_max from the equilibrium.
  const double F = 6e3;
  double mean = 0., cubes = 0.;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double c = std::max(std::cos(2. * std::numbers::pi * k / n), 0.);
    mean += std::pow(c, 2.5) / n;
    cubes += std::pow(c, 4.5) / n;
  }
  const double Q_max = F / (Z * cosine * mean);
  const double radial = turns / 1e6 * std::pow(F / row.rating, 3);
  // Two constants of nine digits, one of them cubed: 1e-8.
  EXPECT_NEAR(life_share(row, cycles_of_rolling(row, turns * Z * cubes * std::pow(Q_max, 3))), radial, 1e-8 * radial);
  // Thrust: P = 0.87 F_a at 25 deg (ISO 281, table of X and Y). Y has two digits there, so that its cube is known to 2 %.
  const double thrust = turns / 1e6 * std::pow(0.87 * F / row.rating, 3);
  const double Q = F / (Z * std::sin(row.contact_angle));
  EXPECT_NEAR(life_share(row, cycles_of_rolling(row, turns * Z * std::pow(Q, 3))), thrust, 0.02 * thrust);
}

TEST(BallLife, OfRacesWithDifferentLoadsIsThatOfTheStandard) {
  // ISO/TS 16281: Q_ci = C / (0.407 Z cos(alpha)) [1 + X]^0.3, Q_ce = C / (0.389 Z cos(alpha)) [1 + 1/X]^0.3,
  // X = {1.044 ((1 - gamma)/(1 + gamma))^1.72 [r_i (2 r_e - D) / (r_e (2 r_i - D))]^0.41}^(10/3),
  // L10 = [(Q_ci/Q_ei)^(-10/3) + (Q_ce/Q_ee)^(-10/3)]^(-9/10), here over its value under equal loads.
  for (const auto& [f_i, f_o] : {std::pair{0.52, 0.52}, std::pair{0.515, 0.53}})
    for (const double outer_load : {0., 1., 1.62, 5.}) {
      const RatedRow row{23, 9.525e-3, 85e-3, 0.4363, 33e3, f_i, f_o};
      const double gamma = row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter;
      const double R =
          std::pow((1. - gamma) / (1. + gamma), 1.72) * std::pow(f_i * (2. * f_o - 1.) / (f_o * (2. * f_i - 1.)), 0.41);
      const double X = std::pow(1.044 * R, 10. / 3.);
      const double inner = std::pow(1. + X, 0.3) / 0.407, outer = std::pow(1. + 1. / X, 0.3) / 0.389;
      const auto share = [&](double Q_o) {
        return std::pow(std::pow(1. / inner, 10. / 3.) + std::pow(Q_o / outer, 10. / 3.), 0.9);
      };
      const double expected = share(outer_load) / share(1.);
      // 1.044 and 0.407/0.389 are rounded: together 0.2 % of the ratio of the ratings, cubed.
      EXPECT_NEAR(of_both_races(row, 1., std::pow(outer_load, 3)), expected, 0.006 * expected) << outer_load;
      EXPECT_NEAR(of_both_races(row, 0.3, 0.3), 0.3, 1e-15);
    }
}

TEST(BallLife, OfAPairIsThatOfItsCommonRating) {
  // ISO 281: i equal rows have i^0.7 times the rating of one, and each carries its part of the load.
  const double C_of_one = 33e3, C = std::pow(2., 0.7) * C_of_one, F = 8e3;
  EXPECT_NEAR(rating_of_row(C, 2), C_of_one, 1e-9);
  RatedRow row{23, 9.525e-3, 85e-3, 0.4363, rating_of_row(C, 2)};
  const double one = life_share(row, sum_of_cubes(row, 0.5 * F, 3));
  const double gamma = row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter;
  const double expected = 3. / (0.5 * (1. - gamma)) / 1e6 * std::pow(F / C, 3);
  // nine digits cubed, as above
  EXPECT_NEAR(together(together(0., one), one), expected, 1e-8 * expected);
}

TEST(BallLife, HasTheLoadOfTheBallUnderTheRating) {
  // Stribeck: 4.37 F / (Z cos(alpha)).
  EXPECT_NEAR(ball_load_at_rating({10, 0.01, 0.08, 0., 1e4}), 4.37e3, 1.) << "N";
}

}  // namespace
}  // namespace rotordrop
