#include "study/many/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "study/many/answers/sensitivity.h"
#include "study_inputs.h"

using namespace rotordrop;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

constexpr const char* three = R"(
[vary]
"contact.friction_coefficient" = { range = [0, 1] }
"rotor.modal_damping" = { range = [0, 1] }
"thermal.share_to_ring" = { range = [0, 1] }
)";

Design design_of(const std::string& text) {
  const test::StudyFolder folder;
  return make_design(folder.read(text));
}

double at(const Design& d, std::size_t row, std::size_t j) { return d.value(row, j).number(); }

std::vector<double> ranks(std::vector<double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  for (std::size_t r = 0; r < order.size(); ++r) values[order[r]] = static_cast<double>(r);
  return values;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.) / n, mb = std::accumulate(b.begin(), b.end(), 0.) / n;
  double ab = 0., aa = 0., bb = 0.;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

// The sequence of Joe & Kuo 2008 (new-joe-kuo-6.21201) in the order of Gray's code, as scipy.stats.qmc.Sobol(scramble=False) gives it, whose
// first point, the origin, is left out.
TEST(SobolSequence, IsThatOfJoeAndKuo) {
  const Design d = design_of(std::string(three) + "[design]\nkind = \"sobol-sequence\"\nsize = 8\nscramble = false\n");
  const double expected[8][3] = {{0.5, 0.5, 0.5},       {0.75, 0.25, 0.25},      {0.25, 0.75, 0.75},
                                 {0.375, 0.375, 0.625}, {0.875, 0.875, 0.125},   {0.625, 0.125, 0.875},
                                 {0.125, 0.625, 0.375}, {0.1875, 0.3125, 0.9375}};
  for (std::size_t row = 0; row < 8; ++row)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(at(d, row, j), expected[row][j]) << row << " " << j;
}

// A digital shift keeps a net a net: of 64 points one lies in each 64th of every axis, and one in each cell of an 8 x 8 grid of the first two.
TEST(SobolSequence, StaysANetUnderItsShift) {
  const Design d = design_of(std::string(three) + "[design]\nkind = \"sobol-sequence\"\nsize = 64\nseed = 5\n");
  std::set<std::pair<int, int>> cells;
  for (std::size_t row = 0; row < 64; ++row)
    cells.insert({static_cast<int>(8. * at(d, row, 0)), static_cast<int>(8. * at(d, row, 1))});
  EXPECT_EQ(cells.size(), 64U);
  for (std::size_t j = 0; j < 3; ++j) {
    std::set<int> strata;
    for (std::size_t row = 0; row < 64; ++row) strata.insert(static_cast<int>(64. * at(d, row, j)));
    EXPECT_EQ(strata.size(), 64U);
  }
}

TEST(LatinHypercube, HasOnePointInEveryStratumAndFollowsItsSeed) {
  const std::string text = std::string(three) + "[design]\nsize = 50\nseed = ";
  const Design a = design_of(text + "3\n"), b = design_of(text + "3\n"), c = design_of(text + "4\n");
  for (std::size_t j = 0; j < 3; ++j) {
    std::set<int> strata;
    for (std::size_t row = 0; row < 50; ++row) strata.insert(static_cast<int>(50. * at(a, row, j)));
    EXPECT_EQ(strata.size(), 50U);
  }
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_NE(a.cells, c.cells);
}

// Of 2000 points the rank correlation is known within 4 standard errors: 4 (1 - rho^2) / sqrt(2000) = 0.05, and 0.09 without correlation.
TEST(LatinHypercube, HasTheRankCorrelationThatIsAskedFor) {
  const Design d = design_of(std::string(three) + R"([design]
size = 2000
[[correlation]]
parameters = ["contact.friction_coefficient", "thermal.share_to_ring"]
rank = -0.7
)");
  std::vector<double> x[3];
  for (std::size_t row = 0; row < 2000; ++row)
    for (std::size_t j = 0; j < 3; ++j) x[j].push_back(at(d, row, j));
  EXPECT_NEAR(correlation(ranks(x[0]), ranks(x[2])), -0.7, 0.05);
  EXPECT_NEAR(correlation(ranks(x[0]), ranks(x[1])), 0., 0.09);
}

