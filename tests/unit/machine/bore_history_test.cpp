// Local temperature of a bore under prescribed motions: swept arc, turns, and Carslaw & Jaeger's half space under constant heat,
//   T(t) = 2 q sqrt(t/(pi k rho c)).
#include "machine/heat/bore_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "laws/heat/moving_band.h"

namespace {

using namespace rotordrop;
using std::numbers::pi;

RubSurfaces steel_surfaces() {
  RubSurfaces s;
  s.bore = {0.035, 45., 3.7e6, 0.004};
  s.rotor_radius = 0.03475;
  s.rotor_conductivity = 45.;
  s.rotor_capacity = 3.7e6;
  s.half_width = 0.003;
  s.axial_width = 0.02;
  return s;
}

/// A rub from 1 ms to 3 ms with constant heat; `ring` and `contact` are angles over time.
RubRecord rub(double watts_ring, double watts_rotor, const std::function<double(double)>& ring,
              const std::function<double(double)>& contact, double rotor_speed, double end = 5e-3,
              double step = 50e-6) {
  RubRecord r;
  const int n = static_cast<int>(std::lround(end / step));
  for (int i = 0; i <= n; ++i) {
    const double t = i * step, rubbed = std::clamp(t - 1e-3, 0., 2e-3);
    r.times.push_back(t);
    r.joules_into_ring.push_back(watts_ring * rubbed);
    r.joules_into_rotor.push_back(watts_rotor * rubbed);
    r.ring_angle.push_back(ring(t));
    r.contact_angle.push_back(contact(t));
    r.rotor_angle.push_back(rotor_speed * t);
  }
  return r;
}

const auto at_rest = [](double) { return 0.; };

std::size_t row(const BoreHistory& h, double t) {
  for (std::size_t i = 0; i < h.times.size(); ++i)
    if (std::fabs(h.times[i] - t) < 1e-9) return i;
  ADD_FAILURE() << t;
  return 0;
}

TEST(BoreHistory, OfARingAtRestIsAHalfSpaceUnderConstantFlux) {
  const auto s = steel_surfaces();
  const double watts = 1e4, q = watts / (2. * s.half_width * s.axial_width);
  const auto h = bore_history(rub(watts, 0., at_rest, at_rest, 0.), s);
  for (const double t : {1.5e-3, 2e-3, 3e-3}) {
    const double expected = surface_rise(q, t - 1e-3, 45., 3.7e6);
    // The kernel of the history is met to 5e-4.
    EXPECT_NEAR(h.rise_at_contact[row(h, t)], expected, 1e-3 * expected);
    EXPECT_NEAR(h.largest_rise[row(h, t)], expected, 1e-3 * expected);
  }
  // Heat ends at 3 ms: the difference of two such rises.
  const double later = surface_rise(q, 3e-3, 45., 3.7e6) - surface_rise(q, 1e-3, 45., 3.7e6);
  EXPECT_NEAR(h.largest_rise[row(h, 4e-3)], later, 2e-3 * later);
  EXPECT_TRUE(std::isnan(h.rise_at_contact[row(h, 4e-3)]));
  EXPECT_TRUE(std::isnan(h.rise_at_contact[row(h, 1e-3)]));
}

TEST(BoreHistory, SpreadsTheSameHeatForItsMean) {
  const auto s = steel_surfaces();
  const auto h = bore_history(rub(
                                  1e4, 0., [](double t) { return 100. * t; }, at_rest, 0.),
                              s);
  const double q = 1e4 / (2. * pi * s.bore.radius * s.axial_width), expected = surface_rise(q, 2e-3, 45., 3.7e6);
  // The kernel of the history is met to 5e-4.
  EXPECT_NEAR(h.mean_rise[row(h, 3e-3)], expected, 5e-4 * expected);
}

// Ring from rest with 40 000 rad/s2, contact ahead with 10 rad/s: from the first row in contact to the last one, the spot goes
// over the ring by the ring's angle less the contact's.
TEST(BoreHistory, KnowsTheArcThatAPrescribedMotionSweeps) {
  const auto ring = [](double t) { return t > 1e-3 ? 0.5 * 4e4 * (t - 1e-3) * (t - 1e-3) : 0.; };
  const auto contact = [](double t) { return 3. + 10. * t; };
  const auto h = bore_history(rub(1e4, 0., ring, contact, 0.), steel_surfaces());
  const double first = 1.05e-3, last = 3e-3;
  // It turns back before it goes on, so the way is longer than its ends are apart: at t_0 = 1 ms + 0.25 ms the ring is as fast as the contact.
  const auto place = [&](double t) { return ring(t) - contact(t); };
  const double back = 1.25e-3, way = place(first) - place(back) + place(last) - place(back);
  EXPECT_NEAR(h.arc[row(h, last)], way, 1e-12);
  EXPECT_EQ(h.arc[row(h, 4e-3)], 0.);
  EXPECT_NEAR(h.ring_turns.back(), ring(5e-3) / (2. * pi), 1e-12);
  // What was heated: the way between its ends and the spot itself, to a cell (720 around) at each end.
  const double heated = place(last) - place(back) + 2. * 0.003 / 0.035;
  EXPECT_NEAR(h.heated_arc.back(), heated, 2. * 2. * pi / 720. + 0.005);
}

TEST(BoreHistory, CrossesTheAngleOfHalfATurnWithoutAJump) {
  const auto contact = [](double t) { return std::remainder(pi - 0.01 + 10. * t, 2. * pi); };
  const auto h = bore_history(rub(1e4, 0., at_rest, contact, 0.), steel_surfaces());
  EXPECT_NEAR(h.arc[row(h, 3e-3)], 10. * (3e-3 - 1.05e-3), 1e-12);
}

// The rotor passes at 55 m/s: Jaeger's band with its heat, the time since touching, and the speed of the spot over the rotor.
TEST(BoreHistory, GivesTheRotorsFlashAsAMovingBand) {
  const auto s = steel_surfaces();
  const double speed = 1600., watts = 5e3;
  const auto h = bore_history(rub(
                                  1e4, watts, at_rest, [](double t) { return -2. * t; }, speed),
                              s);
  MovingBand band;
  band.half_width = s.half_width;
  band.speed = (speed + 2.) * s.rotor_radius;
  band.flux = watts / (2. * s.half_width * s.axial_width);
  band.conductivity = 45.;
  band.capacity = 3.7e6;
  // The estimate is good to 4 % of the largest rise.
  EXPECT_NEAR(h.rotor_flash[row(h, 3e-3)], band.largest_rise(2e-3), 0.04 * band.largest_rise(2e-3));
  EXPECT_TRUE(std::isnan(h.rotor_flash[row(h, 0.5e-3)]));
}

TEST(BoreHistory, SeesNoContactInWhatALedgerGainsByRounding) {
  auto r = rub(1e4, 0., at_rest, at_rest, 0.);
  for (std::size_t i = 0; i < r.times.size(); ++i) r.joules_into_ring[i] += 1e-12 * static_cast<double>(i);
  const auto h = bore_history(r, steel_surfaces());
  EXPECT_TRUE(std::isnan(h.rise_at_contact[row(h, 0.5e-3)]));
  EXPECT_FALSE(std::isnan(h.rise_at_contact[row(h, 2e-3)]));
}

// Rows that are joined keep their heat, and so the temperature after it.
TEST(BoreHistory, OfALongRecordJoinsLaterRows) {
  const auto s = steel_surfaces();
  const auto ring = [](double t) { return 20. * t; };
  const auto r = rub(1e4, 0., ring, at_rest, 0., 20e-3);
  const auto all = bore_history(r, s), joined = bore_history(r, s, 100);
  EXPECT_EQ(all.times.size(), r.times.size());
  EXPECT_LE(joined.times.size(), 100u);
  EXPECT_EQ(joined.times.back(), r.times.back());
  // A joined row of 0.4 ms has the last 0.15 ms of the heat: all of it 9 us later in the mean, 3e-4 of the rise 18 ms after.
  EXPECT_NEAR(joined.mean_rise.back(), all.mean_rise.back(), 1e-3 * all.mean_rise.back());
  EXPECT_NEAR(joined.largest_rise.back(), all.largest_rise.back(), 1e-3 * all.largest_rise.back());
  // A ring that turns more than a radian in a few rows is followed row by row.
  const auto fast = rub(
      1e4, 0., [](double t) { return 3e4 * t; }, at_rest, 0., 20e-3);
  EXPECT_EQ(bore_history(fast, s, 100).times.size(), fast.times.size());
}

TEST(SteadyBand, OfAnUnmovedContactIsTheHalfSpaceUnderConstantFlux) {
  const auto s = steel_surfaces();
  const double expected = surface_rise(20. / (2e-3 * 2. * s.half_width * s.axial_width), 2e-3, 45., 3.7e6);
  // Within 4 % of the exact band, whose edges are far: sqrt(a t)/b = 0.05.
  EXPECT_NEAR(steady_band_rise(s, 20., 2e-3, 0.), expected, 0.04 * expected);
  EXPECT_EQ(steady_band_rise(s, 0., 0., 0.), 0.);
}

}  // namespace
