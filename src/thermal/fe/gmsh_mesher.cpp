#include "thermal/fe/gmsh_mesher.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <limits>
#include <map>
#include <new>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/rotation.h"

namespace rotordrop {
namespace {

// Element types of gmsh.
constexpr int line_2 = 1, quadrilateral_4 = 3;

/// Runs `work` on a fresh model; whatever gmsh throws, but for want of memory, becomes a SolverError with its last words.
template <class Work>
auto in_fresh_model(const std::string& task, Work work) {
  struct Model {
    Model() { gmsh::model::add("section"); }
    ~Model() { gmsh::clear(); }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
  };
  try {
    const Model model;
    return work();
  } catch (const SolverError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // depending on the place an int, a string or an exception
    std::string words;
    gmsh::logger::getLastError(words);
    throw SolverError("gmsh could not " + task + (words.empty() ? "" : ": " + words));
  }
}

/// Gmsh's numbers start at 1.
int tag(std::size_t index) { return static_cast<int>(index) + 1; }

void define(const SectionPlan& plan) {
  namespace geo = gmsh::model::geo;
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    geo::addPoint(plan.points[i].x, plan.points[i].r, 0., 0., tag(i));
  for (std::size_t i = 0; i < plan.arcs.size(); ++i)
    geo::addPoint(plan.arcs[i].x, plan.arcs[i].r, 0., 0., tag(plan.points.size() + i));
  for (std::size_t i = 0; i < plan.curves.size(); ++i) {
    const auto& c = plan.curves[i];
    if (c.arc < 0)
      geo::addLine(tag(c.from), tag(c.to), tag(i));
    else
      geo::addCircleArc(tag(c.from), tag(plan.points.size() + static_cast<std::size_t>(c.arc)), tag(c.to), tag(i));
    geo::mesh::setTransfiniteCurve(tag(i), c.cells + 1, "Progression", c.ratio);
  }
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) {
    const auto& block = plan.blocks[i];
    std::vector<int> loop, corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_along = plan.curves[block.curves[k]].from == block.corners[k];
      loop.push_back(is_along ? tag(block.curves[k]) : -tag(block.curves[k]));
      corners.push_back(tag(block.corners[k]));
    }
    geo::addCurveLoop(loop, tag(i));
    geo::addPlaneSurface({tag(i)}, tag(i));
    geo::mesh::setTransfiniteSurface(tag(i), "Left", corners);
    geo::mesh::setRecombine(2, tag(i));
  }
  geo::synchronize();
}

/// Vertices of gmsh's nodes, in the order of their numbers.
template <class Add>
std::map<std::size_t, unsigned int> take_vertices(Add add) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, std::size_t> places;
  for (std::size_t i = 0; i < tags.size(); ++i) places.emplace(tags[i], i);
  std::map<std::size_t, unsigned int> vertex;
  for (const auto& [node, place] : places) {
    add(coordinates[3 * place], coordinates[3 * place + 1], coordinates[3 * place + 2]);
    vertex.emplace(node, static_cast<unsigned int>(vertex.size()));
  }
  return vertex;
}

/// Calls use(type, nodes of one element) for the elements of an entity.
template <class Use>
void for_each_element(int dimension, int entity, Use use) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const std::size_t n_nodes = nodes[t].size() / elements[t].size();
    for (std::size_t e = 0; e < elements[t].size(); ++e)
      use(types[t], std::vector<std::size_t>(nodes[t].begin() + static_cast<std::ptrdiff_t>(e * n_nodes),
                                             nodes[t].begin() + static_cast<std::ptrdiff_t>((e + 1) * n_nodes)));
  }
}

using Place = std::array<double, 2>;

