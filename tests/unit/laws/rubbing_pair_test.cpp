// Two surfaces with one temperature where they rub. Closed forms, e = sqrt(k rho c):
//  - A ring at rest under a rotor that passes fast is a half space under the flux q, cooled by a film: with one piece across the band the rotor's
//    surface (at the piece's middle, age b/v) is q_rotor/h_f with 1/h_f = 2 sqrt(b/v)/(e sqrt(pi)), so the ring follows (Carslaw & Jaeger 2.7, by Laplace)
//      T(t) = (q/h_f) [1 - exp(a^2 t) erfc(a sqrt(t))],  a = h_f/e.
//  - Long after, a ring at rest takes nothing more, and has under each piece the temperature of a rotor that takes all:
//      T(s) = 2 q sqrt(s/(pi v))/e,  s from the edge at which the rotor's material enters.
//  - At once, the ring takes nearly all: T = 2 q sqrt(t/pi)/e.
//  - Both pass in steady state in one direction: share of the ring 1/(1 + (e_rotor/e_ring) sqrt(v_rotor/v_ring)) (Jaeger), 1/2 in synchrony.
#include "laws/heat/rubbing_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "laws/arc_cells.h"

namespace {

using namespace rotordrop;
using std::numbers::pi;

const RubbedBody steel = {0.035, 45., 3.7e6};
constexpr double width = 0.02, b = 0.003, step = 50e-6;

RubbingPair::Options options(std::size_t n_pieces) {
  RubbingPair::Options o;
  o.n_pieces = n_pieces;
  o.axial_width = width;
  o.shortest_interval = step;
  o.duration = 0.1;
  return o;
}

/// Constant heat rate [W], band at rest in space, surfaces with constant speeds [m/s]; to the time end.
template <class Watch>
void rub(RubbingPair& pair, const RubbedBody& ring, const RubbedBody& rotor, double watts, double v_ring,
         double v_rotor, double end, Watch&& watch, double share = 0.) {
  const int n = static_cast<int>(std::lround(end / step));
  for (int i = 1; i <= n; ++i) {
    const double t = i * step;
    pair.advance(t, {watts * step, b, 0.3, v_ring * t / ring.radius, v_rotor * t / rotor.radius}, {&share, 1});
    watch(t);
  }
}

double flux(double watts) { return watts / (2. * b * width); }

TEST(RubbingPair, RingAtRestUnderAFastRotorIsAHalfSpaceCooledByAFilm) {
  const double watts = 2e4, v = 55., q = flux(watts), e = steel.effusivity();
  const double film = e * std::sqrt(pi) / (2. * std::sqrt(b / v)), a = film / e;
  RubbingPair pair(steel, steel, options(1), 0.);
  rub(pair, steel, steel, watts, 0., v, 3.8e-3, [&](double t) {  // less than a turn of the rotor
    const double expected = q / film * (1. - std::exp(a * a * t) * std::erfc(a * std::sqrt(t)));
    // The flux changes fast at first: implicit steps are first order in step/t there.
    if (t > 0.5e-3) {
      EXPECT_NEAR(pair.state().ring_rise, expected, 0.02 * expected) << t;
    }
    EXPECT_LT(pair.state().largest_difference, 1e-9 * expected);
  });
}

TEST(RubbingPair, RingAtRestEndsWithTheTemperatureOfARotorThatTakesAll) {
  const double watts = 2e4, v = 55., q = flux(watts), e = steel.effusivity();
  const std::size_t n = 12;
  RubbedBody rotor = steel;
  rotor.radius = 3.5;  // no material of it comes back warm in this time
  RubbingPair pair(steel, rotor, options(n), 0.);
  rub(pair, steel, rotor, watts, 0., v, 0.1, [](double) {});
  // In the middle of the last piece. The share that is left falls with 1/sqrt(t).
  const double expected = 2. * q * std::sqrt((2. * b - b / static_cast<double>(n)) / (pi * v)) / e;
  EXPECT_NEAR(pair.state().ring_rise, expected, 0.04 * expected);
  EXPECT_LT(pair.state().share_to_ring, 0.04);
}

TEST(RubbingPair, RingAtRestTakesNearlyAllAtOnce) {
  // A rotor at rest, too, would share evenly; here it brings no cold material for a time that is long against the step.
  RubbedBody insulator = steel;
  insulator.conductivity = 1e-6;
  RubbingPair pair(steel, insulator, options(12), 0.);
  rub(pair, steel, insulator, 2e4, 0., 0., 2e-3, [&](double t) {
    const double expected = 2. * flux(2e4) * std::sqrt(t / pi) / steel.effusivity();
    // The ring's memory is met to 4e-4, and the insulator, with 1.5e-4 of the steel's effusivity, takes a part as small.
    EXPECT_NEAR(pair.state().ring_rise, expected, 1e-3 * expected);
    EXPECT_GT(pair.state().share_to_ring, 0.999);
  });
}

TEST(RubbingPair, SurfacesThatPassInSteadyStateShareAsJaegerSays) {
  RubbedBody rotor = steel;
  rotor.conductivity = 30.;
  for (const double v_ring : {55., 30.}) {
    RubbingPair pair(steel, rotor, options(12), 0.);
    // Until the ring has turned less than once, so that no material comes back warm; the band's length passes in 0.1 and 0.2 ms, not many steps,
    // so that the ring's memory of the steps before enters.
    rub(pair, steel, rotor, 1e4, v_ring, 55., 3e-3, [](double) {});
    const double ratio = rotor.effusivity() / steel.effusivity();
    EXPECT_NEAR(pair.state().share_to_ring, 1. / (1. + ratio * std::sqrt(55. / v_ring)), 0.03) << v_ring;
    EXPECT_LT(pair.state().largest_difference, 1e-9 * pair.state().ring_rise);
  }
  RubbingPair synchronous(steel, steel, options(12), 0.);
  rub(synchronous, steel, steel, 1e4, 55., 55., 3e-3, [](double) {});
  // The band's length passes in two steps, as above.
  EXPECT_NEAR(synchronous.state().share_to_ring, 0.5, 0.01);
}

// The same equations by another way: 160 even pieces, the ring's memory as the exact sum of its fluxes' differences (no exponentials, no cells).
TEST(RubbingPair, AgreesWithADirectSolutionOfBothIntegralEquations) {
  const double watts = 2e4, v = 40., q = flux(watts), e = steel.effusivity(), per_flux = 2. / (std::sqrt(pi) * e);
  const std::size_t n = 160, n_steps = 40;
  const double dt = 2e-3 / n_steps, h = 2. * b / n;
  std::vector<std::vector<double>> ring(n_steps, std::vector<double>(n));
  double hottest = 0., total = 0.;
  for (std::size_t i = 0; i < n_steps; ++i) {
    double sum = 0.;
    const double age = static_cast<double>(i + 1) * dt;
    const auto root_age = [&](double way) { return std::sqrt(std::min(std::max(way, 0.) / v, age)); };
    for (std::size_t k = 0; k < n; ++k) {
      double memory = 0.;
      for (std::size_t m = 0; m < i; ++m)
        memory += per_flux * ring[m][k] *
                  (std::sqrt(static_cast<double>(i + 1 - m) * dt) - std::sqrt(static_cast<double>(i - m) * dt));
      double rotor = 0.;
      for (std::size_t l = 0; l < k; ++l) {
        const double way = static_cast<double>(k - l) * h;
        rotor += per_flux * (q - ring[i][l]) * (root_age(way + 0.5 * h) - root_age(way - 0.5 * h));
      }
      const double own_rotor = per_flux * root_age(0.5 * h), own_ring = per_flux * std::sqrt(dt);
      ring[i][k] = (rotor + own_rotor * q - memory) / (own_rotor + own_ring);
      sum += ring[i][k];
      hottest = std::max(hottest, memory + own_ring * ring[i][k]);
    }
    total += sum * h * width * dt;
  }
  RubbingPair pair(steel, steel, options(12), 0.);
  double reached = 0.;
  rub(pair, steel, steel, watts, 0., v, 2e-3, [&](double) { reached = std::max(reached, pair.state().ring_rise); });
  // Twelve pieces end half a piece before the edge, 2 % short of its square root; cells of the ring are not the pieces.
  EXPECT_NEAR(reached, hottest, 0.04 * hottest);
  EXPECT_NEAR(pair.heat_into_ring(), total, 0.01 * total);
  // The other way round it is the same but for the cells, which begin elsewhere.
  RubbingPair mirrored(steel, steel, options(12), 0.);
  double mirrored_reached = 0.;
  rub(mirrored, steel, steel, watts, 0., -v, 2e-3,
      [&](double) { mirrored_reached = std::max(mirrored_reached, mirrored.state().ring_rise); });
  EXPECT_NEAR(mirrored_reached, hottest, 0.04 * hottest);
  EXPECT_NEAR(mirrored.heat_into_ring(), total, 0.01 * total);
}

TEST(RubbingPair, KeepsEveryJoule) {
  RubbingPair pair(steel, steel, options(12), 0.);
  double given = 0.;
  for (int i = 1; i <= 400; ++i) {
    const double t = i * step, heat = i % 60 < 40 ? 1. + 0.5 * std::sin(0.3 * i) : 0.;
    if (heat == 0.)
      pair.advance(t, 2e3 * t * t, 1600. * t);
    else
      pair.advance(t, {heat, b, -3. * t, 2e3 * t * t * 10., 1600. * t});
    given += heat;
  }
  const auto cells = pair.ring().heat(0);
  const double in_cells = std::accumulate(cells.begin(), cells.end(), 0.);
  EXPECT_NEAR(pair.heat_into_ring() + pair.heat_into_rotor(), given, 1e-12 * given);
  EXPECT_NEAR(in_cells, pair.heat_into_ring(), 1e-12 * given);
}

TEST(RubbingPair, RotorBringsBackWhatEarlierTurnsLeft) {
  // Ring as good as insulated: all heat to the rotor, four turns of it. The band's heat of one turn, even over the circle, q_1 in the time of a turn.
  RubbedBody insulator = steel;
  insulator.conductivity = 1e-6;
  const double v = 55., watts = 1e4, turn = 2. * pi * steel.radius / v;
  RubbingPair::Options o = options(12);
  o.divisions = {RubDivision::one_temperature, RubDivision::given};  // the given share is none
  RubbingPair pair(insulator, steel, o, 0.);
  std::vector<double> rise;
  rub(pair, insulator, steel, watts, 0., v, 0.02, [&](double) {
    rise.push_back(pair.state().rotor_rise);
    // The insulator, with 1.5e-4 of the steel's effusivity, takes some 1e-4 of the heat.
    EXPECT_NEAR(pair.state(1).rotor_rise, rise.back(), 3e-4 * rise.back());
  });
  const double first = 2. * flux(watts) * std::sqrt((2. * b - b / 12.) / (pi * v)) / steel.effusivity();
  // Within the first turn only the share of the insulator differs.
  EXPECT_NEAR(rise[40], first, 1e-3 * first);
  // Each point had a pulse of watts turn/(2 pi r w) joules per area, turns ago: T = sum J/(e sqrt(pi t_j)), t_j = j turn.
  const double pulse = watts * turn / (2. * pi * steel.radius * width);
  double left = 0.;
  for (int j = 1; static_cast<double>(j) * turn < 0.02; ++j)
    left += pulse / (steel.effusivity() * std::sqrt(pi * static_cast<double>(j) * turn));
  // A passage lasts 1/37 of a turn, and its heat is taken as that of an instant in it: up to 0.7 % of the last turn's part.
  EXPECT_NEAR(rise.back() - first, left, 0.01 * left);
}

// After a rub the surfaces roll on each other almost without heat, in intervals of an eighth to half a turn, so that the band comes to nearly the same
// places every few intervals: the hot ones cool, whatever heat goes across.
TEST(RubbingPair, RollingOnDoesNotHeatWithoutHeat) {
  for (const double ring_speed : {54.6, 55.2})
    for (const double long_step : {0.5e-3, 1e-3, 2e-3}) {
      RubbingPair::Options o = options(12);
      o.duration = 20.;
      RubbingPair pair(steel, steel, o, 0.);
      double t = 0., ring_angle = 0., rotor_angle = 0., hottest = 0.;
      const auto go = [&](double dt, double heat, double v_ring, double v_rotor) {
        t += dt;
        ring_angle += v_ring * dt / steel.radius;
        rotor_angle += v_rotor * dt / steel.radius;
        pair.advance(t, {heat, b, 0.01 * std::sin(30. * t), ring_angle, rotor_angle});
      };
      for (int i = 0; i < 60; ++i) {
        go(step, 2e4 * step, 0.5, 55.);
        hottest = std::max(hottest, pair.state().ring_rise);
      }
      for (int i = 0; i < 3000; ++i) {
        go(long_step, 3e-5, ring_speed, ring_speed + 0.1);
        ASSERT_LT(pair.state().ring_rise, hottest) << ring_speed << " m/s, " << long_step << " s, " << i;
      }
      EXPECT_LT(pair.state().ring_rise, 0.1 * hottest);
    }
}

TEST(RubbingPair, GivenShareHeatsTheRingByItAlone) {
  RubbingPair::Options o = options(12);
  o.divisions = {RubDivision::given};
  RubbingPair pair(steel, steel, o, 0.);
  rub(
      pair, steel, steel, 2e4, 0., 55., 3e-3,
      [&](double t) {
        const double expected = 0.66 * 2. * flux(2e4) * std::sqrt(t / pi) / steel.effusivity();
        // the ring's memory, met to 4e-4
        EXPECT_NEAR(pair.state().ring_rise, expected, 5e-4 * expected);
      },
      0.66);
  EXPECT_NEAR(pair.heat_into_ring(), 0.66 * 2e4 * 3e-3, 1e-9);
}

// Bit for bit: a division's numbers never meet another's. The ring is slow at first, then fast; the band comes round to places that are warm.
TEST(RubbingPair, FollowsSeveralDivisionsAsEachAlone) {
  const std::vector<RubDivision> divisions = {RubDivision::given, RubDivision::one_temperature, RubDivision::given};
  const std::vector<double> shares = {0.4, 0., 0.7};
  RubbingPair::Options o = options(12);
  o.divisions = divisions;
  RubbingPair together(steel, steel, o, 0.);
  std::vector<RubbingPair> alone;
  for (const RubDivision division : divisions) {
    o.divisions = {division};
    alone.emplace_back(steel, steel, o, 0.);
  }
  for (int i = 1; i <= 600; ++i) {
    const double t = i * step;
    const RubbingBand band{1. + 0.5 * std::sin(0.3 * i), b, -200. * t, 2e5 * t * t, 1600. * t};
    together.advance(t, band, shares);
    for (std::size_t d = 0; d < alone.size(); ++d) {
      alone[d].advance(t, band, {&shares[d], 1});
      const auto &one = together.state(d), &other = alone[d].state();
      ASSERT_EQ(one.ring_rise, other.ring_rise) << i << " " << d;
      ASSERT_EQ(one.rotor_rise, other.rotor_rise);
      ASSERT_EQ(one.largest_difference, other.largest_difference);
      ASSERT_EQ(one.share_to_ring, other.share_to_ring);
      ASSERT_EQ(together.heat_into_ring(d), alone[d].heat_into_ring());
      ASSERT_EQ(together.heat_into_rotor(d), alone[d].heat_into_rotor());
    }
  }
  EXPECT_GT(together.state(2).ring_rise, 1.2 * together.state(0).ring_rise);
}

}  // namespace
