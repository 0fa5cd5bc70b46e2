// Rings that bend, at rest.
//
// RIGID LIMIT: with harmonics 1e13 times as stiff the ball loads are those of a rigid ring to 1e-9.
// STIFFNESS is the numerical derivative of the forces, those the gradient of the energy.
// THE DYNAMICS' ROW, which statics do not use, has the same forces on ring and shapes.
// CALCULIX: TB1's inner ring as finite elements in three dimensions on 14 springs K (delta - clearance)^1.5, 5 kN at one line of the bore over a ball
// (validation/ring_bending_calculix.py): balls carry 3299, 944 (twice) N, rigid 1897, 1439, 409 N.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "../bearing/numerical_derivative.h"
#include "../bearing/test_bearings.h"
#include "bearing/statics/bearing_statics.h"
#include "bearing/statics/ring_equilibrium.h"
#include "integrate/equilibrium.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

const HuntCrossley contact{1.144e9, 10. / 9., 0.08};
constexpr double gap = 250e-6;

BentRings tb1_rings(RingBendingModel model, double stiffer = 1., bool has_outer = false) {
  RingSection s;
  s.inner_radius = 35e-3;
  s.outer_radius = 41.45e-3;
  s.width = 20e-3;
  s.grooves = {{0., 45e-3 + 0.02 * 11.906e-3, 0.52 * 11.906e-3}};
  s.E = 2e11;
  s.nu = 0.3;
  s.rho = 7800.;
  BentRings b;
  b.model = model;
  b.inner = ring_harmonics(s, 12);
  if (has_outer) {
    b.outer = b.inner;
    for (auto& h : b.outer) h.stiffness += 1e9;
  }
  for (auto* ring : {&b.inner, &b.outer})
    for (auto& h : *ring) h.stiffness *= stiffer;
  b.arc = ArcContact(contact.K, contact.n, gap);
  return b;
}

std::vector<double> ball_loads(const std::optional<BentRings>& bending, const std::vector<BallRowGeometry>& rows,
                               const Force& load, double cage_angle = 0.) {
  RingSurroundings around;
  around.cage_angle = cage_angle;
  BearingEquilibrium system(BentRingStatics(RingStatics(rows, around), bending), load, {contact, gap});
  std::vector<double> x = system.start();
  const auto result = find_equilibrium(system, x);
  EXPECT_TRUE(result.found) << result.residual;
  std::vector<double> loads;
  for (const auto& row : report_ring(system.bent_ring(), system.ring_unknowns(x)).rows)
    for (const auto& ball : row.balls) loads.push_back(ball.inner.load);
  return loads;
}

double largest(const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); }

TEST(BentRing, BecomesTheRigidOneAsItGrowsStiff) {
  const Force load{.y = -4000., .z = 1200.};
  for (const auto& rows : {std::vector{deep_groove_row()}, angular_contact_pair()}) {
    const auto rigid = ball_loads({}, rows, load);
    for (const auto model : {RingBendingModel::point, RingBendingModel::arc}) {
      const auto stiff = ball_loads(tb1_rings(model, 1e13), rows, load);
      for (std::size_t i = 0; i < rigid.size(); ++i)
        EXPECT_NEAR(stiff[i], rigid[i], 1e-9 * largest(rigid)) << "ball " << i << ", N";
    }
  }
}

TEST(BentRing, SharesALoadAsThreeDimensionalElementsOnSprings) {
  const std::vector rows = {deep_groove_row()};
  const auto rigid = ball_loads({}, rows, {.y = 5000.});
  EXPECT_NEAR(rigid[0], 1897., 1.) << "N: the peer's balls";
  const auto bent = ball_loads(tb1_rings(RingBendingModel::point), rows, {.y = 5000.});
  EXPECT_NEAR(bent[0], 3299., 0.03 * 3299.) << "N";
  EXPECT_NEAR(bent[1], 944., 0.03 * 3299.) << "N";
  EXPECT_NEAR(bent[13], bent[1], 1e-6) << "N";
  EXPECT_LT(bent[2], 1.) << "N: the bent ring lifts off there";
  // Over an arc the ring is pressed less sharply, but it still bends.
  const auto arc = ball_loads(tb1_rings(RingBendingModel::arc), rows, {.y = 5000.});
  EXPECT_LT(arc[0], bent[0]);
  EXPECT_GT(arc[0], 1.3 * rigid[0]);
}