TEST(Grid, HasEveryCombinationWithTheLastParameterFastest) {
  const Design d = design_of(R"(
[vary]
"contact.friction_coefficient" = [0.1, 0.2]
"contact.air_gap" = { range = ["200 um", "300 um"], levels = 3 }
[design]
kind = "grid"
)");
  ASSERT_EQ(d.n_rows, 6U);
  std::vector<double> friction, gap;
  for (std::size_t row = 0; row < 6; ++row) {
    friction.push_back(at(d, row, 0));
    gap.push_back(at(d, row, 1) * 1e6);
  }
  EXPECT_THAT(friction, ElementsAre(0.1, 0.1, 0.1, 0.2, 0.2, 0.2));
  EXPECT_THAT(gap, testing::Pointwise(testing::DoubleNear(1e-9), {200., 250., 300., 200., 250., 300.}));
}

TEST(OneAtATime, BeginsWithTheCaseItselfAndChangesOneParameter) {
  const Design d = design_of(R"(
[vary]
"contact.friction_coefficient" = [0.2, 0.3]
"rotor.unbalance[1].angle" = ["0 deg", "90 deg"]
[design]
kind = "one-at-a-time"
)");
  ASSERT_EQ(d.n_rows, 5U);
  const double pi = std::acos(-1.);
  const double expected[5][2] = {{0.1, pi}, {0.2, pi}, {0.3, pi}, {0.1, 0.}, {0.1, pi / 2.}};
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(at(d, row, j), expected[row][j], 1e-12);
}

TEST(Morris, ChangesEachParameterOnceByTwoThirdsInEveryTrajectory) {
  const Design d = design_of(std::string(three) + "[design]\nkind = \"morris\"\nsize = 20\n");
  ASSERT_EQ(d.n_rows, 80U);
  for (std::size_t t = 0; t < 20; ++t) {
    std::multiset<std::size_t> changed;
    for (std::size_t s = 0; s < 3; ++s)
      for (std::size_t j = 0; j < 3; ++j) {
        const double step = at(d, 4 * t + s + 1, j) - at(d, 4 * t + s, j);
        if (step == 0.) continue;
        changed.insert(j);
        EXPECT_NEAR(std::abs(step), 2. / 3., 1e-12);
      }
    EXPECT_THAT(changed, ElementsAre(0, 1, 2));
  }
}

