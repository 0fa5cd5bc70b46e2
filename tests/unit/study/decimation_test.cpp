// What a decimated series keeps: ends, extremes of every span at their own times, order; and how much.
#include "study/report/decimation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {
namespace {

TimeSeries noise(int n) {
  TimeSeries s;
  unsigned state = 1;
  for (int k = 0; k < n; ++k) {
    state = state * 1664525u + 1013904223u;
    s.times.push_back(1e-4 * k);
    s.values.push_back(static_cast<double>(state >> 8));
  }
  return s;
}

TEST(Decimated, KeepsTheExtremesOfEverySpanAtTheirTimes) {
  const TimeSeries all = noise(10000), few = decimated(all, 100);
  EXPECT_LE(few.times.size(), 202u);
  EXPECT_TRUE(std::is_sorted(few.times.begin(), few.times.end()));
  for (int bucket = 0; bucket < 100; ++bucket) {
    const double from = all.times.back() * bucket / 100., to = all.times.back() * (bucket + 1) / 100.;
    const auto inside = [&](const TimeSeries& s) {
      std::vector<double> values;
      for (std::size_t k = 1; k + 1 < s.times.size(); ++k)
        if (s.times[k] >= from && s.times[k] < to) values.push_back(s.values[k]);
      return values;
    };
    const auto a = inside(all), b = inside(few);
    EXPECT_EQ(*std::max_element(a.begin(), a.end()), *std::max_element(b.begin(), b.end())) << bucket;
    EXPECT_EQ(*std::min_element(a.begin(), a.end()), *std::min_element(b.begin(), b.end())) << bucket;
  }
  for (std::size_t k = 0; k < few.times.size(); ++k) EXPECT_EQ(all.at(few.times[k]), few.values[k]);
}

TEST(Decimated, KeepsBothEnds) {
  const TimeSeries all = noise(5000), few = decimated(all, 10);
  EXPECT_EQ(few.times.front(), all.times.front());
  EXPECT_EQ(few.times.back(), all.times.back());
  EXPECT_EQ(few.values.back(), all.values.back());
}

TEST(Decimated, LeavesAShortSeriesAsItIs) { EXPECT_EQ(decimated(noise(22), 10).times.size(), 22u); }

TEST(Decimated, OfUnevenTimesSkipsEmptySpans) {
  TimeSeries s;
  for (int k = 0; k < 1000; ++k) {
    s.times.push_back(k < 500 ? 1e-6 * k : 1. + 1e-6 * k);
    s.values.push_back(k);
  }
  const TimeSeries few = decimated(s, 50);
  EXPECT_LE(few.times.size(), 6u) << "two spans hold all samples";
  EXPECT_EQ(few.values.back(), 999.);
}

TEST(Decimated, RefusesNoBuckets) { EXPECT_THROW((void)decimated(noise(5), 0), std::invalid_argument); }

}  // namespace
}  // namespace rotordrop
