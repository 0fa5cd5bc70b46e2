// A user's mesh is taken only if it is a section: each fault has its words.
#include "thermal/section/own_section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

using Element = MeshFileContent::Element;

/// Rings and a housing of 3 x 1 cells, one row; the inner ring's middle cell has its strip on top.
MeshFileContent small_mesh() {
  MeshFileContent m;
  const auto quad = [&](const char* body, unsigned int a, unsigned int b, unsigned int c, unsigned int d) {
    m.faces.push_back({4, {a, b, c, d}, {body}});
  };
  const auto edge = [&](const std::string& group, unsigned int a, unsigned int b) {
    m.edges.push_back({2, {a, b, 0, 0}, {group}});
  };
  const auto ring = [&](const std::string& name, double low, double high, bool strip_is_low) {
    const auto first = static_cast<unsigned int>(m.vertices.size());
    for (const double r : {low, high})
      for (int i = 0; i < 4; ++i) m.vertices.push_back({0.01 * i, r, 0.});
    for (unsigned int i = 0; i < 3; ++i) {
      quad(name.c_str(), first + i, first + i + 1, first + i + 5, first + i + 4);
      const std::string grooved = i == 1 ? ".strip_1" : strip_is_low ? ".inner" : ".outer";
      edge(name + (strip_is_low ? grooved : ".inner"), first + i, first + i + 1);
      edge(name + (strip_is_low ? ".outer" : grooved), first + i + 4, first + i + 5);
    }
    edge(name + ".left", first, first + 4);
    edge(name + ".right", first + 3, first + 7);
  };
  ring("inner_ring", 0.03, 0.04, false);
  ring("outer_ring", 0.05, 0.06, true);
  const auto first = static_cast<unsigned int>(m.vertices.size());
  for (const double r : {0.06, 0.07})
    for (int i = 0; i < 4; ++i) m.vertices.push_back({0.01 * i, r, 0.});
  for (unsigned int i = 0; i < 3; ++i) {
    quad("housing", first + i, first + i + 1, first + i + 5, first + i + 4);
    edge("housing.inner", first + i, first + i + 1);
    edge("housing.outer", first + i + 4, first + i + 5);
  }
  edge("housing.left", first, first + 4);
  edge("housing.right", first + 3, first + 7);
  return m;
}

const OwnSectionWishes wishes{{"inner_ring", "outer_ring", "housing"}, 1, {}};

std::string complaint(const MeshFileContent& content) {
  Faults faults;
  const auto mesh = own_section(content, wishes, "my.msh", faults);
  std::string text;
  for (const auto& f : faults) {
    EXPECT_EQ(f.where.file, "my.msh");
    text += f.message + "\n" + f.advice + "\n";
  }
  EXPECT_EQ(mesh.empty(), !text.empty());
  return text;
}

void expect_complaint(const MeshFileContent& content, const std::string& words) {
  const auto text = complaint(content);
  EXPECT_NE(text.find(words), std::string::npos) << "wanted: " << words << "\ngot: " << text;
}

TEST(OwnSection, IsTakenAsItIs) {
  EXPECT_EQ(complaint(small_mesh()), "");
  Faults faults;
  const auto mesh = own_section(small_mesh(), wishes, "my.msh", faults);
  EXPECT_EQ(mesh.cells.size(), 9U);
  EXPECT_EQ(mesh.edges.size(), 24U);
  EXPECT_EQ(mesh.bodies, wishes.bodies);
  EXPECT_TRUE(mesh.arcs.empty()) << "a strip of one straight edge is no arc";
}

TEST(OwnSection, TurnsClockwiseCells) {
  auto m = small_mesh();
  std::swap(m.faces[0].vertices[1], m.faces[0].vertices[3]);
  EXPECT_EQ(complaint(m), "");
}

TEST(OwnSection, MayHaveNoTriangles) {
  auto m = small_mesh();
  m.faces[2].n_vertices = 3;
  expect_complaint(m, "a triangle");
  m.faces[2].n_vertices = 9;
  expect_complaint(m, "9 vertices");
}

TEST(OwnSection, NeedsEveryBody) {
  auto m = small_mesh();
  m.faces.resize(6);
  expect_complaint(m, "no body \"housing\"");
}

TEST(OwnSection, KnowsTheNamesOfBodies) {
  auto m = small_mesh();
  m.faces[0].groups = {"iner_ring"};
  expect_complaint(m, "Did you mean \"inner_ring\"?");
  m.faces[0].groups = {};
  expect_complaint(m, "in no body or in several");
}

TEST(OwnSection, KnowsTheNamesOfSides) {
  for (const char* name : {"inner_ring.bore", "inner_ring.strip_2", "inner_ring.strip_0", "inner_ring.strip_01",
                           "inner_ring.strip_", "housing.strip_1", "strip_1", "shaft.outer"}) {
    auto m = small_mesh();
    m.edges[0].groups = {name};
    expect_complaint(m, std::string("the group \"") + name + "\" is not part of an outline");
  }
}

