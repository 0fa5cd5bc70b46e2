// The integrator of eight lanes against that of one drop, on oscillators whose steps differ from lane to lane.
#include "integrate/lane_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/errors.h"

namespace rotordrop {
namespace {

/// A Duffing oscillator x'' = -w^2 (x + x^3) that is pushed at t = 1, and the quadrature of its x'^2, which nothing depends on.
StateLayout layout_of_oscillator() {
  StateLayout layout;
  layout.add_block("part", {{"place", "m", 1.}, {"velocity", "m/s", 10.}, {"work", "J", 1.}});
  return layout;
}
void oscillate(double w, double t, double x, double v, double* rates, std::size_t stride) {
  rates[0] = v;
  rates[stride] = -w * w * (x + x * x * x) + 1000. * std::exp(-5000. * (t - 1.) * (t - 1.));
  rates[2 * stride] = v * v;
}
double frequency(std::size_t lane) { return 3. + 2.5 * static_cast<double>(lane); }  // [rad/s]
const std::vector<double> start_state = {1.2, 0., 0.};

class OneOscillator final : public OdeSystem {
 public:
  explicit OneOscillator(double w) : w_(w), layout_(layout_of_oscillator()) {}
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  [[nodiscard]] std::size_t first_quadrature() const override { return 2; }
  void initial_state(std::span<double> y) const override { std::copy_n(start_state.begin(), 3, y.begin()); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    oscillate(w_, t, y[0], y[1], dydt.data(), 1);
  }

 private:
  double w_;
  StateLayout layout_;
};

class EightOscillators final : public LaneSystem {
 public:
  std::size_t broken_lane = width;  ///< its rates are no numbers from a time on
  double broken_time = 0.;
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  [[nodiscard]] std::size_t first_quadrature() const override { return 2; }
  void rates(std::span<const double> t, std::span<const double> y, std::span<double> dydt) override {
    for (std::size_t lane = 0; lane < width; ++lane)
      oscillate(frequency(lane), t[lane], y[lane], y[width + lane], dydt.data() + lane, width);
    if (broken_lane < width && t[broken_lane] > broken_time) dydt[width + broken_lane] = std::nan("");
  }
  void observe(std::span<const double> t, std::span<const double> y, std::span<double> dydt, std::span<double>,
               std::span<double>) override {
    rates(t, y, dydt);
  }
  void observe_state(std::span<const double>, std::span<double>) override {}
  void observe_held(std::span<const double>, std::span<double>) override {}

