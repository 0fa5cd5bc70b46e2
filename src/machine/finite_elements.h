#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "machine/growth_history.h"
#include "model/heat_conduction.h"
#include "thermal/bearing_heat.h"
#include "thermal/fe_parameters.h"

namespace rotordrop {

/// The finite-element room as a machine needs it, and what was made with it.
struct FiniteElements {
  // Given: the room's doors.
  std::function<std::unique_ptr<HeatConductionSolver>(const HeatConductionProblem&)> make_solver;
  std::function<SectionMesh(const std::string& bearing)> make_mesh;  ///< of the grooved section

  // Made by build_machine().
  struct Section {
    std::string name;  ///< of the bearing
    HeatConductionProblem problem;
    std::unique_ptr<HeatConductionSolver> solver;
    SectionGrowth growth;
    ReducedHeat reduced;  ///< if it is
  };
  std::vector<Section> sections;  ///< of each thermal place
  FeCoupling coupling = FeCoupling::reduced;
  bool drives = false;
  std::shared_ptr<GrowthHistory> growth;  ///< of a windowed coupling
};

/// Energy that has entered a thermal place since the start [J].
struct PlaceEnergy {
  double rub = 0, rub_into_ring = 0, inner = 0, outer = 0;
};

/// Sections that advance beside the drop: each window takes the energy that its ports received in it, and hands on a growth that is
/// linear in time, from what is in force to what the next window is expected to end with.
class WindowedSections {
 public:
  /// @param tolerance  error of the growth at a window's end over the largest growth so far
  /// @param longest    window [s]
  WindowedSections(FiniteElements& elements, double tolerance, double longest);

  [[nodiscard]] double next_end() const { return time_ + window_; }
  /// Advances to next_end().
  /// @param now     where the drop stands [s], >= next_end()
  /// @param energy  at next_end() [n_places]
  void advance(double now, std::span<const PlaceEnergy> energy);
  /// Advances to the drop's end.
  void finish(double end, std::span<const PlaceEnergy> energy);

  struct Report {
    long windows = 0;
    double shortest = 0, longest = 0, mean = 0;  ///< [s]
    double largest_error = 0;                    ///< of the growth at windows' ends [m]
    double largest_growth = 0;                   ///< [m]
    double cpu_time = 0;                         ///< [s]
  };
  [[nodiscard]] Report report() const;
  /// Input, storage and loss of all sections.
  [[nodiscard]] HeatEnergy energy() const;

  /// What stands in every row of the windows' series, and its values.
  [[nodiscard]] std::vector<Observable> observables() const;
  void observe(std::span<double> out) const;

  [[nodiscard]] std::vector<double> packed() const;  ///< for checkpoints
  void unpack(std::span<const double> values);

 private:
  void step(double length, std::span<const PlaceEnergy> energy);
  [[nodiscard]] std::vector<Expansion> present_growth() const;

  FiniteElements& elements_;
  double tolerance_, longest_;
  double time_ = 0, window_ = 0, last_error_ = 0;
  std::vector<PlaceEnergy> energy_;
  std::vector<Expansion> before_, now_;
  Report report_;
};

/// Growth from the volume means of a section's field.
Expansion growth_of(const FiniteElements::Section& section);

}  // namespace rotordrop
