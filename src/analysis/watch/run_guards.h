#pragma once
#include <deque>
#include <string>
#include <vector>

#include "analysis/drop_scalars.h"
#include "analysis/watch/exceedance.h"
#include "integrate/integration_parameters.h"
#include "machine/heat/finite_elements.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"
#include "model/observer.h"
#include "model/run_warning.h"

namespace rotordrop {

/// Watches whether results leave the range for which models and numerics are good: at every observed step and every row, never in between.
/// A warning that the case declares fatal ends the run as a SolverError.
class RunGuards final : public Observer {
 public:
  RunGuards(const Machine& machine, const MachineParameters& parameters, const IntegrationParameters& integration);

  /// Rows of step and state observables.
  [[nodiscard]] RowSink& rows() { return rows_; }
  /// Rows of sections that run in windows. @param observables  of such a row
  [[nodiscard]] RowSink& windows(const std::vector<Observable>& observables);

  /// @throws SolverError that names the first fatal warning
  void step(const Step& step) override;
  void pack(PackedValues& to) const override;
  void unpack(const PackedValues& from) override;

  /// What was found so far; a value of a kind for which the scalars know the peak between steps is that peak.
  [[nodiscard]] std::vector<RunWarning> found(const DropScalars& scalars) const;

 private:
  struct Guard {
    const WarningKind* kind = nullptr;
    std::string place, part;
    double limit = 0;
    bool is_fatal = false;
    double sign = 1;  ///< -1: values below the limit are beyond it
    Exceedance seen = {};
    [[nodiscard]] std::string name() const { return std::string("guards/") + kind->code + "/" + place + "/" + part; }
  };
  /// Which numbers of a row a guard looks at: the largest of them, or the length of the vector that they are.
  struct Look {
    std::size_t guard = 0, first = 0, size = 1;
    bool is_vector = false;
  };
  class Rows final : public RowSink {
   public:
    explicit Rows(RunGuards& guards) : guards_(guards) {}
    void row(double time, std::span<const double> values) override;
    std::vector<Look> looks;
    /// What is not accounted for, and the energies of which it is a part.
    struct Balance {
      std::size_t guard = 0, residual = 0;
      std::vector<std::size_t> moved;
    };
    std::vector<Balance> balances;
    /// Heat of a support into a thermal model, part of what it dissipated; both since the start.
    struct Port {
      std::size_t guard = 0, heat = 0, dissipated = 0;
    };
    std::vector<Port> ports;

   private:
    RunGuards& guards_;
  };

  std::size_t add(const char* code, const std::string& place, const std::string& part, double limit, double sign = 1);
  void look_at_bearings(const Machine& machine, const MachineParameters& parameters);
  void look_at_supports_and_probes(const Machine& machine, const MachineParameters& parameters);
  void look_at_temperatures(const std::vector<Observable>& observables, std::size_t first, Rows& rows);
  void look_at_balances(const Machine& machine, std::size_t first);
  void look_at_heat_ports(const Machine& machine, std::size_t first);
  void follow(std::size_t guard, double time, double value);
  void follow(std::span<const Look> looks, double time, std::span<const double> values);

  const MachineParameters& parameters_;
  std::vector<Guard> guards_;
  std::vector<Look> steps_;
  Rows rows_;
  std::deque<Rows> windows_;
  std::size_t step_guard_ = 0;
  double shortest_step_ = 0, least_energy_ = 0;
  double n_steps_ = 0;
};

/// What is found when a run is over: balls that skid or pivot, windows, reduced models.
struct EndedRun {
  const MachineParameters& parameters;
  const Machine& machine;
  const DropScalars& scalars;
  double end_time = 0;    ///< [s]
  bool is_whole = false;  ///< not interrupted
  const WindowedSections::Report* windows = nullptr;
  HeatEnergy windows_energy;
  const FiniteElements* elements = nullptr;
};
[[nodiscard]] std::vector<RunWarning> warnings_at_end(const EndedRun& run);

}  // namespace rotordrop
