#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "machine/machine.h"

namespace rotordrop {

/// Thermal models of a machine that follow the integration of the rest, in steps of their own: some of its steps are one of theirs, under the energy that
/// the ledgers gained in it, as even power. Their states at any time since are found when they are asked for.
class Followers {
 public:
  /// Their step begins at zero, where the machine starts, until begin() says otherwise.
  explicit Followers(const Machine& machine);
  [[nodiscard]] bool empty() const { return models_.empty(); }

  /// Puts the beginning of their next step somewhere. Ways for heat through balls and contacts, as they are there, stay through it.
  /// @param y      [layout().size()]
  /// @param found  by an evaluation of it
  void begin(double t, std::span<const double> y, const Evaluation& found);
  /// After a step of the integration: ends theirs there too, if it would be too long with another one like it.
  /// @param y      [layout().size()]; its integrated part stands at t, the rest may be filled in
  /// @param found  by an evaluation of it
  void follow(double start, double t, std::span<double> y, const Evaluation& found);
  /// @param t  since the beginning of their step [s]
  /// @param y  [layout().size()]; its integrated part stands at t, the rest is filled in
  void fill(double t, std::span<double> y) const;

  /// Where their step has begun.
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::span<const double> state() const { return state_; }

 private:
  const Machine& machine_;
  std::vector<std::size_t> models_;
  double longest_step_ = 0, time_ = 0;
  std::vector<double> state_;
  mutable std::vector<HeatInput> heats_;  // of the thermal places; their powers are those of the last fill()
};

}  // namespace rotordrop
