// Steps that stability bounds rather than accuracy, and steps that change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "integrate/integrator.h"

namespace rotordrop {
namespace {

/// Modes up to 1000 rad/s that are driven slowly: accuracy asks for little, stability for short steps.
class FastModes final : public OdeSystem {
 public:
  static constexpr std::size_t n = 60;
  static constexpr double damping_ratio = 0.005;
  static double w(std::size_t k) { return 1000. * static_cast<double>(k + 1) / n; }
  FastModes() {
    std::vector<StateEntry> entries;
    for (std::size_t k = 0; k < n; ++k) {
      entries.push_back({"place " + std::to_string(k), "m", 1. / (w(k) * w(k))});
      entries.push_back({"velocity " + std::to_string(k), "m/s", 1. / w(k)});
    }
    layout_.add_block("modes", entries);
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { std::fill(y.begin(), y.end(), 0.); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    for (std::size_t k = 0; k < n; ++k) {
      dydt[2 * k] = y[2 * k + 1];
      dydt[2 * k + 1] = std::sin(t) - w(k) * w(k) * y[2 * k] - 2. * damping_ratio * w(k) * y[2 * k + 1];
    }
  }

 private:
  StateLayout layout_;
};

/// @param radians  of the fastest mode that a step has at least
void expect_steps_near_stability(IntegrationMethod method, double radians) {
  const FastModes system;
  std::vector<double> y(2 * FastModes::n, 0.);
  auto integrator = make_integrator(system, {method, 1., 2e-6}, 0., y, 10.);
  while (integrator->time() < 10.) integrator->advance();
  const auto made = integrator->statistics();
  EXPECT_LT(static_cast<double>(made.steps), 10. * 1000. / radians);
  EXPECT_LT(static_cast<double>(made.rejected_steps), 0.03 * static_cast<double>(made.steps));
  const std::size_t last = FastModes::n - 1;
  EXPECT_NEAR(integrator->state()[2 * last] * 1e6, std::sin(10.), 1e-3) << "it follows the force as a spring would";
}

TEST(StepControl, SeldomTriesStepsBeyondStability) {
  expect_steps_near_stability(IntegrationMethod::sofroniou_spaletta, 2.4);    // of some 2.8 that are stable
  expect_steps_near_stability(IntegrationMethod::two_step_runge_kutta, 1.7);  // of some 2.0
}

/// A pulse at t = 1 that makes steps short and long, and y' = 4 t^3 beside it, which no error control minds.
class PulseAndCubicRate final : public OdeSystem {
 public:
  PulseAndCubicRate() { layout_.add_block("part", {{"pulse", "m", 1.}, {"power of time", "s4", 1e12}}); }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { std::fill(y.begin(), y.end(), 0.); }
  void rhs(double t, std::span<const double>, std::span<double> dydt) const override {
    dydt[0] = std::exp(-50. * (t - 1.) * (t - 1.));
    dydt[1] = 4. * t * t * t;
  }

 private:
  StateLayout layout_;
};

// But for the first step, which has none before it.
TEST(TwoStepRungeKutta, IntegratesCubicRatesExactlyWhateverItsSteps) {
  const PulseAndCubicRate system;
  std::vector<double> y(2, 0.);
  auto integrator = make_integrator(system, {IntegrationMethod::two_step_runge_kutta, 0.5, 1e-6}, 0., y, 2.);
  integrator->advance();
  double time = integrator->time(), step = time, shrunk = 1., grown = 1.;
  const double lacks = std::pow(time, 4) - integrator->state()[1];
  while (integrator->time() < 2.) {
    integrator->advance();
    const double next = integrator->time() - time;
    shrunk = std::min(shrunk, next / step);
    grown = std::max(grown, next / step);
    step = next;
    time = integrator->time();
    EXPECT_NEAR(integrator->state()[1] + lacks, std::pow(time, 4), 1e-13) << "roundoff of numbers up to 16";
  }
  EXPECT_LT(shrunk, 0.7);
  EXPECT_GT(grown, 1.5);
}

}  // namespace
}  // namespace rotordrop
