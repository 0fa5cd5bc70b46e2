#include "rotor/probe_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "rotor/rotor_parameters.h"

namespace rotordrop {
namespace {

Section<ProbeContactParameters> contact_section() {
  using P = ProbeContactParameters;
  Section<P> s("contact",
               "Contact of the rotor with the stationary part around a probe, which neither yields nor turns.");
  s.quantity("stiffness", &P::stiffness,
             {.unit = "N/m",
              .range = positive(),
              .usual = between(5e5, 5e10),
              .help = "K of the normal force K delta (1 + 1.5 lambda delta') at the penetration delta."})
      .quantity("lambda", &P::lambda,
                {.unit = "s/m",
                 .range = at_least(0),
                 .usual = or_zero(between(1e-3, 1)),
                 .fallback = "0.08 s/m",
                 .source = "Neisi, Heikkinen & Sopanen 2019, of a rotor in its touchdown bearing",
                 .help = "Damping: a slow impact at the speed v rebounds with 1 - lambda v of it."})
      .quantity("friction_coefficient", &P::friction_coefficient,
                {.range = between(0, 2),
                 .usual = or_zero(between(5e-3, 0.8)),
                 .fallback = "0.1",
                 .source = "Neisi, Heikkinen & Sopanen 2019, of a rotor in its touchdown bearing",
                 .help = "Of the turning rotor on the stationary part. Its heat warms no bearing."})
      .quantity("regularisation_speed", &P::regularisation_speed,
                {.unit = "m/s",
                 .range = positive(),
                 .usual = between(1e-4, 1),
                 .fallback = "0.05 m/s",
                 .source = "estimate",
                 .help = "Friction goes through zero within this slip speed."})
      .quantity("radius", &P::radius,
                {.unit = "m",
                 .range = positive(),
                 .usual = between(1e-3, 2),
                 .help = "Of the rotor's surface there; half the largest diameter of the shaft at the node if not "
                         "given."});
  return s;
}

}  // namespace

Section<ProbeParameters> probe_section() {
  using P = ProbeParameters;
  Section<P> s("probes", "A node of the rotor with a clearance of its own: magnet, seal, impeller.");
  s.integer("node", &P::node, {.range = at_least(1), .help = "Rotor node whose displacement is recorded, from 1."})
      .quantity("clearance", &P::clearance,
                {.unit = "m",
                 .range = positive(),
                 .usual = between(5e-5, 0.02),
                 .help = "Radial clearance of the rotor in the stationary part there. Without `contact` the rotor "
                         "passes through it, and the results say so."})
      .quantities("centre", &P::centre,
                  {.unit = "m",
                   .range = between(-1e-2, 1e-2),
                   .fallback = {"0 m", "0 m"},
                   .help = "y, z of the stationary part's axis from that of the unloaded outer rings."})
      .table("contact", &P::contact, contact_section(),
             {.help = "What touching there does to the rotor; nothing if left out."});
  return s;
}

double probe_radius(const ProbeParameters& probe, const RotorGeometry& geometry) {
  if (probe.contact && probe.contact->radius) return *probe.contact->radius;
  double diameter = 0.;
  for (const auto& e : geometry.elements)
    if (probe.node == e.n1 || probe.node == e.n2) diameter = std::max(diameter, e.od);
  return 0.5 * diameter;
}

void check_probes(const ProbeList& probes, const RotorGeometry& geometry, const Node& rotor_table, Faults& faults) {
  const Node* tables = rotor_table.find("probes");
  for (const auto& [name, probe] : probes) {
    const Node* own = tables ? tables->find(name) : nullptr;
    const Node& table = own ? *own : rotor_table;
    const bool is_good = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '-';
    });
    if (!is_good)
      faults.add(table.where(), fmt::format("a probe cannot be called \"{}\".", name), "Use letters, digits, _ and -.");
    const std::string path = "rotor.probes." + name;
    check_rotor_node(geometry, probe.node, position_of_value(table, "node"), path + ".node", faults);
    if (const double radius = probe_radius(probe, geometry); radius > 0. && probe.clearance >= 0.5 * radius)
      faults.add(position_of_value(table, "clearance"),
                 fmt::format("{}.clearance = {:.6g} mm is more than half the rotor's radius of {:.6g} mm there.", path,
                             probe.clearance * 1e3, radius * 1e3),
                 "Clearances are a few tenths of a millimetre; a bare number is in metres.");
  }
}

}  // namespace rotordrop
