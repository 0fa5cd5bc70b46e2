#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "conduction/heat_equations.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// Steps heat conduction in time: a six-stage ESDIRK method of order 4 (stage order 2, L-stable, its last stage is the new state), embedded order 3 for the
/// error. All implicit stages share one matrix, factorised again only when the step changes or, with temperature-dependent properties, when
/// Newton's iteration slows down.
class HeatStepper {
 public:
  using Vector = HeatEquations::Vector;
  /// @param equations  must outlive it
  HeatStepper(HeatEquations& equations, const HeatConductionProblem& problem);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Vector& temperatures() const { return T_; }
  [[nodiscard]] std::span<const double> field() const { return {T_.data(), static_cast<std::size_t>(T_.size())}; }
  [[nodiscard]] HeatEnergy energy() const { return {input_, equations_.stored_energy(T_, T_0_), lost_}; }
  /// Steps, factorisations and solves; sizes are the caller's.
  [[nodiscard]] const HeatStatistics& statistics() const { return statistics_; }

  /// Steps to exactly this time [s]. @throws SolverError
  void advance_to(double time);
  /// As of HeatConductionSolver.
  void ask_between_steps(std::function<void()> ask) { ask_ = std::move(ask); }
  /// Heat into each port [W] [n_ports] from now on, and its rate [W/s] [n_ports, or none].
  void set_port_heat(std::span<const double> watts, std::span<const double> rates);
  /// One implicit step of second order without error control; factorisations are kept by step length. @throws SolverError
  void advance_window(double step);
  /// A field of an earlier computation, with the energies that came in and were lost until then.
  void set_field(std::span<const double> temperatures, double time, double input, double lost);

 private:
  static constexpr std::size_t n_stages = 6;

  void integrate_to(double stop);
  void integrate_fixed(double stop);
  [[nodiscard]] double next_change() const;
  /// Computes the stages of a step; false if Newton's iteration fails.
  [[nodiscard]] bool compute_stages(double step);
  [[nodiscard]] bool solve_stage(std::size_t i, double step);
  void clear_held(Vector& residual) const;
  [[nodiscard]] double estimate_error(double step);  ///< [K], largest of all unknowns
  void accept(double step);
  /// @throws SolverError if a temperature is not above 0 K, with what cools there
  void require_above_zero(const Vector& T, double time) const;
  void jump_to_held_temperatures();
  void book(double joules_through_boundary);
  /// Heat that held boundaries took up or gave off while the field went from `before` to `after`.
  /// @param flow_joules  integral of the heat flow over the step, by the method's weights [J]
  void book_held_boundaries(const Vector& before, const Vector& after, const Vector& flow_joules);
  void factorise(double step, const Vector& T);
  /// Whether Newton's iteration should have another matrix: its changes shrink by no more than this.
  [[nodiscard]] bool is_slow(double rate) const { return rate > (kind_ == HeatMatrix::exact ? 0.3 : 0.1); }
  /// Prepares for it. @return false if there is no better one. @param is_fresh  the present one was made in this iteration
  [[nodiscard]] bool has_better_matrix(double rate, bool is_fresh);
  void advance_parts_of_window(double step, int most_parts);
  [[nodiscard]] bool step_window(double step);
  /// difference_ is the enthalpy of T on entry over that at the window's start. @param flow  of T on entry
  /// @return false if Newton's iteration fails
  [[nodiscard]] bool solve_window_stage(double step, double t, Vector& T, Vector& flow);

  HeatEquations& equations_;
  const HeatNumerics numerics_;
  std::function<void()> ask_;
  std::vector<double> changes_;  ///< times at which a flux changes, rising
  double smallest_scale_ = 0;    ///< [K]
  double time_ = 0, step_ = 0;   ///< step_: wanted next
  bool must_restart_ = true;     ///< an input has changed
  double input_ = 0, lost_ = 0;  ///< [J]
  double scale_ = 0;             ///< [K] of errors, in this step
  Vector T_, T_0_;
  std::array<Vector, n_stages> stage_, flow_;
  Vector known_, residual_, difference_;
  std::unique_ptr<HeatInverse> inverse_;
  double factorised_step_ = 0;
  HeatMatrix kind_;        ///< of matrices: exact once slopes of conductivities turn out to matter
  bool is_stale_ = false;  ///< the matrix belongs to temperatures too far away
  HeatStatistics statistics_;
  std::map<double, std::unique_ptr<HeatInverse>> window_inverse_;  ///< by step
};

}  // namespace rotordrop
