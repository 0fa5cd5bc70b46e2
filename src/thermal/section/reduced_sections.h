#pragma once
#include <optional>

#include "model/reduced_heat.h"
#include "model/thermal_model.h"
#include "thermal/heating/bearing_heat.h"
#include "thermal/heating/rolling_exchange.h"
#include "thermal/section/bearing_elastic.h"
#include "thermal/section/modal_sums.h"

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

/// The finite-element model of every touchdown bearing in reduced coordinates: part of the state vector, at about the cost of the circuit, or a follower of the drop's steps.
class ReducedSections final : public ThermalModel {
 public:
  ReducedSections(std::vector<ReducedSection> sections, double ambient);

  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  void initial_state(std::span<double> state) const override;
  void growth(std::span<const double> state, std::span<Expansion> out) const override;
  void growth_rates(std::span<const double> rate, std::span<Expansion> out) const override;
  double rates(std::span<const double> state, std::span<const HeatInput> heat, std::span<double> dydt) const override;
  [[nodiscard]] bool can_follow() const override { return true; }
  double advance(double step, std::span<const double> from, std::span<const HeatInput> heat,
                 std::span<double> to) const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  void observe(std::span<const double> state, std::span<const HeatInput> heat, std::span<double> out) const override;
  void observe_tile(std::span<const double> state, std::span<const HeatInput> heat,
                    std::span<double> out) const override;
  [[nodiscard]] double stored_energy(std::span<const double> state) const override;

 private:
  /// A value for each heated port: those of bearing_heat, then each row's inner and outer strip.
  using HeatedPorts = std::array<double, 64>;
  struct Place {
    std::size_t first = 0, n = 0;  ///< of its states
    ModalRates modes;              ///< inputs: the heated ports'
    ModalShapes means;             ///< the heated ports' rises, and the linear loss
    std::size_t loss = 0;          ///< its place among them
    AlignedNumbers loss_shape;     ///< the same by itself, filled up
    /// Parts of the ports' heat that the modes left out lose to the surroundings at once: a meshed shaft's surface, a few 1e-6.
    std::vector<double> lost_at_once;
    std::vector<double> at_once;  ///< rises of the heated ports at once [K/W]
    /// Of rows heated apart: parts of the raceways' area.
    struct Row {
      double inner_share = 0, outer_share = 0;
    };
    std::vector<Row> rows;
    double film_area = 0;
    ModalShapes growth;                       ///< of growth_surfaces [m/K]
    bool has_widths = false;                  ///< the axial growths are not zero
    ModalShapes stored;                       ///< one: heat of all bodies and nodes
    ModalShapes observed;                     ///< in the order of observe()
    std::vector<SurfacePoints> surfaces;      ///< of the ports that are observed
    std::vector<std::size_t> surface_inputs;  ///< which of the heated ports they are
  };
  /// Heats into the heated ports of a section, and their rises by conduction. @returns what is lost besides by the modes: by the housing's film, and at once [W]
  double port_heats(std::size_t k, const double* states, const HeatInput& heat, HeatedPorts& rises,
                    HeatedPorts& watts) const;
  /// Heat of friction and of rolling balls into the raceways, or their rows, and out of the balls.
  /// @param rises  of the heated ports by conduction
  void heat_raceways(std::size_t k, const double* rises, const HeatInput& heat, HeatedPorts& watts) const;
  /// Heats into the observed surfaces. @param rises  of the heated ports by conduction
  void surface_heats(std::size_t k, const double* rises, const HeatInput& heat, HeatedPorts& watts) const;
  /// @param ranges  of each observed port
  /// @param out     [3] of each; its mean by conduction is there already
  void put_surfaces(std::size_t k, const HeatedPorts& watts, const RiseRange* ranges, double* out) const;
  /// All that is observed of a section. @param sums  of its observed shapes @returns behind it
  double* put_observed(std::size_t k, const double* sums, const HeatedPorts& watts, const RiseRange* ranges,
                       double* out) const;
  void add_growth(std::size_t k, std::span<const double> values, double zero, Expansion& out) const;

  std::vector<ReducedSection> sections_;
  std::vector<Place> places_;
  double ambient_;
};

}  // namespace rotordrop
