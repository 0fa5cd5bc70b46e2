#include "base/power_table.h"

namespace rotordrop {

const PowerTable cube_roots(1.0L / 3.0L);

PowerTable::PowerTable(long double n) : n_(static_cast<double>(n)), n_rows_(n >= 0.0L && n <= 3.0L ? most_rows : 0) {
  double factor = 1.;
  for (std::size_t k = 0; k < binomial_.size(); ++k)
    binomial_[k] = factor *= (n_ - static_cast<double>(k)) / static_cast<double>(k + 1);
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const double c = 1. + (static_cast<double>(k) + 0.5) / static_cast<double>(pieces_.size());
    pieces_[k] = {1. / c, static_cast<double>(std::pow(static_cast<long double>(c), n))};
  }
  for (std::size_t k = 0; k < binary_.size(); ++k)
    binary_[k] = static_cast<double>(std::exp2(n * static_cast<long double>(smallest + static_cast<int>(k))));
}

}  // namespace rotordrop
