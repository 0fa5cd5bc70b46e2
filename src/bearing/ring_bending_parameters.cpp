#include "bearing/ring_bending_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

/// Inner or outer ring of all rows together.
RingSection section(const TouchdownParameters& b, bool is_inner) {
  RingSection s;
  const auto& shoulder = is_inner ? b.inner_shoulder_diameter : b.outer_shoulder_diameter;
  s.inner_radius = 0.5 * (is_inner ? b.inner_ring_diameters[0] : shoulder.value_or(b.outer_ring_diameters[0]));
  s.outer_radius = 0.5 * (is_inner ? shoulder.value_or(b.inner_ring_diameters[1]) : b.outer_ring_diameters[1]);
  s.width = b.width;
  s.has_grooves_outside = is_inner;
  const double side = is_inner ? 1. : -1., conformity = b.conformity[is_inner ? 0 : 1];
  const double offset = side * (conformity - 0.5) * b.ball_diameter;
  for (const auto& row : row_places(b))
    s.grooves.push_back({row.position + row.direction * offset * std::sin(b.contact_angle),
                         0.5 * b.pitch_diameter + offset * std::cos(b.contact_angle), conformity * b.ball_diameter});
  return s;
}

}  // namespace

void add_ring_bending_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.choice("ring_bending", &P::ring_bending,
           {{"none", RingBendingModel::none}, {"point", RingBendingModel::point}, {"arc", RingBendingModel::arc}},
           {.fallback = "none",
            .help = "Rings are rigid, or bend in their plane. arc: the rotor touches the bent bore wherever the "
                    "surfaces overlap. point: at one point on the line of centres; statics then put a radial load at "
                    "one point too. Rigid rings understate the largest ball loads of an impact."});
  s.integer("ring_harmonics", &P::ring_harmonics,
            {.range = between(2, 40),
             .fallback = 12,
             .source = "12: docs/theory/ring-bending.md shows what more of them change",
             .help = "Highest number n of waves around a bent ring; harmonics 2 to n are unknowns. Contact at a point "
                     "needs more of them than contact over an arc."});
  s.quantity("ring_bending_damping", &P::ring_bending_damping,
             {.range = between(0, 1),
              .usual = or_zero(between(1e-4, 0.3)),
              .fallback = "0.01",
              .source = "estimate: a steel ring loosely held by its balls; 0 to 0.05 changes little",
              .help = "Damping ratio of every harmonic of a bent ring."});
  s.quantity(
      "ring_frequency_limit", &P::ring_frequency_limit,
      {.unit = "Hz",
       .range = positive(),
       .usual = between(500, 2e5),
       .fallback = "10 kHz",
       .source = "docs/theory/ring-bending.md: the first impact is within 0.3 % of that with every mass as it is",
       .help = "Harmonics of a bent ring above this frequency get more mass in a drop, so that they oscillate "
               "at it; their stiffness stays."});
  s.quantity("outer_ring_bedding", &P::outer_ring_bedding,
             {.unit = "N/m3",
              .range = positive(),
              .usual = between(1e9, 1e15),
              .help = "Radial stiffness of the housing's bore per area, on which the outer ring bends if ring_bending "
                      "is not none; a rigid outer ring if not given."});
}

void check_ring_bending(const TouchdownParameters& b, const Node& table, const std::string& path, Faults& faults) {
  const bool bends = b.ring_bending != RingBendingModel::none;
  if (b.outer_ring_bedding && !bends)
    faults.add(position_of_value(table, "outer_ring_bedding"),
               fmt::format("{}: outer_ring_bedding is given, and ring_bending = \"none\".", path),
               "Set ring_bending = \"arc\" or \"point\", or leave out the bedding.");
  if (!bends) return;
  const auto check_wall = [&](bool is_inner) {
    const RingSection s = section(b, is_inner);
    const std::string ring = is_inner ? "inner" : "outer";
    const std::string key = is_inner ? (b.inner_shoulder_diameter ? "inner_shoulder_diameter" : "inner_ring_diameters")
                                     : (b.outer_shoulder_diameter ? "outer_shoulder_diameter" : "outer_ring_diameters");
    // Thinner than a hundredth of its radius, the wall is no bearing's but an error.
    const double least = 0.01 * s.inner_radius;
    if (s.outer_radius - s.inner_radius < least || s.least_wall() < least)
      faults.add(
          position_of_value(table, key),
          fmt::format("{}: ring_bending needs the section of the {} ring, and {:.4g} mm of wall are left under "
                      "its groove.",
                      path, ring, s.least_wall() * 1e3),
          fmt::format("Allowed: {:.4g} mm or more. Check {}_ring_diameters, {}_shoulder_diameter, conformity and "
                      "ball_diameter.",
                      least * 1e3, ring, ring));
  };
  check_wall(true);
  if (b.outer_ring_bedding) check_wall(false);
}

std::optional<BentRings> bent_rings(const TouchdownParameters& b, const TouchdownBearingData& data,
                                    const TouchdownSurroundings& around) {
  if (b.ring_bending == RingBendingModel::none) return {};
  BentRings bent;
  bent.model = b.ring_bending;
  const auto harmonics = [&](bool is_inner) {
    RingSection s = section(b, is_inner);
    s.E = around.ring.youngs_modulus;
    s.nu = around.ring.poisson_ratio;
    s.rho = around.ring_density;
    return ring_harmonics(s, b.ring_harmonics);
  };
  bent.inner = harmonics(true);
  if (b.outer_ring_bedding) {
    bent.outer = harmonics(false);
    // Energy of the bedding: the integral of k u_r^2 / 2 over the ring's outside.
    for (auto& h : bent.outer)
      h.stiffness += std::numbers::pi * *b.outer_ring_bedding * 0.5 * b.outer_ring_diameters[1] * b.width;
  }
  bent.damping_ratio = b.ring_bending_damping;
  bent.frequency_limit = b.ring_frequency_limit;
  bent.arc = ArcContact(data.contact.K, data.contact.n, data.air_gap);
  return bent;
}

}  // namespace rotordrop
