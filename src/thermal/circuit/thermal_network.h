#pragma once
#include <string>
#include <vector>

#include "model/thermal_model.h"
#include "thermal/circuit/circuit_flows.h"
#include "thermal/circuit/linear_flows.h"

namespace rotordrop {

/// A thermal network as data: named nodes, resistors between them, heat ports, and the growth that temperatures cause.
struct ThermalNetworkData {
  struct Node {
    std::string name;     ///< "TB1/inner_ring"
    double capacity = 0;  ///< [J/K]; 0: massless, eliminated
    std::string long_name;
  };
  using Law = ResistorLaw;
  struct Resistor {
    std::string between;  ///< node names; "ambient" is the surroundings
    std::string and_node;
    double resistance = 0;  ///< R [K/W]
    Law law = Law::constant;
    double area = 0;        ///< of housing_convection [m^2]
    double R_apart = 0;     ///< of contact [K/W]
    std::size_t place = 0;  ///< of contact
  };
  /// Where the heat of one place enters.
  struct Place {
    std::string shaft_node, ring_node;         ///< take the rub heat
    std::string inner_contact, outer_contact;  ///< take the bearing's internal heat
    std::string balls = {};                    ///< join both contacts by HeatInput::balls; empty: resistors do
    double ball_factor = 1;                    ///< calibration: multiplies their resistances
  };
  /// One linear term of a place's growth: coefficient times the rise of a node.
  struct Growth {
    std::size_t place = 0;
    double Expansion::*surface = nullptr;
    std::string node;
    double coefficient = 0;  ///< [m/K]
  };

  double ambient = 293.15;  ///< [K]
  std::vector<Node> nodes;
  std::vector<Resistor> resistors;
  std::vector<Place> places;
  std::vector<Growth> growths;
};

inline constexpr const char* ambient_node = "ambient";

/// Lumped thermal network. Massless nodes are eliminated when it is built (their resistors must be constant), so that heat flows between
/// pairs of nodes with capacity and what leaves one enters the other exactly. What rolling balls pass between contacts and their bulk is solved for at each
/// evaluation, since their conductances change. Growth sees a massless node's temperature without its own instantaneous heat, rolling balls' included: no
/// feedthrough.
class ThermalNetwork final : public ThermalModel {
 public:
  /// @throws std::invalid_argument for unknown node names, a massless node on a resistor that is not constant, or one without resistors,
  ///   contacts of rolling balls of two places that are joined by massless nodes alone
  explicit ThermalNetwork(ThermalNetworkData data);

  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  void initial_state(std::span<double> temperature) const override;
  void growth(std::span<const double> temperature, std::span<Expansion> out) const override;
  void growth_rates(std::span<const double> temperature_rate, std::span<Expansion> out) const override;
  double rates(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> dydt) const override;
  [[nodiscard]] std::vector<std::string> heat_ports() const override;  ///< nodes with capacity
  void add_heat(std::size_t port, double watts, std::span<double> dydt) const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  void observe(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> out) const override;
  [[nodiscard]] double stored_energy(std::span<const double> temperature) const override;
  [[nodiscard]] std::vector<std::size_t> ring_states() const override;

 private:
  template <class Real>
  friend class ThermalNetworkInLanes;  // thermal/circuit/thermal_network_in_lanes.h
  using Term = CircuitTerm<double>;
  struct Shown {  // a massless node: weights of temperatures [K/K] and of the ports' heats [K/W]
    double of_ambient = 0;
    std::vector<Term> of_temperature;
    std::vector<double> of_heat;  // [4 n_places]: ring, shaft, inner, outer
  };
  struct Reduced;
  void lay_conductances(const Reduced& reduced);
  void lay_law_links(const Reduced& reduced);
  void lay_ports(const Reduced& reduced);
  void lay_rolling_balls(const Reduced& reduced);
  void lay_growths(const Reduced& reduced);
  void lay_shown(const Reduced& reduced);
  /// Rate of a state per heat into it [K/J]; 1 of the surroundings, which sum up heat.
  [[nodiscard]] double rate_per_watt(std::size_t state) const;

  ThermalNetworkData data_;
  std::vector<std::size_t> with_capacity_;  // state index -> node index
  std::vector<double> inverse_capacity_;
  LinearFlows flows_;  // through constant resistors, and from ports
  std::vector<LawLink<double>> law_links_;
  std::vector<RollingBalls<double>> rolling_;
  std::vector<LinearGrowth> growths_;  // of each place
  std::vector<Shown> shown_;           // one per node
};

}  // namespace rotordrop
