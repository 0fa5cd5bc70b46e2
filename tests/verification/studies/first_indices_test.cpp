// First indices from a sample, against numbers known by construction: y = 3 z_1 + z_2 of normal z has the indices 0.9 and 0.1, y = z_1 has 1, scatter that no
// parameter explains has 0. An interval of 95 % has to hold them in all but a few of many studies.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <numeric>
#include <random>

#include "study/many/answers/sensitivity.h"

namespace rotordrop {
namespace {

constexpr int n_studies = 60;
// Of 60 intervals that hold a number with a probability of 0.95 each, at least 51 do with a probability of 0.998.
constexpr int least_right = 51;

using Columns = std::vector<std::vector<double>>;
using Result = double (*)(const std::vector<double>& u, std::mt19937& random);

/// [3][n] of (0, 1).
Columns latin_hypercube(std::size_t n, std::mt19937& random) {
  Columns x(3, std::vector<double>(n));
  std::uniform_real_distribution<double> within;
  for (auto& column : x) {
    std::vector<std::size_t> place(n);
    std::iota(place.begin(), place.end(), std::size_t{0});
    std::shuffle(place.begin(), place.end(), random);
    for (std::size_t k = 0; k < n; ++k)
      column[k] = (static_cast<double>(place[k]) + within(random)) / static_cast<double>(n);
  }
  return x;
}

double normal(double u) { return boost::math::quantile(boost::math::normal(), u); }
double mostly_first(const std::vector<double>& u, std::mt19937&) { return 3. * normal(u[0]) + normal(u[1]); }
double first_alone(const std::vector<double>& u, std::mt19937&) { return normal(u[0]); }
double scatter(const std::vector<double>&, std::mt19937& random) { return std::normal_distribution<double>()(random); }
double third_of(double u) { return std::min(2., std::floor(3. * u)); }
double list_alone(const std::vector<double>& u, std::mt19937&) { return third_of(u[0]); }

struct Case {
  const char* name;
  FirstBy by;
  Result result;
  std::size_t n;
  double first, third;  // indices of the first and of the third parameter
  bool is_list = false;
};

TEST(FirstIndices, HoldTheTrueNumbersInNearlyAllStudies) {
  for (const Case& c :
       {Case{"nine tenths", FirstBy::ranks, mostly_first, 40, 0.9, 0.},
        Case{"nine tenths", FirstBy::ranks, mostly_first, 320, 0.9, 0.},
        Case{"all", FirstBy::ranks, first_alone, 100, 1., 0.}, Case{"nothing", FirstBy::ranks, scatter, 100, 0., 0.},
        Case{"a list", FirstBy::ranks, list_alone, 100, 1., 0., true},
        Case{"nothing, classes", FirstBy::classes, scatter, 256, 0., 0.},
        Case{"a list, classes", FirstBy::classes, list_alone, 256, 1., 0., true}}) {
    std::mt19937 random(17);
    int n_first = 0, n_third = 0;
    double mean = 0.;
    for (int study = 0; study < n_studies; ++study) {
      const Columns u = latin_hypercube(c.n, random);
      std::vector<double> y(c.n);
      for (std::size_t k = 0; k < c.n; ++k) y[k] = c.result({u[0][k], u[1][k], u[2][k]}, random);
      Columns x = u;
      if (c.is_list) std::transform(x[0].begin(), x[0].end(), x[0].begin(), third_of);
      const auto found = FirstIndices(c.by, x, static_cast<std::uint64_t>(study)).first(y);
      constexpr double roundoff = 1e-12;
      const auto holds = [](const Estimate& e, double exact) {
        return *e.low <= exact + roundoff && *e.high >= exact - roundoff;
      };
      n_first += holds(found[0], c.first);
      n_third += holds(found[2], c.third);
      mean += found[0].value / n_studies;
      EXPECT_LT(*found[2].high - *found[2].low, 1.1) << c.name << ": an interval that says something";
    }
    EXPECT_GE(n_first, least_right) << c.name << " of " << c.n << ", mean " << mean;
    EXPECT_GE(n_third, least_right) << c.name << " of " << c.n;
    // By ranks four standard errors of a mean of 60 (0.1/sqrt(60) of scatter alone), or two and the gaps between normal numbers, 0.7/n of the variance.
    if (c.by == FirstBy::ranks) {
      EXPECT_NEAR(mean, c.first, 0.055) << c.name << " of " << c.n;
    }
  }
}

}  // namespace
}  // namespace rotordrop
