// Touchdown bearing: contact or none, growth, waves of the bore, what it reports.
//
// Penetration = e_r - (gap + growth of the bore - growth of the shaft) + wave of the bore, wave = A sin(m (contact angle - ring angle) + phase).
#include "bearing/touchdown_bearing.h"

#include <gtest/gtest.h>

#include <limits>

#include "../../verification/bearing/test_bearings.h"
#include "laws/ball_balance.h"
#include "laws/skidding.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

double observed(const TB& bearing, const SupportInput& in, const std::vector<double>& y, const std::string& name,
                std::size_t column = 0) {
  std::vector<double> rates(TB::n_state), ledger(TB::n_ledger), values(observed_size(bearing.observables()));
  SupportOutput out;
  out.observed = values;
  bearing.evaluate(in, y, rates, ledger, out);
  std::size_t at = 0;
  for (const auto& o : bearing.observables()) {
    if (o.name == name) return values[at + column];
    at += o.size;
  }
  ADD_FAILURE() << "there is no observable " << name;
  return 0.;
}

SupportInput journal_at(double y, double z) {
  SupportInput in;
  in.journal.y = y;
  in.journal.z = z;
  return in;
}

TEST(TouchdownBearing, GrowthOfTheBoreOpensTheGapAndGrowthOfTheShaftClosesIt) {
  const TB bearing(touchdown("TB", {deep_groove_row()}));
  const std::vector<double> y(TB::n_state, 0.);
  auto in = journal_at(-260 * um, 0.);
  EXPECT_NEAR(observed(bearing, in, y, "penetration"), 10 * um, 1e-15) << "m";
  in.growth.bore = 3 * um;
  EXPECT_NEAR(observed(bearing, in, y, "penetration"), 7 * um, 1e-15) << "m";
  EXPECT_NEAR(observed(bearing, in, y, "clearance"), 253 * um, 1e-15) << "m";
  in.growth.shaft = 5 * um;
  EXPECT_NEAR(observed(bearing, in, y, "penetration"), 12 * um, 1e-15) << "m";
  EXPECT_NEAR(observed(bearing, in, y, "contact_force"), 1.144e9 * std::pow(12 * um, 10. / 9.), 1e-6) << "N";
}

TEST(TouchdownBearing, DoesNothingToARotorThatDoesNotTouch) {
  auto data = touchdown("TB", {deep_groove_row()});
  data.bore_waves = {{2, 3 * um, 0.}};
  const TB bearing(data);
  const std::vector<double> y(TB::n_state, 0.);
  std::vector<double> rates(TB::n_state), ledger(TB::n_ledger);
  for (const auto& in : {journal_at(0., 0.), journal_at(100 * um, -200 * um), journal_at(-246 * um, 0.)}) {
    SupportOutput out;
    auto spinning = in;
    spinning.rotor_spin.speed = 1500.;
    spinning.journal.velocity_y = -3.;
    bearing.evaluate(spinning, y, rates, ledger, out);
    EXPECT_EQ(out.force_on_rotor.y, 0.);
    EXPECT_EQ(out.force_on_rotor.z, 0.);
    EXPECT_EQ(out.force_on_rotor.torque, 0.);
    EXPECT_EQ(out.heat.rub, 0.);
    EXPECT_FALSE(out.heat.is_in_contact);
  }
}

TEST(TouchdownBearing, WavesOfTheBoreTurnWithTheRing) {
  auto data = touchdown("TB", {deep_groove_row()});
  data.bore_waves = {{3, 2 * um, 0.4}};
  const TB bearing(data);
  std::vector<double> y(TB::n_state, 0.);
  for (const double direction : {0.3, 2., -2.5})
    for (const double ring : {0., 1., 30.}) {
      y[TB::ring_angle] = ring;
      const auto in = journal_at(260 * um * std::cos(direction), 260 * um * std::sin(direction));
      EXPECT_NEAR(observed(bearing, in, y, "penetration"), 10 * um + 2 * um * std::sin(3. * (direction - ring) + 0.4),
                  1e-15)
          << "m";
    }
}

