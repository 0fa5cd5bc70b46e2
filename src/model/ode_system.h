#pragma once
#include <span>
#include <vector>

#include "model/oscillator.h"
#include "model/state_layout.h"

namespace rotordrop {

/// All that time integration sees of a machine: dy/dt = f(t, y).
class OdeSystem {
 public:
  OdeSystem() = default;
  OdeSystem(const OdeSystem&) = delete;
  OdeSystem& operator=(const OdeSystem&) = delete;
  virtual ~OdeSystem() = default;

  [[nodiscard]] virtual const StateLayout& layout() const = 0;
  /// @param y [layout().size()]
  virtual void initial_state(std::span<double> y) const = 0;
  /// @param t [s]; @param y, dydt [layout().size()]
  virtual void rhs(double t, std::span<const double> y, std::span<double> dydt) const = 0;
  /// Entries [from, size) are quadratures: nothing depends on them, so they need no error control.
  [[nodiscard]] virtual std::size_t first_quadrature() const { return layout().size(); }
  /// Pairs of entries that would oscillate freely without the rest: methods may integrate that exactly.
  [[nodiscard]] virtual std::vector<Oscillator> oscillators() const { return {}; }
  /// Known times at which the rates jump or bend [s], in any order (model/instants.h): steps end there. At such a time itself rhs() gives the rates after
  /// it; those before it are asked for just before it.
  [[nodiscard]] virtual std::vector<double> instants() const { return {}; }
};

}  // namespace rotordrop