/// Where the vertices of a curve belong, from `from` to `to`.
std::vector<Place> places_on(const SectionPlan& plan, const SectionPlan::Curve& curve) {
  const auto &a = plan.points[curve.from], &b = plan.points[curve.to];
  std::vector<Place> places;
  double whole = 0., part = 0., cell = 1.;
  for (int k = 0; k < curve.cells; ++k, cell *= curve.ratio) whole += cell;
  cell = 1.;
  for (int k = 1; k < curve.cells; ++k, cell *= curve.ratio) {
    part += cell;
    const double s = part / whole;
    if (curve.arc < 0) {
      places.push_back({a.x + s * (b.x - a.x), a.r + s * (b.r - a.r)});
    } else {
      const auto& arc = plan.arcs[static_cast<std::size_t>(curve.arc)];
      const double start = std::atan2(a.r - arc.r, a.x - arc.x);
      const double turn = shorter_way(std::atan2(b.r - arc.r, b.x - arc.x) - start);
      places.push_back(
          {arc.x + arc.radius * std::cos(start + s * turn), arc.r + arc.radius * std::sin(start + s * turn)});
    }
  }
  places.insert(places.begin(), {a.x, a.r});
  places.push_back({b.x, b.r});
  return places;
}

/// Where the vertices inside a block belong: transfinite interpolation between its sides.
std::vector<Place> places_inside(const SectionPlan& plan, const SectionPlan::Block& block) {
  std::array<std::vector<Place>, 4> side;  // low r, high x, high r, low x; along rising x or r
  for (std::size_t k = 0; k < 4; ++k) {
    side[k] = places_on(plan, plan.curves[block.curves[k]]);
    const std::size_t start = block.corners[std::array<std::size_t, 4>{0, 1, 3, 0}[k]];
    if (plan.curves[block.curves[k]].from != start) std::reverse(side[k].begin(), side[k].end());
  }
  // Parts of the length of the low and the left side, by the chords.
  const auto parts = [](const std::vector<Place>& p) {
    std::vector<double> sum = {0.};
    for (std::size_t i = 1; i < p.size(); ++i)
      sum.push_back(sum.back() + std::hypot(p[i][0] - p[i - 1][0], p[i][1] - p[i - 1][1]));
    for (auto& s : sum) s /= sum.back();
    return sum;
  };
  const auto u = parts(side[0]), v = parts(side[3]);
  std::vector<Place> places;
  for (std::size_t i = 1; i + 1 < u.size(); ++i)
    for (std::size_t j = 1; j + 1 < v.size(); ++j) {
      Place p{};
      for (std::size_t c = 0; c < 2; ++c)
        p[c] = (1. - v[j]) * side[0][i][c] + v[j] * side[2][i][c] + (1. - u[i]) * side[3][j][c] + u[i] * side[1][j][c] -
               (1. - u[i]) * (1. - v[j]) * side[0].front()[c] - u[i] * (1. - v[j]) * side[0].back()[c] -
               u[i] * v[j] * side[2].back()[c] - (1. - u[i]) * v[j] * side[2].front()[c];
      places.push_back(p);
    }
  return places;
}

/// Puts gmsh's vertices where the plan wants them. Gmsh's own places depend, in their last bits, on what it meshed before.
void put_in_place(const SectionPlan& plan, const std::map<std::size_t, unsigned int>& vertex,
                  std::vector<Place>& vertices) {
  const auto put = [&](int dimension, std::size_t index, const std::vector<Place>& places) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension, tag(index));
    if (tags.size() != places.size()) throw SolverError("gmsh divided a block of the section in its own way");
    std::vector<bool> is_taken(places.size(), false);
    for (const auto node : tags) {
      auto& p = vertices[vertex.at(node)];
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < places.size(); ++i)
        if (const double d = std::hypot(places[i][0] - p[0], places[i][1] - p[1]); d < least) {
          least = d;
          nearest = i;
        }
      if (is_taken[nearest]) throw SolverError("gmsh graded a block of the section in its own way");
      is_taken[nearest] = true;
      p = places[nearest];
    }
  };
  for (std::size_t i = 0; i < plan.points.size(); ++i) put(0, i, {{plan.points[i].x, plan.points[i].r}});
  for (std::size_t i = 0; i < plan.curves.size(); ++i) {
    auto places = places_on(plan, plan.curves[i]);
    put(1, i, {places.begin() + 1, places.end() - 1});
  }
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) put(2, i, places_inside(plan, plan.blocks[i]));
}

