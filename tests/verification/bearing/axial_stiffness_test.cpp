// Preload, axial and tilting stiffness of pairs; the ring hanging in its balls.
//
// NSK'S CATALOGUE (super precision): axial stiffness of a 7914C pair (15 deg, Z = 23, d = 8.731 mm, d_m = 85 mm) at preloads of 100, 200, 490,
// 980 N: 59, 79, 119, 168 N/um. The pair's stiffness at zero load is the sum of its rows' dF_a/dx.
//
// A RADIALLY GROWING INNER RING of an X pair stays put by symmetry, so each row's axial load is Z K delta^1.5 sin phi with
//   B_r = A cos phi_0 + growth, B_x = A sin phi_0 + offset, delta = |B| - A, sin phi = B_x / |B|.
//
// TILT. A ball's contact normal meets the axis at x_row -+ R tan phi from the middle: closer together than the rows for X, further apart for O.
// Of a tilt psi about z the inner groove centre moves by psi cos b (x_row, radially; -+R_c, axially): with s = +-1 the row's direction, along the contact's normal by
// psi cos b (x_row cos phi - s R_c sin phi), across it by psi cos b (x_row sin phi + s R_c cos phi). So, with sum cos^2 b = Z/2, a row's tilting stiffness is
//   Z/2 [ 1.5 K delta^0.5 (x_row cos phi - s R_c sin phi)^2 + K delta^1.5 / |B| (x_row sin phi + s R_c cos phi)^2 ];
// both rows of a pair are alike: x_row s > 0 for X, < 0 for O.
//
// THE DEEP-GROOVE RING under its weight W hangs on the one ball below it: K (s - clearance)^1.5 = W.
#include <gtest/gtest.h>

#include "bearing/statics/ring_equilibrium.h"
#include "numerical_derivative.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

BallRowOutput evaluate(const std::vector<BallRowGeometry>& rows, const BallRowInput& in) {
  BallRowOutput sum{};
  for (const auto& g : rows) {
    BallRowOutput out;
    BallRow(g, {}).evaluate(in, out);
    sum.force_x += out.force_x;
    sum.force_y += out.force_y;
    sum.force_z += out.force_z;
    sum.moment_y += out.moment_y;
    sum.moment_z += out.moment_z;
  }
  return sum;
}

double axial_stiffness(const std::vector<BallRowGeometry>& rows) {
  return -derivative(
      [&](double x) {
        BallRowInput in;
        in.displacement.x = x;
        return evaluate(rows, in).force_x;
      },
      1e-8);
}

TEST(BallRow, AxialStiffnessOfA15DegreePairIsTheCatalogues) {
  const auto one = row(23, 8.731e-3, 85e-3, 15 * deg, steel);
  printf("preload [N]  catalogue [N/um]  model [N/um]\n");
  for (const auto& [preload, catalogue] : {std::pair{100., 59.}, {200., 79.}, {490., 119.}, {980., 168.}}) {
    const double stiffness = axial_stiffness(pair(one, preload)) * 1e-6;
    printf("%11.0f  %16.0f  %12.2f  %+.1f %%\n", preload, catalogue, stiffness, 100. * (stiffness / catalogue - 1.));
    EXPECT_NEAR(stiffness, catalogue, 0.04 * catalogue) << "N/um";
  }
}

TEST(BallRow, PreloadIsTheAxialLoadOfAnUndisplacedRow) {
  for (const auto& rows : {angular_contact_pair(290.), pair(row(23, 8.731e-3, 85e-3, 15 * deg, steel), 980.)}) {
    const double preload = rows.size() == 2 && rows[0].contact_angle > 20 * deg ? 290. : 980.;
    BallRowOutput out;
    BallRow(rows[1], {}).evaluate({}, out);
    EXPECT_NEAR(out.force_x, -preload, 1e-7 * preload) << "N, pushed back by the row that motion towards +x loads";
    BallRow(rows[0], {}).evaluate({}, out);
    EXPECT_NEAR(out.force_x, preload, 1e-7 * preload) << "N";
    EXPECT_NEAR(evaluate(rows, {}).force_x, 0., 1e-9 * preload) << "N: the pair is in balance";
  }
}

TEST(BallRow, InnerGrowthRaisesThePreloadOfAnXPair) {
  const auto rows = angular_contact_pair(290.);
  const auto& g = rows[1];
  const double A = 0.04 * 9.525e-3;
  const auto load = [&](double growth) {
    BallRowInput in;
    in.radial_growth = growth;
    BallRowOutput out;
    BallRow(g, {}).evaluate(in, out);
    const double Br = A * std::cos(25 * deg) + growth, Bx = A * std::sin(25 * deg) + g.preload_offset,
                 B = std::hypot(Br, Bx);
    EXPECT_NEAR(-out.force_x, 23 * g.stiffness * std::pow(B - A, 1.5) * Bx / B, 1e-8 * 290.) << "N";
    return -out.force_x;
  };
  printf("inner growth [um]  preload [N]\n");
  for (const double growth : {0., 1.4, 5.}) printf("%17.1f  %11.1f\n", growth, load(growth * um));
  // docs/theory/model.md quotes rounded estimates: 3 % covers their digits and the choice of Hertz constant.
  EXPECT_NEAR(load(1.4 * um), 590., 0.03 * 590.) << "N";
  EXPECT_NEAR(load(5. * um), 1630., 0.03 * 1630.) << "N";
}

