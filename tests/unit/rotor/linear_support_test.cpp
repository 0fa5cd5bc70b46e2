// Linear support: forces by hand, and its ledger on a rotor.
//
// LEDGER  With K = K_s + K_a (symmetric + antisymmetric) the power of -K x - C v on the rotor is
//   -v.K_s x - v.K_a x - v.C v,   the first of which is minus the rate of x.K_s x / 2. So
//   d(energy of rotor + support)/dt = prescribed_work - other_dissipation with prescribed_work = -v.K_a x,
//   other_dissipation = v.C v.
#include "bearing/support/linear_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../../verification/rotor/test_rotors.h"

namespace rotordrop {
namespace {

TEST(LinearSupport, PullsBackWithItsMatrices) {
  const LinearSupport support("bearing", {{{2, 3}, {5, 7}}}, {{{11, 13}, {17, 19}}});
  SupportInput input;
  input.journal.y = 1;
  input.journal.z = 10;
  input.journal.velocity_y = 100;
  input.journal.velocity_z = 1000;
  SupportOutput out;
  std::vector<double> observed(2);
  out.observed = observed;
  support.evaluate(input, {}, {}, {}, out);
  EXPECT_DOUBLE_EQ(out.force_on_rotor.y, -(2 + 30) - (1100 + 13000));
  EXPECT_DOUBLE_EQ(out.force_on_rotor.z, -(5 + 70) - (1700 + 19000));
  EXPECT_EQ(observed, (std::vector<double>{out.force_on_rotor.y, out.force_on_rotor.z}));
  EXPECT_EQ(support.observables().front().size, 2U);
  EXPECT_EQ(support.name(), "bearing");
  EXPECT_TRUE(support.state_entries().empty());
}

TEST(LinearSupport, ClosesTheLedgerAlsoWithANonSymmetricStiffness) {
  RotorSettings settings;
  settings.gravity_y = -9.81;
  settings.unbalance = {{5, 1e-3, 0.3}};
  const ModalRotor rotor(testing::uniform_beam(8, 0.1), settings, {2, 8});
  const LinearSupport left("left", {{{2e6, 9e5}, {-7e5, 1e6}}}, {{{500, 200}, {-100, 400}}});
  const LinearSupport right("right", {{{1e6, -3e5}, {8e5, 2e6}}}, {{{300, 0}, {50, 600}}});
  const testing::HeldRotor held{rotor, {&left, &right}};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<double> y(rotor.n_state()), dydt(rotor.n_state());
    const std::size_t n = rotor.n_modes();
    for (std::size_t i = 0; i < 2 * n; ++i) {
      y[i] = 1e-5 * uniform(random);
      y[2 * n + i] = 0.1 * uniform(random);
    }
    y[4 * n + 1] = 10;  // slow: its energy does not hide the others
    double supports_power = 0;
    const RotorPower power = held.rates(0, y, dydt, &supports_power);
    const double expected = supports_power - power.damping + power.unbalance_work;
    const double rate = testing::energy_rate([&](const auto& state) { return held.energy(state); }, y, dydt, 1e-4);
    EXPECT_NEAR(rate, expected, 1e-9 * (std::abs(supports_power) + power.damping)) << "W";
  }
}

}  // namespace
}  // namespace rotordrop
