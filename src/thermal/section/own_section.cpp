#include "thermal/section/own_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/parameters/suggestion.h"

namespace rotordrop {
namespace {

using Vertices = std::array<unsigned int, 2>;

Vertices sorted(unsigned int a, unsigned int b) { return {std::min(a, b), std::max(a, b)}; }

/// Collects faults of one file; of many alike only the first is told in full.
class Reader {
 public:
  Reader(const MeshFileContent& content, const OwnSectionWishes& wishes, const std::string& file, Faults& faults)
      : content_(content), wishes_(wishes), file_(file), faults_(faults) {}

  SectionMesh read() {
    mesh_.bodies = wishes_.bodies;
    const std::size_t n_before = faults_.size();
    read_vertices();
    read_cells();
    if (faults_.size() == n_before) read_edges();
    if (faults_.size() == n_before) check_parts();
    if (faults_.size() == n_before) check_contacts();
    if (faults_.size() != n_before) return {};
    find_arcs();
    leave_out_unused_vertices();
    return std::move(mesh_);
  }

 private:
  void fault(const std::string& message, const std::string& advice) { faults_.add({file_, 0, 0}, message, advice); }

  [[nodiscard]] std::string place(std::span<const unsigned int> vertices) const {
    double x = 0., r = 0.;
    for (const auto v : vertices) {
      x += content_.vertices[v][0] / static_cast<double>(vertices.size());
      r += content_.vertices[v][1] / static_cast<double>(vertices.size());
    }
    return fmt::format("near x = {:.4g} m, r = {:.4g} m", x, r);
  }

  void read_vertices() {
    double extent = 0.;
    bool is_flat = true, is_above_axis = true;
    for (const auto& [x, r, z] : content_.vertices) {
      mesh_.vertices.push_back({x, r});
      extent = std::max({extent, std::fabs(x), std::fabs(r)});
      is_flat = is_flat && z == 0.;
      is_above_axis = is_above_axis && r >= 0.;
    }
    if (!is_flat)
      fault("the mesh does not lie in the plane z = 0.",
            "The first coordinate is x along the axis, the second the radius.");
    if (!is_above_axis)
      fault("vertices have a negative radius.", "The second coordinate is the distance from the axis.");
    if (extent > 10.)
      fault(fmt::format("the mesh reaches to {:.4g} m.", extent),
            "Coordinates must be in metres; these look like millimetres.");
  }

  void read_cells() {
    std::size_t n_others = 0, n_nameless = 0;
    std::string first_other, first_nameless;
    std::set<std::string> unknown;
    std::vector<bool> is_present(wishes_.bodies.size(), false);
    for (const auto& element : content_.faces) {
      if (element.n_vertices != 4) {
        if (n_others++ == 0)
          first_other =
              element.n_vertices == 3 ? "a triangle" : fmt::format("an element with {} vertices", element.n_vertices);
        continue;
      }
      if (element.groups.size() != 1) {
        if (n_nameless++ == 0) first_nameless = place(element.vertices);
        continue;
      }
      const auto known = std::find(wishes_.bodies.begin(), wishes_.bodies.end(), element.groups.front());
      if (known == wishes_.bodies.end()) {
        unknown.insert(element.groups.front());
        continue;
      }
      const auto body = static_cast<std::size_t>(known - wishes_.bodies.begin());
      is_present[body] = true;
      add_cell(element.vertices, static_cast<unsigned int>(body));
    }
    if (n_others > 0)
      fault(fmt::format(
                "the mesh has {}, and {} such elements in all; only quadrilaterals with four vertices are allowed.",
                first_other, n_others),
            "In gmsh: transfinite surfaces with Recombine Surface, and Mesh.ElementOrder = 1.");
    if (n_nameless > 0)
      fault(fmt::format("{} cells are in no body or in several, the first {}.", n_nameless, first_nameless),
            fmt::format("Put every surface into one physical group: {}.", fmt::join(wishes_.bodies, ", ")));
    for (const auto& name : unknown)
      fault(fmt::format("the group \"{}\" is not a body of this bearing.", name), suggestion(name, wishes_.bodies));
    for (std::size_t i = 0; i < is_present.size(); ++i)
      if (!is_present[i])
        fault(fmt::format("there is no body \"{}\".", wishes_.bodies[i]),
              fmt::format("Required physical surfaces: {}.", fmt::join(wishes_.bodies, ", ")));
    if (n_tangled_ > 0)
      fault(fmt::format("{} cells are inverted or not convex, the first {}.", n_tangled_, first_tangled_),
            "Every corner must be below 180 degrees.");
  }

