// Local temperature and wear from a rub under prescribed motions. Archard: a surface loses k integral F |v| dt; spread over what passes the band.
#include "machine/heat/local_rub.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "laws/heat/moving_band.h"

namespace {

using namespace rotordrop;
using std::numbers::pi;

LocalRubSettings steel() {
  LocalRubSettings s;
  s.surfaces.bore = {0.035, 45., 3.7e6, 0.004};
  s.surfaces.rotor_radius = 0.03475;
  s.surfaces.rotor_conductivity = 45.;
  s.surfaces.rotor_capacity = 3.7e6;
  s.surfaces.half_width = 0.003;
  s.surfaces.axial_width = 0.02;
  s.hertz_width_per_root = 0.004 / std::sqrt(5000.);  // 4 mm at 5 kN
  s.bore_wear = 1e-14;
  s.rotor_wear = 3e-14;
  return s;
}

/// Constant force [N] and slip from 1 ms to 4 ms with mu = 0.1; `share` of the heat into the ring.
RubRecord rub(double force, double slip, double share, const std::function<double(double)>& ring,
              const std::function<double(double)>& contact, double rotor_speed) {
  RubRecord r;
  for (int i = 0; i <= 120; ++i) {
    const double t = i * 50e-6, rubbed = std::clamp(t - 1e-3, 0., 3e-3);
    r.times.push_back(t);
    r.joules_into_ring.push_back(share * 0.1 * force * slip * rubbed);
    r.joules_into_rotor.push_back((1. - share) * 0.1 * force * slip * rubbed);
    r.ring_angle.push_back(ring(t));
    r.contact_angle.push_back(contact(t));
    r.rotor_angle.push_back(rotor_speed * t);
    r.impulse.push_back(force * rubbed);
    r.slip_speed.push_back(slip);
  }
  return r;
}

const auto at_rest = [](double) { return 0.; };

TEST(LocalRub, StatesOneTemperatureAndItsBounds) {
  const auto s = steel();
  const auto rub_heat = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  const LocalRub r = local_rub(rub_heat, s);
  const double heat = 0.1 * 5000. * 55. * 3e-3;
  EXPECT_NEAR(r.stated.half_width, 0.004, 1e-12);
  EXPECT_LT(r.stated.difference_then, 1e-9 * r.stated.bore);
  EXPECT_NEAR(r.stated.heat, heat, 1e-9 * heat);
  EXPECT_NEAR(r.stated.heat_into_ring + r.stated.heat_into_rotor, heat, 1e-12 * heat);
  // At rest the fixed share is a half space under constant flux; the fixed band of 6 mm concentrates it 8/6 times.
  const double q = 0.1 * 5000. * 55. / (2. * 0.004 * 0.02), fixed = 0.66 * surface_rise(q, 3e-3, 45., 3.7e6);
  EXPECT_NEAR(r.other_share.bore, fixed, 2e-3 * fixed);
  EXPECT_NEAR(r.other_both.bore, fixed * 8. / 6., 3e-3 * fixed);
  EXPECT_NEAR(r.bore_rise_high, r.other_both.bore, 1e-12 * fixed);
  EXPECT_LT(r.stated.bore, 0.6 * fixed) << "the rotor takes most of it";
  // Not above what a rotor that takes all has at the rear edge, a temperature which both have in the end.
  const double limit = 2. * q * std::sqrt(0.008 / (pi * 55.)) / std::sqrt(45. * 3.7e6);
  EXPECT_LT(r.stated.bore, limit);
  EXPECT_GT(r.stated.bore, 0.6 * limit);
  EXPECT_NEAR(r.stated.rotor, r.stated.bore, 0.1 * r.stated.bore) << "K, largest of each over time";
  EXPECT_LE(r.bore_rise_low, r.stated.bore);
  EXPECT_NEAR(r.valid_until, 0.004 * 0.004 * 3.7e6 / (4. * 45.), 1e-12);
}

TEST(LocalRub, ByItsSettingsTakesTheOtherBandOrShareFirst) {
  auto s = steel();
  const auto record = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  const LocalRub usual = local_rub(record, s);
  s.by_hertz = false;
  s.is_one_temperature = false;
  const LocalRub other = local_rub(record, s);
  EXPECT_EQ(other.stated.bore, usual.other_both.bore);
  EXPECT_EQ(other.other_both.bore, usual.stated.bore);
  EXPECT_NEAR(other.bore_rise_high, usual.bore_rise_high, 1e-9);
}

TEST(LocalRub, WithoutContactHasNothing) {
  const LocalRub r = local_rub(rub(0., 55., 0.66, at_rest, at_rest, 1600.), steel());
  EXPECT_EQ(r.stated.bore, 0.);
  EXPECT_TRUE(std::isnan(r.stated.time));
  EXPECT_EQ(r.bore_rise_high, 0.);
  EXPECT_EQ(r.wear.bore_depth, 0.);
}

// Ring at rest: the band's 8 mm lose all evenly. The rotor goes 3e-3 s x 55 m/s = 165 mm under it, 0.76 turns: even but at its ends.
TEST(LocalRub, LeavesTheHeatOfShouldersOut) {
  // The force in the bore rubs with mu = 0.1 at most; four times as much heat was recorded.
  auto s = steel();
  const auto alone = local_rub(rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475), s);
  auto with_shoulders = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  for (auto* list : {&with_shoulders.joules_into_ring, &with_shoulders.joules_into_rotor})
    for (double& joules : *list) joules *= 5.;
  EXPECT_GT(local_rub(with_shoulders, s).stated.bore, 4.9 * alone.stated.bore);
  s.largest_friction = 0.1;
  const auto found = local_rub(with_shoulders, s);
  EXPECT_NEAR(found.stated.bore, alone.stated.bore, 1e-9 * alone.stated.bore);
  EXPECT_NEAR(found.other_share.bore, alone.other_share.bore, 1e-9 * alone.other_share.bore);
  EXPECT_NEAR(found.stated.heat, alone.stated.heat, 1e-9 * alone.stated.heat);
  EXPECT_EQ(found.wear.sliding_work, alone.wear.sliding_work);
}

