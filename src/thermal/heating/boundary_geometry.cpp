#include "thermal/heating/boundary_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rotordrop {

std::array<double, 2> extent_along(const HeatConductionProblem& problem, const HeatBoundary& b) {
  const auto& body = problem.bodies[b.body];
  return b.side == HeatSide::left || b.side == HeatSide::right ? body.r : body.x;
}
double line(const HeatConductionProblem& problem, const HeatBoundary& b) {
  const auto& body = problem.bodies[b.body];
  switch (b.side) {
    case HeatSide::left:
      return body.x[0];
    case HeatSide::right:
      return body.x[1];
    case HeatSide::inner:
      return body.r[0];
    case HeatSide::outer:
      return body.r[1];
    case HeatSide::raceway:
    case HeatSide::strip:
      break;  // rectangles have none
  }
  return 0.;
}

std::vector<std::array<double, 2>> free_parts(const HeatConductionProblem& problem, const HeatBoundary& b) {
  const auto whole = extent_along(problem, b);
  std::vector<std::array<double, 2>> covered, parts;
  for (const auto& interface : problem.interfaces)
    for (const auto* side : {&interface.first, &interface.second})
      if (*side == b)
        covered.push_back(extent_along(problem, side == &interface.first ? interface.second : interface.first));
  std::sort(covered.begin(), covered.end());
  covered.push_back({whole[1], whole[1]});
  double reached = whole[0];
  const double slack = 1e-6 * (whole[1] - whole[0]);
  for (const auto& [from, to] : covered) {
    const double end = std::min(from, whole[1]);
    if (end > reached + slack) parts.push_back({reached, end});
    reached = std::max(reached, to);
  }
  return parts;
}
double free_area(const HeatConductionProblem& problem, const HeatBoundary& b) {
  double area = 0.;
  for (const auto& [from, to] : free_parts(problem, b)) area += area_of(problem, b, from, to);
  return area;
}
double area_of(const HeatConductionProblem& problem, const HeatBoundary& b, double from, double to) {
  const bool is_face = b.side == HeatSide::left || b.side == HeatSide::right;
  return std::numbers::pi * (to - from) * (is_face ? to + from : 2. * line(problem, b));
}

void check_proportions(const HeatConductionProblem& problem, const Node& tree, Faults& faults) {
  constexpr double thinnest = 1e-6;  // of the whole; lines closer than 1e-9 of it are one
  for (const auto side : {&HeatBody::x, &HeatBody::r}) {
    double low = std::numeric_limits<double>::infinity(), high = -low, least = low;
    for (const auto& body : problem.bodies) {
      low = std::min(low, (body.*side)[0]);
      high = std::max(high, (body.*side)[1]);
      least = std::min(least, (body.*side)[1] - (body.*side)[0]);
    }
    if (least < thinnest * (high - low))
      faults.add(position_of(tree, "section"),
                 fmt::format("the section is {:.4g} m {}, but a body of it only {:.4g} m: no mesh can show both.",
                             high - low, side == &HeatBody::x ? "long" : "high", least),
                 "Check the units: a bare number is in metres.");
  }
}

}  // namespace rotordrop
