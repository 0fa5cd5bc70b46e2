#include "thermal/fe/gmsh_mesher.h"

#include <gmsh.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "base/errors.h"

namespace rotordrop {
namespace {

// Element types of gmsh.
constexpr int line_2 = 1, quadrilateral_4 = 3;

/// Runs `work` on a fresh model; whatever gmsh throws becomes a SolverError with its last words.
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

double doubled_area(const SectionMesh& mesh, const SectionMesh::Cell& cell) {
  const auto &a = mesh.vertices[cell.vertices[0]], &b = mesh.vertices[cell.vertices[1]],
             &c = mesh.vertices[cell.vertices[2]], &d = mesh.vertices[cell.vertices[3]];
  return (c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]);
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
  // Grading is found by numerical integration: to the last digits, so that cells follow their series.
  gmsh::option::setNumber("Mesh.LcIntegrationPrecision", 1e-12);
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
    // Leave out what no cell uses, and number the rest in order.
    std::vector<unsigned int> number(mesh.vertices.size(), 0);
    for (const auto& cell : mesh.cells)
      for (const auto v : cell.vertices) number[v] = 1;
    std::vector<std::array<double, 2>> used;
    for (std::size_t v = 0; v < number.size(); ++v)
      if (std::exchange(number[v], static_cast<unsigned int>(used.size())) == 1) used.push_back(mesh.vertices[v]);
    mesh.vertices = std::move(used);
    for (auto& cell : mesh.cells)
      for (auto& v : cell.vertices) v = number[v];
    for (auto& edge : mesh.edges)
      for (auto& v : edge.vertices) v = number[v];
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