TEST(BallRow, OArrangementResistsTiltMoreThanX) {
  const auto tilt_stiffness = [&](Pair arrangement) {
    return -derivative(
        [&](double psi) {
          BallRowInput in;
          in.displacement.psi_z = psi;
          return evaluate(angular_contact_pair(290., arrangement), in).moment_z;
        },
        1e-6);
  };
  const double X = tilt_stiffness(Pair::X), O = tilt_stiffness(Pair::O);
  const auto g = angular_contact_pair(290.)[1];
  const double A = 0.04 * 9.525e-3, Br = A * std::cos(25 * deg), Bx = A * std::sin(25 * deg) + g.preload_offset,
               B = std::hypot(Br, Bx);
  const double R_c = 42.5e-3 + 0.02 * 9.525e-3 * std::cos(25 * deg), c = Br / B, s = Bx / B, delta = B - A;
  const auto expected = [&](double x_row) {                         // of the pair, by its row that is loaded towards +x
    const double x = x_row + 0.02 * 9.525e-3 * std::sin(25 * deg);  // of the inner groove's centre
    return g.n_balls * g.stiffness * std::sqrt(delta) *
           (1.5 * std::pow(x * c - R_c * s, 2) + delta / B * std::pow(x * s + R_c * c, 2));
  };
  printf("tilting stiffness: X %.4g N m/rad, O %.4g N m/rad\n", X, O);
  EXPECT_GT(O, 3. * X);
  EXPECT_NEAR(X, expected(8e-3), 1e-7 * X) << "N m/rad";
  EXPECT_NEAR(O, expected(-8e-3), 1e-7 * O) << "N m/rad";
}

TEST(RingEquilibrium, DeepGrooveRingHangsOnItsLowestBall) {
  const auto g = deep_groove_row();
  const double W = 0.21 * 9.81;
  const auto place = ring_equilibrium({BallRow(g, {})}, {.y = -W});
  EXPECT_NEAR(place.y, -(19 * um + std::pow(W / g.stiffness, 2. / 3.)), 1e-13) << "m";
  EXPECT_NEAR(place.y, -19.287 * um, 0.001 * um) << "m";
  EXPECT_NEAR(place.z, 0., 1e-12) << "m";
}

TEST(RingEquilibrium, DeepGrooveRingFindsItsPlaceUnderWeightFromAnyDirection) {
  // On one ball, then sliding sideways onto the next: never further than the clearance over cos(pi/Z) and the balls' give.
  const auto g = deep_groove_row();
  const double W = 0.21 * 9.81;
  for (double turn = -180. * deg; turn < 180. * deg; turn += 3.7 * deg) {
    const double y = W * std::cos(turn), z = W * std::sin(turn);
    BallRowInput in;
    in.displacement = ring_equilibrium({BallRow(g, {})}, {.y = y, .z = z});
    const auto out = evaluate({g}, in);
    EXPECT_NEAR(out.force_y, -y, 2e-6 * W) << "N, " << turn / deg << " deg";
    EXPECT_NEAR(out.force_z, -z, 2e-6 * W) << "N, " << turn / deg << " deg";
    EXPECT_LT(std::hypot(in.displacement.y, in.displacement.z), 19 * um / std::cos(pi / 14) + 0.3 * um) << "m";
  }
}

TEST(RingEquilibrium, BallsCarryTheForceInAnyDirection) {
  for (const auto& rows : {std::vector{deep_groove_row()}, angular_contact_pair(290.)})
    for (const auto& [y, z] : {std::pair{-2.06, 0.}, {-3., 40.}, {100., -500.}}) {
      std::vector<BallRow> balls;
      for (const auto& g : rows) balls.emplace_back(g, std::vector<RaceWave>{});
      const auto place = ring_equilibrium(balls, {.y = y, .z = z});
      BallRowInput in;
      in.displacement = place;
      const auto out = evaluate(rows, in);
      EXPECT_NEAR(out.force_y, -y, 1e-7 * std::hypot(y, z)) << "N";
      EXPECT_NEAR(out.force_z, -z, 1e-7 * std::hypot(y, z)) << "N";
    }
  EXPECT_EQ(ring_equilibrium({BallRow(deep_groove_row(), {})}, {}).y, 0.);
}

}  // namespace
}  // namespace rotordrop
