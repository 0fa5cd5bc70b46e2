#include "machine/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rotor/probe_contact.h"

namespace rotordrop {

std::vector<Probe> probes_of(const RotorParameters& rotor) {
  std::vector<Probe> probes;
  for (const auto& [name, p] : rotor.probes) probes.push_back({name, p.node, p.clearance, p.centre});
  return probes;
}

std::vector<ProbeContactAtNode> probe_contacts(const RotorParameters& rotor) {
  std::vector<ProbeContactAtNode> contacts;
  for (const auto& [name, p] : rotor.probes) {
    if (!p.contact) continue;
    const auto& c = *p.contact;
    contacts.push_back({p.node, std::make_unique<ProbeContact>(
                                    Probe{name, p.node, p.clearance, p.centre}, HuntCrossley{c.stiffness, 1., c.lambda},
                                    CoulombFriction{c.friction_coefficient, c.regularisation_speed},
                                    probe_radius(p, rotor.geometry))});
  }
  return contacts;
}

double reachable_displacement(const MachineParameters& p, int node) {
  struct Gap {
    double x, gap;
  };
  std::vector<Gap> gaps;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) gaps.push_back({p.rotor.geometry.position(b->node), air_gap(*b, p.contact)});
  if (gaps.size() == 1) return gaps.front().gap;
  const double x = p.rotor.geometry.position(node);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < gaps.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &a = gaps[i], &b = gaps[j];
      const double span = std::fabs(b.x - a.x);
      if (span > 0.) least = std::min(least, (std::fabs(b.x - x) * a.gap + std::fabs(x - a.x) * b.gap) / span);
    }
  return least;
}

}  // namespace rotordrop
