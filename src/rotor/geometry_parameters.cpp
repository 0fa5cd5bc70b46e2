#include "rotor/geometry_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parameters/section.h"
#include "base/parameters/suggestion.h"

namespace rotordrop {

namespace {

struct NodeEntry {
  int id = 0;
  double x = 0;
};
struct ElementEntry {
  std::optional<int> id;
  int n1 = 0, n2 = 0;
  std::optional<double> length;
  double od = 0, older_bore = 0;
  std::optional<double> bore_diameter;
  std::optional<std::string> material, name;

  [[nodiscard]] double bore() const { return bore_diameter.value_or(older_bore); }
};
struct MassPointEntry {
  int node = 0;
  double mass = 0, Ip = 0, Id = 0;
  std::optional<std::string> name;
};
struct MaterialEntry {
  double E = 0, nu = 0, rho = 0;
  std::optional<std::string> name, shear_coefficient;
};
struct GeometryEntries {
  std::optional<std::string> description, units;
  std::optional<MaterialEntry> material;
  std::vector<std::pair<std::string, MaterialEntry>> materials;
  std::vector<NodeEntry> nodes;
  std::vector<ElementEntry> elements;
  std::vector<MassPointEntry> mass_points;
};

void check_geometry(const GeometryEntries& entries, const Node& table, Faults& faults);

Section<MaterialEntry> material_section() {
  Section<MaterialEntry> section("material", "Isotropic, linear elastic.");
  section.text("name", &MaterialEntry::name, {.help = "For the reader only."})
      .quantity("E", &MaterialEntry::E,
                {.unit = "Pa", .range = between(1e6, 1e13), .usual = between(1e9, 1.3e12), .help = "Young's modulus."})
      .quantity("nu", &MaterialEntry::nu, {.range = between(0, 0.5), .help = "Poisson's ratio."})
      .quantity("rho", &MaterialEntry::rho, {.unit = "kg/m3", .range = positive(), .help = "Density."})
      .text("shear_coefficient", &MaterialEntry::shear_coefficient,
            {.help = "For the reader only: the program always uses Cowper's."});
  return section;
}

const Section<GeometryEntries>& geometry_section() {
  static const auto section = [] {
    Section<NodeEntry> node("nodes");
    node.integer("id", &NodeEntry::id, {.range = at_least(1), .help = "Number; 1, 2, 3 ... along the shaft."})
        .quantity("x", &NodeEntry::x, {.unit = "m", .help = "Axial position; rises from node to node."});

    Section<ElementEntry> element("elements");
    element.integer("id", &ElementEntry::id, {.help = "For the reader only; the diameter of a bore is `bore`."})
        .text("name", &ElementEntry::name, {.help = "For the reader only."})
        .integer("n1", &ElementEntry::n1, {.range = at_least(1), .help = "Node at the smaller x."})
        .integer("n2", &ElementEntry::n2, {.range = at_least(1), .help = "The next node."})
        .quantity(
            "length", &ElementEntry::length,
            {.unit = "m", .range = positive(), .help = "If given, it is compared with the positions of the nodes."})
        .quantity("od", &ElementEntry::od, {.unit = "m", .range = positive(), .help = "Outer diameter."})
        .quantity("bore", &ElementEntry::bore_diameter,
                  {.unit = "m", .range = at_least(0), .help = "Diameter of the bore; a solid section if not given."})
        .quantity(
            "id_", &ElementEntry::older_bore,
            {.unit = "m", .range = at_least(0), .fallback = "0 m", .help = "The same as `bore`, as in older files."})
        .text("material", &ElementEntry::material, {.help = "A name in `materials`; without it, `material` holds."});

    Section<MassPointEntry> mass_point("mass_points");
    mass_point
        .integer("node", &MassPointEntry::node, {.range = at_least(1), .help = "Node that carries the mass point."})
        .text("name", &MassPointEntry::name, {.help = "For the reader only."})
        .quantity("mass", &MassPointEntry::mass,
                  {.unit = "kg", .range = at_least(0), .help = "Mass without stiffness."})
        .quantity("Ip", &MassPointEntry::Ip,
                  {.unit = "kg m2", .range = at_least(0), .fallback = "0", .help = "Inertia about the rotor's axis."})
        .quantity("Id", &MassPointEntry::Id,
                  {.unit = "kg m2", .range = at_least(0), .fallback = "0", .help = "Inertia about a diameter."});

    const auto ignore = [](const Node&, GeometryEntries&, Faults&) {};
    Section<GeometryEntries> geometry("", "Geometry of a rotor.");
    geometry.text("description", &GeometryEntries::description, {.help = "For the reader only."})
        .choice("units", &GeometryEntries::units, {"SI"}, {.help = "Unit of bare numbers."})
        .custom("targets", {.help = "For the reader only."}, ignore)
        .custom("achieved", {.help = "For the reader only."}, ignore)
        .table("material", &GeometryEntries::material, material_section(),
               {.help = "Material of every element without its own."})
        .tables("materials", &GeometryEntries::materials, material_section(), {.help = "Further materials by name."})
        .list("nodes", &GeometryEntries::nodes, node, {.min_count = 2})
        .list("elements", &GeometryEntries::elements, element, {.min_count = 1})
        .list("mass_points", &GeometryEntries::mass_points, mass_point)
        .check(check_geometry);
    return geometry;
  }();
  return section;
}

// -------------------------------------------------------------------------------------------------- checks on geometry

/// Place of one key of the k-th table of a list.
SourcePosition position_in(const Node& table, std::string_view list, std::size_t k, std::string_view key) {
  return position_of_value(table.find(list)->items()[k], key);
}

void check_nodes(const GeometryEntries& entries, const Node& table, Faults& faults) {
  for (std::size_t k = 0; k < entries.nodes.size(); ++k) {
    const auto& node = entries.nodes[k];
    if (node.id != static_cast<int>(k) + 1)
      faults.add(
          position_in(table, "nodes", k, "id"),
          fmt::format("node id = {} is at position {} of the list, where {} is expected.", node.id, k + 1, k + 1),
          "Number the nodes 1, 2, 3 ... in the order of increasing x.");
    else if (k > 0 && node.x <= entries.nodes[k - 1].x)
      faults.add(position_in(table, "nodes", k, "x"),
                 fmt::format("x = {} m of node {} is not larger than x = {} m of node {}.", node.x, node.id,
                             entries.nodes[k - 1].x, node.id - 1),
                 "Nodes must follow one another along the axis; merge nodes at the same place.");
  }
}

std::string name_of_element(const GeometryEntries& entries, std::size_t k) {
  const auto& element = entries.elements[k];
  return fmt::format("element {} (nodes {} to {})", element.id.value_or(static_cast<int>(k) + 1), element.n1,
                     element.n2);
}

void check_element(const GeometryEntries& entries, std::size_t k, const Node& table, Faults& faults) {
  const auto& element = entries.elements[k];
  const auto where = [&](std::string_view key) { return position_in(table, "elements", k, key); };
  const auto n_nodes = static_cast<int>(entries.nodes.size());
  const std::string name = name_of_element(entries, k);
  for (const auto& [key, node] : {std::pair("n1", element.n1), std::pair("n2", element.n2)})
    if (node > n_nodes)
      faults.add(where(key), fmt::format("{} = {} of {}: the rotor has nodes 1 to {}.", key, node, name, n_nodes));
  if (element.n1 <= n_nodes && element.n2 <= n_nodes) {
    if (element.n2 != element.n1 + 1)
      faults.add(where("n2"), fmt::format("{} does not join a node and the next one.", name),
                 element.n2 == element.n1 - 1
                     ? fmt::format("Exchange n1 and n2: n1 = {}, n2 = {}.", element.n2, element.n1)
                     : "Split it into elements between neighbouring nodes, or remove the nodes between.");
    else if (element.length) {
      const double between = entries.nodes[static_cast<std::size_t>(element.n2 - 1)].x -
                             entries.nodes[static_cast<std::size_t>(element.n1 - 1)].x;
      if (std::abs(*element.length - between) > 1e-6 * std::abs(between))
        faults.add(where("length"),
                   fmt::format("length = {} m of {} does not fit its nodes, which are {} m apart.", *element.length,
                               name, between),
                   "Correct the length or the nodes' x; the length may also be left out.");
    }
  }
  const char* bore_key = element.bore_diameter ? "bore" : "id_";
  if (element.bore_diameter && element.older_bore > 0.)
    faults.add(where("id_"), fmt::format("{} has both bore and id_, which are the same.", name), "Leave id_ out.");
  if (element.bore() >= element.od)
    faults.add(
        where(bore_key),
        fmt::format("{} = {} m of {} is not smaller than its od = {} m.", bore_key, element.bore(), name, element.od),
        "A bore must be smaller than its shaft; check that both values are diameters.");
  const auto is_named = [&](const auto& material) { return material.first == *element.material; };
  if (element.material && std::none_of(entries.materials.begin(), entries.materials.end(), is_named)) {
    std::vector<std::string> names;
    for (const auto& material : entries.materials) names.push_back(material.first);
    faults.add(where("material"),
               fmt::format("{} is made of \"{}\", which `materials` does not have.", name, *element.material),
               names.empty() ? "`materials` is empty." : suggestion(*element.material, names));
  }
}

/// Elements that name no material take the default one: told once for all of them.
void check_default_material(const GeometryEntries& entries, const Node& table, Faults& faults) {
  if (entries.material) return;
  const auto& all = entries.elements;
  const auto has_none = [](const ElementEntry& element) { return !element.material; };
  const auto first = std::find_if(all.begin(), all.end(), has_none);
  if (first == all.end()) return;
  const auto k = static_cast<std::size_t>(first - all.begin());
  const auto others = std::count_if(first, all.end(), has_none) - 1;
  faults.add(position_in(table, "elements", k, "material"),
             fmt::format("{}{} no material, and there is no default `material`.", name_of_element(entries, k),
                         others == 0   ? " names"
                         : others == 1 ? " and 1 other name"
                                       : fmt::format(" and {} others name", others)),
             "Add material = {E, nu, rho} to the geometry, or a name in `materials` to the element.");
}

void check_spans(const GeometryEntries& entries, const Node& table, Faults& faults) {
  const std::size_t n_spans = entries.nodes.size() - 1;
  std::vector<std::vector<std::size_t>> of_span(n_spans);
  for (std::size_t k = 0; k < entries.elements.size(); ++k)
    of_span[static_cast<std::size_t>(entries.elements[k].n1 - 1)].push_back(k);
  for (std::size_t span = 0; span < n_spans; ++span) {
    if (of_span[span].empty())
      faults.add(position_of_value(table, "elements"),
                 fmt::format("no element joins node {} and node {}.", span + 1, span + 2),
                 "The rotor must be one connected shaft; add the missing element.");
    for (std::size_t i = 0; i < of_span[span].size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto& a = entries.elements[of_span[span][j]];
        const auto& b = entries.elements[of_span[span][i]];
        if (std::max(a.bore(), b.bore()) < std::min(a.od, b.od) * (1 - 1e-9))
          faults.add(
              position_in(table, "elements", of_span[span][i], "od"),
              fmt::format(
                  "two elements between node {} and node {} fill the same space (diameters {} to {} m and {} to {} m).",
                  span + 1, span + 2, a.bore(), a.od, b.bore(), b.od),
              "A sleeve begins where the shaft ends: its bore must not be smaller than the shaft's od.");
      }
  }
}

void check_geometry(const GeometryEntries& entries, const Node& table, Faults& faults) {
  const std::size_t n_faults_before = faults.size();
  check_nodes(entries, table, faults);
  for (std::size_t k = 0; k < entries.elements.size(); ++k) check_element(entries, k, table, faults);
  check_default_material(entries, table, faults);
  const auto n_nodes = static_cast<int>(entries.nodes.size());
  for (std::size_t k = 0; k < entries.mass_points.size(); ++k) {
    const auto& point = entries.mass_points[k];
    if (point.node > n_nodes)
      faults.add(position_in(table, "mass_points", k, "node"),
                 fmt::format("node = {} of mass point {}: the rotor has nodes 1 to {}.", point.node,
                             point.name ? fmt::format("\"{}\"", *point.name) : std::to_string(k + 1), n_nodes));
  }
  if (faults.size() == n_faults_before) check_spans(entries, table, faults);
}

}  // namespace

RotorGeometry read_rotor_geometry(const Node& table, Faults& faults) {
  const std::size_t n_faults_before = faults.size();
  const GeometryEntries entries = geometry_section().read(table, faults);
  RotorGeometry geometry;
  if (faults.size() > n_faults_before) return geometry;
  const auto plain = [](const MaterialEntry& material) { return RotorMaterial{material.E, material.nu, material.rho}; };
  const auto material_of = [&](const ElementEntry& element) {
    if (!element.material) return plain(*entries.material);
    return plain(std::find_if(entries.materials.begin(), entries.materials.end(), [&](const auto& material) {
                   return material.first == *element.material;
                 })->second);
  };
  for (const auto& node : entries.nodes) geometry.node_x.push_back(node.x);
  for (const auto& element : entries.elements)
    geometry.elements.push_back({element.n1, element.n2, element.od, element.bore(), material_of(element)});
  for (const auto& point : entries.mass_points)
    geometry.mass_points.push_back({point.node, point.mass, point.Ip, point.Id});
  return geometry;
}

void check_rotor_node(const RotorGeometry& geometry, int node, const SourcePosition& where, const std::string& name,
                      Faults& faults) {
  if (node < 1 || node > geometry.n_nodes())
    faults.add(where, fmt::format("{} = {}: the rotor has nodes 1 to {}.", name, node, geometry.n_nodes()),
               "Choose a node of the rotor's geometry, or add one at the place that is meant.");
}

}  // namespace rotordrop