 private:
  StateLayout layout_ = layout_of_oscillator();
};

const StateLayout oscillator_layout = layout_of_oscillator();

class LanesOf : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(LanesOf, StepInterpolateAndCountAsOneDropDoes) {
  const IntegrationParameters parameters{GetParam(), 0.5, 1e-5};
  const double end = 2.;
  const LaneIntegrator::Lane start{parameters, 0., end, &oscillator_layout, start_state, 0};
  LaneIntegrator lanes(std::make_unique<EightOscillators>(), start, 0);
  constexpr std::size_t n_drops = 7;  // one lane stays free
  std::vector<std::unique_ptr<OneOscillator>> systems;
  std::vector<std::unique_ptr<Integrator>> alone;
  for (std::size_t l = 0; l < n_drops; ++l) {
    systems.push_back(std::make_unique<OneOscillator>(frequency(l)));
    alone.push_back(make_integrator(*systems.back(), parameters, 0., start_state, end));
    lanes.begin(l, start);
  }
  const double roundoff = 1e-11;  // of some thousand steps of a stable oscillator
  std::vector<double> y(3), expected(3), t(LaneIntegrator::width);
  const auto expect_equal = [&](std::size_t lane, const char* what) {
    for (std::size_t i = 0; i < y.size(); ++i)
      ASSERT_NEAR(y[i], expected[i], roundoff) << what << " of lane " << lane << ", state " << i;
  };
  std::vector<double> before(n_drops, 0.);
  for (bool does_any_run = true; does_any_run;) {
    lanes.advance();
    does_any_run = false;
    for (std::size_t l = 0; l < n_drops; ++l) t[l] = 0.7 * before[l] + 0.3 * lanes.time(l);
    for (std::size_t l = 0; l < n_drops; ++l) {
      does_any_run = does_any_run || lanes.runs(l);
      if (!lanes.has_stepped(l)) continue;
      alone[l]->advance();
      ASSERT_NEAR(alone[l]->time(), lanes.time(l), roundoff) << "lane " << l;
      std::ranges::copy(lanes.state(l), y.begin());
      std::copy_n(alone[l]->state().begin(), 3, expected.begin());
      expect_equal(l, "state");
      alone[l]->interpolate(t[l], expected);
      lanes.interpolate(l, t[l], y);
      expect_equal(l, "state within a step");
    }
    lanes.interpolate_all(t);
    for (std::size_t l = 0; l < n_drops; ++l) {
      if (!lanes.has_stepped(l)) continue;
      alone[l]->interpolate(t[l], expected);
      lanes.interpolate(l, t[l], y);
      expect_equal(l, "state within a step, found for all");
      before[l] = lanes.time(l);
    }
  }
  for (std::size_t l = 0; l < n_drops; ++l) {
    EXPECT_EQ(lanes.time(l), end);
    EXPECT_EQ(lanes.statistics(l).steps, alone[l]->statistics().steps);
    EXPECT_EQ(lanes.statistics(l).rejected_steps, alone[l]->statistics().rejected_steps);
    EXPECT_EQ(lanes.statistics(l).rhs_evaluations, alone[l]->statistics().rhs_evaluations);
    EXPECT_GT(lanes.statistics(l).steps, 10);
  }
  EXPECT_GT(lanes.statistics(6).steps, 2 * lanes.statistics(0).steps) << "all lanes step alike: this shows nothing";
  EXPECT_GT(lanes.statistics(6).rejected_steps, 0);
}

TEST_P(LanesOf, FailAloneWhereRatesAreNoNumbers) {
  const LaneIntegrator::Lane start{{GetParam(), 0.5, 1e-5}, 0., 2., &oscillator_layout, start_state, 0};
  auto system = std::make_unique<EightOscillators>();
  constexpr std::size_t broken = 2;
  system->broken_lane = broken;
  system->broken_time = 0.7;
  LaneIntegrator lanes(std::move(system), start, 0), sound(std::make_unique<EightOscillators>(), start, 0);
  for (std::size_t l = 0; l < LaneIntegrator::width; ++l) {
    lanes.begin(l, start);
    sound.begin(l, start);
  }
  const auto run = [](LaneIntegrator& all) {
    const auto any = [&] {
      for (std::size_t l = 0; l < LaneIntegrator::width; ++l)
        if (all.runs(l)) return true;
      return false;
    };
    while (any()) all.advance();
  };
  run(lanes);
  run(sound);
  for (std::size_t l = 0; l < LaneIntegrator::width; ++l) {
    EXPECT_FALSE(sound.failure(l));
    if (l == broken) continue;
    EXPECT_FALSE(lanes.failure(l)) << l;
    EXPECT_TRUE(std::ranges::equal(lanes.state(l), sound.state(l))) << l;
  }
  ASSERT_TRUE(lanes.failure(broken));
  EXPECT_LE(lanes.time(broken), 0.7);
  try {
    std::rethrow_exception(lanes.failure(broken));
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("velocity"), std::string::npos) << error.what();
  }
}

// Sizes by which errors are judged may differ from drop to drop: those of a drop are its own, whichever was there first.
TEST_P(LanesOf, JudgeErrorsByTheirOwnScales) {
  StateLayout coarse;
  coarse.add_block("part", {{"place", "m", 1e3}, {"velocity", "m/s", 1e4}, {"work", "J", 1.}});
  const IntegrationParameters parameters{GetParam(), 0.5, 1e-5};
  const LaneIntegrator::Lane fine_drop{parameters, 0., 2., &oscillator_layout, start_state, 0},
      coarse_drop{parameters, 0., 2., &coarse, start_state, 0};
  LaneIntegrator fine_first(std::make_unique<EightOscillators>(), fine_drop, 0),
      coarse_first(std::make_unique<EightOscillators>(), coarse_drop, 0);
  for (LaneIntegrator* lanes : {&fine_first, &coarse_first}) {
    lanes->begin(4, fine_drop);
    lanes->begin(5, coarse_drop);
    while (lanes->runs(4) || lanes->runs(5)) lanes->advance();
  }
  for (const std::size_t l : {4, 5}) {
    EXPECT_TRUE(std::ranges::equal(fine_first.state(l), coarse_first.state(l))) << l;
    EXPECT_EQ(fine_first.statistics(l).steps, coarse_first.statistics(l).steps) << l;
  }
  EXPECT_GT(fine_first.statistics(4).steps, fine_first.statistics(5).steps)
      << "scales are no matter: this shows nothing";
}

TEST_P(LanesOf, RefuseADropOfAnotherKind) {
  const IntegrationParameters parameters{GetParam(), 0.5, 1e-5};
  const LaneIntegrator::Lane start{parameters, 0., 2., &oscillator_layout, start_state, 0};
  LaneIntegrator lanes(std::make_unique<EightOscillators>(), start, 0);
  StateLayout longer = oscillator_layout;
  longer.add_block("one more", {{"place", "m", 1.}});
  const std::vector<double> state(4, 0.);
  EXPECT_THROW(lanes.begin(0, {parameters, 0., 2., &longer, state, 0}), std::invalid_argument);
}

// The times of rows are the same for all drops: what was interpolated for the drop before in a lane must not be taken for the next one's.
TEST_P(LanesOf, InterpolateTheDropThatIsThere) {
  const LaneIntegrator::Lane start{{GetParam(), 0.5, 1e-5}, 0., 2., &oscillator_layout, start_state, 0};
  const std::vector<double> other_state = {-0.4, 2., 0.};
  const LaneIntegrator::Lane other{start.parameters, 0., 2., &oscillator_layout, other_state, 0};
  LaneIntegrator lanes(std::make_unique<EightOscillators>(), start, 0);
  LaneIntegrator fresh(std::make_unique<EightOscillators>(), other, 0);
  const auto step_over = [](LaneIntegrator& all, double t) {
    while (all.time(0) <= t) all.advance();
  };
  constexpr double t = 0.11;
  lanes.begin(0, start);
  step_over(lanes, t);
  lanes.interpolate_all(std::vector<double>(LaneIntegrator::width, t));
  lanes.stop(0);
  lanes.begin(0, other);
  fresh.begin(0, other);
  step_over(lanes, t);
  step_over(fresh, t);
  std::vector<double> y(3), expected(3);
  lanes.interpolate(0, t, y);
  fresh.interpolate(0, t, expected);
  EXPECT_EQ(y, expected);
}

INSTANTIATE_TEST_SUITE_P(OwnMethods, LanesOf,
                         testing::Values(IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                                         IntegrationMethod::sofroniou_spaletta,
                                         IntegrationMethod::two_step_runge_kutta));

}  // namespace
}  // namespace rotordrop
