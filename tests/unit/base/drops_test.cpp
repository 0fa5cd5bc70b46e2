// Numbers in lanes: their functions against those of the C library, in units in the last place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "base/drops.h"
#include "base/gather.h"

namespace rotordrop {
namespace {

using Real = EightDrops;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Largest distance of a function from the library's, in units in the last place of the latter.
double largest_error(const std::function<Real(const Real&)>& lanes, const std::function<double(double)>& one,
                     const std::function<double(std::mt19937_64&)>& argument) {
  std::mt19937_64 random(1);
  double worst = 0.;
  for (int i = 0; i < 20000; ++i) {
    double x[n_lanes];
    for (double& value : x) value = argument(random);
    const Real found = lanes(Real::load(x));
    for (int lane = 0; lane < n_lanes; ++lane) {
      const double right = one(x[lane]), size = std::fabs(right);
      const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
      worst = std::max(worst, std::fabs(found[lane] - right) / ulp);
    }
  }
  return worst;
}

double even(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(Drops, HaveFunctionsGoodToAFewUnitsInTheLastPlace) {
  const auto magnitude = [](std::mt19937_64& r) { return std::pow(10., even(r, -12., 12.)); };
  for (const double y : {10. / 9., 0.33, 0.55, 2., -1.5})
    EXPECT_LE(largest_error([&](const Real& x) { return pow(x, Real(y)); }, [&](double x) { return std::pow(x, y); },
                            magnitude),
              2.)
        << y;
  EXPECT_LE(largest_error([](const Real& x) { return cbrt(x); }, [](double x) { return std::cbrt(x); }, magnitude), 3.);
  EXPECT_LE(largest_error([](const Real& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); }, magnitude), 0.);
  const auto inverse_of_library = [](double x) { return 1. / std::sqrt(x); };
  EXPECT_LE(largest_error([](const Real& x) { return inverse_root(x); }, inverse_of_library, magnitude), 0.);
  EXPECT_LE(largest_error([](const Real& x) { return root_and_inverse(x).root; },
                          [](double x) { return std::sqrt(x); }, magnitude),
            0.);
  EXPECT_LE(largest_error([](const Real& x) { return root_and_inverse(x).inverse; }, inverse_of_library, magnitude),
            3.);
  const auto any_sign = [](std::mt19937_64& r) { return even(r, -30., 30.); };
  EXPECT_LE(largest_error([](const Real& x) { return exp(x); }, [](double x) { return std::exp(x); }, any_sign), 2.);
  EXPECT_LE(largest_error([](const Real& x) { return tanh(x); }, [](double x) { return std::tanh(x); },
                          [](std::mt19937_64& r) { return even(r, -3., 3.); }),
            3.);
}

TEST(Drops, SumEightNumbersOverTheirLanesAsOneBitForBit) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 200; ++i) {
    Real numbers[8];
    for (Real& number : numbers)
      for (int lane = 0; lane < n_lanes; ++lane) number.set(lane, std::pow(10., even(random, -9., 9.)));
    double sums[8];
    Real::sum_lanes(numbers, sums);
    for (int k = 0; k < 8; ++k) {
      const Real& v = numbers[k];
      EXPECT_EQ(sums[k], ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]))) << k;
      EXPECT_EQ(sums[k], v.sum()) << k;
    }
  }
}

TEST(Drops, HaveSinesToTheirLastPlaceAndBeyondAMillionTheLibrarys) {
  std::mt19937_64 random(2);
  for (const double range : {1., 1e3, 9e5, 1e9})
    for (int i = 0; i < 2000; ++i) {
      double x[n_lanes];
      for (double& value : x) value = even(random, -range, range);
      const auto found = sine_cosine(Real::load(x));
      for (int lane = 0; lane < n_lanes; ++lane) {
        EXPECT_NEAR(found.sine[lane], std::sin(x[lane]), 3e-16);
        EXPECT_NEAR(found.cosine[lane], std::cos(x[lane]), 3e-16);
      }
    }
}

TEST(Drops, LetWhatIsNoNumberGoOnInItsLaneAlone) {
  double x[n_lanes] = {1., nan, 2., 3., 4., 5., 6., 7.};
  const Real a = Real::load(x);
  for (const Real& r : {pow(a, Real(1.1)), exp(a), tanh(a), cbrt(a) + a * 0., larger(a, Real(0.)), smaller(a, Real(9.)),
                        sqrt(a), sine_cosine(a).sine}) {
    EXPECT_TRUE(std::isnan(r[1]));
    for (const int lane : {0, 2, 3, 4, 5, 6, 7}) EXPECT_FALSE(std::isnan(r[lane]));
  }
  EXPECT_EQ(pow(Real(0.), Real(1.1))[3], 0.);
  EXPECT_TRUE(std::isnan(pow(Real(-1.), Real(1.1))[3]));
}

