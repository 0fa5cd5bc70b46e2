#pragma once
// The reference case as a machine, with a state that moves everything at once.
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bearing/touchdown_bearing.h"
#include "case/case.h"
#include "machine/build_machine.h"

namespace rotordrop::testing {

inline constexpr double um = 1e-6;

struct Example {
  Case settings;
  std::unique_ptr<Machine> machine;
  [[nodiscard]] const Machine* operator->() const { return machine.get(); }
  [[nodiscard]] const Machine& operator*() const { return *machine; }
};

inline Example reference_machine(const std::vector<std::string>& overrides = {},
                                 const std::string& file = "neisi2019.toml") {
  Example e{read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/" + file, overrides), nullptr};
  e.machine = build_machine(e.settings.parameters, e.settings.tree);
  return e;
}

inline std::size_t entry(const Machine& machine, const std::string& name) {
  const auto& entries = machine.layout().entries();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].name == name) return i;
  throw std::out_of_range("no state entry " + name);
}

/// Rotor pressed into (or hanging clear of) the rings, everything moving and warm.
inline std::vector<double> random_state(const Machine& machine, std::mt19937& random, bool in_contact) {
  std::uniform_real_distribution<double> one(-1, 1);
  const auto& layout = machine.layout();
  std::vector<double> y(layout.size());
  machine.initial_state(y);
  const auto& rotor = layout.block("rotor");
  const std::size_t n_modes = (rotor.size - 2) / 4;
  for (std::size_t i = 0; i < 2 * n_modes; ++i) {
    y[rotor.offset + i] = 2 * um * one(random);
    y[rotor.offset + 2 * n_modes + i] = 0.05 * one(random);
  }
  const double direction = 3. * one(random), distance = (in_contact ? 270. : 120.) * um;
  y[rotor.offset] += distance * std::cos(direction);
  y[rotor.offset + n_modes] += distance * std::sin(direction);
  y[rotor.offset + 4 * n_modes] = 10. * one(random);
  y[rotor.offset + 4 * n_modes + 1] = 400. * one(random);
  for (const char* name : {"TB1", "TB2"}) {
    using TB = TouchdownBearing;
    double* b = y.data() + layout.block(name).offset;
    b[TB::support_y] = 1 * um * one(random);
    b[TB::support_z] = 1 * um * one(random);
    b[TB::ring_y] = b[TB::support_y] + 1.5 * um * one(random);
    b[TB::ring_z] = b[TB::support_z] + 1.5 * um * one(random);
    b[TB::ring_vy] = 0.1 * one(random);
    b[TB::ring_vz] = 0.1 * one(random);
    b[TB::support_vy] = 0.02 * one(random);
    b[TB::support_vz] = 0.02 * one(random);
    b[TB::ring_angle] = 10. * one(random);
    b[TB::cage_angle] = 10. * one(random);
    b[TB::ring_spin] = 600. * one(random);
  }
  const auto& temperature = layout.block("temperature");
  for (std::size_t i = 0; i < temperature.size; ++i) y[temperature.offset + i] += 3. * (1. + one(random));
  for (std::size_t i = machine.first_quadrature(); i < y.size(); ++i) y[i] = 10. * one(random);
  return y;
}

}  // namespace rotordrop::testing