TEST(OwnSection, NeedsANameForEveryEdgeOfItsOutline) {
  auto m = small_mesh();
  m.edges.erase(m.edges.begin());
  expect_complaint(m, "1 edges of outlines are in no group, the first near x = 0.005 m, r = 0.03 m on inner_ring");
}

TEST(OwnSection, NamesNoEdgeTwice) {
  auto m = small_mesh();
  m.edges[0].groups.push_back("inner_ring.left");
  expect_complaint(m, "inner_ring.inner and inner_ring.left");
  m = small_mesh();
  m.edges.push_back(m.edges[0]);
  expect_complaint(m, "listed twice");
}

TEST(OwnSection, NamesOnlyItsOwnOutline) {
  auto m = small_mesh();
  m.edges.push_back({2, {1, 5, 0, 0}, {"inner_ring.left"}});
  expect_complaint(m, "not on the outline");
}

TEST(OwnSection, NeedsTheStrips) {
  auto m = small_mesh();
  for (auto& e : m.edges)
    if (e.groups[0] == "outer_ring.strip_1") e.groups = {"outer_ring.inner"};
  expect_complaint(m, "\"outer_ring.strip_1\" is missing");
}

TEST(OwnSection, KeepsBodiesApart) {
  auto m = small_mesh();
  m.faces.push_back({4, {5, 6, 9, 8}, {"housing"}});  // shares vertices with inner and outer ring
  for (const auto& [a, b] : {std::pair{5U, 8U}, {6U, 9U}}) m.edges.push_back({2, {a, b, 0, 0}, {"housing.left"}});
  expect_complaint(m, "share vertices");
}

TEST(OwnSection, SharesNotEvenACorner) {
  auto m = small_mesh();
  // The housing's lower left corner becomes the outer ring's upper left one.
  const auto corner = static_cast<unsigned int>(m.vertices.size()) - 8;
  for (auto* list : {&m.faces, &m.edges})
    for (auto& e : *list)
      for (auto& v : e.vertices)
        if (v == corner && (e.groups[0].starts_with("housing"))) v = 12;
  expect_complaint(m, "share vertices");
}

TEST(OwnSection, MeetsVertexOnVertexInTheFit) {
  auto m = small_mesh();
  m.vertices[17][0] += 1e-6;  // the housing's second vertex in the fit
  expect_complaint(m, "lies on none of");
  m = small_mesh();
  for (std::size_t v = 16; v < 24; ++v) m.vertices[v][1] += 1e-4;  // a gap
  expect_complaint(m, "outer_ring.outer at x = 0 m, r = 0.06 m lies on none of housing.inner");
}

TEST(OwnSection, LiesInMetresAboveTheAxisInThePlane) {
  auto m = small_mesh();
  m.vertices[0][2] = 1e-3;
  expect_complaint(m, "plane z = 0");
  m = small_mesh();
  for (auto& v : m.vertices)
    for (auto& c : v) c *= 1e3;
  expect_complaint(m, "millimetres");
  m = small_mesh();
  for (auto& v : m.vertices) v[1] -= 0.035;
  expect_complaint(m, "negative radius");
}

TEST(OwnSection, HasNoTangledCells) {
  auto m = small_mesh();
  m.vertices[5] = {0.015, 0.025, 0.};  // a corner pushed through the opposite side
  expect_complaint(m, "inverted or not convex");
}

TEST(OwnSection, FindsTheArcOfARacewayAndLeavesStraightOnesStraight) {
  auto m = small_mesh();
  // The inner ring's top: a circle of radius 0.05 about (0.015, 0.08); raceway, strip, raceway.
  for (unsigned int i = 4; i < 8; ++i)
    m.vertices[i][1] = 0.08 - std::sqrt(0.05 * 0.05 - std::pow(m.vertices[i][0] - 0.015, 2));
  for (auto& e : m.edges)
    if (e.groups[0] == "inner_ring.outer") e.groups = {"inner_ring.raceway_1"};
  Faults faults;
  auto mesh = own_section(m, wishes, "my.msh", faults);
  ASSERT_EQ(faults.size(), 0U);
  ASSERT_EQ(mesh.arcs.size(), 1U);
  EXPECT_NEAR(mesh.arcs[0].x, 0.015, 1e-9);
  EXPECT_NEAR(mesh.arcs[0].r, 0.08, 1e-9);
  EXPECT_NEAR(mesh.arcs[0].radius, 0.05, 1e-9);
  for (const auto& e : mesh.edges) {
    const bool is_groove =
        e.boundary.body == 0 && (e.boundary.side == HeatSide::raceway || e.boundary.side == HeatSide::strip);
    EXPECT_EQ(e.arc, is_groove ? 0 : -1);
  }
  m.vertices[5][1] += 1e-5;
  mesh = own_section(m, wishes, "my.msh", faults);
  EXPECT_TRUE(mesh.arcs.empty());
}

}  // namespace
}  // namespace rotordrop