  void add_cell(std::array<unsigned int, 4> v, unsigned int body) {
    const auto corner = [&](std::size_t i) {
      const auto &a = mesh_.vertices[v[(i + 3) % 4]], &b = mesh_.vertices[v[i]], &c = mesh_.vertices[v[(i + 1) % 4]];
      return (c[0] - b[0]) * (a[1] - b[1]) - (c[1] - b[1]) * (a[0] - b[0]);
    };
    if (corner(0) < 0.) std::swap(v[1], v[3]);
    for (std::size_t i = 0; i < 4; ++i)
      if (!(corner(i) > 0.)) {
        if (n_tangled_++ == 0) first_tangled_ = place(v);
        break;
      }
    mesh_.cells.push_back({v, body});
  }

  void read_edges() {
    // Edges of the outlines: those that one cell has.
    struct Side {
      unsigned int body;
      int n_cells;
    };
    std::map<Vertices, Side> sides;
    for (const auto& cell : mesh_.cells)
      for (std::size_t i = 0; i < 4; ++i) {
        auto [found, is_new] =
            sides.try_emplace(sorted(cell.vertices[i], cell.vertices[(i + 1) % 4]), Side{cell.body, 0});
        ++found->second.n_cells;
      }
    std::vector<int> owner(mesh_.vertices.size(), -1);
    bool is_shared = false;
    for (const auto& cell : mesh_.cells)
      for (const auto v : cell.vertices) {
        is_shared = is_shared || (owner[v] >= 0 && owner[v] != static_cast<int>(cell.body));
        owner[v] = static_cast<int>(cell.body);
      }
    if (is_shared)
      fault("two bodies share vertices.",
            "Where bodies touch, each needs its own vertices at the same positions: heat passes between them through "
            "a resistance.");
    std::map<Vertices, HeatBoundary> named;
    std::map<std::string, std::string> unknown;
    for (const auto& element : content_.edges) {
      if (element.n_vertices != 2 || element.groups.empty()) continue;
      const Vertices ends = sorted(element.vertices[0], element.vertices[1]);
      if (element.groups.size() > 1) {
        fault(fmt::format("an edge {} is in the groups {}.", place(ends), fmt::join(element.groups, " and ")),
              "Every edge of an outline belongs to one group.");
        return;
      }
      const std::string& group = element.groups.front();
      const auto boundary = boundary_named(group);
      if (!boundary) {
        unknown.emplace(group, place(ends));
        continue;
      }
      const auto side = sides.find(ends);
      if (side == sides.end() || side->second.n_cells != 1 || side->second.body != boundary->body) {
        fault(fmt::format("an edge of the group \"{}\" {} is not on the outline of {}.", group, place(ends),
                          mesh_.bodies[boundary->body]),
              "Groups of curves name parts of their own body's outline.");
        return;
      }
      if (!named.emplace(ends, *boundary).second) {
        fault(fmt::format("an edge {} is listed twice.", place(ends)),
              "Every edge of an outline belongs to one group.");
        return;
      }
      mesh_.edges.push_back({{element.vertices[0], element.vertices[1]}, *boundary, -1});
    }
    for (const auto& [group, where] : unknown)
      fault(fmt::format("the group \"{}\" is not part of an outline.", group), suggestion(group, known_groups()));
    std::size_t n_open = 0;
    std::string first;
    for (const auto& [ends, side] : sides)
      if (side.n_cells == 1 && !named.contains(ends) && n_open++ == 0)
        first = fmt::format("{} on {}", place(ends), mesh_.bodies[side.body]);
    if (n_open > 0 && unknown.empty())
      fault(fmt::format("{} edges of outlines are in no group, the first {}.", n_open, first),
            "Put every curve of an outline into a physical group such as " + known_groups().front() + ".");
  }

