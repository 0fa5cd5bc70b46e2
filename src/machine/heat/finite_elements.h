#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "machine/heat/growth_history.h"
#include "machine/heat/place_energy.h"
#include "model/heat_conduction.h"
#include "model/thermo_elasticity.h"
#include "thermal/circuit/adiabatic_rises.h"
#include "thermal/fe_parameters.h"
#include "thermal/heating/bearing_heat.h"
#include "thermal/section/bearing_elastic.h"

namespace rotordrop {

/// The finite-element room as a machine needs it, and what was made with it.
struct FiniteElements {
  // Given: the room's doors.
  std::function<std::unique_ptr<HeatConductionSolver>(const HeatConductionProblem&)> make_solver;
  std::function<std::unique_ptr<ElasticSolver>(const ElasticProblem&)> make_elastic_solver;
  std::function<SectionMesh(const std::string& bearing)> make_mesh;  ///< of the grooved section

  /// If the sections are heated without a machine: a mesh that is not reduced then has the housing's film (eq. 16, with the local rise).
  struct Alone {
    double time_tolerance = 1e-6;  ///< of such a mesh
  };
  std::optional<Alone> alone;
  /// If they are reduced whatever the case's coupling, as preload and calibration need them.
  bool always_reduced = false;
  /// Error of the responses that modes aim at; what they reach is judged by thermal.fe.response_tolerance. 0: that too.
  double aimed_response = 0;

  // Made by build_machine() or build_thermal_models().
  struct Section {
    std::string name;  ///< of the bearing
    HeatConductionProblem problem;
    std::unique_ptr<HeatConductionSolver> solver;
    std::vector<RacewayRowPorts> row_ports;         ///< where rows are heated apart
    GrowthPerRise formula;                          ///< per rise of the bodies' means
    AdiabaticSection adiabatic;                     ///< what heat causes at once
    ReducedHeat reduced;                            ///< if it is
    std::unique_ptr<ElasticSolver> elastic_solver;  ///< where growth is judged, or comes, by elasticity
    std::optional<ElasticGrowth> elastic;
    bool grows_elastically = false;                     ///< or else elasticity only judges the formula
    std::vector<ElasticGrowth::RowWeights> row_growth;  ///< with elasticity, if the section has strips of every row
  };
  std::vector<Section> sections;  ///< of each thermal place
  FeCoupling coupling = FeCoupling::reduced;
};

/// Sections that advance beside one drop, whose solvers they take to the start. The growth of a section is what its heat causes at once (AdiabaticRises, in the state vector)
/// and what conduction adds. Each window takes the energy that its ports received in it, and hands on how conduction's part changes: linear in
/// time, from what is in force to what the next window is expected to end with. Windows become shorter where that was wrong by more
/// than the tolerance, and while a rub heats a bore fast.
class WindowedSections {
 public:
  /// @param tolerance  error of a growth at a window's end [m]
  /// @param longest    window [s]; the shortest is a 64th of it
  WindowedSections(FiniteElements& elements, double tolerance, double longest);

  [[nodiscard]] double next_end() const { return time_ + length_; }
  /// Ends the window under way soon after `now` if the rub has heated a bore fast in it, so that what is recorded at windows' ends shows impacts. To be called
  /// after every step of the drop.
  /// @param energy  at `now` [n_places]
  void look(double now, std::span<const PlaceEnergy> energy);
  /// Advances to next_end().
  /// @param now     where the drop stands [s], >= next_end()
  /// @param energy  at next_end() [n_places]
  /// @param balls   what balls conduct as they roll at next_end(); held over the window, as are the temperatures between which they conduct [n_places]
  void advance(double now, std::span<const PlaceEnergy> energy, std::span<const PlaceConduction> balls);
  /// What conduction adds to the immediate growth, as it is in force.
  [[nodiscard]] const GrowthHistory& growth_in_force() const { return in_force_; }
  /// Advances to the drop's end.
  void finish(double end, std::span<const PlaceEnergy> energy, std::span<const PlaceConduction> balls);

  struct Report {
    long windows = 0;
    double shortest = 0, longest = 0, mean = 0;  ///< [s]
    double largest_error = 0;                    ///< of the growth at windows' ends [m]
    double largest_error_time = 0;               ///< [s]
    double tolerance = 0;                        ///< of that error [m]
    long beyond_tolerance = 0;                   ///< windows with a larger error
    double largest_growth = 0;                   ///< [m]
    double cpu_time = 0;                         ///< [s]
  };
  [[nodiscard]] Report report() const;
  /// Input, storage and loss of all sections.
  [[nodiscard]] HeatEnergy energy() const;

  /// Channels in every row of the windows' series, and their values.
  [[nodiscard]] std::vector<Observable> observables() const;
  void observe(std::span<double> out) const;

  [[nodiscard]] std::vector<double> packed() const;  ///< for checkpoints
  void unpack(std::span<const double> values);

 private:
  void step(double length, std::span<const PlaceEnergy> energy, std::span<const PlaceConduction> balls);
  /// Advances a section to the end of a window under its ports' heat, in steps of few lengths.
  void advance_section(HeatConductionSolver& solver, double length) const;
  /// Heat of friction and of rolling balls into the raceways and the balls.
  void heat_raceways(std::size_t place, double length, const PlaceEnergy& given, const PlaceConduction& balls);

  FiniteElements& elements_;
  double tolerance_, shortest_, longest_;
  double length_;  ///< of the window under way [s]: the longest, halved a few times, or what is left of it after a cut
  double time_ = 0, last_error_ = 0, last_length_ = 0, film_loss_ = 0;
  bool is_cut_ = false;                         ///< the window under way ends before its time
  std::vector<double> rise_per_joule_;          ///< of a bore in a half space, times root of time [K s^0.5/J]
  std::vector<double> largest_rise_;            ///< mean of each bore at windows' ends, so far [K]
  std::vector<PlaceEnergy> energy_;             ///< at time_
  std::vector<std::vector<double>> port_heat_;  ///< of all ports [W]
  std::vector<Expansion> growth_;               ///< at time_
  std::vector<Expansion> before_, conducted_;   ///< conduction's part a window ago, and at time_
  GrowthHistory in_force_;
  Report report_;
};

/// Capacities and growth of a section, once it has its solver and formulas.
AdiabaticSection adiabatic_section(const FiniteElements::Section& section);
/// Growth by elasticity right after heat, over the rises without conduction.
GrowthPerRise immediate_elastic_growth(FiniteElements::Section& section);
/// Growth from a section's field: of its volume means, or by elasticity.
Expansion growth_of(FiniteElements::Section& section);

}  // namespace rotordrop
