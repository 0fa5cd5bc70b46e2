// Rows that grow apart: a raceway that grows by g takes as much from its row's clearance.
#include <gtest/gtest.h>

#include "bearing/statics/ring_statics.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace testing;

constexpr double difference = 0.8 * um;

/// Growth as clearances of the rows: the first row's race grows by half the difference less than the mean, the last one's by half more.
std::vector<BallRowGeometry> with_clearances(std::vector<BallRowGeometry> rows) {
  rows.front().radial_clearance += 0.5 * difference;
  rows.back().radial_clearance -= 0.5 * difference;
  return rows;
}

TEST(RowsThatGrowApart, InDropsPressAsRowsOfOtherClearance) {
  for (const bool has_inertia : {false, true}) {
    auto rows = angular_contact_pair(900.);
    for (auto& r : rows) r.has_inertia = has_inertia;
    const auto moved = with_clearances(rows);
    BallRowInput in;
    in.displacement = {.x = 1e-6, .y = -2e-6, .z = 1e-6, .psi_y = 1e-5};
    in.ring_speed = 1000.;
    in.cage_speed = 430.;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      BallRowInput grown = in;
      grown.row_difference = difference;
      BallRowOutput by_growth, by_clearance, neither;
      BallRow(rows[i], {}).evaluate(grown, by_growth);
      BallRow(moved[i], {}).evaluate(in, by_clearance);
      BallRow(rows[i], {}).evaluate(in, neither);
      // The same number is added in another order: roundoff of 5e-19 m on a stiffness of 3e8 N/m, and with inertia what the balance leaves.
      const double tolerance = has_inertia ? 1e-4 : 1e-8;
      EXPECT_NEAR(by_growth.force_x, by_clearance.force_x, tolerance) << "N, row " << i;
      EXPECT_NEAR(by_growth.force_y, by_clearance.force_y, tolerance) << "N, row " << i;
      EXPECT_NEAR(by_growth.moment_y, by_clearance.moment_y, tolerance) << "N m, row " << i;
      EXPECT_GT(std::fabs(by_growth.force_x - neither.force_x), 10.) << "N: too little to tell";
    }
  }
}

TEST(RowsThatGrowApart, AtRestPressAsRowsOfOtherClearance) {
  const auto rows = angular_contact_pair(900.);
  RingSurroundings around;
  const RingStatics by_clearance(with_clearances(rows), around, {}), neither(rows, around, {});
  around.row_difference = difference;
  const RingStatics by_growth(rows, around, {});
  RingVector q = RingVector::Zero();
  q[1] = -2e-6;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (int ball = 0; ball < rows[row].n_balls; ++ball) {
      const double load = by_growth.ball_reaction(row, ball, q, 0., 1.).balance.load_i;
      EXPECT_NEAR(load, by_clearance.ball_reaction(row, ball, q, 0., 1.).balance.load_i, 1e-8) << "N";
      EXPECT_GT(std::fabs(load - neither.ball_reaction(row, ball, q, 0., 1.).balance.load_i), 0.1)
          << "N: too little to tell";
    }
}

}  // namespace
}  // namespace rotordrop
