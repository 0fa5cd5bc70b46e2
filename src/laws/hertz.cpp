#include "laws/hertz.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

double combined_radius(const ContactGeometry& g) { return 1. / (1. / g.R_x + 1. / g.R_y); }

// Ellipticity from the curvature difference (Hamrock & Dowson 1981, eq. 3.27): with j = k,
//   (Ry - Rx)/(Ry + Rx) = [ (k^2 + 1) E - 2 F ] / [ (k^2 - 1) E ].
ContactEllipse exact_ellipse(const ContactGeometry& g) {
  const double difference = (g.R_y - g.R_x) / (g.R_y + g.R_x);
  const auto integrals = [](double k) {
    const double modulus = std::sqrt(1. - 1. / (k * k));
    return ContactEllipse{k, boost::math::ellint_2(modulus), boost::math::ellint_1(modulus)};
  };
  const auto mismatch = [&](double k) {
    const auto e = integrals(k);
    return ((k * k + 1.) * e.E - 2. * e.F) / ((k * k - 1.) * e.E) - difference;
  };
  if (difference < 1e-6) return integrals(1. + 1e-9);
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(mismatch, 1. + 1e-5, 1e4,
                                                         boost::math::tools::eps_tolerance<double>(50), iterations);
  return integrals(0.5 * (bracket.first + bracket.second));
}

}  // namespace

double effective_modulus(const ElasticMaterial& first, const ElasticMaterial& second) {
  const auto compliance = [](const ElasticMaterial& m) {
    return (1. - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  return 2. / (compliance(first) + compliance(second));
}

ContactGeometry inner_race_contact(double ball_diameter, double race_radius, double conformity) {
  return {1. / (2. / ball_diameter + 1. / race_radius), 1. / (2. / ball_diameter - 1. / (conformity * ball_diameter))};
}

ContactGeometry outer_race_contact(double ball_diameter, double race_radius, double conformity) {
  return {1. / (2. / ball_diameter - 1. / race_radius), 1. / (2. / ball_diameter - 1. / (conformity * ball_diameter))};
}

ContactEllipse contact_ellipse(const ContactGeometry& g, EllipticIntegrals method) {
  if (method == EllipticIntegrals::exact) return exact_ellipse(g);
  const double ratio = g.R_y / g.R_x;
  return {1.0339 * std::pow(ratio, 0.636), 1.0003 + 0.5968 / ratio, 1.5277 + 0.6023 * std::log(ratio)};
}

double hertz_stiffness(const ContactGeometry& g, double modulus, EllipticIntegrals method) {
  const auto e = contact_ellipse(g, method);
  return pi * e.k * modulus * std::sqrt(2. * e.E * combined_radius(g) / (9. * e.F * e.F * e.F));
}

double semi_major_axis_factor(const ContactGeometry& g, double modulus, EllipticIntegrals method) {
  const auto e = contact_ellipse(g, method);
  return std::cbrt(6. * e.k * e.k * e.E * combined_radius(g) / (pi * modulus));
}

double line_contact_half_width(double load_per_length, double combined_radius, double effective_modulus) {
  return std::sqrt(8. * load_per_length * combined_radius / (pi * effective_modulus));
}

double stiffness_in_series(double inner, double outer) {
  return std::pow(std::pow(inner, -2. / 3.) + std::pow(outer, -2. / 3.), -1.5);
}

}  // namespace rotordrop
