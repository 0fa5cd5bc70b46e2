#include <array>
#include <bit>
#include <type_traits>

#include "analysis/lanes/scalars_in_lanes.h"
#include "base/drops.h"

// Compiled for every level of vectors, with ROTORDROP_LANE_FACTORY the name of its factory.

namespace rotordrop {
namespace {

/// Values of step observables by column.
template <class Real>
struct StepInLanes {
  std::span<const double> values;  // [number of values][width]
  [[nodiscard]] Real operator[](std::size_t column) const {
    return Real::load(values.data() + column * LaneSystem::width);
  }
};

template <class Real>
class Engine final : public ScalarsInLanes {
 public:
  explicit Engine(const std::vector<BearingColumns>& columns) : columns_(columns), scalars_(columns.size()) {}

  void take(std::size_t lane, std::span<const BearingScalars> bearings) override {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const auto of_one = std::bit_cast<Numbers<double>>(bearings[i]);
      auto all = std::bit_cast<Numbers<Real>>(scalars_[i]);
      for (std::size_t k = 0; k < count; ++k) all[k].set(static_cast<int>(lane), of_one[k]);
      scalars_[i] = std::bit_cast<BearingScalarsOf<Real>>(all);
    }
  }
  [[nodiscard]] std::vector<BearingScalars> of(std::size_t lane) const override {
    std::vector<BearingScalars> bearings;
    for (const auto& scalars : scalars_) {
      const auto all = std::bit_cast<Numbers<Real>>(scalars);
      Numbers<double> of_one;
      for (std::size_t k = 0; k < count; ++k) of_one[k] = all[k][static_cast<int>(lane)];
      bearings.push_back(std::bit_cast<BearingScalars>(of_one));
    }
    return bearings;
  }
  void follow(std::span<const double> told, std::span<const double> t, std::span<const double> step) override {
    const MaskOf<Real> is_told = Real::load(told.data()) != 0.;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      rotordrop::follow(scalars_[i], columns_[i], is_told, Real::load(t.data()), StepInLanes<Real>{step});
  }

 private:
  static constexpr std::size_t count = sizeof(BearingScalars) / sizeof(double);
  template <class Number>
  using Numbers = std::array<Number, count>;

  std::vector<BearingColumns> columns_;
  std::vector<BearingScalarsOf<Real>> scalars_;
};

}  // namespace

std::unique_ptr<ScalarsInLanes> ROTORDROP_LANE_FACTORY(const std::vector<BearingColumns>& columns) {
  return std::make_unique<Engine<EightDrops>>(columns);
}

}  // namespace rotordrop
