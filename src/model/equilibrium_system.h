#pragma once
#include <cstddef>
#include <span>

namespace rotordrop {

/// A mechanical system whose static equilibrium is sought: unknown positions, the forces on them, and the derivative of these.
class EquilibriumSystem {
 public:
  EquilibriumSystem() = default;
  EquilibriumSystem(const EquilibriumSystem&) = delete;
  EquilibriumSystem& operator=(const EquilibriumSystem&) = delete;
  virtual ~EquilibriumSystem() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Lengths (or angles) by which the unknowns typically move [size]; they make the unknowns comparable. The first is a length.
  [[nodiscard]] virtual std::span<const double> scales() const = 0;
  /// Size of the forces [N]: a residual is told as a part of it.
  [[nodiscard]] virtual double force_scale() const = 0;
  /// Forces conjugate to the unknowns [size]; zero in equilibrium.
  virtual void forces(std::span<const double> x, std::span<double> f) const = 0;
  /// -d forces / dx [size x size], column by column.
  virtual void stiffness(std::span<const double> x, std::span<double> K) const = 0;
  /// Potential whose negative gradient the forces are while circulatory forces are switched off [J]. Must be convex.
  [[nodiscard]] virtual double potential(std::span<const double> x) const = 0;
  /// Whether there are forces that follow no potential (inertia of balls).
  [[nodiscard]] virtual bool has_circulatory_forces() const { return false; }
  /// Which part of those acts, 0 to 1: the solver raises it if it cannot find the equilibrium at once.
  virtual void set_circulatory_share(double) {}
};

}  // namespace rotordrop
