// One state vector over rotor, supports, temperatures and ledgers.
#include "machine/machine.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "../../verification/machine/test_machines.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

std::vector<double> rates(const Machine& machine, const std::vector<double>& y, double t = 0.) {
  std::vector<double> dydt(y.size());
  machine.rhs(t, y, dydt);
  return dydt;
}

TEST(Machine, LaysItsPartsOutOneAfterTheOther) {
  const auto machine = reference_machine();
  const auto& blocks = machine->layout().blocks();
  const std::vector<std::string> expected = {"rotor",      "TB1",        "TB2",   "temperature",
                                             "TB1 ledger", "TB2 ledger", "energy"};
  ASSERT_EQ(blocks.size(), expected.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_EQ(blocks[i].name, expected[i]);
    EXPECT_EQ(blocks[i].offset, at) << "no gaps";
    at += blocks[i].size;
  }
  EXPECT_EQ(at, machine->layout().size());
  EXPECT_EQ(machine->first_quadrature(), machine->layout().block("TB1 ledger").offset);
  EXPECT_EQ(machine->layout().block("rotor").size, 4u * 7 + 2)
      << "rigid translation and tilt, five flexible modes, spin";
  EXPECT_EQ(machine->layout().block("TB1").size, static_cast<std::size_t>(TB::n_state));
  EXPECT_EQ(machine->layout().block("temperature").size, 10u) << "five nodes with capacity a bearing";
}

