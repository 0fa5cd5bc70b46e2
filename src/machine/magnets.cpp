#include "machine/magnets.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "bearing/support/magnet_support.h"

namespace rotordrop {

namespace {

/// What magnets without a force of their own have to hold of a load, with the moment of it: given ones take theirs first.
class RestOfLoad {
 public:
  /// @param load  on the rotor [N], at x
  RestOfLoad(double load, double x) : force_(-load), moment_(-load * x) {}
  void take(double force, double x) {
    force_ -= force;
    moment_ -= force * x;
  }
  /// Shares as weight_shares() gives them for a load at some place: straight lines over that place. @param at_0, at_1  for 0 and 1 m
  [[nodiscard]] double shared(double at_0, double at_1) const { return at_0 * force_ + (at_1 - at_0) * moment_; }

 private:
  double force_, moment_;
};

/// The rotor at rest on its line between magnets and linear supports, before any lets go.
class HeldRotor {
 public:
  HeldRotor(const MachineParameters& p, const ModalRotor& rotor, const Motion& line)
      : p_(p), rotor_(rotor), line_(line) {
    for (std::size_t i = 0; i < p.bearings.size(); ++i)
      if (p.bearings[i].linear()) springs_.push_back(i);
    settle();
  }
  [[nodiscard]] const std::vector<std::array<double, 2>>& held() const { return held_; }  // of the magnets
  /// As it is bent. @param y [n_state]
  void bend(std::span<double> y) const { rotor_.add_static_deflection(forces_, y); }
  [[nodiscard]] std::vector<double> state() const {
    std::vector<double> y(rotor_.n_state());
    rotor_.initial_rigid_state(line_, {}, y);
    bend(y);
    return y;
  }

 private:
  /// Forces of the magnets, with the linear supports' given. @param of_springs [2 n]
  void balance(const Eigen::VectorXd& of_springs) {
    std::vector<SideForce> others;
    forces_.assign(rotor_.n_stations(), {});
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      const auto at = 2 * static_cast<Eigen::Index>(k);
      others.push_back(
          {p_.rotor.geometry.position(p_.bearings[springs_[k]].linear()->node), {of_springs(at), of_springs(at + 1)}});
      forces_[springs_[k]].y = of_springs(at);
      forces_[springs_[k]].z = of_springs(at + 1);
    }
    held_ = magnet_holding_forces(p_, rotor_.body(), others);
    std::size_t k = 0;
    for (std::size_t i = 0; i < p_.bearings.size(); ++i)
      if (p_.bearings[i].magnet()) {
        forces_[i].y = held_[k][0];
        forces_[i].z = held_[k++][1];
      }
  }
  /// What the linear supports give where the rotor is then.
  [[nodiscard]] Eigen::VectorXd answer(const Eigen::VectorXd& of_springs) {
    balance(of_springs);
    const auto y = state();
    Eigen::VectorXd list(of_springs.size());
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      const auto& spring = *p_.bearings[springs_[k]].linear();
      const Motion at = rotor_.node_motion(spring.node, y);
      for (std::size_t i = 0; i < 2; ++i)
        list(static_cast<Eigen::Index>(2 * k + i)) = -spring.stiffness[i][0] * at.y - spring.stiffness[i][1] * at.z;
    }
    return list;
  }
  /// The forces that are their own answer, which is linear in them.
  void settle() {
    const auto n = 2 * static_cast<Eigen::Index>(springs_.size());
    const Eigen::VectorXd alone = answer(Eigen::VectorXd::Zero(n));
    if (n == 0) return;
    const double size = std::max(alone.cwiseAbs().maxCoeff(), 1.);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) matrix.col(k) -= (answer(size * Eigen::VectorXd::Unit(n, k)) - alone) / size;
    balance(matrix.partialPivLu().solve(alone));
  }

  const MachineParameters& p_;
  const ModalRotor& rotor_;
  const Motion& line_;
  std::vector<std::size_t> springs_;  // which bearings are linear supports
  std::vector<std::array<double, 2>> held_;
  std::vector<Force> forces_;
};

}  // namespace

std::vector<std::array<double, 2>> magnet_holding_forces(const MachineParameters& p, const RigidBody& body,
                                                         std::span<const SideForce> others) {
  std::array<RestOfLoad, 2> rest = {RestOfLoad(body.mass * p.run.gravity[1], body.centre_of_gravity),
                                    RestOfLoad(body.mass * p.run.gravity[2], body.centre_of_gravity)};
  for (const SideForce& other : others)
    for (std::size_t axis = 0; axis < 2; ++axis) rest[axis].take(other.force[axis], other.position);
  std::vector<const MagnetParameters*> magnets;
  std::vector<double> sharing;  // places of those without a force of their own
  for (const auto& entry : p.bearings)
    if (const auto* m = entry.magnet()) {
      magnets.push_back(m);
      const double x = p.rotor.geometry.position(m->node);
      if (!m->holding_force) sharing.push_back(x);
      for (std::size_t axis = 0; axis < 2 && m->holding_force; ++axis) rest[axis].take((*m->holding_force)[axis], x);
    }
  const std::vector<double> at_0 = weight_shares(sharing, 0.), at_1 = weight_shares(sharing, 1.);
  std::vector<std::array<double, 2>> forces;
  std::size_t n_shared = 0;
  for (const auto* m : magnets) {
    if (m->holding_force) {
      forces.push_back({(*m->holding_force)[0], (*m->holding_force)[1]});
      continue;
    }
    forces.push_back({rest[0].shared(at_0[n_shared], at_1[n_shared]), rest[1].shared(at_0[n_shared], at_1[n_shared])});
    ++n_shared;
  }
  return forces;
}

void add_magnets(const MachineParameters& p, const ModalRotor& rotor, const Motion& line, Machine::Parts& parts) {
  struct Found {
    std::size_t support;
    const MagnetParameters* magnet;
  };
  std::vector<Found> found;
  double n_axial = 0.;
  for (std::size_t i = 0; i < p.bearings.size(); ++i)
    if (const auto* m = p.bearings[i].magnet()) {
      found.push_back({i, m});
      if (m->axial_stiffness > 0. && !m->axial_holding_force) n_axial += 1.;
    }
  if (found.empty()) return;
  const RigidBody& body = rotor.body();
  double axial_load = p.rotor.axial_motion == AxialFreedom::free
                          ? body.mass * p.run.gravity[0] + value_at(p.rotor.axial_force, 0.)
                          : 0.;
  for (const Found& f : found) axial_load += f.magnet->axial_holding_force.value_or(0.);
  const HeldRotor rest(p, rotor, line);
  std::vector<MagnetStart> starts(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const MagnetParameters& m = *found[k].magnet;
    auto& held = starts[k].holding_force;
    if (m.axial_holding_force)
      held[0] = *m.axial_holding_force;
    else if (m.axial_stiffness > 0.)
      held[0] = -axial_load / n_axial;
    held[1] = rest.held()[k][0];
    held[2] = rest.held()[k][1];
  }
  rest.bend(parts.initial_rotor_state);
  // A magnet's springs are free where the bent rotor passes it on the line.
  const std::vector<double> bent = rest.state();
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
