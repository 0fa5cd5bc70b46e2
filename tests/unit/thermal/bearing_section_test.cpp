// The plan of a bearing's section, before any mesh generator sees it.
#include "thermal/section/bearing_section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace rotordrop {
namespace {

/// A deep-groove 6014.
BearingSectionData deep_groove() {
  BearingSectionData d;
  d.rows = {{0., 1.}};
  d.ball_diameter = 11.906e-3;
  d.pitch_diameter = 90e-3;
  d.width = 20e-3;
  d.inner_bore = 70e-3;
  d.inner_shoulder = 82.9e-3;
  d.outer_shoulder = 97.2e-3;
  d.outer_outside = 110e-3;
  d.housing_outside = 130e-3;
  d.housing_length = 25e-3;
  d.strip_half_width = 0.4e-3;
  return d;
}

/// A pair of 71914 face to face.
BearingSectionData pair() {
  BearingSectionData d;
  d.rows = {{-8e-3, -1.}, {8e-3, 1.}};
  d.ball_diameter = 9.525e-3;
  d.pitch_diameter = 85e-3;
  d.contact_angle = 25. * std::numbers::pi / 180.;
  d.width = 32e-3;
  d.inner_bore = 70e-3;
  d.inner_shoulder = 78e-3;
  d.outer_shoulder = 92e-3;
  d.outer_outside = 100e-3;
  d.housing_outside = 120e-3;
  d.housing_length = 50e-3;
  d.strip_half_width = 0.4e-3;
  return d;
}

std::size_t body_of(const SectionPlan& plan, const std::string& name) {
  return static_cast<std::size_t>(std::find(plan.bodies.begin(), plan.bodies.end(), name) - plan.bodies.begin());
}
std::vector<SectionPlan::Curve> curves_of(const SectionPlan& plan, const HeatBoundary& boundary) {
  std::vector<SectionPlan::Curve> found;
  for (const auto& c : plan.curves)
    if (c.boundary == boundary) found.push_back(c);
  return found;
}
/// Middle of a strip, as x and r.
SectionPlan::Point strip_centre(const SectionPlan& plan, const char* ring, int row) {
  const auto curves = curves_of(plan, {body_of(plan, ring), HeatSide::strip, row});
  EXPECT_FALSE(curves.empty());
  const auto &a = plan.points[curves.front().from], &b = plan.points[curves.back().to];
  const auto& arc = plan.arcs[static_cast<std::size_t>(curves.front().arc)];
  const double mx = 0.5 * (a.x + b.x) - arc.x, mr = 0.5 * (a.r + b.r) - arc.r;
  return {arc.x + arc.radius * mx / std::hypot(mx, mr), arc.r + arc.radius * mr / std::hypot(mx, mr)};
}

void expect_fault(const BearingSectionData& d, const std::string& key, const std::string& words) {
  const auto faults = faults_of_section(d);
  ASSERT_FALSE(faults.empty()) << words;
  EXPECT_EQ(faults.front().key, key);
  EXPECT_NE(faults.front().message.find(words), std::string::npos) << faults.front().message;
  EXPECT_THROW(static_cast<void>(plan_bearing_section(d, {})), std::invalid_argument);
}

TEST(BearingSection, PutsStripsWhereTheBallsTouch) {
  // Ball of diameter d on the pitch circle: its contacts lie (d/2) (sin phi, cos phi) to either side of its centre.
  const auto d = pair();
  const auto plan = plan_bearing_section(d, {});
  const double s = 0.5 * d.ball_diameter * std::sin(d.contact_angle),
               c = 0.5 * d.ball_diameter * std::cos(d.contact_angle);
  for (int row = 0; row < 2; ++row) {
    const auto& place = d.rows[static_cast<std::size_t>(row)];
    const auto inner = strip_centre(plan, "inner_ring", row), outer = strip_centre(plan, "outer_ring", row);
    EXPECT_NEAR(inner.x, place.x - place.direction * s, 1e-12) << "m, row " << row;
    EXPECT_NEAR(inner.r, 0.5 * d.pitch_diameter - c, 1e-12) << "m";
    EXPECT_NEAR(outer.x, place.x + place.direction * s, 1e-12) << "m, row " << row;
    EXPECT_NEAR(outer.r, 0.5 * d.pitch_diameter + c, 1e-12) << "m";
  }
  EXPECT_LT(std::fabs(strip_centre(plan, "inner_ring", 0).x), 8e-3) << "face to face: inner contacts lean inwards";
}

TEST(BearingSection, BlocksAreCounterclockwiseAndSidesMeetInTheCorners) {
  auto with_shaft = pair();
  with_shaft.shaft_radius = 34.75e-3;
  with_shaft.shaft_length = 40e-3;
  for (const auto& data : {deep_groove(), pair(), with_shaft}) {
    const auto plan = plan_bearing_section(data, {});
    for (const auto& block : plan.blocks) {
      double area = 0.;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto &a = plan.points[block.corners[k]], &b = plan.points[block.corners[(k + 1) % 4]];
        area += 0.5 * (a.x * b.r - b.x * a.r);
        const auto& side = plan.curves[block.curves[k]];
        EXPECT_EQ(std::minmax(side.from, side.to), std::minmax(block.corners[k], block.corners[(k + 1) % 4]));
      }
      EXPECT_GT(area, 0.);
      EXPECT_EQ(plan.curves[block.curves[0]].cells, plan.curves[block.curves[2]].cells);
      EXPECT_EQ(plan.curves[block.curves[1]].cells, plan.curves[block.curves[3]].cells);
    }
  }
}

