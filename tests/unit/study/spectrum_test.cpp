// Amplitudes of spectra against closed forms.
//
// A Hann window of N points weighs a line that lies d bins beside a point of the spectrum with sinc(d) / (1 - d^2), sinc(d) = sin(pi d) / (pi d)
// (Harris 1978, the window's transform over its value at zero). Zeros up to four times the length put points every quarter of a bin, so d <= 1/8.
#include "study/report/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace rotordrop {
namespace {

constexpr double interval = 50e-6, pi = std::numbers::pi;

TimeSeries sampled(std::size_t n, const std::function<double(double)>& f) {
  TimeSeries s;
  for (std::size_t k = 0; k < n; ++k) {
    s.times.push_back(static_cast<double>(k) * interval);
    s.values.push_back(f(s.times.back()));
  }
  return s;
}

/// Index of the largest amplitude.
std::size_t peak_of(const std::vector<double>& a) {
  return static_cast<std::size_t>(std::max_element(a.begin(), a.end()) - a.begin());
}

double hann(double bins) { return bins == 0. ? 1. : std::sin(pi * bins) / (pi * bins) / (1. - bins * bins); }

TEST(Spectrum, ShowsTheAmplitudeOfASineWithinAPercentWhateverItsFrequency) {
  constexpr double amplitude = 3.7;
  double worst = 0.;
  for (int i = 0; i < 40; ++i) {
    const double f = 300. + 1.37 * i;
    const Waterfall w =
        waterfall(sampled(6001, [&](double t) { return 12. + amplitude * std::cos(2. * pi * f * t + 0.3 * i); }),
                  nullptr, interval, 2000.);
    ASSERT_EQ(w.amplitude.size(), 39u) << "6001 rows, segments of 1024, an eighth of it apart";
    EXPECT_NEAR(w.segment, 1024 * interval, 1e-12);
    const auto found = w.mean();
    const std::size_t k = peak_of(found);
    EXPECT_LE(std::fabs(w.frequencies[k] - f), 0.5 * (w.frequencies[1] - w.frequencies[0]) + 1e-9) << "Hz";
    const double expected = amplitude * hann((f - w.frequencies[k]) * w.segment);
    EXPECT_NEAR(found[k], expected, 1e-4 * amplitude) << f << " Hz";
    EXPECT_NEAR(w.largest()[k], expected, 1e-4 * amplitude) << f << " Hz";
    worst = std::max(worst, 1. - found[k] / amplitude);
  }
  EXPECT_LT(worst, 1. - hann(1. / 8.) + 1e-4);
  EXPECT_GT(worst, 0.005) << "frequencies between the points were among them";
  EXPECT_NEAR(1. - hann(1. / 8.), 0.010, 5e-4) << "as the figures say";
}

TEST(Spectrum, OfTwoSinesShowsBothAmplitudes) {
  const Waterfall w = waterfall(
      sampled(6001, [](double t) { return 2. * std::sin(2. * pi * 253.3 * t) + 0.05 * std::sin(2. * pi * 673.5 * t); }),
      nullptr, interval, 2000.);
  const auto found = w.mean();
  const double step = w.frequencies[1] - w.frequencies[0];
  const auto near = [&](double f) {
    double most = 0.;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (std::fabs(w.frequencies[k] - f) <= step) most = std::max(most, found[k]);
    return most;
  };
  // Between two points of the spectrum up to 1 % is lost.
  EXPECT_NEAR(near(253.3), 2., 0.02);
  EXPECT_NEAR(near(673.5), 0.05, 0.0005) << "a window without side lobes that reach as far";
}

TEST(Spectrum, OfACircleHasItsRadiusOnTheSideToWhichItTurns) {
  constexpr double radius = 80e-6, f = 253.33;
  for (const double side : {1., -1.}) {
    const TimeSeries y = sampled(6001, [&](double t) { return -2e-4 + radius * std::cos(2. * pi * f * t); }),
                     z = sampled(6001, [&](double t) { return 1e-5 + side * radius * std::sin(2. * pi * f * t); });
    const Waterfall w = waterfall(y, &z, interval, 2000.);
    const auto found = w.mean();
    const std::size_t k = peak_of(found);
    EXPECT_NEAR(w.frequencies[k], side * f, 0.5 * (w.frequencies[1] - w.frequencies[0]) + 1e-9);
    EXPECT_NEAR(found[k], radius * hann((side * f - w.frequencies[k]) * w.segment), 1e-9 * radius);
    const auto opposite = static_cast<std::size_t>(found.size() - 1 - k);
    EXPECT_NEAR(w.frequencies[opposite], -w.frequencies[k], 1e-9);
    EXPECT_LT(found[opposite], 1e-4 * radius);
  }
}

TEST(Spectrum, OfAnEllipseHasHalfTheSumAndHalfTheDifferenceOfItsAxes) {
  // a cos + i b sin = (a + b)/2 exp(i w t) + (a - b)/2 exp(-i w t); a multiple of the distance of points, so that nothing is lost between them.
  constexpr double a = 100., b = 40., f = 10. / (1024 * interval);
  const TimeSeries y = sampled(6001, [&](double t) { return a * std::cos(2. * pi * f * t); }),
                   z = sampled(6001, [&](double t) { return b * std::sin(2. * pi * f * t); });
  const Waterfall w = waterfall(y, &z, interval, 1000.);
  const auto found = w.mean();
  const auto at = [&](double frequency) {
    return found[static_cast<std::size_t>(
        std::lround((frequency - w.frequencies[0]) / (w.frequencies[1] - w.frequencies[0])))];
  };
  EXPECT_NEAR(at(f), 70., 1e-9);
  EXPECT_NEAR(at(-f), 30., 1e-9);
}

TEST(Spectrum, OverTimeFollowsASineThatBeginsLate) {
  const TimeSeries s = sampled(6001, [](double t) { return t < 0.15 ? 0. : std::sin(2. * pi * 400. * t); });
  const Waterfall w = waterfall(s, nullptr, interval, 2000.);
  for (std::size_t i = 0; i < w.times.size(); ++i) {
    const double most = *std::max_element(w.amplitude[i].begin(), w.amplitude[i].end());
    if (w.times[i] + 0.5 * w.segment < 0.15) {
      EXPECT_LT(most, 1e-12) << w.times[i];
    }
    if (w.times[i] - 0.5 * w.segment > 0.15) {
      EXPECT_NEAR(most, 1., 0.01) << w.times[i];
    }
  }
  EXPECT_NEAR(w.times.front(), 0.5 * w.segment, 1e-9);
  EXPECT_NEAR(w.times.back(), 0.3 - 0.5 * w.segment, 1.001 * interval) << "a row, and roundoff";
}

TEST(Spectrum, OfRowsThatAreNotEvenlySpacedIsThatOfStraightLinesBetweenThem) {
  // Straight lines with few corners: coarse and fine rows describe the same signal. 1 ms is as coarse as 500 Hz may have.
  const auto triangle = [](double t) { return std::fabs(std::fmod(t, 0.02) - 0.01); };
  TimeSeries coarse;
  for (int k = 0; k <= 300; ++k) {
    coarse.times.push_back(0.001 * k);
    coarse.values.push_back(triangle(coarse.times.back()));
  }
  const Waterfall a = waterfall(sampled(6001, triangle), nullptr, interval, 500.),
                  b = waterfall(coarse, nullptr, interval, 500.);
  EXPECT_NEAR(a.row_distance, interval, 1e-9) << "s";
  EXPECT_NEAR(b.row_distance, 0.001, 1e-9) << "s";
  ASSERT_EQ(a.amplitude.size(), b.amplitude.size());
  const auto x = a.mean(), y = b.mean();
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-12);
}

