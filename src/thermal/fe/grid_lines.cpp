#include "thermal/fe/grid_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"

namespace rotordrop {
namespace {

// Lines closer than this part of the whole extent are one.
constexpr double same_line = 1e-9;

void sort_and_merge(std::vector<double>& lines) {
  std::sort(lines.begin(), lines.end());
  const double gap = same_line * (lines.back() - lines.front());
  lines.erase(std::unique(lines.begin(), lines.end(), [gap](double a, double b) { return b - a <= gap; }), lines.end());
}

// Divides [a, b] so that every cell has the same integral of 1/size.
void divide(double a, double b, const auto& size, std::vector<double>& lines) {
  constexpr int n_samples = 4000;
  std::vector<double> sum(n_samples + 1, 0.);
  const double h = (b - a) / n_samples;
  for (int i = 0; i < n_samples; ++i)
    sum[static_cast<std::size_t>(i) + 1] = sum[static_cast<std::size_t>(i)] + h / size(a + (i + 0.5) * h);
  if (!(sum.back() < 1e5))
    throw SolverError(
        "the section needs more than 100000 lines of cells between two edges: check its dimensions, "
        "fe.cells and fe.grading");
  const int n = std::max(1, static_cast<int>(std::ceil(sum.back() - 1e-6)));
  for (int k = 1; k < n; ++k) {
    const double wanted = sum.back() * k / n;
    const auto above = std::upper_bound(sum.begin(), sum.end(), wanted);
    const auto i = above - sum.begin() - 1;
    lines.push_back(a + h * (static_cast<double>(i) + (wanted - *(above - 1)) / (*above - *(above - 1))));
  }
  lines.push_back(b);
}

struct Demands {
  std::vector<GridDemand> x, r;
};

// Where an interface ends inside a side, the flux has a corner's singularity: of r^(-1/3) between bodies without contact resistance, logarithmic with
// some. Cells get thinner towards that point from all directions.
void add_ends_of_interfaces(const HeatConductionProblem& problem, Demands& demands) {
  const auto& n = problem.numerics;
  if (n.end_grading <= 1.) return;
  for (const auto& interface : problem.interfaces) {
    const auto &one = problem.bodies.at(interface.first.body), &two = problem.bodies.at(interface.second.body);
    const bool is_face = interface.first.side == HeatSide::left || interface.first.side == HeatSide::right;
    const auto &along_1 = is_face ? one.r : one.x, &along_2 = is_face ? two.r : two.x;
    const double at = interface.first.side == HeatSide::left    ? one.x[0]
                      : interface.first.side == HeatSide::right ? one.x[1]
                      : interface.first.side == HeatSide::inner ? one.r[0]
                                                                : one.r[1];
    // The smaller of the two bodies rules, by its smaller side.
    double size = std::numeric_limits<double>::infinity();
    for (const auto* body : {&one, &two}) size = std::min({size, body->x[1] - body->x[0], body->r[1] - body->r[0]});
    const double thin = size / n.cells / n.end_grading, same = 1e-6 * size;
    for (const std::size_t end : {0, 1}) {
      if (std::fabs(along_1[end] - along_2[end]) <= same) continue;
      const double where = end == 0 ? std::max(along_1[0], along_2[0]) : std::min(along_1[1], along_2[1]);
      (is_face ? demands.r : demands.x).push_back({where, where, thin});
      (is_face ? demands.x : demands.r).push_back({at, at, thin});
    }
  }
}

}  // namespace

std::vector<double> grid_lines(std::vector<double> ends, const std::vector<GridDemand>& demands, double growth) {
  sort_and_merge(ends);
  // Sizes follow the centres of cells: a ratio g of neighbours means a slope of 2 (g - 1)/(g + 1).
  const double slope = 2. * (growth - 1.) / (growth + 1.);
  const auto size = [&](double x) {
    double s = std::numeric_limits<double>::infinity();
    for (const auto& d : demands) s = std::min(s, d.size + slope * std::max({d.from - x, x - d.to, 0.}));
    return s;
  };
  std::vector<double> lines = {ends.front()};
  for (std::size_t i = 1; i < ends.size(); ++i) divide(ends[i - 1], ends[i], size, lines);
  return lines;
}

Grid make_grid(const HeatConductionProblem& problem) {
  const auto& n = problem.numerics;
  std::vector<double> x, r;
  Demands demands;
  auto &demands_x = demands.x, &demands_r = demands.r;
  for (const auto& body : problem.bodies) {
    x.insert(x.end(), body.x.begin(), body.x.end());
    r.insert(r.end(), body.r.begin(), body.r.end());
    demands_x.push_back({body.x[0], body.x[1], (body.x[1] - body.x[0]) / n.cells});
    demands_r.push_back({body.r[0], body.r[1], (body.r[1] - body.r[0]) / n.cells});
  }
  std::vector<HeatBoundary> heated;
  for (const auto& flux : problem.fluxes) {
    heated.push_back(flux.boundary);
    if (flux.second) heated.push_back(*flux.second);
  }
  for (const auto& fixed : problem.fixed) heated.push_back(fixed.boundary);
  for (const auto& port : problem.ports) heated.insert(heated.end(), port.boundaries.begin(), port.boundaries.end());
  for (const auto& boundary : heated) {
    const auto& body = problem.bodies.at(boundary.body);
    const double thin_x = (body.x[1] - body.x[0]) / n.cells / n.grading,
                 thin_r = (body.r[1] - body.r[0]) / n.cells / n.grading;
    switch (boundary.side) {
      case HeatSide::left:
        demands_x.push_back({body.x[0], body.x[0], thin_x});
        break;
      case HeatSide::right:
        demands_x.push_back({body.x[1], body.x[1], thin_x});
        break;
      case HeatSide::inner:
        demands_r.push_back({body.r[0], body.r[0], thin_r});
        break;
      case HeatSide::outer:
        demands_r.push_back({body.r[1], body.r[1], thin_r});
        break;
      case HeatSide::raceway:
      case HeatSide::strip:
        break;  // rectangles have none
    }
  }
  add_ends_of_interfaces(problem, demands);
  return {grid_lines(x, demands_x, n.growth), grid_lines(r, demands_r, n.growth)};
}

}  // namespace rotordrop