double doubled_area(const SectionMesh& mesh, const SectionMesh::Cell& cell) {
  const auto &a = mesh.vertices[cell.vertices[0]], &b = mesh.vertices[cell.vertices[1]],
             &c = mesh.vertices[cell.vertices[2]], &d = mesh.vertices[cell.vertices[3]];
  return (c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]);
}

/// Vertices of the first body first, and so on; those that no cell uses are left out.
void number_by_bodies(SectionMesh& mesh) {
  std::vector<std::vector<unsigned int>> of_body(mesh.bodies.size());
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const auto& cell : mesh.cells)
    for (const auto v : cell.vertices)
      if (!is_used[v]) {
        is_used[v] = true;
        of_body[cell.body].push_back(v);
      }
  std::vector<unsigned int> number(mesh.vertices.size(), 0);
  std::vector<Place> ordered;
  for (auto& vertices : of_body) {
    std::sort(vertices.begin(), vertices.end());
    for (const auto v : vertices) {
      number[v] = static_cast<unsigned int>(ordered.size());
      ordered.push_back(mesh.vertices[v]);
    }
  }
  mesh.vertices = std::move(ordered);
  for (auto& cell : mesh.cells)
    for (auto& v : cell.vertices) v = number[v];
  for (auto& edge : mesh.edges)
    for (auto& v : edge.vertices) v = number[v];
}

}  // namespace

GmshMesher::GmshMesher() {
  // Gmsh takes the interrupt signal for itself, which the program needs to end a run in good order.
  struct sigaction interrupt = {};
  sigaction(SIGINT, nullptr, &interrupt);
  gmsh::initialize(0, nullptr, false);
  sigaction(SIGINT, &interrupt, nullptr);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Mesh.ElementOrder", 1);
  gmsh::option::setNumber("Mesh.SaveAll", 0);
}

GmshMesher::~GmshMesher() { gmsh::finalize(); }

SectionMesh GmshMesher::mesh(const SectionPlan& plan) {
  return in_fresh_model("mesh the section", [&] {
    define(plan);
    gmsh::model::mesh::generate(2);
    SectionMesh mesh;
    mesh.bodies = plan.bodies;
    mesh.arcs = plan.arcs;
    const auto vertex = take_vertices([&](double x, double r, double) { mesh.vertices.push_back({x, r}); });
    put_in_place(plan, vertex, mesh.vertices);
    // Centres of arcs are points of the plan too; they have no nodes that cells use.
    for (std::size_t i = 0; i < plan.blocks.size(); ++i)
      for_each_element(2, tag(i), [&](int type, const std::vector<std::size_t>& nodes) {
        if (type != quadrilateral_4) throw SolverError("gmsh left a triangle in a block of the section");
        SectionMesh::Cell cell;
        for (std::size_t k = 0; k < 4; ++k) cell.vertices[k] = vertex.at(nodes[k]);
        cell.body = static_cast<unsigned int>(plan.blocks[i].body);
        if (doubled_area(mesh, cell) < 0.) std::swap(cell.vertices[1], cell.vertices[3]);
        mesh.cells.push_back(cell);
      });
    for (std::size_t i = 0; i < plan.curves.size(); ++i) {
      const auto& curve = plan.curves[i];
      if (!curve.boundary) continue;
      for_each_element(1, tag(i), [&](int, const std::vector<std::size_t>& nodes) {
        mesh.edges.push_back({{vertex.at(nodes[0]), vertex.at(nodes[1])}, *curve.boundary, curve.arc});
      });
    }
    number_by_bodies(mesh);
    return mesh;
  });
}

