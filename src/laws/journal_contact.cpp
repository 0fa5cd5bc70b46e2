#include "laws/journal_contact.h"

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

double plane_compliance(const ElasticMaterial& m) {
  return (1. - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
}

double approach_to_depth(const ElasticMaterial& m, double per_length, double half_width, double depth) {
  const double s = depth / half_width, nu = m.poisson_ratio;
  return 2. * per_length * plane_compliance(m) / std::numbers::pi *
         (std::asinh(s) - nu / (1. - nu) * s * (std::sqrt(1. + s * s) - s));
}

}  // namespace

double journal_contact_half_width(const JournalInBore& b, double force) {
  const double radius = b.journal_radius * b.bore_radius / (b.bore_radius - b.journal_radius);
  return line_contact_half_width(force / b.length, radius, effective_modulus(b.journal, b.ring));
}

double line_contact_approach(const JournalInBore& b, double force) {
  if (!(force > 0.)) return 0.;
  const double a = journal_contact_half_width(b, force), per_length = force / b.length;
  const double journal = b.journal_inner_radius > 0.
                             ? approach_to_depth(b.journal, per_length, a, b.journal_radius - b.journal_inner_radius)
                             : per_length * plane_compliance(b.journal) / std::numbers::pi *
                                   (2. * std::log(4. * b.journal_radius / a) - 1.);
  return journal + approach_to_depth(b.ring, per_length, a, b.ring_wall);
}

double fitted_contact_stiffness(double force, double approach, double exponent) {
  return force / std::pow(approach, exponent);
}

}  // namespace rotordrop
