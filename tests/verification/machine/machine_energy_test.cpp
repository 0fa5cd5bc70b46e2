// The whole machine's books, at random states.
//
// MECHANICS. With E(t, y) the kinetic, elastic and gravitational energy of rotor, rings, supports and contacts,
//   dE/dt = - heat - other dissipation - rotor damping + work of growth + prescribed + unbalance + drive,
// all from one evaluation; dE/dt is a numerical derivative of mechanical_energy along the rates. The growth's part is real: temperatures move along their
// rates too. HEAT: sum C dT/dt + lost = heat of all ports.
//
// CIRCUIT. Rates of the temperatures under unit rises give the circuit that was built from the parameter file; an independent implementation of MODEL 6 gave the
// resistances and capacities below for the same bearings. Elimination of ci and co: i and b through R4 + R5, b and o through R5 + R7.
#include <gtest/gtest.h>

#include <array>

#include "../bearing/numerical_derivative.h"
#include "test_machines.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

// All balls loaded, so that the energy is smooth; waves on every surface, unbalance a thousandfold, a brake, damping, Jaeger's share.
const std::vector<std::string> lively = {
    "bearings.TB1.radial_clearance=\"-12 um\"",
    "bearings.TB2.preload=\"900 N\"",
    "rotor.mass_proportional_alpha=30",
    "rotor.modal_damping=0.02",
    "rotor.unbalance=[{ node = 5, me = \"1.07e-3 kg m\", angle = \"180 deg\" }, { node = 16, me = \"2.78e-3 kg m\", "
    "angle = \"20 deg\" }]",
    "bearings.TB1.waviness=[{ surface = \"inner_race\", order = 2, amplitude = \"0.4 um\" }, { surface = \"bore\", "
    "order = 3, amplitude = \"2 um\" }]",
    "bearings.TB2.waviness=[{ surface = \"outer_race\", order = 23, amplitude = \"0.3 um\", phase = 1.0 }]",
    "bearings.load_law=\"equivalent\"",
    "thermal.heat_share=\"jaeger\"",
    "thermal.expansion=\"formula\"",
    "run.gravity=[0, -9.81, 1.3]"};

struct Balance {
  double rate, scale;  // of what is not accounted for; of the largest power [W]
};

Balance mechanical_balance(const Machine& machine, const std::vector<double>& y, double t = 0.) {
  std::vector<double> dydt(y.size());
  machine.rhs(t, y, dydt);
  const double dE = derivative(
      [&](double s) {
        auto moved = y;
        for (std::size_t i = 0; i < y.size(); ++i) moved[i] += s * dydt[i];
        return machine.mechanical_energy(t + s, moved);
      },
      1e-6);
  const auto rate = [&](const std::string& name) { return dydt[entry(machine, name)]; };
  double sum = dE, scale = std::fabs(dE);
  const auto book = [&](double sign, double power) {
    sum += sign * power;
    scale = std::max(scale, std::fabs(power));
  };
  for (const std::string bearing : {"TB1", "TB2"}) {
    for (const char* taken : {"rub heat", "inner heat", "outer heat", "other dissipation"})
      book(1., rate(bearing + " ledger/" + taken));
    for (const char* given : {"prescribed work", "growth work"}) book(-1., rate(bearing + " ledger/" + given));
  }
  book(1., rate("energy/rotor damping"));
  book(-1., rate("energy/unbalance work"));
  book(-1., rate("energy/drive work"));
  return {sum, scale};
}

TEST(MachineEnergy, EveryWattIsBookedWhateverTheMachineDoes) {
  auto heavy_balls = lively;
  heavy_balls.push_back("bearings.ball_model=inertial");
  for (const auto& overrides : {lively, heavy_balls, std::vector<std::string>{lively[0], lively[1]}}) {
    const auto machine = reference_machine(overrides);
    std::mt19937 random(1);
    double worst = 0.;
    for (int i = 0; i < 40; ++i) {
      const bool in_contact = i % 4 != 0;
      const auto y = random_state(*machine, random, in_contact);
      const auto b = mechanical_balance(*machine, y, 0.01 * i);
      worst = std::max(worst, std::fabs(b.rate) / b.scale);
      // 31 kJ of spin round to 4e-12 J, over 1 us: some 1e-5 W.
      // Balls with inertia are in balance to about 1e-7 of their loads, some 1e3 N at 1e-1 m/s.
      const double balance = overrides.back() == "bearings.ball_model=inertial" ? 2e-5 : 0.;
      EXPECT_LT(std::fabs(b.rate), 1e-8 * b.scale + 2e-5 + balance) << "W of " << b.scale << " W, state " << i;
    }
    printf("worst residual %.1e of the largest power\n", worst);
  }
}

TEST(MachineEnergy, EveryTermMattersInTheStatesTested) {
  // Guards the test above: in its states each ledger runs at a rate far above its tolerance.
  const auto machine = reference_machine(lively);
  std::mt19937 random(1);
  std::vector<double> largest(machine->layout().size());
  double scale = 0.;
  for (int i = 0; i < 40; ++i) {
    const auto y = random_state(*machine, random, true);
    std::vector<double> dydt(y.size());
    machine->rhs(0., y, dydt);
    for (std::size_t k = 0; k < y.size(); ++k) largest[k] = std::max(largest[k], std::fabs(dydt[k]));
    scale = std::max(scale, mechanical_balance(*machine, y).scale);
  }
  for (const char* name :
       {"TB1 ledger/rub heat", "TB1 ledger/inner heat", "TB1 ledger/outer heat", "TB1 ledger/other dissipation",
        "TB1 ledger/prescribed work", "TB1 ledger/growth work", "TB2 ledger/rub heat", "TB2 ledger/inner heat",
        "TB2 ledger/outer heat", "TB2 ledger/other dissipation", "TB2 ledger/prescribed work", "TB2 ledger/growth work",
        "energy/rotor damping", "energy/unbalance work"}) {
    printf("%-32s up to %10.3g W\n", name, largest[entry(*machine, name)]);
    EXPECT_GT(largest[entry(*machine, name)], 1e-6 * scale) << name;
  }
}

