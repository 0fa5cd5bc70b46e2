// A module of parts for test_parts.py: a soft ring around the shaft that reports what a touchdown bearing reports. TYPE is its type; WITH_TAKEN_NAME adds
// a thermal model whose name is taken.
#include <cmath>
#include <optional>

#include "machine/parts_module.h"

#ifndef TYPE
#define TYPE "ring"
#endif

namespace {

using namespace rotordrop;

struct RingParameters {
  int node = 0;
  double stiffness = 0, gap = 0;
  std::optional<std::string> heats;
};

Section<RingParameters> ring_section() {
  Section<RingParameters> s(TYPE, "A soft ring around the shaft.");
  s.integer("node", &RingParameters::node, {.range = at_least(1), .help = "Rotor node."});
  s.quantity("stiffness", &RingParameters::stiffness, {.unit = "N/m", .range = positive(), .help = "Of the ring."});
  s.quantity("gap", &RingParameters::gap, {.unit = "m", .range = positive(), .help = "Around the shaft."});
  s.text("heats", &RingParameters::heats,
         {.help = "Place of the thermal models that its heat, which is none, enters."});
  return s;
}

class Ring final : public Support {
 public:
  Ring(std::string name, const RingParameters& p) : name_(std::move(name)), p_(p) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<Observable> observables() const override {
    using K = Observed;
    const std::vector<std::string> row = {"row 1"};
    return {{"orbit", "m", "position", 2, {"y", "z"}, K::orbit},
            {"penetration", "m", "depth", 1, {}, K::penetration},
            {"clearance", "m", "gap left", 1, {}, K::clearance},
            {"contact_force", "N", "force", 1, {}, K::contact_force},
            {"spin_lag", "rad/s", "lag", 1, {}, K::spin_lag},
            {"ball_force", "N", "force", 1, row, K::ball_force},
            {"contact_pressure", "Pa", "pressure", 1, row, K::contact_pressure},
            {"ring_speed", "rad/s", "speed", 1, {}, K::ring_speed},
            {"load_torque", "N m", "torque", 1, {}, K::load_torque},
            {"spin_torque", "N m", "torque", 1, {}, K::spin_torque},
            {"rub_heat_rate", "W", "heat", 1, {}, K::rub_heat_rate},
            {"inner_heat_rate", "W", "heat", 1, {}, K::inner_heat_rate},
            {"outer_heat_rate", "W", "heat", 1, {}, K::outer_heat_rate},
            growth_observable("growth", "growth"),
            {"preload", "N", "preload", 1, {}, K::preload},
            {"centrifugal_force", "N", "force", 1, {}, K::centrifugal_force},
            {"ellipse_truncation", "1", "part", 1, row, K::ellipse_truncation},
            {"skid_demand", "1", "demand", 1, row, K::skid_demand},
            {"gyroscopic_demand", "1", "demand", 1, row, K::gyroscopic_demand}};
  }
  [[nodiscard]] std::string heat_port() const override { return p_.heats.value_or(""); }
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput& in, std::span<const double>, std::span<double>, std::span<double>,
                SupportOutput& out) const override {
    const double r = std::hypot(in.journal.y, in.journal.z), depth = r - p_.gap;
    const double force = depth > 0. ? p_.stiffness * depth : 0.;
    out.force_on_rotor = {};
    if (force > 0.) {
      out.force_on_rotor.y = -force * in.journal.y / r;
      out.force_on_rotor.z = -force * in.journal.z / r;
    }
    if (out.observed.empty()) return;
    for (double& value : out.observed) value = 0.;
    const double reported[] = {in.journal.y, in.journal.z, depth, -depth, force};
    for (std::size_t i = 0; i < std::size(reported); ++i) out.observed[i] = reported[i];
  }
  [[nodiscard]] double energy(const SupportInput& in, std::span<const double>) const override {
    const double depth = std::hypot(in.journal.y, in.journal.z) - p_.gap;
    return depth > 0. ? 0.5 * p_.stiffness * depth * depth : 0.;
  }

 private:
  std::string name_;
  RingParameters p_;
};

void add(PartsRegistry& registry) {
  registry.add_support(TYPE, ring_section(), [](const std::string& name, const RingParameters& p) {
    return std::make_unique<Ring>(name, p);
  });
#ifdef WITH_TAKEN_NAME
  registry.add(ThermalKind{.name = "lumped"});
#endif
}

}  // namespace

ROTORDROP_PARTS(add)