TEST(Drops, AreChosenLaneByLane) {
  double x[n_lanes], y[n_lanes];
  for (int lane = 0; lane < n_lanes; ++lane) x[lane] = lane, y[lane] = 3.5;
  const Real a = Real::load(x), b = Real::load(y);
  for (int lane = 0; lane < n_lanes; ++lane) {
    EXPECT_EQ(select(a < b, a, b)[lane], std::min(x[lane], 3.5));
    EXPECT_EQ(larger(a, b)[lane], std::max(x[lane], 3.5));
    EXPECT_EQ((!(a <= b))[lane], lane > 3);
    EXPECT_EQ(((a < b) & (a > 1.))[lane], lane == 2 || lane == 3);
    EXPECT_EQ(((a < 1.) | (a > 6.))[lane], lane == 0 || lane == 7);
    EXPECT_EQ(abs(-a)[lane], x[lane]);
  }
  EXPECT_TRUE(any(a > 6.5));
  EXPECT_FALSE(any(a > 7.));
}

template <class Scalar>
struct Pair {
  Scalar first;
  struct {
    Scalar second, third;
  } inner;
};

TEST(Drops, FindPairsBetweenTheEntriesAndTheLinesOfTheirOwnTables) {
  // Bilinear numbers, which straight lines have but for the rounding of tables and sums: four of single precision, of numbers up to 50.
  constexpr int n_entries = 7, n_lines = 3;
  constexpr std::ptrdiff_t length = 2 * n_entries;
  const auto first = [](double table, double entry, double line) {
    return table + 2. * entry + 3. * line + entry * line;
  };
  const auto second = [](double table, double entry, double line) {
    return -table + entry - 5. * line + 0.5 * entry * line;
  };
  std::vector<float> tables;
  for (int table = 0; table < n_lanes; ++table)
    for (int line = 0; line < n_lines; ++line)
      for (int entry = 0; entry < n_entries; ++entry) {
        tables.push_back(static_cast<float>(first(table, entry, line)));
        tables.push_back(static_cast<float>(second(table, entry, line)));
      }
  std::mt19937_64 random(6);
  for (int i = 0; i < 1000; ++i) {
    PairLinesOf<n_lanes> lines;
    double at[n_lanes], line_at[n_lanes];
    for (int lane = 0; lane < n_lanes; ++lane) {
      const int from = i % (n_lines - 1);
      const double part = even(random, 0., 1.);
      at[lane] = i == 0 ? 0. : even(random, 0., n_entries - 1.001);
      line_at[lane] = from + part;
      lines.lane[lane] = {&tables[static_cast<std::size_t>(lane * n_lines + from) * length],
                          length,
                          {static_cast<float>(1. - part), static_cast<float>(part)}};
    }
    const auto own = between_entries(lines, Real::load(at)), of_all = between_entries(lines.lane[2], Real::load(at));
    constexpr double rounding = 4. * 50. * 6e-8;
    for (int lane = 0; lane < n_lanes; ++lane) {
      EXPECT_NEAR(own.first[lane], first(lane, at[lane], line_at[lane]), rounding);
      EXPECT_NEAR(own.second[lane], second(lane, at[lane], line_at[lane]), rounding);
      EXPECT_NEAR(of_all.first[lane], first(2., at[lane], line_at[2]), rounding);
      EXPECT_NEAR(of_all.second[lane], second(2., at[lane], line_at[2]), rounding);
    }
  }
}

TEST(Drops, AreGatheredNumberByNumber) {
  const Pair<double> a{1., {2., 3.}}, b{4., {5., 6.}};
  const Pair<double>* both[] = {&a, &b};
  const auto side_by_side = gathered<Pair, Real>(std::span<const Pair<double>* const>(both));
  EXPECT_EQ(side_by_side.first[0], 1.);
  EXPECT_EQ(side_by_side.first[1], 4.);
  EXPECT_EQ(side_by_side.inner.third[1], 6.);
  EXPECT_EQ(side_by_side.inner.second[7], 2.) << "lanes without a drop repeat the first";
}

}  // namespace
}  // namespace rotordrop
