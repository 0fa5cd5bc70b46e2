#pragma once
#include <array>
#include <vector>

#include "base/gather.h"
#include "bearing/row/row_in_lanes.h"
#include "bearing/touchdown_evaluate.h"

namespace rotordrop {

/// Touchdown bearings of several drops side by side. Laws of supports are those of one drop: they are asked lane by lane.
template <class Real>
class TouchdownInLanes {
 public:
  /// @param bearings  alike (TouchdownBearing::is_alike()); lanes without one repeat the first
  explicit TouchdownInLanes(std::span<const TouchdownBearing* const> bearings)
      : numbers_(numbers_of(bearings), bore_waves_of(bearings)) {
    for (std::size_t i = 0; i < bearings.front()->rows().size(); ++i) {
      std::vector<const BallRow*> rows;
      for (const auto* bearing : bearings) rows.push_back(&bearing->rows()[i]);
      rows_.emplace_back(rows);
    }
    for (std::size_t lane = 0; lane < n_lanes; ++lane)
      bearings_.push_back(lane < bearings.size() ? bearings[lane] : bearings.front());
    const std::size_t n = bearings.front()->support_states_at() + bearings.front()->n_support_states();
    y_.resize(n);
    dydt_.resize(n);
  }
  void evaluate(const SupportInputOf<Real>& in, std::span<const Real> y, std::span<Real> dydt, std::span<Real> ledger,
                SupportOutputOf<Real>& out) const {
    bearings_.front()->evaluate_with<Real>(*this, in, y, dydt, ledger, out);
  }

  [[nodiscard]] Real energy(const SupportInputOf<Real>& in, std::span<const Real> y) const {
    return bearings_.front()->energy_with<Real>(*this, in, y);
  }

  [[nodiscard]] const TouchdownFormulas<Real>& numbers() const { return numbers_; }
  [[nodiscard]] std::span<const RowInLanes<Real>> rows() const { return rows_; }
  SupportAnswerOf<Real> carried(std::span<const Real> y, std::span<Real> dydt) const {
    SupportAnswerOf<Real> all;
    for (int lane = 0; lane < n_lanes; ++lane) {
      const TouchdownBearing& bearing = take(lane, y);
      const SupportAnswer one = bearing.carried(y_, dydt_);
      for (std::size_t i = bearing.support_states_at(); i < dydt_.size(); ++i) dydt[i].set(lane, dydt_[i]);
      all.y.set(lane, one.y);
      all.z.set(lane, one.z);
      all.loss.set(lane, one.loss);
    }
    return all;
  }
  void observe_support(const SupportAnswerOf<Real>& answer, std::span<const Real> y, std::span<Real> out) const {
    for (int lane = 0; lane < n_lanes; ++lane) {
      std::array<double, 3> one;
      take(lane, y).observe_support({answer.y[lane], answer.z[lane], answer.loss[lane]}, y_, one);
      for (std::size_t i = 0; i < one.size(); ++i) out[i].set(lane, one[i]);
    }
  }
  [[nodiscard]] Real stored_in_support(std::span<const Real> y) const {
    Real all;
    for (int lane = 0; lane < n_lanes; ++lane) all.set(lane, take(lane, y).stored_in_support(y_));
    return all;
  }

 private:
  [[nodiscard]] static TouchdownNumbers<Real> numbers_of(std::span<const TouchdownBearing* const> bearings) {
    std::vector<const TouchdownNumbers<double>*> numbers;
    for (const auto* bearing : bearings) numbers.push_back(&bearing->numbers());
    return gathered<TouchdownNumbers, Real>(numbers);
  }
  [[nodiscard]] static std::vector<BoreWaveOf<Real>> bore_waves_of(std::span<const TouchdownBearing* const> bearings) {
    std::vector<BoreWaveOf<Real>> waves;
    for (const BoreWave& wave : bearings.front()->data().bore_waves) {
      const auto of_all = [&, k = waves.size()](double BoreWave::*number) {
        return side_by_side<Real>(bearings.size(),
                                  [&](std::size_t i) { return bearings[i]->data().bore_waves[k].*number; });
      };
      waves.push_back({wave.order, of_all(&BoreWave::amplitude), of_all(&BoreWave::phase)});
    }
    return waves;
  }
  /// A lane's bearing, with its states up to the support's in y_.
  const TouchdownBearing& take(int lane, std::span<const Real> y) const {
    for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = y[i][lane];
    return *bearings_[static_cast<std::size_t>(lane)];
  }

  std::vector<const TouchdownBearing*> bearings_;  // [n_lanes]
  TouchdownFormulas<Real> numbers_;
  std::vector<RowInLanes<Real>> rows_;
  mutable std::vector<double> y_, dydt_;  // of one lane
};

}  // namespace rotordrop