TEST(TouchdownBearing, LetsANumberThatIsNoneThrough) {
  const TB bearing(touchdown("TB", {deep_groove_row()}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> y(TB::n_state, 0.), rates(TB::n_state), ledger(TB::n_ledger);
  SupportOutput out;
  bearing.evaluate(journal_at(nan, 0.), y, rates, ledger, out);
  EXPECT_TRUE(std::isnan(out.force_on_rotor.y));
  auto hot = journal_at(-260 * um, 0.);
  hot.growth.bore = nan;
  bearing.evaluate(hot, y, rates, ledger, out);
  EXPECT_TRUE(std::isnan(out.force_on_rotor.y));
  y[TB::ring_y] = nan;
  bearing.evaluate(journal_at(0., 0.), y, rates, ledger, out);
  EXPECT_TRUE(std::isnan(rates[TB::ring_vy]));
}

TEST(TouchdownBearing, CageTurnsAtItsShareOfTheRingsSpeed) {
  const TB bearing(touchdown("TB", {deep_groove_row()}));
  std::vector<double> y(TB::n_state, 0.), rates(TB::n_state), ledger(TB::n_ledger);
  y[TB::ring_spin] = 1000.;
  SupportOutput out;
  bearing.evaluate({}, y, rates, ledger, out);
  EXPECT_NEAR(rates[TB::cage_angle], 1000. * 78.094 / 180., 1e-9) << "rad/s: (d_m - d)/(2 d_m)";
  EXPECT_EQ(rates[TB::ring_angle], 1000.);
}

TEST(TouchdownBearing, FrictionTorqueOpposesTheRingEitherWay) {
  const TB bearing(touchdown("TB", {deep_groove_row()}));
  std::vector<double> y(TB::n_state), rates(TB::n_state), ledger(TB::n_ledger);
  bearing.initial_state(y);
  SupportOutput out;
  for (const double speed : {-1500., -1., 0., 1., 1500.}) {
    y[TB::ring_spin] = speed;
    bearing.evaluate({}, y, rates, ledger, out);
    EXPECT_EQ(rates[TB::ring_spin] > 0., speed < 0.);
    EXPECT_EQ(rates[TB::ring_spin]<0., speed> 0.);
  }
}

TEST(TouchdownBearing, ReportsAsManyNumbersAsItAnnounces) {
  for (const auto& rows : {std::vector{deep_groove_row()}, angular_contact_pair(290.)}) {
    const TB bearing(touchdown("TB", rows));
    const std::size_t n = observed_size(bearing.observables()), n_balls = observed_size(bearing.detailed_observables());
    EXPECT_EQ(n_balls, rows.size() * static_cast<std::size_t>(rows[0].n_balls));
    EXPECT_EQ(bearing.state_entries().size(), static_cast<std::size_t>(TB::n_state));
    EXPECT_EQ(bearing.ledger_entries().size(), static_cast<std::size_t>(TB::n_ledger));
    const double untouched = -12345.678;
    std::vector<double> y(TB::n_state), rates(TB::n_state, untouched), ledger(TB::n_ledger, untouched),
        values(n + 1, untouched), loads(n_balls + 1, untouched);
    bearing.initial_state(y);
    y[TB::ring_y] -= 30 * um;
    SupportOutput out;
    out.observed = {values.data(), n};
    out.observed_details = {loads.data(), n_balls};
    bearing.evaluate(journal_at(-260 * um, 30 * um), y, rates, ledger, out);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NE(values[i], untouched) << i;
    for (std::size_t i = 0; i < n_balls; ++i) EXPECT_NE(loads[i], untouched) << i;
    for (const double r : rates) EXPECT_NE(r, untouched);
    for (const double r : ledger) EXPECT_NE(r, untouched);
    EXPECT_EQ(values[n], untouched);
    EXPECT_EQ(loads[n_balls], untouched);
    for (const auto& o : bearing.observables()) {
      EXPECT_FALSE(o.unit.empty()) << o.name;
      EXPECT_EQ(o.columns.size(), o.size > 1 || !o.columns.empty() ? o.size : 0u) << o.name;
    }
  }
}

// A ring in the middle of its balls, which all carry Q = preload / (Z sin phi), while the rotor rubs in the bore and spins it up.
struct SpinningUp {
  TB bearing;
  std::vector<double> y = std::vector<double>(TB::n_state, 0.);
  SupportInput in = journal_at(-260 * um, 0.);
  explicit SpinningUp(const TouchdownBearingData& data, double ring_speed = 0.) : bearing(data) {
    in.rotor_spin.speed = 1591.7;
    y[TB::ring_spin] = ring_speed;
  }
  [[nodiscard]] double acceleration() const {
    std::vector<double> rates(TB::n_state), ledger(TB::n_ledger);
    SupportOutput out;
    bearing.evaluate(in, y, rates, ledger, out);
    return rates[TB::ring_spin];
  }
  [[nodiscard]] double reports(const std::string& name, std::size_t row = 0) const {
    return observed(bearing, in, y, name, row);
  }
};

TEST(TouchdownBearing, ReportsWhatSpinningUpAsksOfTheBallsFriction) {
  const auto rows = angular_contact_pair(290.);
  const BallRowGeometry& g = rows[0];
  const SpinningUp up(touchdown("TB2", rows));
  ASSERT_GT(up.acceleration(), 1e3) << "rad/s2";
  const double A = 0.04 * g.ball_diameter, B_x = A * std::sin(25 * deg) + g.preload_offset,
               B_r = A * std::cos(25 * deg);
  const double sum_of_loads = 290. / (B_x / std::hypot(B_x, B_r));
  const double cage = 0.5 * (1. - g.ball_diameter * std::cos(25 * deg) / g.pitch_diameter);
  const double asked = 23 * 0.7 * g.ball_mass * 0.5 * g.pitch_diameter * cage * up.acceleration();
  for (const std::size_t row : {0u, 1u}) {
    EXPECT_NEAR(up.reports("skid_demand", row) / (asked / (0.1 * sum_of_loads)), 1., 1e-9)
        << "preload is found to 1e-9";
    EXPECT_EQ(up.reports("gyroscopic_demand", row), 0.) << "the balls do not travel yet";
  }
}

TEST(TouchdownBearing, ReportsTheDemandOfBothRingMotions) {
  auto data = touchdown("TB2", angular_contact_pair(290.));
  const SpinningUp locked(data, 900.);
  FreeRing ring;
  ring.polar_inertia = ring.diametral_inertia = 1e-4;
  ring.width = ring.contact_length = 0.032;
  data.free_ring = ring;
  SpinningUp free(data, 900.);
  free.y.resize(TB::n_state_free, 0.);
  std::vector<double> values(observed_size(free.bearing.observables())), rates(TB::n_state_free), ledger(TB::n_ledger);
  SupportOutput out;
  out.observed = values;
  free.bearing.evaluate(free.in, free.y, rates, ledger, out);
  std::size_t at = 0;
  for (const auto& o : free.bearing.observables()) {
    if (o.name == "skid_demand" || o.name == "gyroscopic_demand") {
      ASSERT_GT(locked.reports(o.name), 0.) << o.name;
      EXPECT_NEAR(values[at] / locked.reports(o.name), 1., 1e-9) << o.name;
    }
    at += o.size;
  }
}

TEST(TouchdownBearing, AsksMoreThanThereIsOfBallsWithoutLoad) {
  const SpinningUp up(touchdown("TB1", {deep_groove_row()}));
  EXPECT_EQ(up.reports("skid_demand"), largest_traction_demand) << "the ring floats in its clearance";
}

TEST(TouchdownBearing, ReportsTheGyroscopicDemandOfItsBalls) {
  const auto rows = angular_contact_pair(290.);
  const BallRowGeometry& g = rows[0];
  const double speed = 1500., orbit = speed * 0.5 * (1. - g.ball_diameter * std::cos(25 * deg) / g.pitch_diameter);
  const double F_c = 0.5 * g.ball_mass * g.pitch_diameter * orbit * orbit;
  const double A = 0.04 * g.ball_diameter,
               phi = std::atan2(A * std::sin(25 * deg) + g.preload_offset, A * std::cos(25 * deg));
  const double Q = 290. / 23 / std::sin(phi), outer = std::hypot(Q * std::sin(phi), Q * std::cos(phi) + F_c);
  SpinningUp still(touchdown("TB2", rows), speed);
  const double T_g = 0.4 * F_c * Q * std::sin(phi) / outer;
  EXPECT_NEAR(still.reports("gyroscopic_demand") / (T_g / (0.1 * outer)), 1., 1e-9);
  still.in.journal.y = 0.;  // out of contact, bare friction torque: the outer race has more to do than the inner one
  const double T_o = 0.3 * g.ball_mass * 0.5 * g.pitch_diameter * orbit / speed * still.acceleration();
  EXPECT_NEAR(still.reports("skid_demand") / (std::hypot(T_o, T_g) / (0.1 * outer)), 1., 1e-9);

  auto data = touchdown("TB2", rows);
  for (auto& r : data.rows) r.has_inertia = true;
  const BallContacts contacts{g.inner.stiffness,      g.outer.stiffness, 0.02 * g.ball_diameter,
                              0.02 * g.ball_diameter, g.ball_mass,       g.ball_diameter / g.pitch_diameter,
                              g.pitch_diameter};
  const auto ball =
      ball_balance(contacts, A * std::sin(25 * deg) + g.preload_offset, A * std::cos(25 * deg), 0., speed);
  const SpinningUp inertial(data, speed);
  EXPECT_NEAR(inertial.reports("gyroscopic_demand") / (0.4 * F_c * ball.sin_o / ball.load_o / 0.1), 1., 1e-6)
      << "rows are balanced to 2e-7";
  const double rolling =
      23 * 0.7 * g.ball_mass * 0.5 * g.pitch_diameter * orbit / speed * std::fabs(inertial.acceleration());
  // Rows are balanced to 2e-7, as above.
  EXPECT_NEAR(inertial.reports("skid_demand") /
                  std::max(rolling / (0.1 * 23 * ball.load_i),
                           std::hypot(rolling * 3. / 7., 23 * 0.4 * F_c * ball.sin_o) / (0.1 * 23 * ball.load_o)),
              1., 1e-6);
}

TEST(TouchdownBearing, ReportsTheSpinOfTheBallsUnderOuterRaceControl) {
  const TB bearing(touchdown("TB2", angular_contact_pair(290.)));
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  y[TB::ring_spin] = 1000.;
  EXPECT_NEAR(observed(bearing, {}, y, "spin_speed_inner"), 1000. * std::sin(25 * deg), 1e-9)
      << "rad/s: omega_i sin phi";
}

}  // namespace
}  // namespace rotordrop
