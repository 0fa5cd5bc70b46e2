// Steps that stability bounds rather than accuracy.
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

TEST(StepControl, SeldomTriesStepsBeyondStability) {
  const FastModes system;
  std::vector<double> y(2 * FastModes::n, 0.);
  auto integrator = make_integrator(system, {IntegrationMethod::sofroniou_spaletta, 1., 2e-6}, 0., y, 10.);
  while (integrator->time() < 10.) integrator->advance();
  const auto made = integrator->statistics();
  EXPECT_LT(static_cast<double>(made.steps), 10. * 1000. / 2.4) << "rad a step, of some 2.8 that are stable";
  EXPECT_LT(static_cast<double>(made.rejected_steps), 0.03 * static_cast<double>(made.steps));
  const std::size_t last = FastModes::n - 1;
  EXPECT_NEAR(integrator->state()[2 * last] * 1e6, std::sin(10.), 1e-3) << "it follows the force as a spring would";
}

}  // namespace
}  // namespace rotordrop
