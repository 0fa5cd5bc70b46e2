// Hertz' pressure p_0 sqrt(1 - x^2/a^2) on a half-space has along its axis (Johnson 1985, eq. 4.46)
//   sigma_x = -p_0/a [(a^2 + 2 z^2)/sqrt(a^2 + z^2) - 2 z],  sigma_z = -p_0 a / sqrt(a^2 + z^2),  p_0 = 2 P / (pi a),
// and in plane strain eps_z = (1 - nu^2)/E (sigma_z - nu/(1 - nu) sigma_x): summed here by small steps.
#include "laws/journal_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

const ElasticMaterial steel{2e11, 0.3};

double compressed(const ElasticMaterial& m, double P, double a, double depth) {
  const double p_0 = 2. * P / (std::numbers::pi * a), nu = m.poisson_ratio;
  double sum = 0.;
  const int n = 200000;
  for (int k = 0; k < n; ++k) {
    const double z = depth * (k + 0.5) / n, root = std::sqrt(a * a + z * z);
    const double s_x = -p_0 / a * ((a * a + 2. * z * z) / root - 2. * z), s_z = -p_0 * a / root;
    sum -= (1. - nu * nu) / m.youngs_modulus * (s_z - nu / (1. - nu) * s_x) * depth / n;
  }
  return sum;
}

TEST(JournalContact, CompressesTheRingAsHertzPressureDoes) {
  // A hollow journal has the same form as the ring, so that both parts are such integrals.
  const JournalInBore b{steel, {1.1e11, 0.34}, 34.75e-3, 20e-3, 35e-3, 4e-3, 20e-3};
  for (const double force : {50., 3000., 2e4}) {
    const double a = journal_contact_half_width(b, force), P = force / b.length;
    const double expected = compressed(b.ring, P, a, 4e-3) + compressed(b.journal, P, a, 14.75e-3);
    EXPECT_NEAR(line_contact_approach(b, force), expected, 1e-8 * expected) << "m at " << force;
  }
}

TEST(JournalContact, OfASolidJournalFollowsJohnson) {
  const JournalInBore b{steel, steel, 34.75e-3, 0., 35e-3, 4e-3, 20e-3};
  const double a = journal_contact_half_width(b, 5000.), P = 5000. / 0.02;
  // By hand: R = 35 34.75 / 0.25 = 4865 mm, 1/E* = 2 0.91 / 2e11, a = sqrt(4 P R / (pi E*)) = 3.754 mm.
  EXPECT_NEAR(a, 3.754e-3, 1e-6);
  const double journal = P * 0.91 / (std::numbers::pi * 2e11) * (2. * std::log(4. * 34.75e-3 / a) - 1.);
  EXPECT_NEAR(line_contact_approach(b, 5000.), journal + compressed(steel, P, a, 4e-3), 1e-13);
  EXPECT_EQ(line_contact_approach(b, 0.), 0.);
}

TEST(JournalContact, FitMeetsTheApproachAtItsForce) {
  const double K = fitted_contact_stiffness(3000., 2e-6, 10. / 9.);
  EXPECT_NEAR(std::pow(3000. / K, 0.9), 2e-6, 1e-18);
}

}  // namespace
}  // namespace rotordrop
