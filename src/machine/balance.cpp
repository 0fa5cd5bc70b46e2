#include "machine/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/rotation.h"
#include "rotor/balance_grade.h"

namespace rotordrop {
namespace {

double speed_of_grade(const MachineParameters& p) {
  return p.rotor.balance_speed.value_or(std::fabs(p.run.initial_speed));
}

/// Those of the case, or the outermost bearings'.
std::vector<int> planes_of(const MachineParameters& p) {
  if (!p.rotor.balance_planes.empty()) return p.rotor.balance_planes;
  std::vector<int> nodes;
  for (const auto& entry : p.bearings) nodes.push_back(entry.node());
  if (nodes.empty()) return {};
  const auto [first, last] = std::minmax_element(nodes.begin(), nodes.end());
  return *first == *last ? std::vector{*first} : std::vector{*first, *last};
}

bool are_nodes(const RotorGeometry& geometry, const std::vector<int>& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [&](int node) { return node >= 1 && node <= geometry.n_nodes(); });
}

/// Keys that only say more about a grade.
void check_lone_keys(const RotorParameters& rotor, const Node& table, Faults& faults) {
  if (rotor.balance_grade) return;
  // The file of a run's parameters has every key that has a default.
  const bool are_default =
      std::all_of(rotor.balance_angles.begin(), rotor.balance_angles.end(), [](double a) { return a == 0.; });
  for (const char* key : {"balance_speed", "balance_planes", "balance_angles"})
    if (table.has(key) && !(key == std::string_view("balance_angles") && are_default))
      faults.add(position_of(table, key),
                 fmt::format("rotor.{} says something about rotor.balance_grade, which is not given.", key),
                 "Add balance_grade = \"G2.5\" or the like, or leave it out.");
}

}  // namespace

void check_balance(const MachineParameters& p, const Node& case_node, Faults& faults) {
  const Node& table = table_of(case_node, "rotor");
  check_lone_keys(p.rotor, table, faults);
  if (!p.rotor.balance_grade) return;
  const Node* list = table.find("unbalance");
  if (list && list->is_array() && !list->items().empty())
    faults.add(position_of(table, "balance_grade"),
               fmt::format("rotor.balance_grade and rotor.unbalance (at {}) both say how unbalanced the rotor is.",
                           to_string(list->where())),
               "Leave one of them out; unbalance = [] undoes that of a base.");
  const double speed = speed_of_grade(p);
  if (!(speed > 0.))
    faults.add(
        position_of(table, "balance_grade"),
        fmt::format("rotor.balance_grade needs the speed for which it is, and run.initial_speed is {:.6g} rad/s.",
                    p.run.initial_speed),
        "Add rotor.balance_speed, such as \"15200 rpm\".");
  const auto planes = planes_of(p);
  const RotorGeometry& geometry = p.rotor.geometry;
  const bool has_planes = !p.rotor.balance_planes.empty();
  if (!are_nodes(geometry, planes)) {
    if (has_planes)
      faults.add(position_of_value(table, "balance_planes"),
                 fmt::format("rotor.balance_planes: the rotor has nodes 1 to {}.", geometry.n_nodes()));
    return;  // bearings' nodes are checked with the bearings
  }
  if (planes.empty() || (!has_planes && planes.size() == 1)) {
    faults.add(position_of(table, "balance_grade"),
               "rotor.balance_grade needs planes, and the case has no two bearings at different nodes.",
               "Add rotor.balance_planes, such as [2, 28].");
    return;
  }
  if (planes.size() == 2) {
    const double x_A = geometry.position(planes[0]), x_B = geometry.position(planes[1]);
    const double x_G = rigid_body(geometry).centre_of_gravity;
    if (!(std::min(x_A, x_B) < x_G && x_G < std::max(x_A, x_B)))
      faults.add(
          position_of(table, has_planes ? "balance_planes" : "balance_grade"),
          fmt::format("the centre of gravity, at {:.4g} m, is not between the balance planes at {:.4g} and {:.4g} m.",
                      x_G, x_A, x_B),
          "Give rotor.balance_planes on both sides of it, or a single one.");
  }
}

std::vector<Unbalance> unbalance_by_grade(const MachineParameters& p) {
  const auto planes = planes_of(p);
  const RotorGeometry& geometry = p.rotor.geometry;
  const RigidBody body = rigid_body(geometry);
  const double U = permissible_unbalance(body.mass, *p.rotor.balance_grade, speed_of_grade(p));
  const auto& angles = p.rotor.balance_angles;
  if (planes.size() == 1) return {{planes[0], U, angles[0]}};
  const auto parts =
      unbalance_in_planes(U, geometry.position(planes[0]), geometry.position(planes[1]), body.centre_of_gravity);
  return {{planes[0], parts[0], angles[0]}, {planes[1], parts[1], angles[1]}};
}

std::string balance_text(const MachineParameters& p) {
  if (!p.rotor.balance_grade) return {};
  constexpr double g_mm = 1e6, degrees = 180. / std::numbers::pi;
  const double speed = speed_of_grade(p), G = *p.rotor.balance_grade, mass = rigid_body(p.rotor.geometry).mass;
  std::string text =
      fmt::format("unbalance: {:.4g} g mm by balance grade G{:.6g} at {:.6g} rpm (ISO 21940-11: e_per {:.4g} um)",
                  permissible_unbalance(mass, G, speed) * g_mm, G * 1e3, speed * to_rpm, G / speed * 1e6);
  const char* between = ": ";
  for (const auto& u : p.rotor.unbalance) {
    text += fmt::format("{}{:.4g} g mm at node {}, {:.4g} deg", between, u.me * g_mm, u.node, u.angle * degrees);
    between = "; ";
  }
  return text + "\n";
}

}  // namespace rotordrop