TEST(Machine, NamesEveryStateWithItsUnit) {
  const auto machine = reference_machine();
  const auto& layout = machine->layout();
  EXPECT_EQ(layout.describe(layout.block("TB2").offset + TB::ring_spin), "TB2/inner ring spin [rad/s]");
  EXPECT_EQ(layout.describe(layout.block("TB1 ledger").offset), "TB1 ledger/rub heat [J]");
  EXPECT_EQ(layout.describe(layout.block("temperature").offset + 1), "temperature/TB1/inner_ring [K]");
  std::vector<std::string> names;
  for (const auto& e : layout.entries()) {
    EXPECT_GT(e.scale, 0.) << e.name;
    EXPECT_FALSE(e.unit.empty()) << e.name;
    names.push_back(e.name);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << "no name twice";
}

TEST(Machine, StartsWithTheRotorCentredInItsHangingRings) {
  const auto machine = reference_machine();
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  std::vector<Motion> motion(2);
  const auto& rotor = machine->layout().block("rotor");
  machine->rotor().motions({y.data() + rotor.offset, rotor.size}, motion);
  for (std::size_t i = 0; i < 2; ++i) {
    const double* b = y.data() + machine->layout().block(i == 0 ? "TB1" : "TB2").offset;
    EXPECT_NEAR(motion[i].y, b[TB::ring_y], 1e-13) << "m";
    EXPECT_NEAR(motion[i].z, b[TB::ring_z], 1e-13) << "m";
    EXPECT_EQ(motion[i].velocity_y, 0.);
  }
  EXPECT_NEAR(motion[0].y, -19.287 * um, 0.001 * um) << "m, TB1 hangs in its clearance";
  EXPECT_NEAR(motion[1].y, 0., 0.05 * um) << "m, TB2 is preloaded";
  EXPECT_NEAR(machine->spin(y).speed, 15200. * M_PI / 30., 1e-9) << "rad/s";
  for (std::size_t i = machine->first_quadrature(); i < y.size(); ++i) EXPECT_EQ(y[i], 0.);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(y[machine->layout().block("temperature").offset + i], 293.15) << "K";
}

TEST(Machine, RotorFallsFreelyAtFirst) {
  const auto machine = reference_machine({"rotor.unbalance=[]"});
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  const auto dydt = rates(*machine, y);
  const auto& rotor = machine->layout().block("rotor");
  const std::size_t n = (rotor.size - 2) / 4;
  EXPECT_NEAR(dydt[2 * n], -9.81, 1e-9) << "m/s2, translation";
  for (std::size_t i = 1; i < 2 * n; ++i) EXPECT_NEAR(dydt[2 * n + i], 0., 1e-8) << "m/s2: gravity bends no free rotor";
  EXPECT_EQ(dydt[4 * n + 1], 0.) << "nothing brakes it";
}

TEST(Machine, NothingDependsOnItsLedgers) {
  const auto machine = reference_machine();
  std::mt19937 random(1);
  auto y = random_state(*machine, random, true);
  const auto before = rates(*machine, y);
  for (std::size_t i = machine->first_quadrature(); i < y.size(); ++i) y[i] += 1e3;
  EXPECT_EQ(rates(*machine, y), before);
}

TEST(Machine, KeepsNoCopyOfTheState) {
  const auto machine = reference_machine();
  std::mt19937 random(2);
  const auto a = random_state(*machine, random, true), b = random_state(*machine, random, false);
  const auto first = rates(*machine, a);
  rates(*machine, b);
  EXPECT_EQ(rates(*machine, a), first) << "bit for bit, whatever was computed between";
}

TEST(Machine, TemperaturesActOnForcesOnlyIfGrowthIsFedBack) {
  for (const bool fed_back : {true, false}) {
    const auto machine = reference_machine({fed_back ? "thermal.growth=true" : "thermal.growth=false"});
    std::mt19937 random(3);
    auto y = random_state(*machine, random, true);
    const auto cold = rates(*machine, y);
    const auto& temperature = machine->layout().block("temperature");
    for (std::size_t i = 0; i < temperature.size; ++i) y[temperature.offset + i] += 5.;
    const auto warm = rates(*machine, y);
    const std::size_t velocity = machine->layout().block("TB2").offset + TB::ring_vy;
    EXPECT_EQ(warm[velocity] != cold[velocity], fed_back);
    if (!fed_back) {
      EXPECT_EQ(machine->layout().block("TB1 ledger").size, 7u + TB::n_ledger);
      EXPECT_EQ(cold[entry(*machine, "TB1 ledger/growth work")], 0.);
    }
  }
}

TEST(Machine, FindsLedgersByName) {
  const auto machine = reference_machine();
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  y[entry(*machine, "TB2 ledger/rub heat")] = 12.;
  y[entry(*machine, "TB1 ledger/contact impulse")] = 3.;
  EXPECT_EQ(machine->ledger(1, "rub heat", y), 12.);
  EXPECT_EQ(machine->ledger(0, "contact impulse", y), 3.);
  EXPECT_THROW(static_cast<void>(machine->ledger(0, "rub heaat", y)), std::out_of_range);
}

TEST(Machine, BalanceAddsUpItsLedgers) {
  const auto machine = reference_machine();
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  double value = 1.;
  for (std::size_t i = machine->first_quadrature(); i < y.size(); ++i) y[i] = value++;  // all different
  const auto at = [&](const std::string& name) { return y[entry(*machine, name)]; };
  const auto b = machine->energy_balance(0., y);
  double heat = 0., other = 0., prescribed = 0., growth = 0.;
  for (const std::string name : {"TB1 ledger/", "TB2 ledger/"}) {
    heat += at(name + "rub heat") + at(name + "inner heat") + at(name + "outer heat");
    other += at(name + "other dissipation");
    prescribed += at(name + "prescribed work");
    growth += at(name + "growth work");
  }
  EXPECT_NEAR(b.mechanical, machine->initial_mechanical_energy(), 1e-9);
  EXPECT_NEAR(b.heat_deposited, heat, 1e-12);
  EXPECT_NEAR(b.dissipated, heat + other + at("energy/rotor damping"), 1e-12);
  EXPECT_NEAR(b.residual,
              -heat - other - at("energy/rotor damping") + growth + prescribed + at("energy/unbalance work") +
                  at("energy/drive work"),
              1e-9);
  EXPECT_NEAR(b.heat.at(0).residual, heat - at("energy/heat lost"), 1e-9) << "nothing stored at ambient";
}

TEST(Machine, WritesAllThatItAnnounces) {
  const auto machine = reference_machine();
  std::mt19937 random(4);
  const auto y = random_state(*machine, random, true);
  std::vector<double> dydt(y.size());
  const double untouched = -12345.678;
  for (const auto* list :
       {&machine->step_observables(), &machine->detail_observables(), &machine->state_observables()}) {
    std::vector<std::string> names;
    for (const auto& o : *list) names.push_back(o.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << "no name twice";
  }
  const auto sized = [&](const std::vector<Observable>& list) {
    return std::vector<double>(observed_size(list), untouched);
  };
  Evaluation found;
  found.wants_step = found.wants_details = true;
  found.step = sized(machine->step_observables());
  found.details = sized(machine->detail_observables());
  auto state = sized(machine->state_observables());
  const std::size_t n_step = found.step.size(), n_details = found.details.size();
  EXPECT_EQ(n_details, 14u + 2 * 23) << "every ball";
  machine->evaluate(0., y, dydt, found);
  machine->observe_state(y, found, state);
  EXPECT_EQ(found.step.size(), n_step);
  EXPECT_EQ(found.details.size(), n_details);
  for (const auto* values : {&found.step, &found.details, &state})
    for (const double v : *values) EXPECT_NE(v, untouched);
  EXPECT_EQ(rates(*machine, y), dydt) << "watching changes nothing";
}

TEST(Machine, IsEvaluatedByTwoThreadsAtOnceToTheLastBit) {
  // Each thread has states and an Evaluation of its own; what one finds alone it must find beside the other.
  const auto machine = reference_machine();
  constexpr std::size_t n_states = 64, n_rounds = 60;
  struct Found {
    std::vector<double> rates, step, details, state;
    bool operator==(const Found&) const = default;
  };
  const auto look_at = [&](const std::vector<double>& y, Evaluation& e) {
    machine->evaluate(0.01, y, e);
    Found found{e.rates, e.step, e.details, std::vector<double>(observed_size(machine->state_observables()))};
    machine->observe_state(y, e, found.state);
    return found;
  };
  const auto watching = [] {
    Evaluation e;
    e.wants_step = e.wants_details = true;
    return e;
  };
  std::mt19937 random(11);
  std::vector<std::vector<double>> states[2];
  std::vector<Found> alone[2];
  for (std::size_t thread : {0u, 1u}) {
    Evaluation e = watching();
    for (std::size_t i = 0; i < n_states; ++i) {
      states[thread].push_back(random_state(*machine, random, thread == 0));
      alone[thread].push_back(look_at(states[thread].back(), e));
    }
  }
  std::size_t n_different[2] = {};
  const auto work = [&](std::size_t thread) {
    Evaluation e = watching();
    for (std::size_t round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < n_states; ++i)
        if (look_at(states[thread][i], e) != alone[thread][i]) ++n_different[thread];
  };
  std::thread first(work, 0), second(work, 1);
  first.join();
  second.join();
  EXPECT_EQ(n_different[0], 0u);
  EXPECT_EQ(n_different[1], 0u);
}

TEST(Machine, RefusesPartsThatDoNotFitTogether) {
  EXPECT_THROW(
      {
        class NoRotor final : public RotorModel {
         public:
          [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
          [[nodiscard]] std::size_t n_stations() const override { return 1; }
          void motions(std::span<const double>, std::span<Motion>) const override {}
          [[nodiscard]] Motion node_motion(int, std::span<const double>) const override { return {}; }
          [[nodiscard]] Spin spin(std::span<const double>) const override { return {}; }
          RotorPower rates(double, std::span<const double>, std::span<const Force>, std::span<double>) const override {
            return {};
          }
          [[nodiscard]] double energy(std::span<const double>) const override { return 0.; }
        };
        Machine::Parts parts;
        parts.rotor = std::make_unique<NoRotor>();
        Machine machine(std::move(parts));
      },
      std::invalid_argument)
      << "a station without support";
}

}  // namespace
}  // namespace rotordrop
