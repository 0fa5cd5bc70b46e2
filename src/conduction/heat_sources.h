#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "model/heat_conduction.h"

namespace rotordrop {

/// What the fluxes and ports of a problem bring: fluxes [W/m2] by their tables, ports as they are told.
class HeatSources {
 public:
  /// @param problem  must outlive it; @param flux_areas, port_areas  [m2]
  HeatSources(const HeatConductionProblem& problem, std::vector<double> flux_areas, std::vector<double> port_areas);

  /// Fluxes keep, until the next call, the values that hold right after this time [s].
  void hold_fluxes_of(double time);
  /// Heat into each port [W] [n_ports] at a time [s], and its rate [W/s] [n_ports, or none], until the next call.
  void hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time);

  [[nodiscard]] double flux(std::size_t flux) const { return fluxes_[flux]; }  ///< [W/m2]
  [[nodiscard]] double watts(std::size_t port, double t) const {
    return ports_[port].held + ports_[port].rate * (t - held_since_);
  }
  [[nodiscard]] bool is_silent(std::size_t port) const { return ports_[port].held == 0. && ports_[port].rate == 0.; }
  [[nodiscard]] bool is_steady() const;        ///< no port's heat changes
  [[nodiscard]] double power(double t) const;  ///< of fluxes and ports [W], by their areas
  /// Rise of a half space [K] under the largest flux or port's heat after this time [s], as long as it has not felt the body's other side, or of a
  /// node under its port's heat: a scale.
  [[nodiscard]] double expected_rise(double duration) const;
  /// In words: the flux or port that cools a place, or else the one that cools most.
  /// @param flux_is_here, port_is_here  whether it reaches the place
  [[nodiscard]] std::string strongest_cooling(double t, const std::function<bool(std::size_t)>& flux_is_here,
                                              const std::function<bool(std::size_t)>& port_is_here) const;

 private:
  struct Port {
    double held = 0;  ///< at held_since_ [W]
    double rate = 0;  ///< [W/s]
  };
  const HeatConductionProblem* problem_;
  std::vector<double> flux_areas_, port_areas_;
  std::vector<double> fluxes_;  ///< [W/m2]
  std::vector<Port> ports_;
  double held_since_ = 0;  ///< of the ports' heat [s]
};

}  // namespace rotordrop
