#include "model/section_mesher.h"

#include <charconv>

namespace rotordrop {
namespace {

constexpr const char* side_names[] = {"left", "right", "inner", "outer", "raceway", "strip"};

bool has_rows(HeatSide side) { return side == HeatSide::raceway || side == HeatSide::strip; }

}  // namespace

std::string boundary_name(const SectionMesh& mesh, const HeatBoundary& b) {
  std::string name = mesh.bodies.at(b.body) + "." + side_names[static_cast<std::size_t>(b.side)];
  if (has_rows(b.side)) name += "_" + std::to_string(b.row + 1);
  return name;
}

std::optional<HeatBoundary> boundary_of_name(const std::string& name) {
  for (std::size_t i = 0; i < std::size(side_names); ++i) {
    const auto side = static_cast<HeatSide>(i);
    const std::string start = has_rows(side) ? std::string(side_names[i]) + "_" : side_names[i];
    if (!has_rows(side)) {
      if (name == start) return HeatBoundary{0, side, 0};
      continue;
    }
    if (!name.starts_with(start)) continue;
    int row = 0;
    const char* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + start.size(), end, row);
    if (error == std::errc() && stop == end && row >= 1 && name[start.size()] != '0')
      return HeatBoundary{0, side, row - 1};
  }
  return {};
}

}  // namespace rotordrop
