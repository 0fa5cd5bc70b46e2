// Sums in vectors against plain loops: numbers of shapes, modes and points that fill no vector.
#include "thermal/section/modal_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rotordrop {
namespace {

constexpr double zero = 300.;

/// Numbers without a pattern between -1 and 1.
std::vector<double> numbers(std::size_t n, double seed) {
  std::vector<double> list(n);
  for (std::size_t i = 0; i < n; ++i) list[i] = std::sin(seed + 12.9898 * static_cast<double>(i * i + 1));
  return list;
}

std::vector<double> states(std::size_t n) {
  std::vector<double> y = numbers(n, 0.3);
  for (double& x : y) x += zero;
  return y;
}

double sum(const std::vector<double>& shape, const std::vector<double>& y) {
  double s = 0.;
  for (std::size_t i = 0; i < shape.size(); ++i) s += shape[i] * (y[i] - zero);
  return s;
}

// Roundoff of rises at 300 K, some 1e-13 each.
constexpr double roundoff = 1e-12;

TEST(ModalShapes, SumsEachShape) {
  for (const std::size_t n_modes : {1U, 2U, 5U, 28U}) {
    ModalShapes shapes(n_modes);
    std::vector<std::vector<double>> list;
    for (std::size_t k = 0; k < 11; ++k) {
      list.push_back(numbers(n_modes, static_cast<double>(k)));
      EXPECT_EQ(shapes.add(list.back()), k);
    }
    EXPECT_EQ(shapes.add({}), 11U);
    const auto y = states(n_modes);
    std::vector<double> out;
    shapes.sums(y.data(), zero, out);
    for (std::size_t k = 0; k < 11; ++k) EXPECT_NEAR(out[k], sum(list[k], y), roundoff) << n_modes << " modes, " << k;
    EXPECT_EQ(out[11], 0.) << "an empty shape";
  }
}

/// Rises of eight states side by side, and each by itself.
struct Tile {
  std::vector<double> rises;
  std::vector<std::vector<double>> y;
  explicit Tile(std::size_t n_modes) : rises(n_modes * RowTile::width) {
    for (std::size_t l = 0; l < RowTile::width; ++l) {
      y.push_back(numbers(n_modes, 0.1 * static_cast<double>(l)));
      for (std::size_t i = 0; i < n_modes; ++i) {
        rises[i * RowTile::width + l] = y[l][i];
        y[l][i] += zero;
      }
    }
  }
};

TEST(ModalShapes, SumEightStatesAsOne) {
  for (const std::size_t n_modes : {1U, 5U, 28U}) {
    ModalShapes shapes(n_modes);
    for (std::size_t k = 0; k < 11; ++k) shapes.add(numbers(n_modes, static_cast<double>(k)));
    const Tile tile(n_modes);
    std::vector<double> out(16 * RowTile::width + 1, -1.), alone;
    shapes.sums_of_tile(tile.rises.data(), out.data());
    EXPECT_EQ(out.back(), -1.) << "nothing behind";
    for (std::size_t l = 0; l < RowTile::width; ++l) {
      shapes.sums(tile.y[l].data(), zero, alone);
      for (std::size_t k = 0; k < 11; ++k)
        EXPECT_NEAR(out[16 * l + k], alone[k], roundoff) << n_modes << " modes, state " << l << ", " << k;
    }
  }
}

TEST(ModalRates, DecayAndTakeHeatAndTouchNothingBehind) {
  for (const std::size_t n : {1U, 8U, 13U}) {
    std::vector<double> rate(n);
    for (std::size_t i = 0; i < n; ++i) rate[i] = 0.5 * static_cast<double>(i);
    ModalRates modes(rate);
    const auto a = numbers(n, 1.), b = numbers(n, 2.), y = states(n);
    EXPECT_EQ(modes.add(a), 0U);
    EXPECT_EQ(modes.add(b), 1U);
    const std::vector<double> watts = {3., -7.};
    std::vector<double> dydt(n + 8, 99.);
    modes.rates(y.data(), zero, watts.data(), dydt.data());
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(dydt[i], -rate[i] * (y[i] - zero) + 3. * a[i] - 7. * b[i], roundoff) << i << " of " << n;
    for (std::size_t i = n; i < dydt.size(); ++i) EXPECT_EQ(dydt[i], 99.);
  }
}

TEST(ModalRates, AdvanceExactlyWhateverTheStepIs) {
  const std::vector<double> rate = {0., 1e-9, 1e-3, 0.3, 1., 2.7, 40., 600., 1e5, 1e9, 5e-7, 1.1e-6, 1e-12};
  ModalRates modes(rate);
  const auto gain = numbers(rate.size(), 1.), y = states(rate.size());
  modes.add(gain);
  const double watts = 3.;
  for (const double step : {1., 0.5, 2.}) {
    std::vector<double> to(rate.size() + 8, 99.);
    AlignedNumbers weights(filled_up(rate.size()), 0.);
    long double mean = 0.;
    for (std::size_t i = 0; i < rate.size(); ++i) weights[i] = 1. + 0.1 * static_cast<double>(i);
    const double found = modes.advance(y.data(), zero, &watts, step, weights, to.data());
    for (std::size_t i = 0; i < rate.size(); ++i) {
      // z' = g - rate z, in extended precision.
      const long double x = static_cast<long double>(rate[i]) * step, z = y[i] - zero, g = watts * gain[i];
      const long double first = x > 0 ? -std::expm1(-x) / x : 1.L;
      const long double second =
          x > 1e-3L ? (1.L - first) / x : 0.5L - x / 6.L + x * x / 24.L - x * x * x / 120.L + x * x * x * x / 720.L;
      const long double z_end = z + step * first * (g - rate[i] * z), z_mean = z + step * second * (g - rate[i] * z);
      EXPECT_NEAR(to[i] - zero, static_cast<double>(z_end), roundoff) << rate[i] << " 1/s, " << step << " s";
      mean += weights[i] * z_mean;
      // By itself, too: no mode hides behind a larger one.
      AlignedNumbers one(weights.size(), 0.);
      one[i] = 1.;
      EXPECT_NEAR(modes.advance(y.data(), zero, &watts, step, one, to.data()), static_cast<double>(z_mean), roundoff)
          << rate[i] << " 1/s, " << step << " s";
    }
    EXPECT_NEAR(found, static_cast<double>(mean), 10. * roundoff);
    for (std::size_t i = rate.size(); i < to.size(); ++i) EXPECT_EQ(to[i], 99.);
  }
}

TEST(SurfacePoints, FindThoseOfEightStatesAsOfOne) {
  for (const std::size_t n_modes : {1U, 5U, 28U})
    for (const std::size_t n_points : {1U, 8U, 13U}) {
      const SurfacePoints points(n_modes, numbers(n_modes * n_points, 3.), numbers(n_points, 4.));
      const Tile tile(n_modes);
      const std::vector<double> watts = numbers(RowTile::width, 5.);
      std::vector<RiseRange> found(RowTile::width);
      points.extremes_of_tile(tile.rises.data(), watts.data(), found.data());
      for (std::size_t l = 0; l < RowTile::width; ++l) {
        const RiseRange alone = points.extremes(tile.y[l].data(), zero, watts[l]);
        EXPECT_NEAR(found[l].lowest, alone.lowest, roundoff) << n_modes << " modes, " << n_points << " points, " << l;
        EXPECT_NEAR(found[l].highest, alone.highest, roundoff);
      }
    }
}

TEST(SurfacePoints, FindTheColdestAndTheHottest) {
  constexpr std::size_t n_modes = 5;
  const auto y = states(n_modes);
  for (const std::size_t n_points : {1U, 7U, 8U, 21U}) {
    const auto by_point = numbers(n_points * n_modes, 4.), at_once = numbers(n_points, 5.);
    for (const double watts : {0., 2., -30.}) {
      std::vector<double> rises(n_points);
      for (std::size_t k = 0; k < n_points; ++k) {
        const auto first = by_point.begin() + static_cast<std::ptrdiff_t>(k * n_modes);
        rises[k] = sum({first, first + n_modes}, y) + watts * at_once[k];
      }
      const auto [lowest, highest] = std::minmax_element(rises.begin(), rises.end());
      const RiseRange found = SurfacePoints(n_modes, by_point, at_once).extremes(y.data(), zero, watts);
      EXPECT_NEAR(found.lowest, *lowest, roundoff) << n_points << " points, " << watts << " W";
      EXPECT_NEAR(found.highest, *highest, roundoff) << n_points << " points, " << watts << " W";
    }
  }
  const auto by_point = numbers(3 * n_modes, 4.);
  const RiseRange found = SurfacePoints(n_modes, by_point, {}).extremes(y.data(), zero, 2.);
  const RiseRange expected = SurfacePoints(n_modes, by_point, std::vector<double>(3)).extremes(y.data(), zero, 2.);
  EXPECT_EQ(found.lowest, expected.lowest) << "nothing at once";
  EXPECT_EQ(found.highest, expected.highest);
}

}  // namespace
}  // namespace rotordrop
