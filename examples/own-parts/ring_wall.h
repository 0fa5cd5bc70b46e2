#pragma once
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "model/thermal_model.h"
#include "thermal/circuit/bearing_circuit.h"

/// [thermal.wall].
struct RingWallParameters {
  int shells = 0;  ///< of every ring
};
rotordrop::Section<RingWallParameters> ring_wall_section();

/// Third thermal model, between the lumped circuit and the finite elements: the wall of every inner ring as thin shells from bore to race, which
/// conduct radially, between two lumps, the shaft and everything outside (outer ring with housing).
///
///   ambient -R1- shaft -R2- shell 1 - ... - shell N -2 R5, R7- outside -convection- ambient
///
/// The rub heat enters shell 1 and the shaft, the heat of the inner race shell N, that of the outer race the outside. So it shows what a lump
/// cannot, how warm the bore gets while heat soaks in. Shells are thin at the bore, each 1.2 times as thick as the last: the first one, about a
/// hundredth of the wall, is heated through within 0.1 ms. The balls are resistances without capacity.
/// Growth: of a free ring with any radial temperature its bore and outside grow by alpha r times the mean rise over its area (plane stress).
/// All temperatures are means around the ring, and along it.
class RingWall final : public rotordrop::ThermalModel {
 public:
  /// @param bearings  in the order of the machine's thermal places
  /// @param ambient   [K], also of everything at the start
  RingWall(const std::vector<rotordrop::BearingCircuitData>& bearings, double ambient, std::size_t n_shells);

  [[nodiscard]] std::vector<rotordrop::StateEntry> state_entries() const override;
  void initial_state(std::span<double> temperature) const override;
  void growth(std::span<const double> temperature, std::span<rotordrop::Expansion> out) const override;
  void growth_rates(std::span<const double> temperature_rate, std::span<rotordrop::Expansion> out) const override;
  double rates(std::span<const double> temperature, std::span<const rotordrop::HeatInput> heat,
               std::span<double> dydt) const override;
  [[nodiscard]] std::vector<rotordrop::Observable> observables() const override;
  void observe(std::span<const double> temperature, std::span<const rotordrop::HeatInput> heat,
               std::span<double> out) const override;
  [[nodiscard]] double stored_energy(std::span<const double> temperature) const override;

 private:
  /// States of a bearing: shaft, shells from the bore outwards, outside.
  struct Bearing {
    std::string name;
    std::vector<double> capacity;                           // [n_states] [J/K]
    std::vector<double> conductance;                        // [n_states - 1] between neighbours [W/K]
    double to_ambient = 0;                                  // of the shaft [W/K]
    double housing_area = 0;                                // [m^2]
    double half_first_shell = 0;                            // bore to the middle of shell 1 [K/W]
    rotordrop::Expansion per_shaft, per_wall, per_outside;  // growth [m/K]
  };
  [[nodiscard]] rotordrop::Expansion growth_of(const Bearing& bearing, std::span<const double> T,
                                               double reference) const;

  std::vector<Bearing> bearings_;
  double ambient_;
  std::size_t n_shells_, n_states_;  // of a bearing
};
