#pragma once

// Sums over the modes of reduced finite elements, compiled for several kinds of machine. States are absolute temperatures: their rises count
// from `zero`.
#include <cstddef>

namespace rotordrop {

struct TwoSums {
  double a, b;
};
/// Weighted sums of y - zero, several at once.
TwoSums two_sums(const double* y, double zero, const double* a, const double* b, std::size_t n);

struct ThreeSums {
  double a, b, c;
};
ThreeSums three_sums(const double* y, double zero, const double* a, const double* b, const double* c, std::size_t n);

struct FiveSums {
  double a, b, c, d, e;
};
FiveSums five_sums(const double* y, double zero, const double* a, const double* b, const double* c, const double* d,
                   const double* e, std::size_t n);

/// Adds a row times a factor.
void add_times(double factor, const double* row, double* to, std::size_t n);

struct ModalHeats {
  const double *bore, *shaft, *inner, *outer, *film;  // rows
  double q_bore, q_shaft, q_inner, q_outer, q_film;   // [W]
};
/// Rates of the modes under heats.
void modal_rates(const double* y, double zero, const double* rate, const ModalHeats& h, double* dydt, std::size_t n);

struct RiseRange {
  double lowest, highest;
};
/// Extremes over a surface's points. @param rises  scratch [n_points]
RiseRange extremes(const double* y, double zero, std::size_t n, const double* by_mode, const double* at_once,
                   double watts, double* rises, std::size_t n_points);

}  // namespace rotordrop