TEST(MachineEnergy, UnbalanceWorksAsBookedWithoutContact) {
  auto overrides = lively;
  overrides.push_back("bearings.TB1.air_gap=\"400 um\"");
  overrides.push_back("bearings.TB2.air_gap=\"400 um\"");
  const auto machine = reference_machine(overrides);
  std::mt19937 random(9);
  double largest = 0.;
  for (int i = 0; i < 20; ++i) {
    const auto y = random_state(*machine, random, false);
    std::vector<double> dydt(y.size());
    machine->rhs(0., y, dydt);
    ASSERT_EQ(dydt[entry(*machine, "TB1 ledger/rub heat")], 0.);
    largest = std::max(largest, std::fabs(dydt[entry(*machine, "energy/unbalance work")]));
    const auto b = mechanical_balance(*machine, y);
    EXPECT_LT(std::fabs(b.rate), 1e-8 * b.scale + 2e-5) << "W";
  }
  EXPECT_GT(largest, 1.) << "W";
}

TEST(MachineEnergy, HeatIsStoredOrLost) {
  const auto machine = reference_machine(lively);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    const auto y = random_state(*machine, random, true);
    std::vector<double> dydt(y.size());
    machine->rhs(0., y, dydt);
    double heat = 0.;
    for (const std::string bearing : {"TB1", "TB2"})
      for (const char* port : {"rub heat", "inner heat", "outer heat"})
        heat += dydt[entry(*machine, bearing + " ledger/" + port)];
    // Linear in the temperatures: the difference over one second along the rates is the rate.
    auto later = y;
    for (std::size_t k = 0; k < y.size(); ++k) later[k] += dydt[k];
    const double stored =
        machine->energy_balance(0., later).heat.at(0).stored - machine->energy_balance(0., y).heat.at(0).stored;
    EXPECT_NEAR(stored + dydt[entry(*machine, "energy/heat lost")], heat, 1e-9 * std::fabs(heat)) << "W";
  }
}

TEST(MachineEnergy, BuildsTheCircuitOfItsParameterFile) {
  struct Published {
    const char* name;
    double R1, R2, R3, R4, R5, R6, R7, R8, C_s, C_i, C_b, C_o, C_h;
  };
  const std::array<Published, 2> circuits = {
      {{"TB1", 4.5799984, 0.05684105, 0.00713223, 0.00598465, 2.6601439, 3.2078964, 0.00724912, 0.01972776, 301.8243,
        107.1, 26.6434, 165.7236, 374.9177},
       {"TB2", 2.8624990, 0.03552566, 0.00445764, 0.00374041, 0.4089555, 1.5254301, 0.00302392, 0.01223448, 482.9189,
        107.1, 82.7973, 153.5663, 687.3491}}};
  const auto machine = reference_machine();
  std::vector<double> y(machine->layout().size()), dydt(y.size());
  const std::size_t offset = machine->layout().block("temperature").offset;
  for (std::size_t place = 0; place < 2; ++place) {
    const auto& c = circuits[place];
    const std::array<double, 5> C = {c.C_s, c.C_i, c.C_b, c.C_o, c.C_h};
    const double G_si = 1. / (c.R2 + c.R3), G_ib = 1. / (c.R4 + c.R5), G_bo = 1. / (c.R5 + c.R7), G_oh = 1. / c.R8;
    std::array<std::array<double, 5>, 5> G{};
    const auto join = [&](std::size_t a, std::size_t b, double g) {
      G[a][a] -= g;
      G[b][b] -= g;
      G[a][b] += g;
      G[b][a] += g;
    };
    join(0, 1, G_si);
    join(1, 2, G_ib);
    join(2, 3, G_bo);
    join(3, 4, G_oh);
    G[0][0] -= 1. / c.R1;
    G[2][2] -= 1. / c.R6;
    const double area = place == 0 ? M_PI * 130e-3 * 25e-3 : M_PI * 120e-3 * 50e-3;
    for (std::size_t warm = 0; warm < 5; ++warm) {
      machine->initial_state(y);
      y[offset + 5 * place + warm] += 1.;
      machine->rhs(0., y, dydt);
      for (std::size_t node = 0; node < 5; ++node) {
        const double convection = node == 4 && warm == 4 ? 23. * area : 0.;  // at a rise of 1 K
        const double expected = (G[node][warm] - convection) / C[node];
        EXPECT_NEAR(dydt[offset + 5 * place + node], expected, 3e-6 * std::fabs(G[node][node]) / C[node])
            << c.name << ", K/s of node " << node << " for 1 K at node " << warm
            << "; digits of the independent implementation";
        EXPECT_EQ(dydt[offset + 5 * (1 - place) + node], 0.) << "the other bearing does not feel it";
      }
    }
  }
}

}  // namespace
}  // namespace rotordrop
