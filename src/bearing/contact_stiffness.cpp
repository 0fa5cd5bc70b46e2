#include "bearing/contact_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "laws/hertz.h"
#include "laws/journal_contact.h"

namespace rotordrop {
namespace {

/// A journal with a crown: Hertz' point contact, with the ellipse along the axis.
double crowned_approach(const JournalInBore& b, double crown_radius, double force) {
  const ContactGeometry geometry{b.journal_radius * b.bore_radius / (b.bore_radius - b.journal_radius), crown_radius};
  // The fits and integrals are for R_y >= R_x; a contact is the same with its axes exchanged.
  const ContactGeometry sorted{std::min(geometry.R_x, geometry.R_y), std::max(geometry.R_x, geometry.R_y)};
  return std::pow(force / hertz_stiffness(sorted, effective_modulus(b.journal, b.ring), EllipticIntegrals::exact),
                  2. / 3.);
}

}  // namespace

ContactStiffness contact_stiffness(const TouchdownParameters& b, const ContactParameters& contact,
                                   const TouchdownSurroundings& around) {
  ContactStiffness s;
  s.is_given = b.contact_stiffness.has_value();
  const double bore = bore_radius(b, contact), n = contact.exponent;
  JournalInBore bodies;
  bodies.journal = around.journal ? around.journal->material : around.ring;
  bodies.ring = around.ring;
  bodies.bore_radius = bore;
  bodies.journal_radius = bore - air_gap(b, contact);
  bodies.journal_inner_radius =
      around.journal ? std::min(around.journal->inner_radius, 0.9 * bodies.journal_radius) : 0.;
  bodies.ring_wall = std::max(0.5 * b.inner_ring_diameters[1] - bore, 1e-3 * bore);
  bodies.length = b.contact_width.value_or(b.width);
  s.reference_force = 0.1 * b.C0;
  const auto approach = [&](double force) {
    const double line = line_contact_approach(bodies, force);
    return b.crown_radius ? std::max(line, crowned_approach(bodies, *b.crown_radius, force)) : line;
  };
  s.half_width = journal_contact_half_width(bodies, s.reference_force);
  s.approach = approach(s.reference_force);
  s.from_bodies = fitted_contact_stiffness(s.reference_force, s.approach, n);
  const auto deviation = [&](double force) { return std::pow(force / s.from_bodies, 1. / n) / approach(force) - 1.; };
  s.deviation_low = deviation(0.2 * s.reference_force);
  s.deviation_high = deviation(5. * s.reference_force);
  s.value = b.contact_stiffness.value_or(s.from_bodies);
  return s;
}

std::string contact_stiffness_words(const std::string& name, const ContactStiffness& s, double n) {
  const std::string bodies = fmt::format(
      "{:.4g} N/m^{:.4g} from the bodies: {:.3g} um under {:.4g} N, in a contact {:.3g} mm wide; off them by {:+.0f} % "
      "at a fifth "
      "and {:+.0f} % at five times this force",
      s.from_bodies, n, s.approach * 1e6, s.reference_force, 2e3 * s.half_width, 100. * s.deviation_low,
      100. * s.deviation_high);
  if (!s.is_given) return fmt::format("{}: contact stiffness {}", name, bodies);
  return fmt::format("{}: contact stiffness {:.4g} N/m^{:.4g} as given; {}", name, s.value, n, bodies);
}

}  // namespace rotordrop