  [[nodiscard]] std::optional<HeatBoundary> boundary_named(const std::string& group) const {
    const auto dot = group.find('.');
    if (dot == std::string::npos) return {};
    const auto body = std::find(wishes_.bodies.begin(), wishes_.bodies.end(), group.substr(0, dot));
    auto boundary = boundary_of_name(group.substr(dot + 1));
    if (body == wishes_.bodies.end() || !boundary) return {};
    const bool is_of_row = boundary->side == HeatSide::raceway || boundary->side == HeatSide::strip;
    if (is_of_row && (!is_ring(*body) || boundary->row >= wishes_.rows)) return {};
    boundary->body = static_cast<std::size_t>(body - wishes_.bodies.begin());
    return boundary;
  }

  static bool is_ring(const std::string& body) { return body.ends_with("_ring"); }

  [[nodiscard]] std::vector<std::string> known_groups() const {
    std::vector<std::string> names;
    for (std::size_t body = 0; body < mesh_.bodies.size(); ++body) {
      for (const auto side : {HeatSide::inner, HeatSide::outer, HeatSide::left, HeatSide::right})
        names.push_back(boundary_name(mesh_, {body, side, 0}));
      if (is_ring(mesh_.bodies[body]))
        for (int row = 0; row < wishes_.rows; ++row)
          for (const auto side : {HeatSide::strip, HeatSide::raceway})
            names.push_back(boundary_name(mesh_, {body, side, row}));
    }
    return names;
  }

  void check_parts() {
    std::vector<HeatBoundary> needed;
    for (std::size_t body = 0; body < mesh_.bodies.size(); ++body) {
      if (is_ring(mesh_.bodies[body]))
        for (int row = 0; row < wishes_.rows; ++row) needed.push_back({body, HeatSide::strip, row});
      if (mesh_.bodies[body] == "inner_ring") needed.push_back({body, HeatSide::inner, 0});
      if (mesh_.bodies[body] == "outer_ring" || mesh_.bodies[body].starts_with("shaft"))
        needed.push_back({body, HeatSide::outer, 0});
      if (mesh_.bodies[body] == "housing")
        for (const auto side : {HeatSide::inner, HeatSide::outer}) needed.push_back({body, side, 0});
    }
    for (const auto& step : wishes_.shaft_steps) {
      const std::size_t body = body_named(step.name);
      needed.push_back({body, step.is_left ? HeatSide::right : HeatSide::left, 0});
      if (step.is_first)
        needed.push_back({body_named("shaft"), step.is_left ? HeatSide::left : HeatSide::right, 0});
      else
        needed.push_back({body - 1, step.is_left ? HeatSide::left : HeatSide::right, 0});
    }
    for (const auto& boundary : needed)
      if (std::none_of(mesh_.edges.begin(), mesh_.edges.end(), [&](const auto& e) { return e.boundary == boundary; }))
        fault(fmt::format("the group \"{}\" is missing or empty.", boundary_name(mesh_, boundary)),
              "Heat enters or leaves there, so the mesh must name it.");
  }

  [[nodiscard]] std::size_t body_named(const std::string& name) const {
    return static_cast<std::size_t>(std::find(mesh_.bodies.begin(), mesh_.bodies.end(), name) - mesh_.bodies.begin());
  }

  void check_contacts() {
    check_contact({body_named("outer_ring"), HeatSide::outer}, {body_named("housing"), HeatSide::inner}, 0);
    std::size_t before = 0;
    for (const auto& step : wishes_.shaft_steps) {
      if (step.is_first) before = body_named("shaft");
      const std::size_t k = body_named(step.name);
      check_contact({before, step.is_left ? HeatSide::left : HeatSide::right},
                    {k, step.is_left ? HeatSide::right : HeatSide::left}, 1);
      before = k;
    }
  }

