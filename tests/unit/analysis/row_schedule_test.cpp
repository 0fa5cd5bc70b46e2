// Rows at every multiple of an interval while something changes, seldom otherwise.
#include "analysis/row_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace rotordrop {
namespace {

/// Steps of `step` to `end`; the times at which rows were written, as a run does it: those due within a step, then the step itself is followed, then
/// one that is due at its end.
std::vector<double> rows_of(RowSchedule& rows, const std::function<double(double)>& value, double step, double end,
                            double start = 0.) {
  std::vector<double> times;
  const auto write = [&](double t) {
    times.push_back(t);
    rows.written(t);
  };
  if (start == 0.) {
    rows.follow(0., std::vector<double>{value(0.)});
    write(0.);
  }
  const auto n = std::lround(end / step);
  for (long k = std::lround(start / step) + 1; k <= n; ++k) {
    const double t = static_cast<double>(k) * step, before = static_cast<double>(k - 1) * step;
    while (rows.due() < t && !is_same_time(rows.due(), t)) write(rows.due());
    rows.follow(t, std::vector<double>{value(t)});
    if (rows.is_awoken(before)) write(before);
    if (is_same_time(rows.due(), t)) write(t);
  }
  return times;
}

TEST(RowSchedule, IsEvenWithoutALongerInterval) {
  RowSchedule rows(1e-3, 1e-3, 0.02, {0});
  const auto times = rows_of(
      rows, [](double) { return 1.; }, 0.3e-3, 0.03);
  ASSERT_EQ(times.size(), 31u);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_DOUBLE_EQ(times[k], 1e-3 * static_cast<double>(k));
}

TEST(RowSchedule, IsCoarseWhileNothingChanges) {
  RowSchedule rows(1e-3, 10e-3, 0.02, {0});
  const auto times = rows_of(
      rows, [](double t) { return 100. + std::sin(1e3 * t); }, 0.3e-3, 0.3);  // 1 % of its size
  ASSERT_GE(times.size(), 30u);
  EXPECT_LE(times.size(), 34u);
  for (std::size_t k = 2; k < times.size(); ++k) EXPECT_NEAR(times[k] - times[k - 1], 10e-3, 1e-9);
}

TEST(RowSchedule, MissesLessThanTheChangeBetweenRows) {
  // A pulse of 5 ms after 0.1 s of rest: straight lines between rows against the pulse itself.
  const auto pulse = [](double t) {
    return t > 0.1 && t < 0.105 ? 500. * std::sin(std::numbers::pi * (t - 0.1) / 5e-3) : 0.;
  };
  RowSchedule rows(50e-6, 20e-3, 0.02, {0});
  const auto times = rows_of(rows, pulse, 7e-6, 0.3);
  EXPECT_LT(times.size(), 150u);
  double worst = 0.;
  for (std::size_t k = 1; k < times.size(); ++k) {
    EXPECT_GT(times[k], times[k - 1]);
    for (double part = 0.; part < 1.; part += 0.05) {
      const double t = times[k - 1] + part * (times[k] - times[k - 1]);
      const double line = pulse(times[k - 1]) + part * (pulse(times[k]) - pulse(times[k - 1]));
      worst = std::max(worst, std::fabs(line - pulse(t)));
    }
  }
  // 2 % of 500 N, and what the pulse's steepest flank (3.1e5 N/s) does in two steps of 7 us before it is seen.
  EXPECT_LT(worst, 10. + 2. * 7e-6 * 3.2e5);
}

TEST(RowSchedule, KeepsTheLineStraightUpToAJump) {
  const auto jump = [](double t) { return t < 0.1093 ? 0. : 500.; };
  RowSchedule rows(50e-6, 20e-3, 0.02, {0});
  const auto times = rows_of(rows, jump, 7e-6, 0.3);
  double area = 0.;
  for (std::size_t k = 1; k < times.size(); ++k)
    area += 0.5 * (jump(times[k]) + jump(times[k - 1])) * (times[k] - times[k - 1]);
  // The line rises between the step before the jump and the first multiple after it.
  EXPECT_NEAR(area, 500. * (times.back() - 0.1093), 500. * (7e-6 + 50e-6));
}

TEST(RowSchedule, GoesOnAfterAResumeAsIfNothingHadBeen) {
  // A blip in one step at 60.4 ms: what it changed is over in the next one, and only the checkpoint knows of it.
  const auto wave = [](double t) {
    return t < 0.05 ? std::sin(300. * t) : std::fabs(t - 0.0604) < 1e-6 ? 0.9 : 0.3 * std::floor((t + 1e-9) / 0.04);
  };
  RowSchedule whole(1e-3, 8e-3, 0.02, {0});
  const auto expected = rows_of(whole, wave, 0.4e-3, 0.2);
  for (const double stop : {0.0212, 0.06, 0.0604, 0.1604}) {
    RowSchedule first(1e-3, 8e-3, 0.02, {0}), second(1e-3, 8e-3, 0.02, {0});
    auto times = rows_of(first, wave, 0.4e-3, stop);
    second.unpack(first.packed());
    const auto rest = rows_of(second, wave, 0.4e-3, 0.2, stop);
    times.insert(times.end(), rest.begin(), rest.end());
    EXPECT_EQ(times, expected) << stop;
  }
}

TEST(RowSchedule, OfRowsThatComeLateGoesOnAfterAResumeAtAnyStep) {
  // As of windows: what ends between two steps is written after the second, and not every step is observed.
  const auto rows_with = [](bool is_resumed_at_every_step) {
    RowSchedule rows(50e-6, 20e-3, 0.02, {0});
    std::vector<double> times;
    double end = 31e-6;
    for (int k = 0; k < 4000; ++k) {
      const double t = 7e-6 * k;
      if (k % 3 == 0) rows.follow(t, std::vector<double>{t < 5e-3 ? 0. : std::sin(4e3 * t)});
      for (; end <= t; end += 31e-6)
        if (rows.due() <= end) {
          times.push_back(end);
          rows.written(end);
        }
      if (is_resumed_at_every_step) {
        RowSchedule other(50e-6, 20e-3, 0.02, {0});
        other.unpack(rows.packed());
        rows = other;
      }
    }
    return times;
  };
  EXPECT_GT(rows_with(false).size(), 50u);
  EXPECT_EQ(rows_with(true), rows_with(false));
  RowSchedule rows(50e-6, 20e-3, 0.02, {0});
  EXPECT_THROW(rows.unpack(std::vector<double>{1., 2.}), std::invalid_argument);
}

TEST(WatchedColumns, AreForcesPositionsAndRingSpeeds) {
  const std::vector<Observable> list = {{"/bearings/A/orbit", "m", "", 2, {}, Observed::orbit},
                                        {"/bearings/A/slip_speed", "m/s", "", 1, {}, Observed::slip_speed},
                                        {"/bearings/A/contact_force", "N", "", 1, {}, Observed::contact_force},
                                        {"/bearings/A/ring_speed", "rad/s", "", 1, {}, Observed::ring_speed},
                                        {"/bearings/A/axial_position", "m", "", 2, {}, Observed::axial_position},
                                        {"/bearings/A/axial_force", "N", "", 1, {}, Observed::axial_force},
                                        {"/bearings/A/shoulder_force", "N", "", 1, {}, Observed::shoulder_force}};
  EXPECT_EQ(watched_columns(list), (std::vector<std::size_t>{0, 1, 3, 4, 5, 6, 8}));
  EXPECT_EQ(watched_columns({{"/bearings/L/displacement", "m", "", 2, {}}}), (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace rotordrop
