#pragma once
#include <optional>

#include "model/reduced_heat.h"
#include "model/thermal_model.h"
#include "thermal/heating/bearing_heat.h"
#include "thermal/heating/rolling_exchange.h"
#include "thermal/section/bearing_elastic.h"

namespace rotordrop {

/// A bearing's section on a few modes, and what its mesh does not know.
struct ReducedSection {
  std::string name;  ///< of the bearing
  ReducedHeat heat;  ///< of bearing_heat_problem()
  GrowthPerRise growth;
  struct ContactLink {
    double touching = 0, apart = 0;  ///< resistance between shaft and bore [K/W]
  };
  std::optional<ContactLink> contact_link;  ///< if it is not permanent
  bool balls_roll = false;                  ///< HeatInput::balls join strips and balls
  std::vector<RacewayRowPorts> rows = {};   ///< where HeatInput::rows heat each row's strips
  /// A linear functional of the states: value = at_rest + shape . (z - T_0).
  struct Functional {
    double at_rest = 0;
    std::vector<double> shape;  ///< [n_modes]
  };
  /// By elasticity, projected on the modes.
  struct Elastic {
    std::array<std::vector<double>, growth_surfaces.size()> growth;  ///< shapes of growth_surfaces
    Functional mean_pressure;                                        ///< of the fit in the housing [Pa]
    std::vector<Functional> node_pressure;                           ///< of its nodes
    std::vector<double> node_share;                                  ///< of its area
    std::vector<std::vector<double>> rows;                           ///< shapes: radial and axial of each row, if known
    bool drives = true;                                              ///< instead of `growth`; else it only judges that
  };
  std::optional<Elastic> elastic;
};

/// The finite-element model of every touchdown bearing in reduced coordinates: part of the state vector, at about the cost of the circuit.
class ReducedSections final : public ThermalModel {
 public:
  ReducedSections(std::vector<ReducedSection> sections, double ambient);

  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  void initial_state(std::span<double> state) const override;
  void growth(std::span<const double> state, std::span<Expansion> out) const override;
  void growth_rates(std::span<const double> rate, std::span<Expansion> out) const override;
  double rates(std::span<const double> state, std::span<const HeatInput> heat, std::span<double> dydt) const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  void observe(std::span<const double> state, std::span<const HeatInput> heat, std::span<double> out) const override;
  [[nodiscard]] double stored_energy(std::span<const double> state) const override;

 private:
  struct Place {
    std::size_t first = 0, n = 0;  ///< of its states
    /// Rows of n numbers: rate, the ports' inputs [K/(s W)], mean shapes.
    std::vector<double> rate, bore_input, shaft_input, inner_input, outer_input, film_input;
    std::vector<double> bore, shaft_surface, film, loss;
    std::vector<double> stored;
    /// Of balls that roll: mean shapes of strips and balls, input of the balls; rises of strips at once [K/W].
    std::vector<double> inner_strip, outer_strip, balls, ball_input;
    double inner_at_once = 0, outer_at_once = 0;
    /// Of rows heated apart: inputs and mean shapes of their strips.
    struct Row {
      std::vector<double> inner_input, outer_input, inner_strip, outer_strip;
      double inner_at_once = 0, outer_at_once = 0;
      double inner_share = 0, outer_share = 0;  ///< of the raceways' area
      double inner_lost = 0, outer_lost = 0;    ///< parts of their heat that the modes left out lose at once
    };
    std::vector<Row> rows;
    std::array<std::vector<double>, growth_surfaces.size()> growth;  ///< of growth_surfaces [m/K]
    bool has_widths = false;                                         ///< the axial growths are not zero
    double film_area = 0;
    /// Parts of the ports' heat that the modes left out lose to the surroundings at once: a meshed shaft's surface, a few 1e-6.
    struct AtOnce {
      double bore = 0, shaft = 0, inner = 0, outer = 0, film = 0, balls = 0;
    } lost;
    struct Surface {
      std::vector<double> by_mode;  ///< rises of its points, mode after mode [n * n_points]
      std::vector<double> at_once;  ///< [n_points]
    };
    std::vector<Surface> surfaces;           ///< of the ports that are observed
    std::vector<std::size_t> surface_ports;  ///< which they are
  };
  [[nodiscard]] ContactHeat rolling_heat(const Place& place, const double* states, const HeatInput& heat) const;
  [[nodiscard]] ContactHeat rolling_heat(const Place& place, const Place::Row& row, const double* states,
                                         const RowHeat& heat) const;
  /// Heat of rows by themselves into the modes; what is lost at once [W].
  double heat_rows(std::size_t k, const double* states, const HeatInput& heat, double* dydt) const;
  double* observe_surfaces(std::size_t k, const double* states, const HeatInput& heat, double* out,
                           std::vector<double>& rises) const;
  void add_growth(std::size_t k, std::span<const double> values, double zero, Expansion& out) const;

  std::vector<ReducedSection> sections_;
  std::vector<Place> places_;
  double ambient_;
  std::size_t most_points_ = 0;  ///< of a surface
};

}  // namespace rotordrop
