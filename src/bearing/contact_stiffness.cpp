#include "bearing/contact_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "laws/hertz.h"
#include "laws/journal_contact.h"

namespace rotordrop {
namespace {

/// A journal with a crown: Hertz' point contact.
struct CrownContact {
  double approach, length, half_width;  // [m]
};
CrownContact crown_contact(const JournalInBore& b, double crown_radius, double force) {
  const ContactGeometry geometry{b.journal_radius * b.bore_radius / (b.bore_radius - b.journal_radius), crown_radius};
  // The fits and integrals are for R_y >= R_x; a contact is the same with its axes exchanged.
  const ContactGeometry sorted{std::min(geometry.R_x, geometry.R_y), std::max(geometry.R_x, geometry.R_y)};
  constexpr auto method = EllipticIntegrals::exact;
  const double modulus = effective_modulus(b.journal, b.ring);
  const double major = semi_major_axis_factor(sorted, modulus, method) * std::cbrt(force),
               minor = major / contact_ellipse(sorted, method).k;
  const bool is_along = geometry.R_y >= geometry.R_x;  // its major axis lies along the rotor's
  return {std::pow(force / hertz_stiffness(sorted, modulus, method), 2. / 3.), 2. * (is_along ? major : minor),
          is_along ? minor : major};
}

JournalInBore journal_in_bore(const TouchdownParameters& b, const ContactParameters& contact,
                              const TouchdownSurroundings& around) {
  JournalInBore bodies;
  bodies.journal = around.rotor();
  bodies.ring = around.ring;
  bodies.bore_radius = bore_radius(b, contact);
  bodies.journal_radius = bodies.bore_radius - air_gap(b, contact);
  bodies.journal_inner_radius =
      around.journal ? std::min(around.journal->inner_radius, 0.9 * bodies.journal_radius) : 0.;
  bodies.ring_wall = std::max(0.5 * b.inner_ring_diameters[1] - bodies.bore_radius, 1e-3 * bodies.bore_radius);
  bodies.length = b.contact_width.value_or(b.width);
  return bodies;
}

}  // namespace

ContactStiffness contact_stiffness(const TouchdownParameters& b, const ContactParameters& contact,
                                   const TouchdownSurroundings& around) {
  ContactStiffness s;
  s.is_given = b.contact_stiffness.has_value();
  const double n = contact.exponent;
  const JournalInBore bodies = journal_in_bore(b, contact, around);
  s.reference_force = 0.1 * b.C0;
  const auto approach = [&](double force) {
    const double line = line_contact_approach(bodies, force);
    return b.crown_radius ? std::max(line, crown_contact(bodies, *b.crown_radius, force).approach) : line;
  };
  s.half_width = journal_contact_half_width(bodies, s.reference_force);
  s.length = bodies.length;
  if (b.crown_radius)
    if (const auto crown = crown_contact(bodies, *b.crown_radius, s.reference_force); crown.length < bodies.length) {
      s.half_width = crown.half_width;
      s.length = crown.length;
      s.is_ellipse = true;
    }
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
      "{:.4g} N/m^{:.4g} from the bodies: {:.3g} um under {:.4g} N, in a contact {:.3g} mm wide and {:.3g} mm long "
      "along the axis; off them by {:+.0f} % at a fifth and {:+.0f} % at five times this force",
      s.from_bodies, n, s.approach * 1e6, s.reference_force, 2e3 * s.half_width, 1e3 * s.length, 100. * s.deviation_low,
      100. * s.deviation_high);
  if (!s.is_given) return fmt::format("{}: contact stiffness {}", name, bodies);
  return fmt::format("{}: contact stiffness {:.4g} N/m^{:.4g} as given; {}", name, s.value, n, bodies);
}

}  // namespace rotordrop