// Lists of 2, 3 and 8 values beside a range of 4 levels. A result 7 i + f(j) + 0.5 k + 30 x, with i, j, k the places in the lists and x the range:
// over its whole list the first parameter changes it by 7 (2 - 1), the third by 0.5 (8 - 1), the range by 30.
TEST(Morris, StepsThroughAllValuesOfAListWhateverTheirWeights) {
  const Design d = design_of(R"(
[vary]
"contact.friction_coefficient" = { values = [0.1, 0.3], weights = [9, 1] }
"rotor.modal_damping" = [0.1, 0.2, 0.7]
"thermal.share_to_ring" = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.9]
"contact.air_gap" = { range = [0, 1] }
[design]
kind = "morris"
size = 60
)");
  const std::vector<std::vector<double>> lists{{0.1, 0.3}, {0.1, 0.2, 0.7}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.9}};
  const double f[] = {0., 5., 1.};
  std::vector<double> y;
  std::vector<std::vector<double>> place(d.n_rows);
  std::vector<std::set<double>> used(3);
  for (std::size_t row = 0; row < d.n_rows; ++row) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double value = at(d, row, j);
      used[j].insert(value);
      const auto found = std::find(lists[j].begin(), lists[j].end(), value);
      place[row].push_back(static_cast<double>(found - lists[j].begin()));
    }
    place[row].push_back(at(d, row, 3));
    const auto& p = place[row];
    y.push_back(7. * p[0] + f[static_cast<std::size_t>(p[1])] + 0.5 * p[2] + 30. * p[3]);
  }
  for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(used[j].size(), lists[j].size()) << j;
  const auto effects = morris_effects(d.unit, y, 4, 1);
  const double whole[] = {1., 2., 7., 1.};  // steps from end to end, and the whole range
  for (std::size_t j = 0; j < 4; ++j) {
    double sum = 0.;
    int n = 0;
    for (std::size_t row = 0; row + 1 < d.n_rows; ++row) {
      const double change = place[row + 1][j] - place[row][j];
      if (row % 5 == 4 || change == 0.) continue;
      sum += (y[row + 1] - y[row]) / change * whole[j];
      ++n;
    }
    EXPECT_EQ(effects[j].n, 60U) << j;
    EXPECT_EQ(n, 60) << j;
    EXPECT_NEAR(effects[j].mean, sum / n, 1e-12) << j;
  }
  EXPECT_NEAR(effects[0].mean, 7., 1e-12);
  EXPECT_NEAR(effects[2].mean, 3.5, 1e-12);
  EXPECT_NEAR(effects[3].mean, 30., 1e-12);
  EXPECT_GT(effects[1].deviation, 5.) << "up by 5 and down by 4 over one step";
}

TEST(Morris, LeavesAListOfOneValueAlone) {
  const Design d = design_of(R"(
[vary]
"contact.friction_coefficient" = [0.2]
"thermal.share_to_ring" = [0.1, 0.2]
[design]
kind = "morris"
size = 8
)");
  for (std::size_t row = 0; row < d.n_rows; ++row) EXPECT_EQ(at(d, row, 0), 0.2);
  EXPECT_EQ(morris_effects(d.unit, std::vector<double>(d.n_rows, 1.), 2, 1)[0].n, 0U);
}

TEST(Saltelli, ExchangesOneColumnInEveryRowOfABlock) {
  const Design d = design_of(std::string(three) + "[design]\nkind = \"saltelli\"\nsize = 8\n");
  ASSERT_EQ(d.n_rows, 40U);
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(at(d, 5 * k + 2 + i, j), at(d, 5 * k + (i == j ? 1 : 0), j));
}

TEST(StudyPoints, SetSeveralKeysDeriveOthersAndLiftReplicates) {
  const test::StudyFolder folder;
  const Study study = folder.read(R"(
[vary.stiffness]
keys = ["bearings.TB1.support.K_y", "bearings.TB2.support.K_y"]
values = ["1e9 N/m", "2e9 N/m"]
[vary."bearings.TB1.support.K_z"]
formula = "stiffness / 2"
[vary."rotor.initial_offset[0]"]
values = ["10 um", "20 um"]
[design]
kind = "list"
[replicates]
n = 2
spread = "2 nm"
)");
  const Design design = make_design(study);
  EXPECT_EQ(n_points(study, design), 4U);
  EXPECT_THAT(point_of(study, design, 2).overrides,
              ElementsAre("bearings.TB1.support.K_y=2000000000.0", "bearings.TB2.support.K_y=2000000000.0",
                          "bearings.TB1.support.K_z=1000000000.0", "rotor.initial_offset[0]=2e-05"));
  EXPECT_THAT(point_of(study, design, 3).overrides.back(), HasSubstr("rotor.initial_offset[0]=2.0002"));
  const Case c = read_case(study.case_file, point_of(study, design, 3).overrides);
  EXPECT_NEAR(c.parameters.rotor.initial_offset[0], 20.002e-6, 1e-15);
  EXPECT_EQ(c.parameters.rotor.initial_offset[1], 0.);
}
