// A rotor with all its modes, up to 87 kHz, integrated by exponentials where they turn by more than half a radian in a step: the same drop as with steps that resolve them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "integrate/exponential_stages.h"
#include "integrate/integrator.h"
#include "test_machines.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

struct Followed {
  std::vector<double> orbit;  // both stations at every millisecond [m]
  IntegrationStatistics statistics;
  double residual = 0;  // [J]
};

Followed follow(const Example& machine, const IntegrationParameters& parameters) {
  constexpr double end = 16e-3;  // the first impact comes at 7.4 ms
  const MachineSystem equations(*machine);
  std::vector<double> y(machine->integrated_layout().size());
  machine->initial_state(y);
  const auto integrator = make_integrator(equations, parameters, 0., y, end);
  Followed found;
  int next = 1;
  while (integrator->time() < end) {
    integrator->advance();
    for (; next * 1e-3 <= integrator->time(); ++next) {
      integrator->interpolate(next * 1e-3, y);
      std::vector<Motion> motions(2);
      machine->rotor().motions(std::span<const double>(y).first(machine->layout().block("rotor").size), motions);
      for (const Motion& m : motions) found.orbit.insert(found.orbit.end(), {m.y, m.z});
    }
  }
  found.statistics = integrator->statistics();
  found.residual = machine->energy_balance(end, integrator->state()).residual;
  return found;
}

class FastModes : public ::testing::TestWithParam<IntegrationMethod> {};

TEST_P(FastModes, ByExponentialsMoveAsByStepsThatResolveThem) {
  const Example machine = reference_machine({"rotor.model=full"}, "neisi2019-settling.toml");
  static const Followed fine = follow(machine, {IntegrationMethod::runge_kutta_4, 0.5e-6, 1e-6});
  IntegrationParameters parameters{GetParam(), {}, 1e-6};
  EXPECT_EQ(fast_oscillators(machine->oscillators(), parameters).size(), 2U * 60U);
  const Followed fast = follow(machine, parameters);
  parameters.exponential_above = 1e9;
  const Followed slow = follow(machine, parameters);
  double largest = 0., largest_by_steps = 0.;
  ASSERT_EQ(fast.orbit.size(), fine.orbit.size());
  for (std::size_t i = 0; i < fine.orbit.size(); ++i) {
    largest = std::max(largest, std::fabs(fast.orbit[i] - fine.orbit[i]));
    largest_by_steps = std::max(largest_by_steps, std::fabs(slow.orbit[i] - fine.orbit[i]));
  }
  std::printf("%ld steps: %.2g um; by steps that resolve them %ld: %.2g um; residual %.2g J\n", fast.statistics.steps,
              largest / um, slow.statistics.steps, largest_by_steps / um, fast.residual);
  EXPECT_LT(largest, 0.01 * um) << "what the method errs by over this time with the reference case's five modes";
  EXPECT_LT(std::fabs(fast.residual), 1e-5);
  EXPECT_LT(fast.statistics.steps, 3 * slow.statistics.steps / 4);
}

TEST(FastModesOfARotor, WithoutDampingAreLeftToTheSteps) {
  const auto n_oscillators = [](const std::string& damping) {
    return reference_machine({"rotor.model=full", "rotor.modal_damping=" + damping}, "neisi2019-settling.toml")
        ->oscillators()
        .size();
  };
  EXPECT_EQ(n_oscillators("0.0003"), 2U * 60U);
  EXPECT_EQ(n_oscillators("0.0001"), 0U);
  EXPECT_EQ(n_oscillators("0"), 0U) << "mass-proportional damping is little for the fastest";
}

INSTANTIATE_TEST_SUITE_P(Methods, FastModes,
                         ::testing::Values(IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                                           IntegrationMethod::sofroniou_spaletta,
                                           IntegrationMethod::two_step_runge_kutta));

}  // namespace
}  // namespace rotordrop
