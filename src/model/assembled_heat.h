#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rotordrop {

/// A mean of temperatures: of a point over the unknowns of its cell, of a surface, of a body.
struct HeatMean {
  std::vector<unsigned int> unknowns;
  std::vector<double> weights;  ///< [as many], of sum 1

  /// @param T  of all unknowns [K]; @param T_0  [K], near them: differences cost no digits
  [[nodiscard]] double rise(std::span<const double> T, double T_0) const {
    double rise = 0.;
    for (std::size_t i = 0; i < unknowns.size(); ++i) rise += weights[i] * (T[unknowns[i]] - T_0);
    return rise;
  }
  [[nodiscard]] double of(std::span<const double> T, double T_0) const { return T_0 + rise(T, T_0); }
  [[nodiscard]] double lowest(std::span<const double> T) const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto i : unknowns) lowest = std::min(lowest, T[i]);
    return lowest;
  }
  [[nodiscard]] double highest(std::span<const double> T) const {
    double highest = -std::numeric_limits<double>::infinity();
    for (const auto i : unknowns) highest = std::max(highest, T[i]);
    return highest;
  }
};

/// Unknowns that are held at a temperature [K]: of a body or a boundary.
struct HeldUnknowns {
  std::vector<unsigned int> unknowns;
  double temperature = 0;
};

/// A linear problem of heat conduction in space, C dT/dt = loads - K (T - T_0) with T_0 its initial temperature, as plain data. Unknowns: those of the
/// mesh, then the nodes. A port's watts and a flux's [W/m2] are its loads.
struct AssembledHeat {
  std::vector<int> row_start, column;           ///< of both matrices, by rows with rising columns
  std::vector<double> capacity, conductance;    ///< C [J/K], K [W/K], symmetric
  std::vector<double> capacity_weights;         ///< stored energy = weights . (T - T_0)
  std::vector<double> loss_weights;             ///< heat lost = weights . (T - T_0) - sum of ambient_load
  std::vector<double> ambient_load;             ///< [W]: convection while all is at T_0
  std::vector<std::vector<double>> flux_loads;  ///< [n_fluxes][n] per W/m2
  std::vector<HeatMean> ports;                  ///< means, and loads per W [n_ports]
  std::vector<double> flux_areas, port_areas;   ///< [m2]
  std::vector<HeldUnknowns> held;               ///< no unknown twice
  std::vector<HeatMean> bodies;                 ///< over their volumes
  std::vector<unsigned int> body_of;            ///< of the mesh's unknowns
  double shortest_time = 0;                     ///< [s] in which heat crosses the thinnest cell, node to node

  [[nodiscard]] std::size_t size() const { return capacity_weights.size(); }
};

}  // namespace rotordrop
