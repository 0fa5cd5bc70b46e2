#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// The meshed section of an axisymmetric body, as plain data: what a mesh generator hands to the finite elements.
namespace rotordrop {

/// Named parts of a body's outline. Sides by radius are inner and outer, by x left and right. A ring with a groove has a raceway (its arc beside
/// the strip) and a strip (the part of the arc that the contact ellipses sweep) in every row; what else looks to the balls is its outer or inner side.
enum class HeatSide { left, right, inner, outer, raceway, strip };

struct HeatBoundary {
  std::size_t body = 0;
  HeatSide side = HeatSide::inner;
  int row = 0;  ///< of raceway and strip, from 0
  bool operator==(const HeatBoundary&) const = default;
};

/// Quadrilaterals in the r-z half plane. Bodies share no vertices; where two touch, their edges lie on each other, vertex on vertex.
struct SectionMesh {
  struct Cell {
    std::array<unsigned int, 4> vertices{};  ///< counterclockwise in the (x, r) plane
    unsigned int body = 0;
  };
  struct Edge {  ///< of the outline of a body: every one is listed
    std::array<unsigned int, 2> vertices{};
    HeatBoundary boundary;
    int arc = -1;  ///< index of the arc that it is a piece of; -1: straight
  };
  struct Arc {
    double x = 0, r = 0, radius = 0;  ///< centre and radius [m]
  };
  std::vector<std::array<double, 2>> vertices;  ///< x, r [m]
  std::vector<Cell> cells;
  std::vector<Edge> edges;
  std::vector<Arc> arcs;
  std::vector<std::string> bodies;  ///< names, such as "inner_ring"
  [[nodiscard]] bool empty() const { return cells.empty(); }
};

}  // namespace rotordrop