TEST(Spectrum, LeavesOutSegmentsWhoseRowsAreTooFarApart) {
  // A sine of 400 Hz for 0.3 s, of which rows from 0.1 to 0.15 s are 5 ms apart: two periods, and every row is at a zero of the sine.
  constexpr double f = 400.;
  TimeSeries s;
  for (int k = 0; k <= 6000; ++k) {
    const double t = k * interval;
    if (k > 2000 && k < 3000 && k % 100 != 0) continue;
    s.times.push_back(t);
    s.values.push_back(std::sin(2. * pi * f * t));
  }
  const Waterfall w = waterfall(s, nullptr, interval, 2000.);
  ASSERT_EQ(w.place_times.size(), 39u);
  ASSERT_EQ(w.times.size(), w.places.size());
  for (std::size_t i = 0; i < w.times.size(); ++i) {
    EXPECT_TRUE(w.times[i] + 0.5 * w.segment < 0.1 + 2. * interval ||
                w.times[i] - 0.5 * w.segment > 0.15 - 2. * interval)
        << w.times[i];
    EXPECT_NEAR(*std::max_element(w.amplitude[i].begin(), w.amplitude[i].end()), 1., 0.01) << w.times[i];
  }
  ASSERT_EQ(w.uncovered.size(), 1u);
  const double apart = w.place_times[1] - w.place_times[0];
  EXPECT_NEAR(w.uncovered[0][0], 0.1, apart) << "s";
  EXPECT_NEAR(w.uncovered[0][1], 0.15, apart) << "s";
  EXPECT_NEAR(w.row_distance, interval, 1e-9) << "s";
}

TEST(Spectrum, OfCoarseRowsAloneIsNoneButSaysHowFineTheyShouldBe) {
  TimeSeries s;
  for (int k = 0; k <= 60; ++k) {
    s.times.push_back(0.005 * k);
    s.values.push_back(k % 2);
  }
  const Waterfall w = waterfall(s, nullptr, interval, 2000.);
  EXPECT_TRUE(w.amplitude.empty());
  EXPECT_NEAR(w.longest_allowed, 250e-6, 1e-9) << "s: half a period of 2000 Hz";
}

TEST(Spectrum, OfALongDropHasSegmentsThatOverlap) {
  // 30 s of a sine that lasts for the length of one segment only, somewhere.
  constexpr double begin = 17.3, length = 0.2048;
  const TimeSeries s =
      sampled(600'001, [](double t) { return t < begin || t > begin + length ? 0. : std::sin(2. * pi * 400. * t); });
  const Waterfall w = waterfall(s, nullptr, interval, 1000.);
  EXPECT_NEAR(w.segment, length, 1e-9);
  EXPECT_LE(w.times[1] - w.times[0], 0.51 * length);
  EXPECT_TRUE(w.uncovered.empty());
  // The nearest segment is off by a quarter of its length at most, of which a Hann window holds 1/2 + 1/4 + 1/(2 pi) = 0.909.
  const auto found = w.largest();
  EXPECT_GT(found[peak_of(found)], 0.909 * 0.98);
}

TEST(Spectrum, OfFewSamplesIsNone) {
  EXPECT_TRUE(waterfall(sampled(100, [](double t) { return t; }), nullptr, interval, 1000.).amplitude.empty());
}

}  // namespace
}  // namespace rotordrop