void GmshMesher::write(const SectionMesh& mesh, const std::string& file, MeshFileFormat format) {
  in_fresh_model("write " + file, [&] {
    namespace model = gmsh::model;
    // One surface for each body, one curve for each part of its outline.
    std::vector<std::vector<std::size_t>> vertices_of(mesh.bodies.size());
    std::vector<int> owner(mesh.vertices.size(), -1);
    std::vector<std::vector<std::size_t>> quadrilaterals(mesh.bodies.size());
    for (const auto& cell : mesh.cells)
      for (const auto v : cell.vertices) {
        quadrilaterals[cell.body].push_back(v + 1);
        if (owner[v] < 0) {
          owner[v] = static_cast<int>(cell.body);
          vertices_of[cell.body].push_back(v);
        }
      }
    std::vector<std::pair<HeatBoundary, std::vector<std::size_t>>> parts;
    for (const auto& edge : mesh.edges) {
      auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.first == edge.boundary; });
      if (found == parts.end()) found = parts.insert(parts.end(), {edge.boundary, {}});
      for (const auto v : edge.vertices) found->second.push_back(v + 1);
    }
    for (std::size_t i = 0; i < mesh.bodies.size(); ++i) {
      model::addDiscreteEntity(2, tag(i));
      std::vector<std::size_t> tags;
      std::vector<double> coordinates;
      std::sort(vertices_of[i].begin(), vertices_of[i].end());
      for (const auto v : vertices_of[i]) {
        tags.push_back(v + 1);
        coordinates.insert(coordinates.end(), {mesh.vertices[v][0], mesh.vertices[v][1], 0.});
      }
      model::mesh::addNodes(2, tag(i), tags, coordinates);
      model::mesh::addElementsByType(tag(i), quadrilateral_4, {}, quadrilaterals[i]);
      model::setPhysicalName(2, model::addPhysicalGroup(2, {tag(i)}), mesh.bodies[i]);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      model::addDiscreteEntity(1, tag(i));
      model::mesh::addElementsByType(tag(i), line_2, {}, parts[i].second);
      model::setPhysicalName(1, model::addPhysicalGroup(1, {tag(i)}), boundary_name(mesh, parts[i].first));
    }
    gmsh::option::setNumber("Mesh.MshFileVersion", format == MeshFileFormat::msh_2_2 ? 2.2 : 4.1);
    gmsh::write(file);
  });
}

MeshFileContent GmshMesher::read(const std::string& file) {
  return in_fresh_model("read " + file, [&] {
    gmsh::merge(file);
    if (file.ends_with(".geo")) gmsh::model::mesh::generate(2);
    MeshFileContent content;
    const auto vertex = take_vertices([&](double x, double r, double z) { content.vertices.push_back({x, r, z}); });
    const auto take = [&](int dimension, std::vector<MeshFileContent::Element>& into) {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto& [dim, entity] : entities) {
        std::vector<int> groups;
        gmsh::model::getPhysicalGroupsForEntity(dim, entity, groups);
        std::vector<std::string> names;
        for (const int group : groups) {
          std::string name;
          gmsh::model::getPhysicalName(dim, group, name);
          names.push_back(name.empty() ? std::to_string(group) : name);
        }
        for_each_element(dim, entity, [&](int type, const std::vector<std::size_t>& nodes) {
          MeshFileContent::Element element;
          element.n_vertices = static_cast<int>(nodes.size());
          if (type == line_2 || type == quadrilateral_4)
            for (std::size_t k = 0; k < nodes.size(); ++k) element.vertices[k] = vertex.at(nodes[k]);
          element.groups = names;
          into.push_back(std::move(element));
        });
      }
    };
    take(1, content.edges);
    take(2, content.faces);
    return content;
  });
}

}  // namespace rotordrop

extern "C" __attribute__((visibility("default"))) rotordrop::SectionMesher* rotordrop_section_mesher() {
  static rotordrop::GmshMesher mesher;
  return &mesher;
}
