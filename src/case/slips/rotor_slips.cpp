#include "case/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/facts/coarse_shaft.h"
#include "analysis/facts/material_slips.h"
#include "machine/probes.h"

namespace rotordrop {
namespace {

constexpr double lightest_rotor = 0.1, heaviest_rotor = 1e5;  // [kg]

/// Diameters and materials of a shaft; a geometry has no declarations of its own here.
void look_at_elements(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  for (std::size_t i = 0; i < p.rotor.geometry.elements.size(); ++i) {
    const auto& [n1, n2, od, id, material] = p.rotor.geometry.elements[i];
    if (material.rho < 1000. || material.rho > 23e3)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("a material of the rotor has rho = {:.6g} kg/m3; it is most often between 1000 and 23000 kg/m3.",
                       material.rho),
           "A bare number is in kg/m3: steel has 7850, or \"7.85 g/cm3\".");
    if (material.E < 1e9 || material.E > 1e12)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("a material of the rotor has E = {:.6g} Pa; it is most often between 1 and 1000 GPa.",
                       material.E),
           "A bare number is in Pa: steel has 2.1e11, or \"210 GPa\".");
    for (const auto& slip :
         material_slips("a material of the rotor", {material.rho, material.E, {}, {}, material.nu, {}}))
      warn(warnings, position_of(rotor, "geometry"), slip.message, slip.advice);
    if (od > 3. || od < 2e-3)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("element {} of the rotor has od = {:.6g} m; it is most often between 0.002 and 3 m.", i + 1, od),
           "A bare number is in metres: 90 millimetres are 0.09 or \"90 mm\".");
  }
}

/// Elements against each other.
void look_at_steps(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  constexpr double thinnest_wall = 5e-3;                                       // of the diameter; all of them estimates
  constexpr double deepest_neck = 0.2, thinnest_stub = 0.1, widest_disc = 6.;  // of the neighbours'
  const Node& where = table_at(tree, "rotor");
  const auto& elements = p.rotor.geometry.elements;
  // The thickest element that ends at a node, and that begins there.
  std::vector<double> ending(p.rotor.geometry.node_x.size() + 1, 0.), beginning = ending;
  for (const auto& e : elements) {
    for (auto [largest, node] : {std::pair(&ending, e.n2), {&beginning, e.n1}}) {
      double& od = (*largest)[static_cast<std::size_t>(node)];
      od = std::max(od, e.od);
    }
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& e = elements[i];
    if (const double wall = 0.5 * (e.od - e.id); wall < thinnest_wall * e.od)
      warn(warnings, position_of(where, "geometry"),
           fmt::format("element {} of the rotor is a tube with a wall of {:.4g} mm at od = {:.4g} mm.", i + 1, mm(wall),
                       mm(e.od)),
           "od and id are diameters: check both.");
    const double before = ending[static_cast<std::size_t>(e.n1)], after = beginning[static_cast<std::size_t>(e.n2)];
    const double largest = std::max(before, after), smallest = std::min(before, after);
    const bool is_disc = largest > 0. && e.od > widest_disc * largest;
    const bool is_neck = smallest == 0. ? e.od < thinnest_stub * largest : e.od < deepest_neck * smallest;
    if (is_disc || is_neck)
      warn(warnings, position_of(where, "geometry"),
           fmt::format("element {} of the rotor has od = {:.4g} mm beside an element of {:.4g} mm.", i + 1, mm(e.od),
                       mm(largest)),
           "Check the digits and the unit of its od.");
  }
}

/// A rotor is not thinner than a disc: Ip <= 2 Id of every body, equal for a plane one.
void look_at_body(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  const RigidBody body = rigid_body(p.rotor.geometry);
  if (body.mass < lightest_rotor || body.mass > heaviest_rotor)
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor's mass is {:.4g} kg; most often it is {} to {} kg.", body.mass, lightest_rotor,
                     heaviest_rotor),
         "Check the units of its dimensions (bare numbers are in metres) and of its density (kg/m3).");
  if (body.Ip > 2. * body.Id * (1. + 1e-9))
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor's Ip = {:.4g} kg m2 is more than 2 Id = {:.4g} kg m2, which no rigid body has.",
                     body.Ip, 2. * body.Id),
         "Check Ip and Id of its mass points; they may be exchanged.");
  const double thickest = largest_diameter(p.rotor.geometry);
  const auto& x = p.rotor.geometry.node_x;
  const double length = x.empty() ? 0. : x.back() - x.front();
  if (thickest > 0. && length > 50. * thickest)
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor is {:.4g} m long and at most {:.4g} m thick, more than 50 times as long as thick.",
                     length, thickest),
         "Check the units of its lengths; bare numbers are in metres.");
  for (std::size_t i = 0; i < p.rotor.geometry.mass_points.size(); ++i) {
    const auto& point = p.rotor.geometry.mass_points[i];
    const double gyration = point.mass > 0. && point.Ip > 0. ? std::sqrt(point.Ip / point.mass) : thickest;
    if (thickest > 0. && (gyration > 5. * thickest || gyration < 0.05 * thickest))
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("mass point {} at node {} has {:.4g} kg and Ip = {:.4g} kg m2: a radius of gyration of {:.3g} "
                       "mm, where the shaft is up to {:.4g} mm thick.",
                       i + 1, point.node, point.mass, point.Ip, mm(gyration), mm(thickest)),
           "Check the units of mass and Ip: kg and kg m2, not kg mm2.");
    // Of a body, Id = Ip/2 and what its length adds: that of the whole rotor, at most.
    if (const double most = 0.75 * point.Ip + point.mass * length * length / 12.;
        point.mass > 0. && length > 0. && point.Id > most)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("mass point {} at node {} has {:.4g} kg and Id = {:.4g} kg m2; a body of its mass and Ip as "
                       "long as the whole rotor has {:.3g} kg m2.",
                       i + 1, point.node, point.mass, point.Id, most),
           "Check the units of mass and Id: kg and kg m2, not kg mm2.");
    if (point.Ip > 2. * point.Id * (1. + 1e-9) && point.Ip > 0. && point.Id > 0.)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("mass point {} at node {} has Ip = {:.4g} kg m2, more than 2 Id = {:.4g} kg m2, which no "
                       "rigid body has.",
                       i + 1, point.node, point.Ip, 2. * point.Id),
           "Ip is about the rotor's axis, Id about a diameter; they may be exchanged.");
  }
}