TEST(BearingSection, CurvesOfOneBlockAloneAreTheOutline) {
  for (const auto& data : {deep_groove(), pair()}) {
    const auto plan = plan_bearing_section(data, {});
    std::vector<int> uses(plan.curves.size(), 0);
    for (const auto& block : plan.blocks)
      for (const auto c : block.curves) ++uses[c];
    for (std::size_t i = 0; i < plan.curves.size(); ++i)
      EXPECT_EQ(uses[i], plan.curves[i].boundary ? 1 : 2) << "curve " << i;
  }
}

TEST(BearingSection, ArcsPassThroughTheirEnds) {
  const auto plan = plan_bearing_section(pair(), {});
  int n_arcs = 0;
  for (const auto& c : plan.curves) {
    if (c.arc < 0) continue;
    ++n_arcs;
    const auto& arc = plan.arcs[static_cast<std::size_t>(c.arc)];
    EXPECT_NEAR(arc.radius, 0.52 * 9.525e-3, 1e-15);
    for (const auto p : {c.from, c.to})
      EXPECT_NEAR(std::hypot(plan.points[p].x - arc.x, plan.points[p].r - arc.r), arc.radius, 1e-14);
  }
  EXPECT_EQ(n_arcs, 12) << "raceway, strip, raceway in two rows of two rings";
}

TEST(BearingSection, RelievesOnlyTheOuterRingsShoulderAwayFromTheLoad) {
  const auto d = pair();
  const auto plan = plan_bearing_section(d, {});
  const auto lands = [&](const char* ring, HeatSide side) {
    std::map<double, double> radius;  // by x
    for (const auto& c : curves_of(plan, {body_of(plan, ring), side, 0}))
      for (const auto p : {c.from, c.to}) radius[plan.points[p].x] = plan.points[p].r;
    return radius;
  };
  const auto outer = lands("outer_ring", HeatSide::inner), inner = lands("inner_ring", HeatSide::outer);
  for (const auto& [x, r] : inner) EXPECT_NEAR(r, 39e-3, 1e-12) << x;
  const double radius = 0.52 * d.ball_diameter;
  const double bottom = 0.5 * d.pitch_diameter - (radius - 0.5 * d.ball_diameter) * std::cos(d.contact_angle) + radius;
  for (const auto& [x, r] : outer) {
    const double depth = bottom - 46e-3;
    EXPECT_NEAR(r, std::fabs(x) > 8e-3 ? 46e-3 : bottom - 0.4 * depth, 1e-12) << x;
  }
}

