// Meshed sections against closed forms.
//
// Area of an inner ring: (r_shoulder - r_bore) W less one segment of a circle per groove. A groove with edges at the angles alpha_l and
// alpha_r from its bottom, radius R, both shoulders at the same radius (alpha_l = alpha_r = alpha), takes away R^2 (alpha - sin alpha cos alpha).
// A relieved shoulder takes away more: between the angles 0 and alpha the groove takes, below the height R (1 - cos alpha),
// R^2/2 (alpha - sin alpha cos alpha) whatever the other side, and the relieved land a rectangle. The mesh is straight-sided: chords of an arc of n
// cells leave R^2/2 (theta - sin theta) each, below 1e-8 m^2 here, or lie beyond it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include "base/errors.h"
#include "case/case.h"
#include "machine/heat/bearing_mesh_data.h"
#include "model/section_quality.h"
#include "section_measures.h"
#include "thermal/fe/gmsh_mesher.h"
#include "thermal/section/bearing_section.h"
#include "thermal/section/own_section.h"

extern "C" rotordrop::SectionMesher* rotordrop_section_mesher();

namespace rotordrop {
namespace {

using testing::body_area;
using testing::boundary_length;

namespace fs = std::filesystem;

BearingSectionData single_row(double contact_angle = 0.) {
  BearingSectionData d;
  d.rows = {{0., 1.}};
  d.ball_diameter = 11.906e-3;
  d.pitch_diameter = 90e-3;
  d.contact_angle = contact_angle;
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
BearingSectionData two_rows(double first_direction) {
  BearingSectionData d;
  d.rows = {{-8e-3, first_direction}, {8e-3, 1.}};
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
BearingSectionData with_shaft(BearingSectionData d, double length) {
  d.shaft_radius = 34.75e-3;
  d.shaft_length = length;
  return d;
}
std::vector<std::pair<std::string, BearingSectionData>> all_kinds() {
  auto narrow_housing = single_row();
  narrow_housing.housing_length = 15e-3;
  auto housing_ends_in_groove = two_rows(-1.);
  housing_ends_in_groove.housing_length = 20e-3;
  return {{"deep groove", single_row()},
          {"angular contact", single_row(25. * std::numbers::pi / 180.)},
          {"X pair", two_rows(-1.)},
          {"tandem", two_rows(1.)},
          {"narrow housing", narrow_housing},
          {"housing ends in a groove", housing_ends_in_groove},
          {"with a long shaft", with_shaft(two_rows(-1.), 60e-3)},
          {"with a short shaft", with_shaft(single_row(), 15e-3)}};
}

SectionMesh mesh_of(const BearingSectionData& d, double refinement = 1.) {
  return rotordrop_section_mesher()->mesh(plan_bearing_section(d, {.refinement = refinement}));
}
std::size_t body_of(const SectionMesh& mesh, const std::string& name) {
  const auto found = std::find(mesh.bodies.begin(), mesh.bodies.end(), name);
  EXPECT_NE(found, mesh.bodies.end()) << name;
  return static_cast<std::size_t>(found - mesh.bodies.begin());
}
double length_of(const SectionMesh& mesh, const std::string& body, HeatSide side, int row = 0) {
  return boundary_length(mesh, {body_of(mesh, body), side, row});
}

TEST(SectionMesh, HasTheAreasOfItsBodies) {
  for (const double refinement : {1., 4.}) {
    const auto d = single_row();
    const auto mesh = mesh_of(d, refinement);
    // Chords lie outside the material of a concave groove, by less than the step's square: 3e-8 m^2 of 1e-4 m^2 unrefined.
    const double tolerance = 3e-3 / (refinement * refinement);
    const double R = 0.52 * d.ball_diameter, rise = R - 0.5 * d.ball_diameter;
    const auto segment = [&](double centre, double shoulder) {
      const double alpha = std::acos(std::fabs(centre - shoulder) / R);
      return R * R * (alpha - std::sin(alpha) * std::cos(alpha));
    };
    const double inner = (41.45e-3 - 35e-3) * d.width - segment(45e-3 + rise, 41.45e-3);
    const double outer = (55e-3 - 48.6e-3) * d.width - segment(45e-3 - rise, 48.6e-3);
    EXPECT_NEAR(body_area(mesh, body_of(mesh, "inner_ring")) / inner, 1., tolerance);
    EXPECT_NEAR(body_area(mesh, body_of(mesh, "outer_ring")) / outer, 1., tolerance);
    EXPECT_NEAR(body_area(mesh, body_of(mesh, "housing")), 10e-3 * 25e-3, 1e-15) << "m^2";
  }
}

TEST(SectionMesh, HasTheAreaOfARingWithARelievedShoulder) {
  const auto d = single_row(25. * std::numbers::pi / 180.);
  const auto mesh = mesh_of(d, 4.);
  const double R = 0.52 * d.ball_diameter;
  const double centre = 45e-3 - (R - 0.5 * d.ball_diameter) * std::cos(d.contact_angle);
  const double centre_x = -(R - 0.5 * d.ball_diameter) * std::sin(d.contact_angle);
  const double depth = centre + R - 48.6e-3, low = 0.4 * depth;
  const auto half_segment = [&](double h) {
    const double alpha = std::acos(1. - h / R);
    return 0.5 * R * R * (alpha - std::sin(alpha) * std::cos(alpha));
  };
  // The contact leans to +x, so the shoulder at -x is relieved: from the face to the middle of the groove it keeps less.
  const double lost_left = half_segment(low) + (depth - low) * (0.5 * d.width + centre_x);
  const double area = (55e-3 - 48.6e-3) * d.width - half_segment(depth) - lost_left;
  EXPECT_NEAR(body_area(mesh, body_of(mesh, "outer_ring")) / area, 1., 2e-4);
}

TEST(SectionMesh, HasGoodCellsOnly) {
  for (const auto& [name, d] : all_kinds())
    for (const double refinement : {0.5, 1., 3.}) {
      const auto q = mesh_quality(mesh_of(d, refinement));
      EXPECT_GT(q.smallest_jacobian, 0.4) << name;
      EXPECT_GT(q.mean_jacobian, 0.9) << name;
    }
}

TEST(SectionMesh, NamesEveryEdgeOfItsOutlineOnce) {
  for (const auto& [name, d] : all_kinds()) {
    const auto mesh = mesh_of(d);
    std::map<std::pair<unsigned int, unsigned int>, int> n_cells, n_names;
    for (const auto& cell : mesh.cells)
      for (std::size_t k = 0; k < 4; ++k) ++n_cells[std::minmax(cell.vertices[k], cell.vertices[(k + 1) % 4])];
    for (const auto& edge : mesh.edges) ++n_names[std::minmax(edge.vertices[0], edge.vertices[1])];
    std::size_t n_outline = 0;
    for (const auto& [ends, n] : n_cells) {
      ASSERT_LE(n, 2) << name;
      if (n == 1) ++n_outline;
      EXPECT_EQ(n_names.contains(ends) ? n_names[ends] : 0, n == 1 ? 1 : 0) << name;
    }
    EXPECT_EQ(mesh.edges.size(), n_outline) << name;
  }
}

TEST(SectionMesh, HasVerticesOnItsArcs) {
  for (const auto& [name, d] : all_kinds()) {
    const auto mesh = mesh_of(d);
    std::size_t n_on_arcs = 0;
    for (const auto& edge : mesh.edges) {
      const bool is_groove = edge.boundary.side == HeatSide::raceway || edge.boundary.side == HeatSide::strip;
      ASSERT_EQ(edge.arc >= 0, is_groove) << name;
      if (!is_groove) continue;
      const auto& arc = mesh.arcs.at(static_cast<std::size_t>(edge.arc));
      for (const auto v : edge.vertices) {
        ++n_on_arcs;
        EXPECT_NEAR(std::hypot(mesh.vertices[v][0] - arc.x, mesh.vertices[v][1] - arc.r), arc.radius, 1e-13) << name;
      }
    }
    EXPECT_GT(n_on_arcs, 10U);
  }
}

TEST(SectionMesh, HasBoundariesOfTheRightLength) {
  for (const auto& [name, d] : all_kinds()) {
    const auto mesh = mesh_of(d);
    for (const char* ring : {"inner_ring", "outer_ring"})
      for (int row = 0; row < static_cast<int>(d.rows.size()); ++row)
        EXPECT_NEAR(length_of(mesh, ring, HeatSide::strip, row), 0.8e-3, 1e-9) << name;
    EXPECT_NEAR(length_of(mesh, "inner_ring", HeatSide::inner), d.width, 1e-12) << name;
    EXPECT_NEAR(length_of(mesh, "outer_ring", HeatSide::outer), d.width, 1e-12) << name;
    EXPECT_NEAR(length_of(mesh, "housing", HeatSide::inner), d.housing_length, 1e-12) << name;
    EXPECT_NEAR(length_of(mesh, "housing", HeatSide::outer), d.housing_length, 1e-12) << name;
    for (const auto side : {HeatSide::left, HeatSide::right})
      EXPECT_NEAR(length_of(mesh, "housing", side), 10e-3, 1e-12) << name;
    if (d.shaft_radius > 0.) {
      EXPECT_NEAR(length_of(mesh, "shaft", HeatSide::outer), d.shaft_length, 1e-12) << name;
      EXPECT_NEAR(length_of(mesh, "shaft", HeatSide::inner), d.shaft_length, 1e-12) << "the axis, " << name;
      EXPECT_NEAR(body_area(mesh, body_of(mesh, "shaft")), d.shaft_radius * d.shaft_length, 1e-14) << name;
    }
  }
}

TEST(SectionMesh, HasItsStripsAboutTheContactPoints) {
  const auto d = two_rows(-1.);
  const auto mesh = mesh_of(d);
  for (int row = 0; row < 2; ++row) {
    double x = 0., r = 0.;
    int n = 0;
    for (const auto& e : mesh.edges)
      if (e.boundary == HeatBoundary{body_of(mesh, "inner_ring"), HeatSide::strip, row})
        for (const auto v : e.vertices) x += mesh.vertices[v][0], r += mesh.vertices[v][1], ++n;
    const auto& place = d.rows[static_cast<std::size_t>(row)];
    // The mean of vertices on an arc lies a sagitta above its middle: 8 um.
    EXPECT_NEAR(x / n, place.x - place.direction * 0.5 * d.ball_diameter * std::sin(d.contact_angle), 1e-5) << "m";
    EXPECT_NEAR(r / n, 0.5 * (d.pitch_diameter - d.ball_diameter * std::cos(d.contact_angle)), 1e-5) << "m";
  }
}

TEST(SectionMesh, MeetsVertexOnVertexInTheFit) {
  for (const auto& [name, d] : all_kinds()) {
    const auto mesh = mesh_of(d);
    const double half = 0.5 * std::min(d.width, d.housing_length);
    const auto along = [&](const char* body, HeatSide side) {
      std::set<double> x;
      for (const auto& e : mesh.edges)
        if (e.boundary == HeatBoundary{body_of(mesh, body), side, 0})
          for (const auto v : e.vertices)
            if (std::fabs(mesh.vertices[v][0]) < half + 1e-9) {
              x.insert(mesh.vertices[v][0]);
              EXPECT_NEAR(mesh.vertices[v][1], 0.5 * d.outer_outside, 1e-15);
            }
      return std::vector<double>(x.begin(), x.end());
    };
    const auto ring = along("outer_ring", HeatSide::outer), housing = along("housing", HeatSide::inner);
    ASSERT_EQ(ring.size(), housing.size()) << name;
    for (std::size_t i = 0; i < ring.size(); ++i) EXPECT_NEAR(ring[i], housing[i], 1e-14) << name;
    EXPECT_NEAR(ring.front(), -half, 1e-12) << name;
    EXPECT_NEAR(ring.back(), half, 1e-12) << name;
  }
}

TEST(SectionMesh, SharesNoVerticesBetweenBodies) {
  for (const auto& [name, d] : all_kinds()) {
    const auto mesh = mesh_of(d);
    std::vector<int> owner(mesh.vertices.size(), -1);
    for (const auto& cell : mesh.cells)
      for (const auto v : cell.vertices) {
        EXPECT_TRUE(owner[v] < 0 || owner[v] == static_cast<int>(cell.body)) << name;
        owner[v] = static_cast<int>(cell.body);
      }
    EXPECT_EQ(std::count(owner.begin(), owner.end(), -1), 0) << name;
  }
}

/// Largest thickness of the cells on a boundary: across, from the boundary's edge to the opposite one.
double thickness_on(const SectionMesh& mesh, const HeatBoundary& boundary) {
  double largest = 0.;
  for (const auto& edge : mesh.edges) {
    if (!(edge.boundary == boundary)) continue;
    for (const auto& cell : mesh.cells)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto a = cell.vertices[k], b = cell.vertices[(k + 1) % 4];
        if (std::minmax(a, b) != std::minmax(edge.vertices[0], edge.vertices[1])) continue;
        const auto &c = mesh.vertices[cell.vertices[(k + 2) % 4]], &e = mesh.vertices[cell.vertices[(k + 3) % 4]];
        largest = std::max(largest, std::hypot(0.5 * (c[0] + e[0] - mesh.vertices[a][0] - mesh.vertices[b][0]),
                                               0.5 * (c[1] + e[1] - mesh.vertices[a][1] - mesh.vertices[b][1])));
      }
  }
  return largest;
}

TEST(SectionMesh, IsThinWhereHeatEnters) {
  for (const auto& [name, d] : all_kinds())
    for (const double refinement : {1., 2.}) {
      const auto mesh = mesh_of(d, refinement);
      const double wanted = 25e-6 / refinement * 1.0001;
      EXPECT_LE(thickness_on(mesh, {body_of(mesh, "inner_ring"), HeatSide::inner, 0}), wanted) << name;
      for (const char* ring : {"inner_ring", "outer_ring"})
        EXPECT_LE(thickness_on(mesh, {body_of(mesh, ring), HeatSide::strip, 0}), wanted) << name << ", " << ring;
      if (d.shaft_radius > 0.) {
        EXPECT_LE(thickness_on(mesh, {body_of(mesh, "shaft"), HeatSide::outer, 0}), wanted) << name;
      }
    }
}

TEST(SectionMesh, GrowsGently) {
  // Up the middle of a strip's column, cell by cell.
  const auto mesh = mesh_of(single_row());
  std::set<double> radii;
  for (const auto& v : mesh.vertices)
    if (std::fabs(v[0]) < 1e-12 && v[1] < 42e-3) radii.insert(v[1]);
  ASSERT_GT(radii.size(), 10U);
  std::vector<double> r(radii.begin(), radii.end());
  for (std::size_t i = 2; i < r.size(); ++i) {
    const double ratio = (r[i] - r[i - 1]) / (r[i - 1] - r[i - 2]);
    EXPECT_LT(std::max(ratio, 1. / ratio), 1.7) << "at r = " << r[i - 1];
  }
}

TEST(SectionMesh, IsSmallByDefault) {
  EXPECT_LT(mesh_of(single_row()).cells.size(), 750U);
  EXPECT_LT(mesh_of(two_rows(-1.)).cells.size(), 1200U);
}

TEST(SectionMesh, MirrorsItselfInAFaceToFacePair) {
  const auto mesh = mesh_of(two_rows(-1.));
  std::set<std::pair<long, long>> places;
  const auto place = [](double x, double r) { return std::pair{std::lround(x * 1e10), std::lround(r * 1e10)}; };
  const auto near = [&](const std::pair<long, long>& p) {
    for (const long i : {-1L, 0L, 1L})
      for (const long j : {-1L, 0L, 1L})
        if (places.contains({p.first + i, p.second + j})) return true;
    return false;
  };
  for (const auto& v : mesh.vertices) places.insert(place(v[0], v[1]));
  for (const auto& v : mesh.vertices) EXPECT_TRUE(near(place(-v[0], v[1]))) << v[0] << ", " << v[1];
}

bool is_same(const SectionMesh& a, const SectionMesh& b) {
  return a.vertices.size() == b.vertices.size() && a.cells.size() == b.cells.size() &&
         a.edges.size() == b.edges.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(a.vertices[0])) == 0 &&
         std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(),
                    [](const auto& p, const auto& q) { return p.vertices == q.vertices && p.body == q.body; });
}

TEST(GmshMesher, MakesTheSameMeshTwice) {
  const auto first = mesh_of(two_rows(-1.));
  static_cast<void>(mesh_of(single_row(), 2.));
  EXPECT_TRUE(is_same(first, mesh_of(two_rows(-1.))));
}

/// A file that is removed again.
struct Scratch {
  fs::path path;
  explicit Scratch(const std::string& name)
      : path(fs::temp_directory_path() / (std::to_string(::getpid()) + "-" + name)) {}
  ~Scratch() { fs::remove(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

TEST(GmshMesher, ReadsBackWhatItWrote) {
  auto& mesher = *rotordrop_section_mesher();
  for (const auto format : {MeshFileFormat::msh_2_2, MeshFileFormat::msh_4_1})
    for (const auto& d : {single_row(), two_rows(-1.), with_shaft(two_rows(1.), 40e-3)}) {
      const Scratch file("section.msh");
      const auto written = mesh_of(d);
      mesher.write(written, file.path.string(), format);
      OwnSectionWishes wishes{written.bodies, static_cast<int>(d.rows.size()), {}};
      Faults faults;
      const auto read = own_section(mesher.read(file.path.string()), wishes, "section.msh", faults);
      faults.throw_if_any();
      ASSERT_EQ(read.vertices.size(), written.vertices.size());
      for (std::size_t v = 0; v < read.vertices.size(); ++v) {
        EXPECT_NEAR(read.vertices[v][0], written.vertices[v][0], 1e-16);
        EXPECT_NEAR(read.vertices[v][1], written.vertices[v][1], 1e-16);
      }
      EXPECT_EQ(read.edges.size(), written.edges.size());
      ASSERT_EQ(read.arcs.size(), written.arcs.size());
      for (const auto& body : written.bodies) {
        EXPECT_NEAR(body_area(read, body_of(read, body)), body_area(written, body_of(written, body)), 1e-17) << body;
        for (const auto side :
             {HeatSide::inner, HeatSide::outer, HeatSide::left, HeatSide::right, HeatSide::raceway, HeatSide::strip})
          for (int row = 0; row < wishes.rows; ++row)
            EXPECT_NEAR(length_of(read, body, side, row), length_of(written, body, side, row), 1e-12) << body;
      }
    }
}

TEST(GmshMesher, ReadsAMeshThatGmshMadeFromAScript) {
  auto& mesher = *rotordrop_section_mesher();
  const fs::path recipe = fs::path(ROTORDROP_SOURCE_DIR) / "meshes" / "6014.geo";
  const auto content = mesher.read(recipe.string());
  Faults faults;
  const auto mesh = own_section(content, {{"inner_ring", "outer_ring", "housing"}, 1, {}}, recipe.string(), faults);
  faults.throw_if_any();
  EXPECT_GT(mesh.cells.size(), 100U);
  EXPECT_EQ(mesh.arcs.size(), 2U);
  EXPECT_GT(mesh_quality(mesh).smallest_jacobian, 0.4);
}

TEST(GmshMesher, SaysWhatItCannotRead) {
  auto& mesher = *rotordrop_section_mesher();
  const Scratch file("broken.msh");
  std::ofstream(file.path) << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\nnonsense\n";
  EXPECT_THROW(static_cast<void>(mesher.read(file.path.string())), SolverError);
  EXPECT_NO_THROW(static_cast<void>(mesh_of(single_row()))) << "and goes on working";
}

TEST(BearingMesh, IsMadeForEveryBearingOfTheCatalogue) {
  int n = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(ROTORDROP_SOURCE_DIR) / "params" / "bearings")) {
    if (entry.path().extension() != ".toml") continue;
    ++n;
    const std::string name = entry.path().stem().string();
    std::ifstream text(entry.path());
    std::string line;
    double bore = 0.;  // of the housing, which belongs to the machine and not to the catalogue
    while (std::getline(text, line))
      if (line.starts_with("outer_ring_diameters")) bore = std::stod(line.substr(line.find(", \"") + 3));
    const auto mm = [](double value) { return "\"" + std::to_string(value) + " mm\""; };
    const Scratch file("case.toml");
    std::ofstream(file.path)
        << "[run]\nend_time = 0.1\ninitial_speed = \"10000 rpm\"\n[rotor]\ngeometry = \"" << ROTORDROP_SOURCE_DIR
        << "/params/neisi2019-rotor.json\"\n[bearings.B]\ntype = \"touchdown\"\nnode = 2\ncontact_stiffness = 1e9\n"
        << "catalogue = \"" << name << "\"\nhousing_diameters = [" << mm(bore) << ", " << mm(bore + 20.)
        << "]\nhousing_length = \"30 mm\"\n"
        << "support = { mass = 85, K_y = 1e9, K_z = 1e9, C_y = 1e3, C_z = 1e3 }\n";
    const auto c = read_case(file.path);
    const auto mesh = rotordrop_section_mesher()->mesh(section_plan(c.parameters, c.tree, "B"));
    const auto q = mesh_quality(mesh);
    EXPECT_GT(q.smallest_jacobian, 0.4) << name;
    EXPECT_LT(q.thinnest_cell, 25.001e-6) << name;
    EXPECT_LT(mesh.cells.size(), 1400U) << name;
  }
  EXPECT_GT(n, 15);
}

}  // namespace
}  // namespace rotordrop
