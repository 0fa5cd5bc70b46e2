#include "machine/static_growth.h"

#include "machine/bearing_data.h"

namespace rotordrop {

RaceSurfaces race_surfaces(const MachineParameters& p, const TouchdownParameters& b) {
  if (p.thermal.expansion == GrowthSource::paper)
    return {0.5 * b.inner_ring_diameters[1], 0.5 * b.outer_ring_diameters[0], 0.};
  return contact_point_surfaces(b.ball_diameter, b.pitch_diameter, b.contact_angle, b.width);
}

Expansion even_growth(const MachineParameters& p, const TouchdownParameters& b) {
  const GrowthPerRise g =
      growth_per_rise({material_of(p, b.ring).alpha, material_of(p, b.ball).alpha, shaft_material(p, b).alpha,
                       bore_radius(b, p.contact) - air_gap(b, p.contact), 0.5 * b.inner_ring_diameters[0],
                       0.5 * b.ball_diameter, race_surfaces(p, b)});
  return {.shaft = g.shaft,
          .bore = g.bore,
          .inner_race = g.inner_race,
          .outer_race = g.outer_race,
          .ball = g.ball,
          .inner_width = g.inner_width,
          .outer_width = g.outer_width};
}

Expansion static_growth(const MachineParameters& p, const TouchdownParameters& b) {
  const auto& s = p.statics;
  Expansion g = even_growth(p, b);
  g.shaft *= s.shaft_rise;
  g.bore *= s.inner_rise;
  g.inner_race = g.inner_race * s.inner_rise + s.inner_growth;
  g.outer_race = g.outer_race * s.outer_rise + s.outer_growth;
  g.ball *= s.ball_rise;
  g.inner_width *= s.inner_rise;
  g.outer_width *= s.outer_rise;
  return g;
}

}  // namespace rotordrop
