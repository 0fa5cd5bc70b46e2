#include "study/many/answers/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/many/distribution.h"
#include "study/many/expression.h"

using namespace rotordrop;

// Clopper & Pearson's interval in closed form: none of n is [0, 1 - 0.025^(1/n)]; and as tables print it (5 of 10: 18.71 to 81.29 %).
TEST(ClopperPearson, HasItsClosedFormsAndTabledValues) {
  const Estimate none = probability_estimate(0., 10.);
  EXPECT_EQ(*none.low, 0.);
  EXPECT_NEAR(*none.high, 1. - std::pow(0.025, 0.1), 1e-12);
  const Estimate all = probability_estimate(10., 10.);
  EXPECT_NEAR(*all.low, std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(*all.high, 1.);
  const Estimate half = probability_estimate(5., 10.);
  EXPECT_NEAR(*half.low, 0.1871, 5e-5);
  EXPECT_NEAR(*half.high, 0.8129, 5e-5);
}

// P(x_(r) <= median <= x_(s)) of 10 values: binomial tails P(K <= 1) = 11/1024 = 1.1 %, P(K <= 2) = 5.5 %: the interval is x_(2) to x_(9).
TEST(QuantileInterval, IsThatOfTheOrderStatistics) {
  const std::vector<double> sorted{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const Estimate median = quantile_estimate(sorted, 0.5);
  EXPECT_DOUBLE_EQ(median.value, 5.5);
  EXPECT_EQ(*median.low, 2.);
  EXPECT_EQ(*median.high, 9.);
  // The largest of 10 lies below the 95 % quantile with probability 0.95^10 = 60 %: no upper end.
  EXPECT_FALSE(quantile_estimate(sorted, 0.95).high);
}

// Groups 1 3 and 5 7: W = 2, MSB = 2 (2^2 + 2^2) = 16, B = (16 - 2)/2 = 7. Groups 1 3 5 and 9: W = 8/2, MSB = 3 1.5^2 + 4.5^2 = 27, n0 = 4 - 10/4 = 1.5,
// B = 23/1.5.
TEST(ShareWithin, IsThatOfTheComponentsOfVariance) {
  EXPECT_DOUBLE_EQ(*share_within({{1, 3}, {5, 7}}), 2. / 9.);
  EXPECT_DOUBLE_EQ(*share_within({{1, 3, 5}, {}, {9}}), 4. / (4. + 23. / 1.5));
  EXPECT_EQ(*share_within({{1, 3}, {3, 1}}), 1.) << "never more";
  EXPECT_EQ(*share_within({{1, 1}, {2, 2}}), 0.);
  EXPECT_FALSE(share_within({{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}}));
  EXPECT_FALSE(share_within({{1, 2}}));
  EXPECT_FALSE(share_within({{1}, {2}}));
}

// 0.1 summed three times is not 0.3 in binary numbers, so that a mean differs from its equal values.
TEST(Deviation, OfEqualNumbersIsZero) {
  EXPECT_EQ(deviation_of({0.1, 0.1, 0.1}), 0.);
  EXPECT_EQ(deviation_of({1e-9}), 0.);
  EXPECT_DOUBLE_EQ(deviation_of({1., 3.}), std::sqrt(2.));
}

// Quantiles against scipy.stats (truncnorm, triang, norm, uniform, loguniform), 1e-12.
TEST(Distribution, HasTheQuantilesOfScipy) {
  Distribution d;
  d.kind = Distribution::Kind::normal;
  d.mean = 2.;
  d.deviation = 0.5;
  EXPECT_NEAR(d.quantile(0.975), 2. + 0.5 * 1.959963984540054, 1e-12);
  d.kind = Distribution::Kind::truncated_normal;
  d.lower = 1.8;
  d.upper = 3.;
  EXPECT_NEAR(d.quantile(0.3), 2.0431420879114137, 1e-12);
  d.lower = 6.;
  d.upper = 7.;
  EXPECT_NEAR(d.quantile(0.5), 6.042455502949364, 1e-10);
  d.kind = Distribution::Kind::triangular;
  d.lower = 1.;
  d.upper = 5.;
  d.mode = 2.;
  EXPECT_NEAR(d.quantile(0.1), 1.632455532033676, 1e-12);
  EXPECT_NEAR(d.quantile(0.8), 3.450806661517033, 1e-12);
  d.kind = Distribution::Kind::log_uniform;
  d.upper = 100.;
  EXPECT_NEAR(d.quantile(0.25), std::pow(10., 0.5), 1e-12);
}

TEST(Distribution, TakesDiscreteValuesByTheirWeights) {
  Distribution d;
  d.values = {Node(1.), Node(2.), Node(3.)};
  d.weights = {0.2, 0.5, 0.3};
  EXPECT_EQ(d.index(0.19), 0U);
  EXPECT_EQ(d.index(0.21), 1U);
  EXPECT_EQ(d.index(0.69), 1U);
  EXPECT_EQ(d.index(0.71), 2U);
  EXPECT_EQ(d.index(1. - 1e-17), 2U);
}

// "-" in a name is a minus without quotes; what follows may be a number or a name.
TEST(Expression, TellsOfNamesThatNeedQuotes) {
  try {
    const Expression formula("max(bearings.DE-1.force, 0)");
    FAIL() << formula.text();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("write it in quotes: 'bearings.DE-1.force'"), std::string::npos)
        << error.what();
  }
  const std::vector<std::string> known{"bearings.A.force", "bearings.DE-A.force"};
  EXPECT_EQ(advice_on_quotes(Expression("2 * bearings.DE-A.force"), known),
            "Write this name in quotes, since - would be a minus: 'bearings.DE-A.force'.");
  EXPECT_EQ(advice_on_quotes(Expression("2 * 'bearings.DE-A.force' + b"), known), "");
  EXPECT_EQ(advice_on_quotes(Expression("bearings.A.force - b"), known), "");
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  const auto value = [](const char* text, const std::vector<double>& values = {}) {
    return Expression(text).value(values);
  };
  EXPECT_DOUBLE_EQ(value("1 + 2 * 3 ^ 2"), 19.);
  EXPECT_DOUBLE_EQ(value("-2 ^ 2"), -4.);
  EXPECT_DOUBLE_EQ(value("2 ^ 3 ^ 2"), 512.);
  EXPECT_DOUBLE_EQ(value("(1 - 4) / 2 - 1"), -2.5);
  EXPECT_DOUBLE_EQ(value("max(sqrt(16), 3, min(9, 8)) + cos(2 * pi)"), 9.);
  const Expression e("a.b[0].c + 2 * other");
  EXPECT_EQ(e.names(), (std::vector<std::string>{"a.b[0].c", "other"}));
  EXPECT_DOUBLE_EQ(e.value({1., 10.}), 21.);
  for (const char* text : {"max('a.DE-1.b', 0) - x-2", "max(\"a.DE-1.b\", 0) - x - 2"}) {
    const Expression quoted(text);
    EXPECT_EQ(quoted.names(), (std::vector<std::string>{"a.DE-1.b", "x"}));
    EXPECT_DOUBLE_EQ(quoted.value({7., 3.}), 2.);
  }
  EXPECT_DOUBLE_EQ(Expression("'pi' + pi").value({1.}), 1. + std::acos(-1.)) << "a name in quotes is no constant";
  for (const char* bad :
       {"'a", "''", "2x", "max(a.DE-1.b, 0)", "", "1 +", "(1", "1 2", "sin(1, 2)", "what(1)", "3 $ 4"})
    EXPECT_THROW(Expression{bad}, std::invalid_argument) << bad;
}
