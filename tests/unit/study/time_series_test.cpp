// Differences of two series with known crossings. Straight lines are met exactly, so tolerances are roundoff.
#include "study/time_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace rotordrop;

TimeSeries sampled(double end, int n, double (*f)(double)) {
  TimeSeries s;
  for (int i = 0; i <= n; ++i) {
    s.times.push_back(end * i / n);
    s.values.push_back(f(s.times.back()));
  }
  return s;
}

TEST(TimeSeries, IsLinearBetweenSamplesAndConstantOutside) {
  const TimeSeries s{{1., 2., 4.}, {10., 20., 0.}};
  EXPECT_DOUBLE_EQ(s.at(1.5), 15.);
  EXPECT_DOUBLE_EQ(s.at(3.), 10.);
  EXPECT_DOUBLE_EQ(s.at(2.), 20.);
  EXPECT_DOUBLE_EQ(s.at(0.), 10.);
  EXPECT_DOUBLE_EQ(s.at(9.), 0.);
  EXPECT_THROW((void)TimeSeries{}.at(0.), std::invalid_argument);
}

// second - first = 3 - t: it exceeds 1 until t = 2 exactly, between samples, and falls below -1 at t = 4.
TEST(Difference, CrossesTheToleranceWhereTheLinesDo) {
  const auto first = sampled(3.5, 5, [](double t) { return t; }), second = sampled(3.5, 5, [](double) { return 3.; });
  const Difference d = difference_of(first, second, {1.});
  EXPECT_DOUBLE_EQ(d.largest, 3.);
  EXPECT_DOUBLE_EQ(d.largest_time, 0.);
  ASSERT_TRUE(d.beyond && d.within);
  EXPECT_DOUBLE_EQ(*d.beyond, 0.);
  EXPECT_NEAR(*d.within, 2., 1e-14);
  EXPECT_NEAR(d.time_beyond, 2., 1e-14);
}

TEST(Difference, HasTheSignOfSecondMinusFirst) {
  const TimeSeries cold{{0., 1., 2.}, {1., 1., 1.}}, warm{{0., 1., 2.}, {1., 5., 2.}};
  EXPECT_EQ(difference_of(cold, warm, {0.5}).largest, 4.);
  EXPECT_EQ(difference_of(warm, cold, {0.5}).largest, -4.);
  EXPECT_EQ(difference_of(warm, cold, {0.5}).largest_time, 1.);
}

// 2 - t on 0..4 with tolerance 1: beyond before 1 and after 3; the end is beyond.
TEST(Difference, ThatEndsBeyondIsNeverWithinForGood) {
  const auto zero = sampled(4., 7, [](double) { return 0.; }), line = sampled(4., 7, [](double t) { return 2. - t; });
  const Difference d = difference_of(zero, line, {1.});
  EXPECT_FALSE(d.within);
  EXPECT_NEAR(d.time_beyond, 2., 1e-14);
  EXPECT_TRUE(d.beyond);
}

// A step from -2 to +2 between two samples is within the tolerance of 1 only in the middle half.
TEST(Difference, SeesBothCrossingsBetweenTwoSamples) {
  const TimeSeries zero{{0., 1., 2.}, {0., 0., 0.}}, step{{0., 1., 2.}, {-2., 2., 0.}};
  const Difference d = difference_of(zero, step, {1.});
  EXPECT_NEAR(d.time_beyond, 0.25 + 0.25 + 0.5, 1e-14);
  ASSERT_TRUE(d.within);
  EXPECT_NEAR(*d.within, 1.5, 1e-14);
  const TimeSeries fall{{0., 1., 2.}, {2., -2., 0.}};
  EXPECT_NEAR(difference_of(zero, fall, {1.}).time_beyond, 0.25 + 0.25 + 0.5, 1e-14) << "downwards";
}

TEST(Difference, WithinThroughoutIsWithinFromTheBeginning) {
  const TimeSeries a{{2., 3.}, {0., 0.}}, b{{2., 3.}, {0.5, -0.5}};
  const Difference d = difference_of(a, b, {0.6});
  EXPECT_FALSE(d.beyond);
  ASSERT_TRUE(d.within);
  EXPECT_EQ(*d.within, 2.);
  EXPECT_EQ(d.time_beyond, 0.);
}

