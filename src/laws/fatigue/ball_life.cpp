#include "laws/fatigue/ball_life.h"

#include <cmath>

namespace rotordrop {
namespace {

constexpr double J_r = 0.228827929;  // sqrt(pi) Gamma(7/4) / (2 pi Gamma(9/4))
constexpr double J_3 = 0.177977278;  // Gamma(11/4) / (2 sqrt(pi) Gamma(13/4))
constexpr double weibull = 10. / 9.;

double gamma_of(const RatedRow& row) { return row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter; }

/// Passages of a ball in a turn of the inner ring.
double passages_a_turn(const RatedRow& row) { return 0.5 * (1. - gamma_of(row)); }

/// Q_ci / Q_co
double inner_over_outer_rating(const RatedRow& row) {
  const double f_i = row.inner_conformity, f_o = row.outer_conformity, gamma = gamma_of(row);
  return std::pow(f_i * (2. * f_o - 1.) / (f_o * (2. * f_i - 1.)), 0.41) * std::pow((1. - gamma) / (1. + gamma), 1.72);
}

}  // namespace

double rating_of_row(double C, int n_rows) { return C / std::pow(n_rows, 0.7); }

double ball_load_at_rating(const RatedRow& row) {
  return row.rating / (row.n_balls * std::cos(row.contact_angle) * J_r);
}

double life_share(const RatedRow& row, double sum_of_cubes) {
  const double passages = 1e6 * row.n_balls * passages_a_turn(row);
  const double Q_C = ball_load_at_rating(row);
  return sum_of_cubes / (passages * Q_C * Q_C * Q_C);
}

double cycles_of_rolling(const RatedRow& row, double cubes) { return passages_a_turn(row) * cubes / J_3; }

double of_both_races(const RatedRow& row, double by_inner_loads, double by_outer_loads) {
  const double outer_over_inner = std::pow(inner_over_outer_rating(row), load_life_exponent);
  return together(by_inner_loads, outer_over_inner * by_outer_loads) / together(1., outer_over_inner);
}

double together(double share, double other) {
  return std::pow(std::pow(share, weibull) + std::pow(other, weibull), 1. / weibull);
}

}  // namespace rotordrop
