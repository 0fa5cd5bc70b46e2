#include "machine/heat/bearing_mesh_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "machine/shaft_geometry.h"
#include "thermal/section/bearing_section.h"
#include "thermal/section/own_section.h"

namespace rotordrop {
namespace {

BearingSectionData section_data(const MachineParameters& p, const TouchdownParameters& b) {
  const auto& fe = p.thermal.fe;
  BearingSectionData d;
  for (const auto& row : row_places(b)) d.rows.push_back({row.position, row.direction});
  d.ball_diameter = b.ball_diameter;
  d.pitch_diameter = b.pitch_diameter;
  d.conformity = b.conformity;
  d.contact_angle = b.contact_angle;
  d.width = b.width;
  d.inner_bore = b.inner_ring_diameters[0];
  d.inner_shoulder = b.inner_shoulder_diameter.value_or(b.inner_ring_diameters[1]);
  d.outer_shoulder = b.outer_shoulder_diameter.value_or(b.outer_ring_diameters[0]);
  d.outer_outside = b.outer_ring_diameters[1];
  d.housing_outside = b.housing_diameters[1];
  d.housing_length = b.housing_length;
  d.strip_half_width = fe.strip_half_width.value_or(p.thermal.contact_half_width);
  d.outer_relief = fe.relieved_shoulder;
  if (fe.shaft != FeShaft::lump) {
    d.shaft_radius = bore_radius(b, p.contact) - air_gap(b, p.contact);
    d.shaft_length = b.shaft_lump_length.value_or(b.width);
    d.shaft_bore_radius = shaft_bore_radius(p, b);
    if (fe.shaft == FeShaft::beyond) d.shaft_steps = shaft_steps(p, b);
  }
  return d;
}

}  // namespace

SectionPlan section_plan(const MachineParameters& p, const Node& case_node, const std::string& name) {
  const auto data = section_data(p, touchdown_of(p, name));
  const Node* bearings = case_node.find("bearings");
  const Node* table = bearings ? bearings->find(name) : nullptr;
  Faults faults;
  for (const auto& fault : faults_of_section(data)) {
    std::string key = fault.key;
    if (table && !table->find(key) && key.ends_with("_shoulder_diameter"))
      key = key.substr(0, key.find('_')) + "_ring_diameters";
    faults.add(table ? position_of_value(*table, key) : SourcePosition{},
               fmt::format("bearings.{} cannot be meshed: {}.", name, fault.message), fault.advice);
  }
  faults.throw_if_any();
  const auto& fe = p.thermal.fe;
  SectionPlan plan = plan_bearing_section(data, {fe.surface_cell, fe.largest_cell, fe.refinement});
  // A cell costs some 2 kB of mesh, matrices and factors: this many are 2 GB, and hours.
  constexpr double most_cells = 1e6, most_in_a_line = 1e4;
  double n_cells = 0., longest = 0.;
  for (const auto& block : plan.blocks)
    n_cells += static_cast<double>(plan.curves.at(block.curves[0]).cells) * plan.curves.at(block.curves[1]).cells;
  for (const auto& curve : plan.curves) longest = std::max(longest, static_cast<double>(curve.cells));
  if (n_cells > most_cells || longest > most_in_a_line)
    throw InputError(
        table ? table->where() : SourcePosition{},
        fmt::format("the mesh of bearings.{} would have {:.3g} cells (some {:.3g} GB), {:.3g} of them in a line; "
                    "at most {:.0f} are made, {:.0f} in a line.",
                    name, n_cells, n_cells * 2e-6, longest, most_cells, most_in_a_line),
        "Check its dimensions (housing_length, width, diameters), or make thermal.fe.largest_cell larger "
        "or thermal.fe.refinement smaller.");
  return plan;
}

SectionMesh own_section_of_bearing(const MeshFileContent& content, const MachineParameters& p, const std::string& name,
                                   const std::string& file) {
  const TouchdownParameters& b = touchdown_of(p, name);
  OwnSectionWishes wishes{{"inner_ring", "outer_ring", "housing"}, b.rows, {}};
  if (p.thermal.fe.shaft != FeShaft::lump) wishes.bodies.emplace_back("shaft");
  if (p.thermal.fe.shaft == FeShaft::beyond) {
    wishes.shaft_steps = shaft_steps(p, b);
    for (const auto& step : wishes.shaft_steps) wishes.bodies.push_back(step.name);
  }
  Faults faults;
  auto mesh = own_section(content, wishes, file, faults);
  faults.throw_if_any();
  return mesh;
}

}  // namespace rotordrop