  /// Over the length that two sides have in common, every vertex of one lies on a vertex of the other.
  /// @param along  0: x, 1: r
  void check_contact(const HeatBoundary& one, const HeatBoundary& two, std::size_t along) {
    constexpr double same_place = 1e-8;  // [m]
    const auto places_of = [&](const HeatBoundary& side) {
      std::vector<std::array<double, 2>> places;
      for (const auto& edge : mesh_.edges)
        if (edge.boundary == side)
          for (const auto v : edge.vertices) places.push_back(mesh_.vertices[v]);
      std::sort(places.begin(), places.end(), [&](const auto& p, const auto& q) { return p[along] < q[along]; });
      return places;
    };
    const auto first = places_of(one), second = places_of(two);
    if (first.empty() || second.empty()) return;
    const double from = std::max(first.front()[along], second.front()[along]) - same_place,
                 to = std::min(first.back()[along], second.back()[along]) + same_place;
    for (const auto& [these, those] : {std::pair{&first, &second}, std::pair{&second, &first}})
      for (const auto& p : *these) {
        if (p[along] < from || p[along] > to) continue;
        const bool is_met = std::any_of(those->begin(), those->end(), [&](const auto& q) {
          return std::hypot(p[0] - q[0], p[1] - q[1]) <= same_place;
        });
        if (is_met) continue;
        const bool is_first = these == &first;
        fault(fmt::format("a vertex of {} at x = {:.6g} m, r = {:.6g} m lies on none of {}.",
                          boundary_name(mesh_, is_first ? one : two), p[0], p[1],
                          boundary_name(mesh_, is_first ? two : one)),
              along == 0 ? "In the fit, vertices of both bodies must be at the same places: divide both sides alike."
                         : "Where pieces of the shaft touch, vertices of both must be at the same places: divide both "
                           "faces alike.");
        return;
      }
  }

  void find_arcs() {
    std::map<std::pair<std::size_t, int>, std::vector<std::size_t>> of_row;
    for (std::size_t i = 0; i < mesh_.edges.size(); ++i) {
      const auto& b = mesh_.edges[i].boundary;
      if (b.side == HeatSide::raceway || b.side == HeatSide::strip) of_row[{b.body, b.row}].push_back(i);
    }
    for (const auto& [row, edges] : of_row) {
      const auto arc = circle_through(edges);
      if (!arc) continue;
      mesh_.arcs.push_back(*arc);
      for (const auto i : edges) mesh_.edges[i].arc = static_cast<int>(mesh_.arcs.size()) - 1;
    }
  }

  void leave_out_unused_vertices() {  // such as the centres of arcs
    std::vector<unsigned int> number(mesh_.vertices.size(), 0);
    for (const auto& cell : mesh_.cells)
      for (const auto v : cell.vertices) number[v] = 1;
    std::vector<std::array<double, 2>> used;
    for (std::size_t v = 0; v < number.size(); ++v)
      if (std::exchange(number[v], static_cast<unsigned int>(used.size())) == 1) used.push_back(mesh_.vertices[v]);
    mesh_.vertices = std::move(used);
    for (auto& cell : mesh_.cells)
      for (auto& v : cell.vertices) v = number[v];
    for (auto& edge : mesh_.edges)
      for (auto& v : edge.vertices) v = number[v];
  }

  /// The circle of the outermost and the middle vertex, if all others are on it.
  [[nodiscard]] std::optional<SectionMesh::Arc> circle_through(const std::vector<std::size_t>& edges) const {
    std::vector<std::array<double, 2>> p;
    for (const auto i : edges)
      for (const auto v : mesh_.edges[i].vertices) p.push_back(mesh_.vertices[v]);
    std::sort(p.begin(), p.end());
    const auto a = p.front(), b = p[p.size() / 2], c = p.back();
    const double ux = b[0] - a[0], ur = b[1] - a[1], vx = c[0] - a[0], vr = c[1] - a[1];
    const double twice_area = ux * vr - ur * vx;
    if (std::fabs(twice_area) < 1e-6 * (vx * vx + vr * vr)) return {};  // as good as straight
    const double u2 = ux * ux + ur * ur, v2 = vx * vx + vr * vr;
    const double x = (u2 * vr - v2 * ur) / (2. * twice_area), r = (v2 * ux - u2 * vx) / (2. * twice_area);
    const SectionMesh::Arc arc{a[0] + x, a[1] + r, std::hypot(x, r)};
    for (const auto& q : p)
      if (std::fabs(std::hypot(q[0] - arc.x, q[1] - arc.r) - arc.radius) > 1e-7) return {};
    return arc;
  }

  const MeshFileContent& content_;
  const OwnSectionWishes& wishes_;
  const std::string& file_;
  Faults& faults_;
  SectionMesh mesh_;
  std::size_t n_tangled_ = 0;
  std::string first_tangled_;
};

}  // namespace

SectionMesh own_section(const MeshFileContent& content, const OwnSectionWishes& wishes, const std::string& file,
                        Faults& faults) {
  return Reader(content, wishes, file, faults).read();
}

}  // namespace rotordrop
