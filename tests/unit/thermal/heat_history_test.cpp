// Steps of heat flux from pulses and from recorded heat.
//
// PULSES: n pulses bring n height width [J/m2]. RECORDED: flux times duration times area, summed up, is share times the ledger's difference, to roundoff.
#include "thermal/heating/heat_history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

double joules_per_area(const FluxSteps& steps) {
  double sum = 0.;
  for (std::size_t i = 0; i + 1 < steps.times.size(); ++i)
    sum += steps.values[i] * (steps.times[i + 1] - steps.times[i]);
  return sum;
}

TEST(PulseTrain, BecomesSteps) {
  const auto steps = steps_of(PulseTrain{.height = 5., .width = 1., .period = 4., .start = 2., .count = 3});
  EXPECT_EQ(steps.times, (std::vector<double>{2., 3., 6., 7., 10., 11.}));
  EXPECT_EQ(steps.values, (std::vector<double>{5., 0., 5., 0., 5., 0.}));
  EXPECT_EQ(joules_per_area(steps), 15.);
}

TEST(PulseTrain, WithoutGapsIsOneLongPulse) {
  const auto steps = steps_of(PulseTrain{.height = 5., .width = 0.1, .period = 0.1, .start = 0., .count = 10});
  EXPECT_EQ(steps.values, (std::vector<double>{5., 0.}));
  EXPECT_NEAR(joules_per_area(steps), 5., 1e-14);
}

TEST(PulseTrain, OfOneNeedsNoPeriod) {
  const auto steps = steps_of(PulseTrain{.height = 5., .width = 3., .period = 0., .start = 1., .count = 1});
  EXPECT_EQ(steps.times, (std::vector<double>{1., 4.}));
}

RecordedHeat wavy(int n) {
  RecordedHeat heat{{0.}, {17.}};
  for (int i = 1; i < n; ++i) {
    heat.times.push_back(heat.times.back() + 50e-6 * (1. + 0.3 * std::sin(i)));
    heat.joules.push_back(heat.joules.back() + std::fmax(0., std::sin(0.01 * i)));
  }
  return heat;
}

TEST(RecordedHeat, KeepsItsJoules) {
  const auto heat = wavy(20000);
  const double given = heat.joules.back() - heat.joules.front(), area = 4.4e-3;
  for (const double interval : {0., 1e-3, 0.3}) {
    const auto steps = steps_of(heat, area, 0.66, interval);
    EXPECT_NEAR(joules_per_area(steps) * area / (0.66 * given), 1., 1e-12) << "interval " << interval;
    EXPECT_EQ(steps.values.back(), 0.) << "nothing after the last row";
    EXPECT_EQ(steps.times.back(), heat.times.back());
    for (std::size_t i = 0; i + 2 < steps.times.size(); ++i)
      EXPECT_GE(steps.times[i + 1] - steps.times[i], interval * (1. - 1e-9));
  }
}

TEST(RecordedHeat, JoinsRowsOfEqualOrNoFlux) {
  const RecordedHeat heat{{0., 1., 2., 3., 4., 5., 6., 7.}, {0., 0., 0., 2., 4., 6., 6., 6.}};
  const auto steps = steps_of(heat, 2., 1.);
  EXPECT_EQ(steps.times, (std::vector<double>{0., 2., 5., 7.}));
  EXPECT_EQ(steps.values, (std::vector<double>{0., 1., 0., 0.}));
}

TEST(RecordedHeat, PassesOverATimeThatIsThereTwice) {
  const auto steps = steps_of({{0., 1., 1., 2.}, {0., 3., 3., 4.}}, 1., 1.);
  EXPECT_EQ(steps.times, (std::vector<double>{0., 1., 2.}));
  EXPECT_EQ(steps.values, (std::vector<double>{3., 1., 0.}));
}

TEST(RecordedHeat, OfLessThanTwoRowsIsNone) { EXPECT_TRUE(steps_of({{0.}, {1.}}, 1., 1.).times.empty()); }

// Two parts into the bore, one of them a triangle of 2 s and 6 W: 6 J. One into a race that begins later and stays.
BearingHeatHistory example() {
  BearingHeatHistory history;
  history.add(HeatedPort::ring, {{0., 1.}, {4., 0.}});
  history.add_linear(HeatedPort::ring, {{0., 1., 2.}, {0., 12., 0.}}, 0.5);
  history.add(HeatedPort::shaft, {{0., 1.}, {4., 0.}}, 0.25);
  history.add(HeatedPort::outer, {{0.5}, {-3.}});
  return history;
}

TEST(BearingHeatHistory, AddsUpItsParts) {
  const auto history = example();
  EXPECT_EQ(history.changes(), (std::vector<double>{0., 0.5, 1., 2.}));
  const HeatInput heat = history.heat(0.25), rate = history.rate(0.25);
  EXPECT_DOUBLE_EQ(heat.rub_into_ring, 4. + 1.5);
  EXPECT_DOUBLE_EQ(heat.rub, 4. + 1.5 + 1.);
  EXPECT_EQ(heat.outer, 0.);
  EXPECT_DOUBLE_EQ(rate.rub_into_ring, 6.);
  EXPECT_DOUBLE_EQ(rate.rub, 6.);
  EXPECT_TRUE(heat.is_in_contact);
}

TEST(BearingHeatHistory, TakesTheValueAfterAJump) {
  const auto history = example();
  EXPECT_DOUBLE_EQ(history.heat(1.).rub_into_ring, 6.);
  EXPECT_DOUBLE_EQ(history.rate(1.).rub_into_ring, -6.);
  EXPECT_DOUBLE_EQ(history.heat(1.).rub, 6.);
  EXPECT_EQ(history.heat(0.5).outer, -3.);
}

TEST(BearingHeatHistory, TouchesWhileRubHeatFlows) {
  const auto history = example();
  EXPECT_TRUE(history.heat(0.).is_in_contact);
  EXPECT_TRUE(history.heat(1.99).is_in_contact);
  EXPECT_FALSE(history.heat(2.).is_in_contact);
}

TEST(BearingHeatHistory, IntegratesToJoules) {
  const auto history = example();
  EXPECT_DOUBLE_EQ(history.joules(HeatedPort::ring, 10.), 4. + 6.);
  EXPECT_DOUBLE_EQ(history.joules(HeatedPort::ring, 0.5), 2. + 0.75);
  EXPECT_DOUBLE_EQ(history.joules(HeatedPort::shaft, 10.), 1.);
  EXPECT_DOUBLE_EQ(history.joules(HeatedPort::outer, 1.5), -3.);
  EXPECT_EQ(history.joules(HeatedPort::inner, 10.), 0.);
  EXPECT_DOUBLE_EQ(history.turnover(1.5), 4. + 5.25 + 1. + 3.);
}

}  // namespace
}  // namespace rotordrop