TEST(BentRing, HasTheForcesOfItsEnergyAndTheirDerivative) {
  for (const bool has_outer : {false, true}) {
    const BentRingStatics ring(RingStatics(angular_contact_pair(1500.), {}),
                               tb1_rings(RingBendingModel::arc, 1., has_outer));
    Eigen::VectorXd x(ring.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = ring.scales()[i] * std::sin(1.7 * static_cast<double>(i) + 0.3);
    const auto r = ring.reaction(x);
    const double energy_size = 1e-6 * 1000.;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const auto moved = [&](double t) {
        Eigen::VectorXd q = x;
        q[i] += t * ring.scales()[i];
        return q;
      };
      const double slope = derivative([&](double t) { return ring.reaction(moved(t)).energy; }, 1e-2);
      EXPECT_NEAR(slope, -r.force[i] * ring.scales()[i], 1e-6 * energy_size + 1e-7 * std::fabs(slope)) << i;
      for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double K = derivative([&](double t) { return -ring.reaction(moved(t)).force[k]; }, 1e-2);
        EXPECT_NEAR(K * ring.scales()[k], r.stiffness(k, i) * ring.scales()[i] * ring.scales()[k],
                    1e-6 * std::fabs(r.stiffness(i, i)) * ring.scales()[i] * ring.scales()[i] + 1e-9)
            << i << ", " << k;
      }
    }
  }
}

TEST(BentRing, TouchesTheRotorWithTheGradientOfAnEnergy) {
  for (const auto model : {RingBendingModel::point, RingBendingModel::arc}) {
    const auto bending = std::make_optional(tb1_rings(model));
    const Eigen::Index m = static_cast<Eigen::Index>(bending->n_inner());
    Eigen::VectorXd x(2 + m);
    x[0] = 200e-6;
    x[1] = -190e-6;
    for (Eigen::Index k = 0; k < m; ++k)
      x[2 + k] = 3e-6 / static_cast<double>(k + 1) * std::cos(1.3 * static_cast<double>(k));
    const auto at = [&](const Eigen::VectorXd& q) {
      return bore_reaction(contact, bending, gap, q.head<2>(), q.tail(m));
    };
    const auto r = at(x);
    ASSERT_GT(r.force, 100.);
    for (Eigen::Index i = 0; i < 2 + m; ++i) {
      const auto moved = [&](double t) {
        Eigen::VectorXd q = x;
        q[i] += 1e-6 * t;
        return q;
      };
      const double slope = derivative([&](double t) { return at(moved(t)).energy; }, 1e-2) / 1e-6;
      // Points that enter the arc have an infinite second derivative of their energy.
      EXPECT_NEAR(slope, r.gradient[i], 2e-4 * r.force) << i << ", N";
      if (model == RingBendingModel::arc) continue;
      for (Eigen::Index k = 0; k < 2 + m; ++k) {
        const double H = derivative([&](double t) { return at(moved(t)).gradient[k]; }, 1e-2) / 1e-6;
        EXPECT_NEAR(H, r.hessian(k, i), 1e-5 * r.hessian.cwiseAbs().maxCoeff()) << i << ", " << k << ", N/m";
      }
    }
  }
}

TEST(BentRing, HasTheForcesOfTheDynamicsRows) {
  for (const bool has_inertia : {false, true}) {
    auto rows = angular_contact_pair(1500.);
    const auto bending = tb1_rings(RingBendingModel::arc);
    RingSurroundings around;
    around.cage_angle = 0.7;
    around.has_inertia = has_inertia;
    around.speed = has_inertia ? 1200. : 0.;
    const BentRingStatics ring(RingStatics(rows, around), bending);
    Eigen::VectorXd x(ring.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = ring.scales()[i] * std::sin(2.1 * static_cast<double>(i) + 0.4);
    const Eigen::VectorXd expected = ring.reaction(x).force;
    BallRowInput in;
    in.displacement = {x[0], x[1], x[2], x[3], x[4]};
    in.cage_angle = 0.7;
    in.cage_cosine = std::cos(0.7);
    in.cage_sine = std::sin(0.7);
    in.ring_speed = around.speed;
    const std::vector<double> shape(x.data() + 5, x.data() + x.size()), rate(shape.size(), 0.);
    std::vector<double> force(shape.size(), 0.);
    in.shape = shape;
    in.shape_rate = rate;
    in.shape_force = force;
    double y = 0., axial = 0., energy = 0.;
    for (auto g : rows) {
      g.has_inertia = has_inertia;
      g.highest_harmonic = 12;
      const BallRow row(g, {});
      BallRowOutput out;
      row.evaluate(in, out);
      y += out.force_y;
      axial += out.force_x;
      energy += row.energy(in);
    }
    EXPECT_NEAR(y, expected[1], 1e-6 * expected.norm()) << "N";
    EXPECT_NEAR(axial, expected[0], 1e-6 * expected.norm()) << "N";
    double bend = 0.;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const double k_n = bending.inner[k / 2].stiffness;
      EXPECT_NEAR(force[k] - k_n * shape[k], expected[5 + static_cast<Eigen::Index>(k)], 1e-6 * expected.norm()) << "N";
      bend += 0.5 * k_n * shape[k] * shape[k];
    }
    if (!has_inertia) {
      EXPECT_NEAR(energy + bend, ring.reaction(x).energy, 1e-9 * bend) << "J";
    }
  }
}

