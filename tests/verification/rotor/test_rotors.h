#pragma once
// Rotors that several tests use.
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/support.h"
#include "rotor/geometry.h"
#include "rotor/modal_rotor.h"

namespace rotordrop::testing {

constexpr double rpm = 2 * std::numbers::pi / 60;
constexpr double two_pi = 2 * std::numbers::pi;

/// params/neisi2019-rotor.json
inline RotorGeometry reference_rotor() {
  const std::string path = std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019-rotor.json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  const auto json = nlohmann::json::parse(file);
  const auto& m = json["material"];
  const RotorMaterial material{m["E"].get<double>(), m["nu"].get<double>(), m["rho"].get<double>()};
  RotorGeometry geometry;
  for (const auto& node : json["nodes"]) geometry.node_x.push_back(node["x"].get<double>());
  for (const auto& e : json["elements"])
    geometry.elements.push_back(
        {e["n1"].get<int>(), e["n2"].get<int>(), e["od"].get<double>(), e["id_"].get<double>(), material});
  for (const auto& p : json["mass_points"])
    geometry.mass_points.push_back(
        {p["node"].get<int>(), p["mass"].get<double>(), p["Ip"].get<double>(), p["Id"].get<double>()});
  return geometry;
}

/// Uniform steel shaft of length 1 m from x = 0: E 200 GPa, nu 0.3, rho 7850 kg/m3.
inline RotorGeometry uniform_beam(int n_elements, double od, double id = 0) {
  RotorGeometry geometry;
  for (int k = 0; k <= n_elements; ++k) geometry.node_x.push_back(static_cast<double>(k) / n_elements);
  for (int k = 1; k <= n_elements; ++k) geometry.elements.push_back({k, k + 1, od, id, {2.0e11, 0.3, 7850}});
  return geometry;
}

/// Motion of every node [n_nodes].
inline std::vector<Motion> node_motions(const ModalRotor& rotor, std::span<const double> y) {
  std::vector<Motion> motions;
  for (std::size_t k = 0; k < rotor.n_nodes(); ++k) motions.push_back(rotor.node_motion(static_cast<int>(k) + 1, y));
  return motions;
}

/// One evaluation of a rotor whose station s rests on supports[s]: rates, and what rotor and supports report.
struct HeldRotor {
  const ModalRotor& rotor;
  std::vector<const Support*> supports;

  RotorPower rates(double t, std::span<const double> y, std::span<double> dydt,
                   double* supports_power = nullptr) const {
    std::vector<Motion> motion(supports.size());
    std::vector<Force> force(supports.size());
    rotor.motions(y, motion);
    for (std::size_t s = 0; s < supports.size(); ++s) {
      SupportOutput out;
      supports[s]->evaluate({.time = t, .journal = motion[s], .rotor_spin = rotor.spin(y), .growth = {}}, {}, {}, {},
                            out);
      force[s] = out.force_on_rotor;
      if (supports_power) *supports_power += out.prescribed_work - out.other_dissipation;
    }
    return rotor.rates(t, y, force, dydt);
  }
  double energy(std::span<const double> y) const {
    std::vector<Motion> motion(supports.size());
    rotor.motions(y, motion);
    double sum = rotor.energy(y);
    for (std::size_t s = 0; s < supports.size(); ++s)
      sum += supports[s]->energy({.time = 0, .journal = motion[s], .rotor_spin = rotor.spin(y), .growth = {}}, {});
    return sum;
  }
  /// Classical Runge-Kutta steps of size h.
  void integrate(double h, int n_steps, std::vector<double>& y) const {
    const std::size_t n = y.size();
    std::vector<double> k1(n), k2(n), k3(n), k4(n), trial(n);
    for (int step = 0; step < n_steps; ++step) {
      const double t = step * h;
      rates(t, y, k1);
      for (std::size_t i = 0; i < n; ++i) trial[i] = y[i] + 0.5 * h * k1[i];
      rates(t + 0.5 * h, trial, k2);
      for (std::size_t i = 0; i < n; ++i) trial[i] = y[i] + 0.5 * h * k2[i];
      rates(t + 0.5 * h, trial, k3);
      for (std::size_t i = 0; i < n; ++i) trial[i] = y[i] + h * k3[i];
      rates(t + h, trial, k4);
      for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }
};

/// d(energy)/dt along dydt. Energy is a quadratic form plus a linear one, for which a central difference of any width
/// is exact; the width is chosen so that y and its increment are of one size and little is cancelled.
template <class Energy>
double energy_rate(const Energy& energy, const std::vector<double>& y, const std::vector<double>& dydt, double width) {
  std::vector<double> after = y, before = y;
  for (std::size_t i = 0; i < y.size(); ++i) {
    after[i] += width * dydt[i];
    before[i] -= width * dydt[i];
  }
  return (energy(after) - energy(before)) / (2 * width);
}

}  // namespace rotordrop::testing
