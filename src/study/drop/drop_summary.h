#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/drop.h"
#include "analysis/facts/rotor_report.h"
#include "analysis/facts/shoulder_report.h"
#include "case/case.h"
#include "model/run_warning.h"
#include "study/drop/fe_summary.h"
#include "study/drop/probe_summary.h"
#include "study/drop/summary_parts.h"
#include "study/drop/support_summary.h"
#include "study/drop/whirl.h"
#include "study/rub/local_report.h"

namespace rotordrop {

/// Scalars of one touchdown bearing in a drop. NaN where something has not happened.
struct BearingSummary {
  std::string name;
  BearingScalars scalars;             ///< peaks and instants, followed at every step
  std::size_t n_rows = 0;             ///< of balls
  bool is_free = false;               ///< the inner ring takes axial loads from the rotor
  bool is_up_along_y = true;          ///< gravity across the axis is along -y
  bool is_inertial = false;           ///< the balls have inertia
  double friction_heat = 0;           ///< of rotor and ring [J]
  double inner_heat = 0;              ///< of balls and inner race [J]
  double outer_heat = 0;              ///< of balls and outer race [J]
  double mean_contact_force_end = 0;  ///< over the end of the run [N]
  /// Rises of a thermal model's temperatures over ambient, at the end [K].
  struct Rises {
    const ThermalKind* kind = nullptr;
    NamedValues values;
    [[nodiscard]] const double* find(const std::string& node) const;  ///< null if there is none
  };
  std::vector<Rises> rises;  ///< of models that mesh no section, in the order of thermal_kinds()
  /// The meshed section, and the thermal model that it belongs to.
  struct Section {
    const ThermalKind* kind = nullptr;
    FeSummary fe;
  };
  std::optional<Section> section;
  std::optional<LocalSummary> local;             ///< if it is told
  std::optional<ShoulderReport> shoulder;        ///< of a free ring with shoulders
  std::optional<WhirlSummary> whirl;             ///< if it is told
  std::optional<nlohmann::ordered_json> damage;  ///< damage_json()
  std::optional<SupportSummary> support;
  /// Rub heat derived from the spin-up alone, and what the integrated rub heat is more [J].
  struct SpinUp {
    double slip_energy = 0, residual = 0;
  };
  std::optional<SpinUp> spin_up;
};

/// Scalars of a drop, from which summary.json, the screen and studies are rendered. SI.
struct DropSummary {
  std::string case_name;
  std::string title, note;  ///< the user's; empty: none
  RotorReport rotor;
  std::vector<BearingSummary> bearings;
  std::vector<ProbeSummary> probes;
  double rotor_speed_end = 0;     ///< [rad/s]
  double tilt_end = 0;            ///< of the rotor's end that is tilted more [rad]
  double ambient = 0;             ///< [K]; 0: of a summary that does not tell it
  double mechanical_initial = 0;  ///< energy at the start [J]
  EnergyBalance energy;           ///< at the end; `heat` of `heat_models`
  bool has_windage = false;
  std::vector<const ThermalKind*>
      heat_models;                         ///< thermal models in the state vector; null of one that is not registered
  std::vector<std::string> heat_prefixes;  ///< before the names of their heat: "", "fe_"
  /// Of a windowed coupling.
  struct Windows {
    WindowedSections::Report report;
    HeatEnergy energy;
  };
  std::optional<Windows> windows;
  bool completed = false;
  double end_time = 0;                 ///< reached [s]
  std::string until;                   ///< condition of run.until; empty: none, or a time
  std::string ended_by;                ///< condition, "until", "end_time", "interruption"
  double wall_time = 0, cpu_time = 0;  ///< [s]
  IntegrationStatistics statistics;
  std::vector<Fault> input_warnings;
  std::vector<RunWarning> warnings;                      ///< of the run, and of what only its summary tells
  std::optional<nlohmann::ordered_json> limits;          ///< assessed(), of a case with limits
  std::optional<nlohmann::ordered_json> second_opinion;  ///< second_opinion(); null if it was interrupted
};

/// @param elements  of the machine, or null
/// @param recorded       series of the finite elements, of orbits and rubs
/// @param parts  that are told, and warned of
DropSummary summarise(const Case& drop_case, const Machine& machine, const DropScalars& scalars,
                      const DropResult& result, FiniteElements* elements, const RecordedDrop& recorded,
                      const SummaryParts& parts = {});

/// As in summary.json; docs/reference/results.md has every key.
nlohmann::ordered_json summary_json(const DropSummary& summary);

/// What summary_text() tells, from summary.json: models of modules that are not loaded are left out.
DropSummary recorded_summary(const nlohmann::ordered_json& summary);

/// The main results as a few lines for the terminal.
std::string summary_text(const DropSummary& summary);

}  // namespace rotordrop
