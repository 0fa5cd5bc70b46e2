#include "machine/heat/growth_history.h"

#include <gtest/gtest.h>

namespace rotordrop {
namespace {

Expansion growth(double bore) {
  return {.shaft = 1., .bore = bore, .inner_race = 2. * bore, .outer_race = 0., .ball = -bore};
}

TEST(GrowthHistory, IsZeroBeforeAnythingIsKnown) {
  const GrowthHistory history(2);
  std::vector<Expansion> e(2, growth(7.));
  history.at(3., e);
  EXPECT_EQ(e[1].bore, 0.);
  history.rate(3., e);
  EXPECT_EQ(e[0].shaft, 0.);
}

TEST(GrowthHistory, IsLinearBetweenItsInstantsAndConstantOutside) {
  GrowthHistory history(1);
  for (const auto& [t, bore] : {std::pair{1., 10.}, {2., 30.}, {4., 20.}}) history.append(t, std::vector{growth(bore)});
  std::vector<Expansion> e(1);
  for (const auto& [t, bore, rate] : {std::tuple{0., 10., 0.},
                                      {1., 10., 20.},
                                      {1.25, 15., 20.},
                                      {2., 30., -5.},
                                      {3., 25., -5.},
                                      {4., 20., 0.},
                                      {9., 20., 0.}}) {
    history.at(t, e);
    EXPECT_DOUBLE_EQ(e[0].bore, bore) << t;
    EXPECT_DOUBLE_EQ(e[0].inner_race, 2. * bore) << t;
    EXPECT_DOUBLE_EQ(e[0].ball, -bore) << t;
    history.rate(t, e);
    EXPECT_DOUBLE_EQ(e[0].bore, rate) << t;
  }
}

TEST(GrowthHistory, ForgetsWhatWasExpectedButStaysWhereItIs) {
  GrowthHistory history(1);
  history.append(0., std::vector{growth(0.)});
  history.append(2., std::vector{growth(10.)});
  history.cut(0.5);
  std::vector<Expansion> e(1);
  history.at(0.5, e);
  EXPECT_DOUBLE_EQ(e[0].bore, 2.5);
  history.at(2., e);
  EXPECT_DOUBLE_EQ(e[0].bore, 2.5) << "nothing is known after the cut";
  history.append(1.5, std::vector{growth(3.5)});
  history.at(1., e);
  EXPECT_DOUBLE_EQ(e[0].bore, 3.);
}

TEST(GrowthHistory, GoesOnFromItsLastInstants) {
  GrowthHistory history(2), other(2);
  for (const double t : {0., 1., 3.}) history.append(t, std::vector{growth(t * t), growth(-t)});
  const auto packed = history.packed_tail();
  ASSERT_EQ(packed.size(), history.packed_size());
  other.unpack_tail(packed);
  std::vector<Expansion> a(2), b(2);
  for (const double t : {1., 2.2, 3., 5.}) {
    history.at(t, a);
    other.at(t, b);
    for (std::size_t place = 0; place < 2; ++place) EXPECT_EQ(a[place].inner_race, b[place].inner_race) << t;
  }
}

}  // namespace
}  // namespace rotordrop
