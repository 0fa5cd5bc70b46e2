#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "integrate/integration_parameters.h"
#include "model/ode_system.h"

namespace rotordrop {

/// What an integration has cost so far.
struct IntegrationStatistics {
  long steps = 0;
  long rhs_evaluations = 0;
  long rejected_steps = 0;
};

/// Advances one ODE system step by step; owns the state.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  [[nodiscard]] virtual double time() const = 0;
  /// State at time().
  [[nodiscard]] virtual std::span<const double> state() const = 0;
  /// One step, not beyond the end time given at construction, nor beyond an instant of the system: after that it begins anew. @throws SolverError naming the worst components
  virtual void advance() = 0;
  /// Tells the rates at time(), state() that the caller has evaluated anyway, so that the next step need not: after a change of the system the only ones
  /// that are right.
  virtual void offer_rates(std::span<const double> rates) = 0;
  /// Whether it makes use of them: then looking at the rates after every step costs nothing.
  [[nodiscard]] virtual bool uses_offered_rates() const = 0;
  /// Evaluation of a system at the end t of a step, with whatever else the caller wants to know of it; the rates are the system's, at one of its instants
  /// those just before it (Instants::before()).
  using EndEvaluation = std::function<void(double t, std::span<const double> y, std::span<double> dydt)>;
  /// Has the method evaluate ends of steps so, those that it rejects among them: then looking at every accepted step costs nothing.
  /// @returns whether it can; else nothing changes
  virtual bool evaluate_ends_with(const EndEvaluation&) { return false; }
  /// State at a time within the last step.
  virtual void interpolate(double t, std::span<double> y) const = 0;
  [[nodiscard]] virtual IntegrationStatistics statistics() const = 0;
};

/// @param start_time [s]; @param state [system.layout().size()]; @param end_time [s], > start_time
std::unique_ptr<Integrator> make_integrator(const OdeSystem& system, const IntegrationParameters& parameters,
                                            double start_time, std::span<const double> state, double end_time);

/// For few slow and stiff states: backward differences (CVODES) without a longest step.
/// @param tolerance  relative; absolute is this times each state's scale
std::unique_ptr<Integrator> make_stiff_integrator(const OdeSystem& system, double tolerance, double start_time,
                                                  std::span<const double> state, double end_time);

/// The `count` largest shares of a squared error norm, in words: ""TB1/inner ring y [m]" (84 %), ...".
std::string worst_components(const StateLayout& layout, std::span<const double> weighted_error, std::size_t count = 3);

}  // namespace rotordrop
