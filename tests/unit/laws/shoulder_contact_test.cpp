// AN ANNULUS ON A HALF SPACE, from Boussinesq's point load by another way than Hankel's transform: a ring of radius s under a line load makes the displacement
// w(r) = (1 - nu^2)/(pi E) * 4 s K(m)/(r + s), m = 4 r s/(r + s)^2, per unit of pressure and width of ring. The logarithm at r = s is integrated over cells, midpoint
// against edges, so that no point meets it; the mean over the annulus converges with the number of cells.
#include "laws/shoulder_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

double by_point_loads(double a, double b, const ElasticMaterial& material, int n) {
  const double h = (b - a) / n;
  double sum = 0.;
  // Loads on n rings at the middles of cells; displacement at the middles of a grid shifted by half a cell, the trapezoidal rule between.
  for (int i = 0; i <= n; ++i) {
    const double r = a + i * h, weight = (i == 0 || i == n ? 0.5 : 1.) * h;
    double w = 0.;
    for (int k = 0; k < n; ++k) {
      const double s = a + (k + 0.5) * h, m = 4. * r * s / ((r + s) * (r + s));
      w += 4. * s * std::comp_ellint_1(std::sqrt(m)) / (r + s) * h;
    }
    sum += w * 2. * pi * r * weight;
  }
  const double area = pi * (b * b - a * a);
  return (1. - material.poisson_ratio * material.poisson_ratio) / (pi * material.youngs_modulus) * sum / (area * area);
}

TEST(AnnulusOnAHalfSpace, IsAsManyPointLoadsTogether) {
  const ElasticMaterial steel{2.1e11, 0.3};
  for (const double a : {5e-3, 20e-3, 35e-3, 38e-3}) {
    const double exact = annulus_compliance(a, 39e-3, steel);
    // First order in the cells: two grids are extrapolated.
    const double coarse = by_point_loads(a, 39e-3, steel, 400), fine = by_point_loads(a, 39e-3, steel, 800);
    EXPECT_NEAR((2. * fine - coarse) / exact, 1., 2e-6) << a << " m";
  }
}

TEST(AnnulusOnAHalfSpace, IsADiscWithoutAHole) {
  const ElasticMaterial steel{2e11, 0.25};
  const double disc =
      16. * (1. - 0.0625) / (3. * pi * pi * 2e11 * 0.01);  // Johnson 1985, eq. (3.29c): 16 p b (1 - nu^2)/(3 pi E)
  EXPECT_NEAR(annulus_compliance(0., 0.01, steel) / disc, 1., 1e-14);
  EXPECT_NEAR(annulus_compliance(1e-5, 0.01, steel) / disc, 1., 1e-5);
  // Series and closed form meet at (a/b)^2 = 1e-3.
  const double below = annulus_compliance(0.01 * std::sqrt(0.999e-3), 0.01, steel),
               above = annulus_compliance(0.01 * std::sqrt(1.001e-3), 0.01, steel);
  EXPECT_NEAR(above / below, 1., 1e-5);
}

TEST(Sleeve, IsAColumn) {
  EXPECT_DOUBLE_EQ(sleeve_compliance(0.03, 0.04, 0.02, {2e11, 0.3}), 0.02 / (2e11 * pi * 7e-4));
}

}  // namespace
}  // namespace rotordrop