TEST(BearingSection, ClipsAStripAtTheShoulder) {
  auto d = pair();
  d.strip_half_width = 3e-3;
  const auto plan = plan_bearing_section(d, {});
  const auto curves = curves_of(plan, {body_of(plan, "inner_ring"), HeatSide::strip, 0});
  double end = -1.;
  for (const auto& c : curves) end = std::max(end, plan.points[c.to].r);
  EXPECT_NEAR(end, 39e-3, 1e-12);
  auto narrow = pair();
  EXPECT_LT(strip_centre(plan_bearing_section(narrow, {}), "inner_ring", 0).r, 39e-3);
}

TEST(BearingSection, HousingMeetsTheRingPointOnPoint) {
  for (const double length :
       {50e-3, 32e-3, 20e-3, 12e-3}) {  // wider than the ring, as wide, narrower, and ending in a groove
    auto d = pair();
    d.housing_length = length;
    const auto plan = plan_bearing_section(d, {});
    std::map<double, std::pair<int, double>> ring, housing;  // start of a curve -> its cells and ratio
    for (const auto& c : curves_of(plan, {body_of(plan, "outer_ring"), HeatSide::outer, 0}))
      ring[plan.points[c.from].x] = {c.cells, c.ratio};
    for (const auto& c : curves_of(plan, {body_of(plan, "housing"), HeatSide::inner, 0}))
      housing[plan.points[c.from].x] = {c.cells, c.ratio};
    const double half = 0.5 * std::min(length, d.width);
    int n_common = 0;
    for (const auto& [x, division] : ring) {
      if (x < -half - 1e-9 || x > half - 1e-9) continue;
      ++n_common;
      ASSERT_TRUE(housing.contains(x)) << "length " << length << ", x " << x;
      EXPECT_EQ(housing[x], division);
    }
    EXPECT_GE(n_common, 4);
    EXPECT_EQ(housing.size(), static_cast<std::size_t>(n_common) + (length > d.width + 1e-9 ? 2 : 0));
  }
}

TEST(BearingSection, SaysWhichKeyIsWrong) {
  auto d = deep_groove();
  EXPECT_TRUE(faults_of_section(d).empty());
  d.inner_shoulder = 78e-3;
  expect_fault(d, "inner_shoulder_diameter", "leaves no groove");
  d = deep_groove();
  d.outer_shoulder = 103e-3;
  expect_fault(d, "outer_shoulder_diameter", "leaves no groove");
  d = deep_groove();
  d.inner_bore = 79e-3;
  expect_fault(d, "inner_ring_diameters", "cuts through the wall");
  d = deep_groove();
  d.inner_shoulder = 90e-3;
  expect_fault(d, "inner_shoulder_diameter", "encloses the balls");
  d = deep_groove();
  d.width = 8e-3;
  expect_fault(d, "width", "reaches over");
  d = pair();
  d.rows = {{-2e-3, -1.}, {2e-3, 1.}};
  expect_fault(d, "width", "overlap");
  d = pair();
  d.contact_angle = 50. * std::numbers::pi / 180.;
  expect_fault(d, "contact_angle", "beyond its shoulder");
  d = deep_groove();
  d.housing_outside = 110e-3;
  expect_fault(d, "housing_diameters", "not larger");
}

TEST(BearingSection, RefinementHalvesCells) {
  const auto count = [](double refinement) {
    int n = 0;
    const auto plan = plan_bearing_section(pair(), {.refinement = refinement});
    for (const auto& b : plan.blocks) n += plan.curves[b.curves[0]].cells * plan.curves[b.curves[1]].cells;
    return n;
  };
  const double ratio = static_cast<double>(count(2.)) / count(1.);
  EXPECT_GT(ratio, 3.);
  EXPECT_LT(ratio, 5.);
}

}  // namespace
}  // namespace rotordrop
