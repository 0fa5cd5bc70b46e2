// What is taken for granted of thermal models of others, and refused where it is not so.
#include "machine/others/declared_heat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "machine/others/declared_parts.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

/// Two lumps, one for each bearing; growth 1e-7 m/K of the bore.
struct Lumps : ThermalModel {
  std::vector<std::size_t> rings = {0, 1};
  std::vector<std::string> ports = {};
  double curvature = 0., rate = 1e-7, heat_at_start = 0.;
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {{"A", "K", 1.}, {"B", "K", 1.}}; }
  void initial_state(std::span<double> T) const override { T[0] = T[1] = ambient; }
  void growth(std::span<const double> T, std::span<Expansion> out) const override {
    for (std::size_t i = 0; i < 2; ++i) {
      const double rise = T[i] - ambient;
      out[i].bore = 1e-7 * rise + curvature * rise * rise;
    }
  }
  void growth_rates(std::span<const double> rates, std::span<Expansion> out) const override {
    for (std::size_t i = 0; i < 2; ++i) out[i].bore = rate * rates[i];
  }
  double rates(std::span<const double>, std::span<const HeatInput>, std::span<double>) const override { return 0.; }
  [[nodiscard]] std::vector<std::string> heat_ports() const override { return ports; }
  [[nodiscard]] std::vector<Observable> observables() const override { return {}; }
  void observe(std::span<const double>, std::span<const HeatInput>, std::span<double>) const override {}
  [[nodiscard]] std::vector<std::size_t> ring_states() const override { return rings; }
  [[nodiscard]] double stored_energy(std::span<const double> T) const override {
    return 100. * (T[0] + T[1] - 2. * ambient) + heat_at_start;
  }
};

std::string fault_of(const Lumps& model, bool has_ring_states = true) {
  ThermalKind kind{.name = "lumps"};
  kind.has_ring_states = has_ring_states;
  Faults faults;
  check_declared(&model, kind, 2, {}, faults);
  return faults.empty() ? "" : faults.begin()->message;
}

TEST(DeclaredHeat, SoundOnesPass) {
  Lumps with, without;
  without.rings = {};
  EXPECT_EQ(fault_of(with), "");
  EXPECT_EQ(fault_of(without, false), "");
}

TEST(DeclaredHeat, StatesOfInnerRingsAreOneForEachBearingWhereTheyArePromised) {
  Lumps none, one, beyond, unsaid;
  none.rings = {};
  one.rings = {0};
  beyond.rings = {0, 1'000'000'000};
  EXPECT_NE(fault_of(none).find("has_ring_states is true, and ring_states() gives 0 states for 2"), std::string::npos);
  EXPECT_NE(fault_of(one).find("gives 1 states for 2 touchdown bearings"), std::string::npos);
  EXPECT_NE(fault_of(beyond).find("gives states beyond the 2 that there are"), std::string::npos);
  EXPECT_NE(fault_of(unsaid, false).find("has_ring_states is false"), std::string::npos);
}

TEST(DeclaredHeat, AKindThatCallsItselfACircuitIsNotSpared) {
  Lumps none;
  none.rings = {};
  ThermalKind kind{.name = "lumps"};
  kind.is_circuit = kind.has_ring_states = true;
  Faults faults;
  check_declared(&none, kind, 2, {}, faults);
  EXPECT_FALSE(faults.empty());
}

TEST(DeclaredHeat, APlaceOfHeatIsNamedOnce) {
  Lumps twice;
  twice.ports = {"bush", "lid", "bush"};
  EXPECT_NE(fault_of(twice).find("heat_ports() gives \"bush\" twice"), std::string::npos);
}

TEST(DeclaredHeat, GrowthIsLinearAndHasItsRates) {
  Lumps curved, slow, unknown;
  curved.curvature = 1e-11;  // at 80 K 0.8 % of the growth
  slow.rate = 0.999e-7;
  unknown.curvature = std::nan("");
  for (const Lumps* model : {&curved, &slow, &unknown})
    EXPECT_NE(fault_of(*model).find("the growth of \"bore\" is not linear in the temperatures"), std::string::npos);
}

TEST(DeclaredHeat, NoHeatIsStoredAtTheStart) {
  Lumps warm, unknown;
  warm.heat_at_start = 5.;
  unknown.heat_at_start = std::nan("");
  EXPECT_NE(fault_of(warm).find("stored_energy() is 5 J at the start"), std::string::npos);
  EXPECT_NE(fault_of(unknown).find("stored_energy()"), std::string::npos);
}

}  // namespace
}  // namespace rotordrop
