#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/drop_loop.h"
#include "analysis/drop_scalars.h"
#include "analysis/output_parameters.h"
#include "analysis/section_coupling.h"
#include "analysis/series_rows.h"
#include "analysis/watch/ball_fatigue.h"
#include "analysis/watch/contact_impulse.h"
#include "analysis/watch/fit_watch.h"
#include "analysis/watch/kelvin_check.h"
#include "analysis/watch/run_guards.h"

namespace rotordrop {

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
  std::optional<GrowthHistory> growth_in_force;      ///< of a machine that takes it from windows
  std::vector<std::optional<FatigueShare>> fatigue;  ///< of each touchdown bearing; none without a rating
  std::vector<RunWarning> warnings;                  ///< what was found beyond its limit
};

/// A drop in memory: the loop, and the observers that every drop has. Files and screens join them as sinks of rows and further observers.
class Drop {
 public:
  /// @param parameters  must outlive the drop
  /// @param elements  those that the machine was built with, if any
  /// @param tell      called with what a user should know
  Drop(const Machine& machine, const MachineParameters& parameters, const IntegrationParameters& integration,
       const OutputParameters& output, FiniteElements* elements = nullptr, const FitWatch::Tell& tell = {});

  /// Rows of step and state observables, of the detailed ones, and of the sections' windows, if they run in windows.
  [[nodiscard]] SeriesRows& rows() { return rows_; }
  [[nodiscard]] DetailRows& detail_rows() { return detail_rows_; }
  [[nodiscard]] SectionCoupling& sections() { return *sections_; }
  [[nodiscard]] DropScalars& scalars() { return scalars_; }
  [[nodiscard]] const DropScalars& scalars() const { return scalars_; }
  [[nodiscard]] DropLoop& loop() { return loop_; }
  [[nodiscard]] const DropLoop& loop() const { return loop_; }

  /// To the end, or until it is stopped.
  void run(const std::function<bool()>& is_stopped = {});
  /// After a loop that was run to its end by somebody else (run_in_lanes()).
  void finish();
  /// So far; times of wall and processor are left to the caller.
  [[nodiscard]] DropResult result() const;

 private:
  std::unique_ptr<SectionCoupling> sections_;
  SeriesRows rows_;
  DetailRows detail_rows_;
  DropScalars scalars_;
  BallFatigue fatigue_;
  std::unique_ptr<ContactImpulse> impulse_;
  KelvinCheck kelvin_;
  RunGuards guards_;
  FitWatch closed_fits_, followed_fits_;
  DropLoop loop_;
  const Machine& machine_;
  const MachineParameters& parameters_;
  const FiniteElements* elements_;
  bool is_complete_ = false;
};

}  // namespace rotordrop
