#include "laws/shoulder_contact.h"

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

/// 2F1(1/2, -1/2; 2; m). Near 0 the closed form loses all digits to cancellation: its series.
double mutual_factor(double m) {
  if (m < 1e-3) return 1. - m / 8. * (1. + m / 8.);
  const double k = std::sqrt(m);
  return 4. / (3. * pi * m) * ((1. + m) * std::comp_ellint_2(k) - (1. - m) * std::comp_ellint_1(k));
}

}  // namespace

double annulus_compliance(double a, double b, const ElasticMaterial& material) {
  const double area = b * b - a * a;  // over pi
  const double sum = 4. * (a * a * a + b * b * b) / (3. * pi) - a * a * b * mutual_factor(a * a / (b * b));
  return 4. * (1. - material.poisson_ratio * material.poisson_ratio) / (pi * material.youngs_modulus * area * area) *
         sum;
}

double sleeve_compliance(double inside, double outside, double length, const ElasticMaterial& material) {
  return length / (material.youngs_modulus * pi * (outside * outside - inside * inside));
}

}  // namespace rotordrop
