#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/assembled_heat.h"

namespace rotordrop {

/// What a matrix knows of conductivities over temperature: their values alone, which leaves it symmetric, or their slopes, too.
enum class HeatMatrix { symmetric, exact };

/// Solves with one matrix after another, of one pattern.
class HeatInverse {
 public:
  HeatInverse() = default;
  HeatInverse(const HeatInverse&) = delete;
  HeatInverse& operator=(const HeatInverse&) = delete;
  virtual ~HeatInverse() = default;

  /// Takes d(enthalpy)/dT - scaled_step dF/dT at T, rows and columns of held unknowns but for their diagonal left out.
  /// @throws SolverError if it is singular
  virtual void set_matrix(const Eigen::VectorXd& T, double scaled_step, HeatMatrix kind) = 0;
  /// v becomes the solution. @throws SolverError
  virtual void solve(Eigen::VectorXd& v) = 0;
};

/// Heat conduction once space is unknowns: d enthalpy(T)/dt = F(T, t), by which HeatStepper steps. Vectors have an entry per unknown.
class HeatEquations {
 public:
  using Vector = Eigen::VectorXd;
  HeatEquations() = default;
  HeatEquations(const HeatEquations&) = delete;
  HeatEquations& operator=(const HeatEquations&) = delete;
  virtual ~HeatEquations() = default;

  [[nodiscard]] virtual Vector initial_temperature() const = 0;  ///< [K]
  /// Whether there is one Jacobian for all temperatures.
  [[nodiscard]] virtual bool is_linear() const = 0;
  /// Whether the exact matrix is symmetric: no conductivity depends on temperature.
  [[nodiscard]] virtual bool is_symmetric() const = 0;
  [[nodiscard]] virtual const std::vector<HeldUnknowns>& held() const = 0;

  /// Fluxes keep, until the next call, the values that hold right after this time [s].
  virtual void hold_fluxes_of(double time) = 0;
  /// Heat into each port [W] [n_ports] at a time [s], and its rate [W/s] [n_ports, or none], until the next call.
  virtual void hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time) = 0;

  /// Whether F does not depend on time between such calls.
  [[nodiscard]] virtual bool is_steady() const = 0;

  virtual void enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const = 0;  ///< [J]
  virtual void heat_flow(const Vector& T, double t, Vector& out) const = 0;                          ///< F [W]
  [[nodiscard]] virtual std::unique_ptr<HeatInverse> make_inverse() const = 0;

  [[nodiscard]] virtual double input_power(double t) const = 0;                                   ///< [W]
  [[nodiscard]] virtual double lost_power(const Vector& T) const = 0;                             ///< [W]
  [[nodiscard]] virtual double stored_energy(const Vector& T, const Vector& T_before) const = 0;  ///< [J]

  /// Largest rise [K] that fluxes and ports as they are held can be expected to give in this time [s]: a scale.
  [[nodiscard]] virtual double expected_rise(double duration) const = 0;
  [[nodiscard]] virtual double shortest_time() const = 0;  ///< [s] in which heat crosses the thinnest cell
  /// "body "ring"", and what cools an unknown most, in a sentence.
  [[nodiscard]] virtual std::string part_of(std::size_t unknown) const = 0;
  [[nodiscard]] virtual std::string strongest_cooling(std::size_t unknown, double t) const = 0;
};

}  // namespace rotordrop
