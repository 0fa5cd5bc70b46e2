#include "machine/magnets.h"

#include <fmt/format.h>

#include "bearing/support/magnet_support.h"

namespace rotordrop {

void add_magnets(const MachineParameters& p, const ModalRotor& rotor, const Motion& line, Machine::Parts& parts) {
  struct Found {
    std::size_t support;
    const MagnetParameters* magnet;
    double x;
  };
  std::vector<Found> found;
  std::vector<double> positions;
  double n_axial = 0.;
  for (std::size_t i = 0; i < p.bearings.size(); ++i)
    if (const auto* m = p.bearings[i].magnet()) {
      found.push_back({i, m, p.rotor.geometry.position(m->node)});
      positions.push_back(found.back().x);
      if (m->axial_stiffness > 0.) n_axial += 1.;
    }
  if (found.empty()) return;
  const RigidBody& body = rotor.body();
  const std::vector<double> shares = weight_shares(positions, body.centre_of_gravity);
  const double axial_load = p.rotor.axial_motion == AxialFreedom::free
                                ? body.mass * p.run.gravity[0] + value_at(p.rotor.axial_force, 0.)
                                : 0.;
  std::vector<MagnetStart> starts(found.size());
  std::vector<Force> forces(rotor.n_stations());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const MagnetParameters& m = *found[k].magnet;
    auto& held = starts[k].holding_force;
    if (m.axial_holding_force)
      held[0] = *m.axial_holding_force;
    else if (m.axial_stiffness > 0.)
      held[0] = -axial_load / n_axial;
    for (std::size_t axis = 0; axis < 2; ++axis)
      held[1 + axis] = m.holding_force ? (*m.holding_force)[axis] : -shares[k] * body.mass * p.run.gravity[1 + axis];
    forces[found[k].support].y = held[1];
    forces[found[k].support].z = held[2];
  }
  rotor.add_static_deflection(forces, parts.initial_rotor_state);
  // A magnet's springs are free where the bent rotor passes it on the line.
  std::vector<double> bent(rotor.n_state());
  rotor.initial_rigid_state(line, {}, bent);
  rotor.add_static_deflection(forces, bent);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Motion at = rotor.node_motion(found[k].magnet->node, bent);
    starts[k].centre = {at.x, at.y, at.z};
    const std::size_t i = found[k].support;
    parts.supports[i] = std::make_unique<MagnetSupport>(p.bearings[i].name, *found[k].magnet, starts[k]);
  }
}

void check_magnets(const MachineParameters& p, const Node& case_node, Faults& faults) {
  const Node* bearings = case_node.find("bearings");
  for (const auto& entry : p.bearings) {
    const auto* m = entry.magnet();
    if (!m) continue;
    const Node* own = bearings ? bearings->find(entry.name) : nullptr;
    const Node& table = own ? *own : case_node;
    if ((m->axial_stiffness > 0. || m->axial_holding_force) && p.rotor.axial_motion != AxialFreedom::free)
      faults.add(position_of_value(table, m->axial_stiffness > 0. ? "axial_stiffness" : "axial_holding_force"),
                 fmt::format("bearings.{} acts along the axis of a rotor that cannot move along it.", entry.name),
                 "Set rotor.axial_motion = \"free\".");
  }
}

}  // namespace rotordrop
