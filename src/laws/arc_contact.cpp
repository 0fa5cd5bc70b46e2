#include "laws/arc_contact.h"

#include <cmath>

namespace rotordrop {
namespace {

double beta_function(double a, double b) { return std::exp(std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b)); }

double binomial(double n, int k) {
  double value = 1.;
  for (int i = 0; i < k; ++i) value *= (n - i) / (i + 1.);
  return value;
}

}  // namespace

// With y = t delta_0 and x = delta_0 / c: 1 / sqrt(2 e - y) = (2 c)^(-1/2) sum_j binomial(-1/2, j) (x / 2)^j (1 + (1 - t))^j.
ArcContact::ArcContact(double K, double n, double gap) : exponent_(n - 0.5) {
  const double p = n + 0.5;  // w = sum_k w_k c^-k delta^(p + k)
  const auto integral = [&](int k, int j) {
    double sum = 0.;
    for (int i = 0; i <= j; ++i) sum += binomial(j, i) * beta_function(0.5, p + k + i + 1.);
    return binomial(-0.5, j) * std::pow(0.5, j) * sum;
  };
  std::array<double, n_orders> w{};
  for (int s = 0; s < n_orders; ++s) {
    double rest = s == 0 ? K / (n + 1.) * std::sqrt(2. * gap) / 2. : 0.;
    for (int k = 0; k < s; ++k) rest -= w[static_cast<std::size_t>(k)] * integral(k, s - k);
    w[static_cast<std::size_t>(s)] = rest / integral(s, 0);
  }
  for (int k = 0; k < n_orders; ++k)
    factor_[static_cast<std::size_t>(k)] = (p + k) * w[static_cast<std::size_t>(k)] * std::pow(gap, -k);
}

double ArcContact::stiffness(double delta) const {
  if (!(delta > 0.)) return 0.;
  double sum = 0., power = 1.;
  for (int k = 0; k < n_orders; ++k, power *= delta)
    sum += (exponent_ + k) * factor_[static_cast<std::size_t>(k)] * power;
  return std::pow(delta, exponent_ - 1.) * sum;
}

double ArcContact::energy(double delta) const {
  if (!(delta > 0.)) return 0.;
  double sum = 0., power = 1.;
  for (int k = 0; k < n_orders; ++k, power *= delta)
    sum += factor_[static_cast<std::size_t>(k)] * power / (exponent_ + k + 1.);
  return std::pow(delta, exponent_ + 1.) * sum;
}

}  // namespace rotordrop
