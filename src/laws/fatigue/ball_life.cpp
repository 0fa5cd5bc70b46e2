#include "laws/fatigue/ball_life.h"

#include <cmath>

namespace rotordrop {
namespace {

constexpr double J_r = 0.228827929;  // sqrt(pi) Gamma(7/4) / (2 pi Gamma(9/4))
constexpr double J_3 = 0.177977278;  // Gamma(11/4) / (2 sqrt(pi) Gamma(13/4))
constexpr double weibull = 10. / 9.;

/// Passages of a ball in a turn of the inner ring.
double passages_a_turn(const RatedRow& row) {
  return 0.5 * (1. - row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter);
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

double together(double share, double other) {
  return std::pow(std::pow(share, weibull) + std::pow(other, weibull), 1. / weibull);
}

}  // namespace rotordrop