TEST(BentRing, HasNoForceLeftWhereTheDynamicsStart) {
  // ring_equilibrium() has its own rows and its own search, and knows both rings by their series.
  double largest_bend = 0.;
  for (const bool has_outer : {false, true})
    for (const auto& rows : {angular_contact_pair(1500.), std::vector{deep_groove_row()}})
      for (const Force& load : {Force{300., -500., 100., 0., 0.}, Force{-200., -2000., 0., 3., -2.}}) {
        const auto bending = tb1_rings(RingBendingModel::arc, 1., has_outer);
        std::vector<double> series, of_inner, of_outer;
        for (std::size_t k = 0; k < bending.inner.size(); ++k) {
          const double inner = bending.inner[k].stiffness;
          const double both = has_outer ? 1. / (1. / inner + 1. / bending.outer[k].stiffness) : inner;
          for (int part = 0; part < 2; ++part) {
            series.push_back(both);
            of_inner.push_back(both / inner);
            if (has_outer) of_outer.push_back(both / bending.outer[k].stiffness);
          }
        }
        std::vector<BallRow> balls;
        for (auto g : rows) {
          g.highest_harmonic = 12;
          balls.emplace_back(g, std::vector<RaceWave>{});
        }
        RingSurroundings around;
        around.cage_angle = 0.7;
        const auto rest = ring_equilibrium(balls, load, true, around.cage_angle, series);
        const BentRingStatics ring(RingStatics(rows, around), bending);
        Eigen::VectorXd x(ring.size());
        x.head(5) << rest.x, rest.y, rest.z, rest.psi_y, rest.psi_z;
        for (std::size_t k = 0; k < series.size(); ++k) {
          x[5 + static_cast<Eigen::Index>(k)] = of_inner[k] * rest.shape[k];
          if (has_outer) x[5 + static_cast<Eigen::Index>(series.size() + k)] = -of_outer[k] * rest.shape[k];
        }
        Eigen::VectorXd left = ring.reaction(x).force;
        left.head(5) += Eigen::Matrix<double, 5, 1>(load.x, load.y, load.z, load.moment_y, load.moment_z);
        // The search leaves 1e-9 of the load, and of its moment at 43 mm; 10 times for the roundoff of two sums over the balls.
        const double enough = 1e-8 * std::hypot(load.x, load.y, load.z);
        for (Eigen::Index i = 0; i < left.size(); ++i)
          EXPECT_NEAR(left[i], 0., i == 3 || i == 4 ? 0.05 * enough : enough)
              << i << (has_outer ? ", both" : ", inner");
        largest_bend = std::max(largest_bend, x.tail(x.size() - 5).cwiseAbs().maxCoeff());
      }
  EXPECT_GT(largest_bend, 1e-6) << "m: rings bend";
}

TEST(BentRing, OnASoftBeddingTheOuterRingBendsTooAndLoadsConcentrateMore) {
  const std::vector rows = {deep_groove_row()};
  const auto stiff_outer = ball_loads(tb1_rings(RingBendingModel::point), rows, {.y = 5000.});
  const auto soft_outer = ball_loads(tb1_rings(RingBendingModel::point, 1., true), rows, {.y = 5000.});
  // Along the load the sums are equal; over all balls they differ by the loads' directions.
  EXPECT_NEAR(std::accumulate(soft_outer.begin(), soft_outer.end(), 0.) /
                  std::accumulate(stiff_outer.begin(), stiff_outer.end(), 0.),
              1., 0.02);
  EXPECT_GT(std::fabs(soft_outer[0] - stiff_outer[0]), 10.) << "N";
}

}  // namespace
}  // namespace rotordrop