/// Elements that are too long for the shaft's bending modes.
void look_at_lengths(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  constexpr double largest_error = 0.02;  // of a frequency; damping and stiffness of supports are known worse
  constexpr std::size_t most_named = 6;
  const RotorGeometry& geometry = p.rotor.geometry;
  const auto coarse = coarse_shaft(geometry, p.run.initial_speed, largest_error);
  if (!coarse) return;
  const Node& rotor = table_at(tree, "rotor");
  const Node* table = rotor.find("geometry");
  const Node* elements = table && table->is_table() ? table->find("elements") : nullptr;
  const std::size_t longest = coarse->elements.front();
  const SourcePosition where = elements && elements->is_array() && elements->items()[longest].where().is_known()
                                   ? elements->items()[longest].where()
                                   : position_of(rotor, "geometry");
  std::string named;
  for (std::size_t i = 0; i < std::min(most_named, coarse->elements.size()); ++i) {
    const ShaftElement& e = geometry.elements[coarse->elements[i]];
    named += fmt::format("{}element {} ({:.4g} mm: {} pieces)", i ? ", " : "", coarse->elements[i] + 1,
                         mm(geometry.length(e)), pieces_of(geometry, e, p.run.initial_speed));
  }
  if (coarse->elements.size() > most_named) named += fmt::format(" and {} more", coarse->elements.size() - most_named);
  warn(warnings, where,
       fmt::format(
           "elements of the rotor are too long for its bending: mode {} of the free shaft lies at {:.4g} Hz, and "
           "{:.2g} % lower, at {:.4g} Hz, with its long elements cut.",
           coarse->mode, coarse->frequency, 100. * (1. - coarse->refined / coarse->frequency), coarse->refined),
       fmt::format("{}, here {}. Numbers of the nodes behind them rise. Elements of one to two diameters are usual.",
                   where.file.text().ends_with(".csv")
                       ? "A row of the shaft's table is one beam element: cut it into several rows "
                         "of the same diameter"
                       : "Cut them into several elements of the same diameter, with nodes between",
                   named));
}

/// A stationary part that the rotor reaches before, or while, its touchdown bearings hold it.
void look_at_probes(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node* tables = table_at(tree, "rotor").find("probes");
  for (const auto& [name, probe] : p.rotor.probes) {
    const double reach = reachable_displacement(p, probe.node);
    const double left = probe.clearance - std::hypot(probe.centre[0], probe.centre[1]);
    if (!std::isfinite(reach) || left > reach) continue;
    const Node* own = tables ? tables->find(name) : nullptr;
    warn(warnings, position_of_value(own ? *own : table_at(tree, "rotor"), "clearance"),
         fmt::format("rotor.probes.{}.clearance leaves {:.4g} um at node {}, not more than the {:.4g} um by which the "
                     "gaps of the touchdown bearings let a straight rotor move there: it touches.",
                     name, left * 1e6, probe.node, reach * 1e6),
         "Touchdown bearings are there to be touched first: check the clearance, its centre, the node and "
         "contact.air_gap.");
  }
}

}  // namespace

double largest_diameter(const RotorGeometry& geometry) {
  double thickest = 0.;
  for (const auto& element : geometry.elements) thickest = std::max(thickest, element.od);
  return thickest;
}

void look_at_rotor(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  look_at_elements(p, tree, warnings);
  look_at_steps(p, tree, warnings);
  look_at_body(p, tree, warnings);
  look_at_lengths(p, tree, warnings);
  look_at_probes(p, tree, warnings);
}

}  // namespace rotordrop
