#pragma once
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "integrate/integrator.h"
#include "machine/finite_elements.h"
#include "machine/machine.h"
#include "study/case.h"
#include "study/drop_scalars.h"

namespace rotordrop {

/// Where a run stands; for the moving line.
struct Progress {
  double time = 0, end_time = 0;      ///< [s]
  double wall_time = 0;               ///< since the start of this program's part of the run [s]
  double wall_time_left = 0;          ///< estimate [s]
  double rotor_speed = 0;             ///< [rad/s]
  double largest_contact_force = 0;   ///< so far [N]
  double inner_ring_temperature = 0;  ///< the warmest inner ring [K]; NaN if there is none
};

struct RunOptions {
  std::filesystem::path directory;
  bool force = false;                                ///< replace results that are there
  bool resume = false;                               ///< go on from the newest checkpoint there
  const volatile std::sig_atomic_t* stop = nullptr;  ///< nonzero: end after the current step, as if interrupted
  FiniteElements* elements = nullptr;                ///< those that the machine was built with, if any
  std::function<void(const Progress&)> report;       ///< called a few times a second
  std::function<void(const std::string&)> tell;      ///< called with what a user should know
};

/// A finished or interrupted drop.
struct DropResult {
  bool completed = false;
  bool condition_met = false;  ///< that of run.until, before its latest end
  double end_time = 0;         ///< reached [s]
  double wall_time = 0,
         cpu_time = 0;               ///< of the time integration, results included, over all parts of a resumed run [s]
  IntegrationStatistics statistics;  ///< likewise
  std::vector<double> state;
  std::vector<double> impulse_before_end;           ///< of each touchdown bearing at averaging_start [N s]
  double averaging_start = 0;                       ///< [s]
  std::optional<WindowedSections::Report> windows;  ///< of a windowed coupling
  HeatEnergy windows_energy;
  std::optional<GrowthHistory> growth_in_force;  ///< of a machine that takes it from windows
};

/// Length of the means that summaries call "_end" [s].
inline constexpr double averaging_time = 0.05;

/// Runs a case into a directory: results.h5, parameters.toml, checkpoints and summary.json.
/// @throws InputError if the directory holds results and neither force nor resume is set
/// @throws SolverError if the integration fails; the last good state is saved as a checkpoint in DIRECTORY/failed
DropResult run_drop(const Case& drop_case, const Machine& machine, const RunOptions& options);

}  // namespace rotordrop
