// A free ring with a hot layer at its bore flares at its ends. No closed form: the expected displacements are CalculiX 2.20's, with CAX8 elements on a mesh
// of its own, as validation/growth_calculix.py computes them again (that script reads what this test prints). CalculiX makes its axisymmetric elements wedges
// of 2 degrees, whose radial displacements it lets come out smaller by sin(1 deg)/(1 deg), 5.1e-5: half of the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fe_room.h"

namespace rotordrop {
namespace {

constexpr double a = 35e-3, b = 41e-3, L = 16e-3, layer = 1e-3, T_0 = 293.15;

struct Expected {
  const char* side;
  double r, place;       // place: part of the length
  double axial, radial;  // [um]
};
const Expected calculix[] = {
    {"bore", a, 0.0, -4.950916, 6.460569},    {"bore", a, 0.125, -2.806105, 3.881261},
    {"bore", a, 0.25, -1.731970, 2.839981},   {"bore", a, 0.5, 0.000000, 2.035639},
    {"outside", b, 0.0, 1.255889, 5.710644},  {"outside", b, 0.125, 1.135552, 4.545886},
    {"outside", b, 0.25, 0.824939, 3.504411}, {"outside", b, 0.5, 0.000000, 2.645051},
};

/// From `from` to `to`, the first cell the smallest.
std::vector<double> graded(double from, double to, int n) {
  std::vector<double> lines;
  for (int i = 0; i <= n; ++i) lines.push_back(from + (to - from) * std::pow(static_cast<double>(i) / n, 1.7));
  lines.back() = to;
  return lines;
}
SectionMesh mesh_of_lines(const std::vector<double>& x, const std::vector<double>& r) {
  SectionMesh mesh;
  mesh.bodies = {"ring"};
  const auto n_x = static_cast<unsigned int>(x.size()), n_r = static_cast<unsigned int>(r.size());
  const auto vertex = [&](unsigned int i, unsigned int j) { return j * n_x + i; };
  for (const double r_j : r)
    for (const double x_i : x) mesh.vertices.push_back({x_i, r_j});
  for (unsigned int j = 0; j + 1 < n_r; ++j)
    for (unsigned int i = 0; i + 1 < n_x; ++i)
      mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, 0});
  for (unsigned int i = 0; i + 1 < n_x; ++i) {
    mesh.edges.push_back({{vertex(i, 0), vertex(i + 1, 0)}, {0, HeatSide::inner, 0}, -1});
    mesh.edges.push_back({{vertex(i, n_r - 1), vertex(i + 1, n_r - 1)}, {0, HeatSide::outer, 0}, -1});
  }
  for (unsigned int j = 0; j + 1 < n_r; ++j) {
    mesh.edges.push_back({{vertex(0, j), vertex(0, j + 1)}, {0, HeatSide::left, 0}, -1});
    mesh.edges.push_back({{vertex(n_x - 1, j), vertex(n_x - 1, j + 1)}, {0, HeatSide::right, 0}, -1});
  }
  return mesh;
}

TEST(EndFlare, OfARingWithAHotLayerIsCalculixsTo1e4) {
  ElasticProblem problem;
  problem.bodies = {{"ring", {0., L}, {a, b}, 7800., 2.05e11, 0.3, PropertyTable(11.8e-6), 0.}};
  problem.outputs = {{"bore", {{0, HeatSide::inner}}}};
  // Fine where surfaces meet; the layer ends on a line.
  auto x = graded(0., 0.5 * L, 24);
  for (std::size_t i = x.size() - 1; i-- > 0;) x.push_back(L - x[i]);
  auto r = graded(a, a + layer, 16);
  const auto rest = graded(b, a + layer, 16);
  r.insert(r.end(), rest.rbegin() + 1, rest.rend());
  problem.mesh = mesh_of_lines(x, r);
  const auto solver = make_elastic_solver(problem);
  solver->solve(solver->interpolate(
                    [](std::size_t, double, double y) { return T_0 + 100. * std::max(0., 1. - (y - a) / layer); }),
                0.);
  double largest = 0.;
  for (const auto& e : calculix) largest = std::max({largest, std::fabs(e.axial), std::fabs(e.radial)});
  for (const auto& e : calculix) {
    const auto u = solver->displacement(0, e.place * L, e.r);
    std::printf("flare: %s %.3f %.10e %.10e\n", e.side, e.place, u[0], u[1]);
    EXPECT_NEAR(u[0] * 1e6, e.axial, 1e-4 * largest) << e.side << " at " << e.place;
    EXPECT_NEAR(u[1] * 1e6, e.radial, 1e-4 * largest) << e.side << " at " << e.place;
  }
  // The end opens more than the middle: a flare, not a shift.
  EXPECT_GT(solver->displacement(0, 0., a)[1], 1.05 * solver->displacement(0, 0.5 * L, a)[1]);
}

}  // namespace
}  // namespace rotordrop
