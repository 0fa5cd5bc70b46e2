#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "machine/growth_history.h"
#include "machine/place_energy.h"
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
    ReducedHeat reduced;                                                ///< if it is
    double inner_capacity = 0, outer_capacity = 0, shaft_capacity = 0;  ///< outer: ring and housing [J/K]
  };
  std::vector<Section> sections;  ///< of each thermal place
  FeCoupling coupling = FeCoupling::reduced;
  bool drives = false;
  std::shared_ptr<GrowthHistory> growth;  ///< of a windowed coupling
};

/// Sections that advance beside the drop: each window takes the energy that its ports received in it, and hands on a growth that is
/// linear in time, from what is in force to what the next window is expected to end with. A window ends when the heat has left its
/// prediction by so much that the growth would be wrong by more than half the tolerance.
class WindowedSections {
 public:
  /// @param tolerance  error of a growth at a window's end [m]
  /// @param longest    window [s]; the shortest is a 32nd of it
  WindowedSections(FiniteElements& elements, double tolerance, double longest);

  /// Looks at the drop after every step; may bring the window's end forward.
  void watch(double now, std::span<const PlaceEnergy> energy);
  [[nodiscard]] double next_end() const { return time_ + static_cast<double>(units_) * unit_; }
  /// Advances to next_end().
  /// @param now     where the drop stands [s], >= next_end(), watched
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
  void advance_sections(double length);
  [[nodiscard]] std::vector<Expansion> present_growth() const;

  FiniteElements& elements_;
  double tolerance_, unit_;
  long longest_units_, units_;  ///< of the window under way
  double time_ = 0, last_error_ = 0, last_length_ = 0, film_loss_ = 0;
  std::vector<PlaceEnergy> energy_;        ///< at time_
  double watched_ = 0;                     ///< when the drop was last looked at
  std::vector<PlaceEnergy> seen_, power_;  ///< energy then; power [W] over the last step
  std::vector<PlaceEnergy> promised_;      ///< energy at promised_at_, from where the present growth was laid out
  std::vector<PlaceEnergy> promised_power_;
  double promised_at_ = 0;
  std::vector<std::array<double, n_bearing_ports>> port_heat_;  ///< [W]
  std::vector<Expansion> before_, now_;
  Report report_;
};

/// Fills in a section's capacities once it has its solver.
void complete(FiniteElements::Section& section);
/// Growth from the volume means of a section's field.
Expansion growth_of(const FiniteElements::Section& section);

}  // namespace rotordrop
