#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/section_mesh.h"

namespace rotordrop {

/// What a mesh of a section shall be: four-sided blocks, each divided evenly in number along opposite sides. Plain data, without a mesh generator.
/// Blocks of one body share points and curves; bodies share none.
struct SectionPlan {
  struct Point {
    double x = 0, r = 0;  ///< [m]
  };
  struct Curve {
    std::size_t from = 0, to = 0;  ///< points
    int cells = 1;
    double ratio = 1;                      ///< length of each cell over that of the one before it, from `from` to `to`
    int arc = -1;                          ///< index of the arc that it is a piece of; -1: straight
    std::optional<HeatBoundary> boundary;  ///< on the outline of its body
  };
  struct Block {
    std::array<std::size_t, 4> curves{};   ///< low r, high x, high r, low x
    std::array<std::size_t, 4> corners{};  ///< points, counterclockwise in the (x, r) plane, from low r and low x
    std::size_t body = 0;
  };
  std::vector<Point> points;
  std::vector<Curve> curves;
  std::vector<Block> blocks;
  std::vector<SectionMesh::Arc> arcs;
  std::vector<std::string> bodies;
};

}  // namespace rotordrop
