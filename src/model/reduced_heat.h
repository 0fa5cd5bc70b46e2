#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// A heat-conduction problem projected on a few modes, as plain data.
namespace rotordrop {

struct ReductionSettings {
  std::size_t modes = 200;            ///< maximum number; 0: all modes of the mesh (small meshes only)
  double response_tolerance = 0.005;  ///< as few modes are taken as this relative error of the responses allows
  double fastest = 6e4;         ///< [1/s] modes that decay faster are left out; explicit steps of 50 us bear these
  double shortest_time = 1e-4;  ///< [s] the response to heat is matched from here: a twentieth of an impact
  double longest_time = 1000.;  ///< [s] to here
};

/// Mean temperatures and heat of a linear problem in coordinates z [K] of its modes:
///   dz_i/dt = - rate_i (z_i - T_0) + sum_p input[p][i] q_p,    T = T_0 + sum_i shape[i] (z_i - T_0)
/// with q_p the heat into port p [W]; a port's own rise has at_once q_p besides. Modes are normalised so that their heat capacity is that of the whole, so input[p] = port[p].shape/capacity.
/// The uniform temperature is among what the modes span: the energy of the reduced problem closes exactly.
struct ReducedHeat {
  /// A temperature as a weighted sum of states.
  struct Output {
    std::string name;
    std::vector<double> shape;        ///< [n_modes]
    double capacity = 0;              ///< of a body or node [J/K]
    double area = 0;                  ///< of a surface [m2]
    std::vector<double> points = {};  ///< of a surface: the same for single points [n_points * n_modes]
    /// Of a port: what the modes left out add to its own rise per watt into it, at once; and to the points' [K/W].
    double at_once = 0;
    std::vector<double> points_at_once = {};
    /// Largest relative error from the shortest to the longest time. Of a port: of its rise under a step of heat into it. Of a body or node:
    /// of its mean under a step of heat or a joule at once into any port, over its rise plus a thousandth of the largest mean rise.
    double response_error = 0;
  };
  std::vector<double> rate;    ///< [1/s], rising [n_modes]
  double capacity = 0;         ///< of everything [J/K]
  std::vector<Output> ports;   ///< as in the problem
  std::vector<Output> bodies;  ///< volume means
  std::vector<Output> nodes;
  std::vector<double> loss;  ///< heat lost by linear convection and links [W/K] [n_modes]
  /// The largest error of all responses, and which it is, in words; none if every mode of the mesh is kept.
  double response_error = 0;
  std::string worst_response;
  [[nodiscard]] std::size_t n_modes() const { return rate.size(); }
};

}  // namespace rotordrop