// The coarse one bends between its samples: there it says nothing, and must not be compared.
TEST(Difference, IsTakenAtTheTimesOfTheCoarserSeries) {
  const auto fine = sampled(1., 100, [](double t) { return t * t; }),
             coarse = sampled(1., 4, [](double t) { return t * t; });
  for (const auto& d : {difference_of(fine, coarse, {1.}), difference_of(coarse, fine, {1.})}) {
    EXPECT_THAT(d.series.times, testing::ElementsAre(0., 0.25, 0.5, 0.75, 1.));
    EXPECT_NEAR(d.largest, 0., 1e-15);
  }
}

TEST(Difference, CoversTheCommonTimeOnly) {
  const TimeSeries a{{0., 1., 2.}, {0., 0., 0.}}, b{{1., 2., 3.}, {1., 1., 9.}}, later{{5., 6.}, {0., 0.}};
  EXPECT_EQ(difference_of(a, b, {0.1}).largest, 1.);
  EXPECT_THROW((void)difference_of(a, later, {0.1}), std::invalid_argument);
}

// Rises t and 1.1 t: the difference 0.1 t is beyond 5 % of the larger rise at once, and beyond the floor of 0.2 from t = 2 on.
TEST(Difference, IsJudgedByTheRiseAtTheTimeAndAFloor) {
  const auto rise = [](double factor, double end) {
    return TimeSeries{{0., end / 4., end / 2., end},
                      {300., 300. + factor * end / 4., 300. + factor * end / 2., 300. + factor * end}};
  };
  for (const double end : {4., 40.}) {  // the same verdict of the beginning, however long the run
    const Difference d = difference_of(rise(1., end), rise(1.1, end), {.floor = 0.2, .part = 0.05, .zero = 300.});
    ASSERT_TRUE(d.beyond);
    // With samples 10 apart the tolerance is taken as a straight line from 0.2 to 0.55: 0.1 t = 0.2 + 0.035 t.
    EXPECT_NEAR(*d.beyond, end == 4. ? 2. : 0.2 / 0.065, 1e-9);
    EXPECT_NEAR(d.worst_until(end).usage, 0.1 / 0.055, 1e-9);
    EXPECT_NEAR(d.worst_until(0.25 * end).difference, 0.025 * end, 1e-9);
    EXPECT_EQ(d.worst_until(0.).usage, 0.);
  }
  EXPECT_FALSE(difference_of(rise(1., 40.), rise(1.1, 40.), {.floor = 0.2, .part = 0.1, .zero = 300.}).beyond);
}

TEST(TimeSeries, FindsItsFirstCrossingOfZeroEachWay) {
  const auto wave = sampled(8., 400, [](double t) { return -std::cos(t); });
  // Chords of a cosine: their zero is off by less than the step squared.
  EXPECT_NEAR(first_crossing(wave, true, 0.).value(), 0.5 * M_PI, 4e-4);
  EXPECT_NEAR(first_crossing(wave, false, 0.).value(), 1.5 * M_PI, 4e-4);
  EXPECT_NEAR(first_crossing(wave, true, 2.).value(), 2.5 * M_PI, 4e-4);
  EXPECT_FALSE(first_crossing(wave, false, 5.));
}

TEST(TimeSeries, FindsItsLargestValueInATime) {
  const TimeSeries s{{0., 1., 2., 3.}, {5., 1., 3., 2.}};
  EXPECT_EQ(largest_of(s).value, 5.);
  EXPECT_EQ(largest_of(s, 0.5, 3.)->time, 2.);
  EXPECT_FALSE(largest_of(s, 0.2, 0.8));
}

// Trapezoids of a straight line are exact: integral of 2 t is t^2.
TEST(TimeSeries, IntegratesAStraightLineExactly) {
  const auto sum = integral_of(sampled(3., 7, [](double t) { return 2. * t; }));
  EXPECT_EQ(sum.values.front(), 0.);
  EXPECT_NEAR(sum.values.back(), 9., 1e-14);
}

}  // namespace
