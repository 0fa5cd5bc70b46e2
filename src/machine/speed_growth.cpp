#include "machine/speed_growth.h"

#include <algorithm>

#include "laws/ring_growth.h"
#include "machine/static_growth.h"

namespace rotordrop {

Expansion ring_growth_by_speed(const MachineParameters& p, const TouchdownParameters& b) {
  const auto& m = material_of(p, b.ring);
  const double inside = 0.5 * b.inner_ring_diameters[0];
  const double outside = 0.5 * b.inner_shoulder_diameter.value_or(b.inner_ring_diameters[1]);
  const RaceSurfaces races = race_surfaces(p, b);
  Expansion g;
  g.bore = spinning_ring_growth(m.E, m.nu, m.rho, inside, outside, inside);
  g.inner_race = spinning_ring_growth(m.E, m.nu, m.rho, inside, outside, races.inner);
  g.inner_width = spinning_ring_strain(m.E, m.nu, m.rho, inside, outside) * races.width;
  return g;
}

bool drop_grows_by_speed(const MachineParameters& p) {
  return p.thermal.growth_by_speed != GrowthBySpeed::none && driver_of(p.thermal) != recorded_driver;
}

double rotor_growth_by_speed(const MachineParameters& p, const TouchdownParameters& b) {
  const double surface = bore_radius(b, p.contact) - air_gap(b, p.contact);
  const ShaftElement* outermost = nullptr;
  double inside = surface;
  for (const auto& e : p.rotor.geometry.elements) {
    if (b.node != e.n1 && b.node != e.n2) continue;
    inside = std::min(inside, 0.5 * e.id);
    if (!outermost || e.od > outermost->od) outermost = &e;
  }
  if (!outermost) return 0.;
  // A tube as wide as the surface under the bearing leaves nothing to spin: such a rotor's journal is a part of its own.
  if (inside >= surface) inside = 0.;
  const auto& m = outermost->material;
  return spinning_ring_growth(m.E, m.nu, m.rho, inside, surface, surface);
}

}  // namespace rotordrop
