#pragma once
#include <memory>

#include "base/power_table.h"
#include "base/real.h"

namespace rotordrop {

/// An exponent with what its powers need: pow(x, n) is written as with a number.
template <class Real>
class ExponentOf {
 public:
  explicit ExponentOf(const Real& n) : n_(n) {}
  /// Where it is 1/2, as for deep-groove bearings, the root costs less.
  friend Real pow(const Real& x, const ExponentOf& n) {
    const auto is_root = n.n_ == 0.5;
    const Real root = sqrt(x);
    return any(!is_root) ? select(is_root, root, pow(x, n.n_)) : root;
  }

 private:
  Real n_;
};
template <>
class ExponentOf<double> {
 public:
  explicit ExponentOf(double n) : table_(std::make_shared<const PowerTable>(n)) {}
  [[gnu::always_inline]] friend inline double pow(double x, const ExponentOf& n) { return n.table_->power(x); }

 private:
  std::shared_ptr<const PowerTable> table_;
};

}  // namespace rotordrop