TEST(LocalRub, IsNotDisturbedByAnImpulseThatFallsByRounding) {
  const auto clean = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  auto rounded = clean;
  for (std::size_t i = 1; i < rounded.impulse.size(); i += 2) rounded.impulse[i] -= 1e-15 * rounded.impulse.back();
  for (const bool has_shoulders : {false, true}) {
    auto s = steel();
    if (has_shoulders) s.largest_friction = 0.1 * (1. + 1e-9);
    const auto expected = local_rub(clean, s), found = local_rub(rounded, s);
    EXPECT_GT(expected.stated.bore, 1.);
    // A row has 1/60 of the impulse, of which 1e-15 of the whole is 6e-14.
    EXPECT_NEAR(found.stated.bore, expected.stated.bore, 1e-9 * expected.stated.bore) << has_shoulders;
    EXPECT_NEAR(found.stated.heat, expected.stated.heat, 1e-9 * expected.stated.heat);
  }
}

TEST(LocalRub, WearsByArchardsLawAndLosesItsVolume) {
  const auto s = steel();
  const LocalRub r = local_rub(rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475), s);
  const double work = 5000. * 55. * 3e-3;
  EXPECT_NEAR(r.wear.sliding_work, work, 1e-9 * work) << "N m";
  EXPECT_NEAR(r.wear.bore_volume, 1e-14 * work, 1e-9 * 1e-14 * work);
  EXPECT_NEAR(r.wear.rotor_volume, 3e-14 * work, 1e-9 * 3e-14 * work);
  EXPECT_NEAR(r.wear.bore_depth, 1e-14 * work / (0.008 * 0.02), 1e-9 * r.wear.bore_depth);
  EXPECT_NEAR(r.wear.rotor_depth, 3e-14 * work / (0.165 * 0.02), 1e-9 * r.wear.rotor_depth);
  EXPECT_NEAR(r.wear.bore_mean_depth, 1e-14 * work / (2. * pi * 0.035 * 0.02), 1e-9 * r.wear.bore_mean_depth);
  EXPECT_NEAR(r.wear.rotor_mean_depth, 3e-14 * work / (2. * pi * 0.03475 * 0.02), 1e-9 * r.wear.rotor_mean_depth);
}

// Archard's law does not know friction.
TEST(LocalRub, WithoutFrictionWearsAsMuchAndStaysCold) {
  const auto s = steel();
  const auto with = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  const LocalRub expected = local_rub(with, s);
  for (const double friction : {0., 1e-300, 1e-20}) {  // times that of the record
    auto without = with;
    for (auto* ledger : {&without.joules_into_ring, &without.joules_into_rotor})
      for (double& joules : *ledger) joules *= friction;
    const LocalRub r = local_rub(without, s);
    EXPECT_EQ(r.wear.bore_depth, expected.wear.bore_depth) << friction;
    EXPECT_EQ(r.wear.rotor_depth, expected.wear.rotor_depth) << friction;
    EXPECT_EQ(r.stated.bore, 0.) << friction;
    EXPECT_EQ(r.stated.share_to_ring, 0.) << friction;
  }
}

TEST(LocalRub, ARingThatTurnsSpreadsItsWear) {
  const auto s = steel();
  const LocalRub r = local_rub(rub(
                                   5000., 20., 0.66, [](double t) { return 1000. * t; }, at_rest, 1600.),
                               s);
  // 3 rad under a band of 8/35 rad: what a place gets is the band's work over the way.
  const double work = 5000. * 20. * 3e-3;
  EXPECT_NEAR(r.wear.bore_depth, 1e-14 * work / (3. * 0.035 * 0.02), 2e-3 * r.wear.bore_depth);
}

TEST(LocalRub, HeatOfBristlesThatRecoverIsNoContact) {
  // A ten-millionth of an interval's heat a millisecond after the contact, with what rounding leaves of the impulse.
  const auto s = steel();
  const auto plain = rub(5000., 55., 0.66, at_rest, at_rest, 55. / 0.03475);
  auto recovering = plain;
  for (std::size_t i = 101; i < recovering.times.size(); ++i) {
    recovering.joules_into_ring[i] += 1e-7;
    recovering.impulse[i] += 2e-13;
  }
  const LocalRub without = local_rub(plain, s), with = local_rub(recovering, s);
  EXPECT_NEAR(with.stated.share_to_ring, without.stated.share_to_ring, 1e-6) << "1e-7 of 8.25 J";
  EXPECT_EQ(with.stated.bore, without.stated.bore) << "K";
}

}  // namespace
