#pragma once
#include <vector>

#include "base/gather.h"
#include "bearing/row/row_in_lanes.h"
#include "bearing/touchdown_evaluate.h"

namespace rotordrop {

/// Touchdown bearings of several drops side by side.
template <class Real>
class TouchdownInLanes {
 public:
  /// @param bearings  alike (TouchdownBearing::is_alike()); lanes without one repeat the first
  explicit TouchdownInLanes(std::span<const TouchdownBearing* const> bearings) : form_(*bearings.front()) {
    std::vector<const TouchdownNumbers<double>*> numbers;
    for (const auto* bearing : bearings) numbers.push_back(&bearing->numbers());
    numbers_ = gathered<TouchdownNumbers, Real>(numbers);
    for (std::size_t i = 0; i < form_.rows().size(); ++i) {
      std::vector<const BallRow*> rows;
      for (const auto* bearing : bearings) rows.push_back(&bearing->rows()[i]);
      rows_.emplace_back(rows);
    }
  }
  void evaluate(const SupportInputOf<Real>& in, std::span<const Real> y, std::span<Real> dydt, std::span<Real> ledger,
                SupportOutputOf<Real>& out) const {
    form_.evaluate_with<Real, RowInLanes<Real>>(numbers_, rows_, in, y, dydt, ledger, out);
  }

 private:
  const TouchdownBearing& form_;
  TouchdownNumbers<Real> numbers_;
  std::vector<RowInLanes<Real>> rows_;
};

}  // namespace rotordrop
