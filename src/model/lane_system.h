#pragma once
#include <cstddef>
#include <span>

#include "model/evaluation.h"
#include "model/state_layout.h"

namespace rotordrop {

/// As OdeSystem, of several drops side by side: number i of lane l stands at [i][l], rows of `width`. All lanes are evaluated, those without a drop too.
/// What a lane gives depends on its own numbers alone, bit for bit. One thread at a time.
class LaneSystem {
 public:
  static constexpr std::size_t width = 8;

  LaneSystem() = default;
  LaneSystem(const LaneSystem&) = delete;
  LaneSystem& operator=(const LaneSystem&) = delete;
  virtual ~LaneSystem() = default;

  [[nodiscard]] virtual const StateLayout& layout() const = 0;
  /// Entries [from, size) are quadratures.
  [[nodiscard]] virtual std::size_t first_quadrature() const = 0;
  /// @param t [width] [s]; @param y, dydt [layout().size()][width], at whole lines of the cache (AlignedNumbers)
  virtual void rates(std::span<const double> t, std::span<const double> y, std::span<double> dydt) = 0;
  /// The same with what is observed on the way. @param step, details  [number of values][width]; empty: not
  virtual void observe(std::span<const double> t, std::span<const double> y, std::span<double> dydt,
                       std::span<double> step, std::span<double> details) = 0;
  /// State observables of the states that the last observe() evaluated; only with one machine in all lanes. @param y  whole states; @param out  [number of values][width]
  virtual void observe_state(std::span<const double> y, std::span<double> out) = 0;
  /// Only those that need no evaluation; the others are left alone.
  virtual void observe_held(std::span<const double> y, std::span<double> out) = 0;
};

}  // namespace rotordrop
