#include "study/report/section_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rotordrop {
namespace {

/// Cells of two bodies side by side, 4 x 1 m of 2 x 1 and 1 x 1 cells, each with points of its own; rise = 10 x + 3 r - 5.
TemperatureField two_bodies() {
  TemperatureField field;
  const auto add = [&](double x0, double x1, double r0, double r1, int body) {
    const auto first = static_cast<std::uint32_t>(field.x.size());
    for (const auto& [x, r] : {std::pair{x0, r0}, {x1, r0}, {x1, r1}, {x0, r1}}) {
      field.x.push_back(x);
      field.r.push_back(r);
      field.rise.push_back(10. * x + 3. * r - 5.);
    }
    field.cells.push_back({first, first + 1, first + 2, first + 3});
    field.body.push_back(body);
  };
  add(0., 1., 5., 6., 0);
  add(1., 2., 5., 6., 0);
  add(2., 4., 5., 6., 1);
  return field;
}

TEST(SectionPicture, ShowsALinearFieldExactly) {
  const SectionPicture picture = picture_of(two_bodies(), 1600);
  EXPECT_EQ(picture.columns, 80u);
  EXPECT_EQ(picture.rows, 20u);
  EXPECT_EQ(picture.low, 10.);   // x 0, r 5
  EXPECT_EQ(picture.high, 53.);  // x 4, r 6
  for (std::size_t row = 0; row < picture.rows; ++row)
    for (std::size_t column = 0; column < picture.columns; ++column) {
      const double x = 4. * (static_cast<double>(column) + 0.5) / 80., r = 6. - (static_cast<double>(row) + 0.5) / 20.;
      const double level = 1. + 254. * std::sqrt((10. * x + 3. * r - 5. - 10.) / 43.);
      // Half a level of rounding.
      EXPECT_NEAR(picture.levels[row * picture.columns + column], level, 0.5 + 1e-9) << column << ", " << row;
    }
}

TEST(SectionPicture, LeavesOutWhatIsNoBody) {
  TemperatureField field = two_bodies();
  field.cells.erase(field.cells.begin() + 1);  // a hole from x = 1 to 2
  const SectionPicture picture = picture_of(field, 1600);
  for (std::size_t column = 0; column < picture.columns; ++column)
    EXPECT_EQ(picture.levels[column] == 0, column >= 20 && column < 40) << column;
}

TEST(SectionPicture, OfAnEvenTemperatureHasOneLevel) {
  TemperatureField field = two_bodies();
  for (double& rise : field.rise) rise = 0.;
  const SectionPicture picture = picture_of(field, 100);
  for (const auto level : picture.levels) EXPECT_EQ(level, 1);
}

TEST(BodyEdges, OfNeighboursThatDoNotQuiteMeetAreNoOutline) {
  TemperatureField field = two_bodies();
  const auto n_within = [&field] {
    std::size_t n = 0;
    for (const auto& edge : body_edges(field)) n += std::fabs(edge[0] - 1.) < 0.1 && std::fabs(edge[2] - 1.) < 0.1;
    return n;
  };
  field.x[4] += 0.02;  // a corner of the second cell, as if the common edge were curved
  EXPECT_EQ(n_within(), 0u);
  field.x[4] -= 0.02;
  field.x[4] += 2e-9;  // both by roundoff
  field.x[7] += 2e-9;
  EXPECT_EQ(n_within(), 0u);
}

TEST(BodyEdges, OfThinCellsAtASurfaceAreKept) {
  TemperatureField field = two_bodies();
  // A thin cell on the first one, whose common edge does not quite meet: its own upper edge stays, though three edges are close together.
  const auto first = static_cast<std::uint32_t>(field.x.size());
  for (const auto& [x, r] : {std::pair{0., 6.}, {1., 6.01}, {1., 6.02}, {0., 6.02}}) {
    field.x.push_back(x);
    field.r.push_back(r);
    field.rise.push_back(0.);
  }
  field.cells.push_back({first, first + 1, first + 2, first + 3});
  field.body.push_back(0);
  std::size_t n_upper = 0, n_common = 0;
  for (const auto& [x1, r1, x2, r2] : body_edges(field)) {
    if (std::max(x1, x2) > 1.001 || x1 == x2) continue;
    n_upper += r1 == 6.02 && r2 == 6.02;
    n_common += r1 > 5.9 && r2 > 5.9 && std::min(r1, r2) < 6.015;
  }
  EXPECT_EQ(n_upper, 1u);
  EXPECT_EQ(n_common, 0u);
}

TEST(BodyEdges, AreTheOutlineAndTheLinesBetweenBodies) {
  double length = 0., between = 0.;
  for (const auto& [x1, r1, x2, r2] : body_edges(two_bodies())) {
    length += std::hypot(x2 - x1, r2 - r1);
    if (x1 == 2. && x2 == 2.) between += std::fabs(r2 - r1);
    EXPECT_FALSE(x1 == 1. && x2 == 1.) << "within a body";
  }
  EXPECT_DOUBLE_EQ(between, 1.);
  EXPECT_DOUBLE_EQ(length, 2. * (4. + 1.) + 1.);
}

}  // namespace
}  // namespace rotordrop
