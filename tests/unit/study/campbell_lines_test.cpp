// Lines of a Campbell diagram whose modes are made up: frequencies that depend on the speed in a known way, each over its own range of speeds.
// What is asked for: as many lines as there were, each with the frequencies of one of them throughout.
#include "study/modes/campbell_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace rotordrop {
namespace {

struct Motion {
  std::function<double(double)> frequency;  // at a part of the highest speed [Hz]
  double from = 0., to = 1.;                // parts of it
};

constexpr int n_speeds = 61;

CriticalSpeedReport diagram(const std::vector<Motion>& motions) {
  CriticalSpeedReport report;
  for (int k = 0; k < n_speeds; ++k) {
    const double part = k / (n_speeds - 1.);
    WhirlModes at;
    for (const Motion& motion : motions)
      if (part >= motion.from && part <= motion.to) {
        WhirlMode mode;
        mode.frequency = motion.frequency(part);
        at.modes.push_back(mode);
      }
    std::sort(at.modes.begin(), at.modes.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
    report.diagram_speeds.push_back(1000. * part);
    report.diagram_modes.push_back(std::move(at));
  }
  return report;
}

bool is_followed(const CampbellLine& line, const Motion& motion) {
  const auto part = [](const CampbellPoint& point) { return point.speed / 1000.; };
  return part(line.front()) - motion.from < 1. / (n_speeds - 1) &&
         motion.to - part(line.back()) < 1. / (n_speeds - 1) &&
         std::all_of(line.begin(), line.end(), [&](const CampbellPoint& point) {
           return std::fabs(point.mode->frequency - motion.frequency(part(point))) < 1e-9;  // Hz, roundoff
         });
}

void expect_each_followed(const std::vector<Motion>& motions, double largest_frequency) {
  const auto report = diagram(motions);
  const auto lines = campbell_lines(report, largest_frequency);
  EXPECT_EQ(lines.size(), motions.size());
  for (const Motion& motion : motions)
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return is_followed(line, motion); }));
}

std::function<double(double)> constant(double frequency) {
  return [frequency](double) { return frequency; };
}

TEST(CampbellLines, FollowModesThatLeaveAndEnterAmongOthers) {
  expect_each_followed({{constant(100.)}, {constant(180.)}, {constant(140.), 0.3}}, 400.);
  expect_each_followed({{constant(100.)}, {constant(180.)}, {constant(60.), 0., 0.7}}, 400.);
  expect_each_followed({{constant(100.)}, {constant(180.)}, {constant(300.), 0.5}}, 400.);
}

TEST(CampbellLines, FollowModesWhereOneLeavesAtTheTopAsAnotherEntersAtTheBottom) {
  // As many modes at each speed: counted from either end each would jump to its neighbour.
  expect_each_followed({{constant(100.)}, {constant(220.)}, {constant(340.), 0., 0.5}, {constant(30.), 0.501}}, 400.);
}

TEST(CampbellLines, FollowGyroscopicSplittingToTwiceTheSpin) {
  // A thin disc's forward whirl tends to twice the spin frequency, of which the diagram's height is 1.25; the backward one to zero.
  const double height = 1.25 * 200.;
  expect_each_followed(
      {{[](double part) { return 20. + 200. * part; }}, {[](double part) { return 20. / (1. + 20. * part); }}}, height);
  const auto report = diagram({{[](double part) { return 20. + 400. * part; }}, {constant(10.)}});
  const auto lines = campbell_lines(report, height);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[0].back().speed, 1000. * (height - 20.) / 400.,
              1000. / (n_speeds - 1));  // cut at the height, within a step
  EXPECT_EQ(lines[1].size(), std::size_t{n_speeds});
}

}  // namespace
}  // namespace rotordrop
