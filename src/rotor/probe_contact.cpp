#include "rotor/probe_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rotordrop {

ProbeContact::ProbeContact(Probe probe, const HuntCrossley& contact, CoulombFriction friction, double radius)
    : name_("probes/" + probe.name),
      probe_(std::move(probe)),
      contact_(contact),
      friction_(std::move(friction)),
      radius_(radius) {}

std::vector<StateEntry> ProbeContact::ledger_entries() const {
  return {{"contact impulse", "N s", 100., "integral of the contact force"},
          {"contact damping", "J", 1., "energy dissipated by the damping of the contact"},
          {"contact friction", "J", 1., "friction heat of rotor and stationary part, which warms no bearing"}};
}

std::vector<Observable> ProbeContact::observables() const {
  return {{"contact_force", "N", "normal force between the rotor and the stationary part at the probe", 1, {}},
          {"friction_force", "N", "friction force on the rotor at the probe, positive about +x", 1, {}}};
}

void ProbeContact::evaluate(const SupportInput& in, std::span<const double>, std::span<double>,
                            std::span<double> ledger, SupportOutput& out) const {
  const double e_y = in.journal.y - probe_.centre[0], e_z = in.journal.z - probe_.centre[1];
  const double distance = std::sqrt(e_y * e_y + e_z * e_z), penetration = distance - probe_.clearance;
  double normal = 0., friction = 0., damping = 0., rub = 0.;
  out.force_on_rotor = {};
  // Written so that a penetration that is not a number goes on into the force and is found.
  if (!(penetration <= 0.)) {
    const double n_y = e_y / distance, n_z = e_z / distance;
    const double rate = in.journal.velocity_y * n_y + in.journal.velocity_z * n_z;
    const double slip = in.rotor_spin.speed * radius_ + in.journal.velocity_z * n_y - in.journal.velocity_y * n_z;
    const double elastic = contact_.elastic(penetration);
    normal = contact_.total(elastic, rate);
    friction = -friction_.coefficient(slip) * normal;
    damping = (normal - elastic) * rate;
    rub = -friction * slip;
    out.force_on_rotor.y = -normal * n_y - friction * n_z;
    out.force_on_rotor.z = -normal * n_z + friction * n_y;
    out.force_on_rotor.torque = friction * radius_;
  }
  out.other_dissipation = damping + rub;
  ledger[contact_impulse] = normal;
  ledger[contact_damping] = damping;
  ledger[contact_friction] = rub;
  if (out.observed.empty()) return;
  out.observed[0] = normal;
  out.observed[1] = friction;
}

double ProbeContact::energy(const SupportInput& in, std::span<const double>) const {
  const double e_y = in.journal.y - probe_.centre[0], e_z = in.journal.z - probe_.centre[1];
  return contact_.energy(std::sqrt(e_y * e_y + e_z * e_z) - probe_.clearance);
}

}  // namespace rotordrop
