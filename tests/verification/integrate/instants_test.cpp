// Known instants of a system, at which its rates jump or bend: all methods step to them and begin anew.
//
// A body is let go at t_1 and caught by twice its weight at t_2, which lasts: with s_i = max(t - t_i, 0)
//   v = -g s_1 + 2 g s_2,   x = -g s_1^2 / 2 + g s_2^2
// A pulse of torque rises from 0 at t_3 to T at t_4 and falls to 0 at t_5: it leaves T (t_5 - t_3) / 2.
// Every method here integrates lines exactly, so what is left is rounding, if no step lies across an instant.
#include "model/instants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "integrate/integrator.h"
#include "integrate/lane_integrator.h"

namespace rotordrop {
namespace {

constexpr double g = 9.81, torque = 4000.;  // [m/s^2], [rad/s^2]
constexpr double t_1 = 1.037e-3, t_2 = 2.9e-3, t_3 = 3.0013e-3, t_4 = 3.0019e-3, t_5 = 3.0027e-3, end = 4e-3;  // [s]
constexpr double infinity = std::numeric_limits<double>::infinity();

StateLayout layout_of_body() {
  StateLayout layout;
  layout.add_block("body", {{"place", "m", 1e-4}, {"velocity", "m/s", 0.1}, {"spin", "rad/s", 1000.}});
  return layout;
}
const std::vector<double> start_state = {0., 0., 300.};

double acceleration(double t) { return (t >= t_1 ? -g : 0.) + (t >= t_2 ? 2. * g : 0.); }
double pulse(double t) {
  if (t <= t_3 || t >= t_5) return 0.;
  return torque * (t <= t_4 ? (t - t_3) / (t_4 - t_3) : (t_5 - t) / (t_5 - t_4));
}
void rates_of_body(double t, const double* y, double* rates, std::size_t stride) {
  rates[0] = y[stride];
  rates[stride] = acceleration(t);
  rates[2 * stride] = pulse(t);
}
std::vector<double> exact(double t) {
  const double s_1 = std::max(t - t_1, 0.), s_2 = std::max(t - t_2, 0.);
  double turned = torque * (t_5 - t_3) / 2.;
  if (t < t_3)
    turned = 0.;
  else if (t < t_4)
    turned = torque * (t - t_3) * (t - t_3) / (t_4 - t_3) / 2.;
  else if (t < t_5)
    turned -= torque * (t_5 - t) * (t_5 - t) / (t_5 - t_4) / 2.;
  return {-g * s_1 * s_1 / 2. + g * s_2 * s_2, -g * s_1 + 2. * g * s_2, 300. + turned};
}

class Body final : public OdeSystem {
 public:
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { std::ranges::copy(start_state, y.begin()); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    rates_of_body(t, y.data(), dydt.data(), 1);
  }
  [[nodiscard]] std::vector<double> instants() const override { return {t_4, t_1, t_5, t_2, t_3, 0., 1.}; }

 private:
  StateLayout layout_ = layout_of_body();
};

class Bodies final : public LaneSystem {
 public:
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  [[nodiscard]] std::size_t first_quadrature() const override { return 3; }
  void rates(std::span<const double> t, std::span<const double> y, std::span<double> dydt) override {
    for (std::size_t lane = 0; lane < width; ++lane) {
      const double own[] = {y[lane], y[width + lane], y[2 * width + lane]};
      double found[3];
      rates_of_body(t[lane], own, found, 1);
      for (std::size_t i = 0; i < 3; ++i) dydt[i * width + lane] = found[i];
    }
  }
  void observe(std::span<const double> t, std::span<const double> y, std::span<double> dydt, std::span<double>,
               std::span<double>) override {
    rates(t, y, dydt);
  }
  void observe_state(std::span<const double>, std::span<double>) override {}
  void observe_held(std::span<const double>, std::span<double>) override {}

 private:
  StateLayout layout_ = layout_of_body();
};

TEST(Instants, AreInOrderWithinTheRunAndOneWhereRoundingMakesThemTwo) {
  const double twice = std::nextafter(0.3, 1.);
  const std::vector<double> times = {2., 0.3, twice, 0., 0.1, -1., NAN, 1.};
  const Instants instants(times, 1.);
  EXPECT_EQ(instants.next(0.), 0.1);
  EXPECT_EQ(instants.next(0.1), twice);
  EXPECT_EQ(instants.next(twice), 1.);
  EXPECT_EQ(instants.last(0.05), 0.);
  EXPECT_EQ(instants.last(0.1), 0.1);
  EXPECT_TRUE(instants.contains(0.1));
  EXPECT_FALSE(instants.contains(0.3));
  EXPECT_TRUE(instants.contains(1.)) << "what the end of a run is evaluated by lies before it";
  EXPECT_EQ(instants.before(twice), std::nextafter(0.3, 0.));
  EXPECT_EQ(instants.before(0.2), 0.2);
  EXPECT_EQ(instants.latest(0.2), infinity);
  EXPECT_EQ(instants.latest(0.1), std::nextafter(0.1, 0.));
}

TEST(Instants, OfAMomentBeforeTheEndLeaveNoStepOfRounding) {
  const std::vector<double> times = {std::nextafter(1., 0.)};
  const Instants instants(times, 1.);
  EXPECT_EQ(instants.next(0.), 1.);
  EXPECT_LT(instants.latest(1.), times.front());
}

class ByEveryMethod : public testing::TestWithParam<MethodKind> {};

TEST_P(ByEveryMethod, StepsEndAtInstantsAndNoneLiesAcross) {
  const Body body;
  for (const double tolerance : {1e-3, 1e-7, 1e-12}) {
    auto integrator = make_integrator(body, {GetParam().method, {}, tolerance}, 0., start_state, end);
    std::vector<double> met, between(3);
    // Of Adams' own starting steps, which double from order one, errors within the tolerance are left.
    const double own = GetParam().method == IntegrationMethod::adams ? 5. * tolerance : 0.;
    while (integrator->time() < end) {
      const double before = integrator->time();
      integrator->advance();
      const double now = integrator->time(), middle = before + 0.5 * (now - before);
      for (const double t : {t_1, t_2, t_3, t_4, t_5}) {
        EXPECT_FALSE(before < t && t < now) << "s: a step across " << t;
        if (now == t) met.push_back(t);
      }
      integrator->interpolate(middle, between);
      const auto here = exact(now), within = exact(middle);
      for (const auto& [is, should] :
           {std::pair{std::vector(integrator->state().begin(), integrator->state().end()), here},
            std::pair{between, within}}) {
        ASSERT_NEAR(is[0], should[0], 1e-17 + own * 1e-4) << "m at " << now;
        ASSERT_NEAR(is[1], should[1], 1e-14 + own * 0.1) << "m/s at " << now;
        ASSERT_NEAR(is[2], should[2], 1e-10 + own * 1000.) << "rad/s at " << now;
      }
    }
    EXPECT_EQ(met, (std::vector{t_1, t_2, t_3, t_4, t_5}));
    if (own == 0.) {
      EXPECT_EQ(integrator->statistics().rejected_steps, 0);
    }
    EXPECT_GT(integrator->statistics().steps, 80) << "of 50 us at most, those before restarts counted";
  }
}

TEST_P(ByEveryMethod, ARunThatBeginsAtAnInstantSeesWhatComesAfterIt) {
  const Body body;
  auto integrator = make_integrator(body, {GetParam().method, {}, 1e-8}, t_1, start_state, end);
  while (integrator->time() < t_2) integrator->advance();
  EXPECT_NEAR(integrator->state()[1], -g * (t_2 - t_1), 1e-9) << "m/s";
}

INSTANTIATE_TEST_SUITE_P(Methods, ByEveryMethod, testing::ValuesIn(integration_methods), [](const auto& of) {
  std::string name = of.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(LanesWithInstants, EndTheStepsOfEachLaneAtItsOwn) {
  const StateLayout layout = layout_of_body();
  const Body body;
  for (const auto& method : integration_methods) {
    if (!runs_in_lanes(method.method)) continue;
    const IntegrationParameters parameters{method.method, {}, 1e-7};
    const auto lane_until = [&](double until) {
      return LaneIntegrator::Lane{.parameters = parameters,
                                  .start_time = 0.,
                                  .end_time = until,
                                  .layout = &layout,
                                  .state = start_state,
                                  .n_details = 0,
                                  .instants = Instants(body.instants(), until)};
    };
    LaneIntegrator lanes(std::make_unique<Bodies>(), lane_until(end), 0);
    const std::vector<double> ends = {end, 3.5e-3, 3.0015e-3, 2e-3, t_2};
    for (std::size_t l = 0; l < ends.size(); ++l) lanes.begin(l, lane_until(ends[l]));
    std::vector<double> between(3);
    std::vector<double> before(ends.size(), 0.);
    std::size_t n_met = 0;
    while (std::ranges::any_of(std::vector<std::size_t>{0, 1, 2, 3, 4}, [&](std::size_t l) { return lanes.runs(l); })) {
      lanes.advance();
      for (std::size_t l = 0; l < ends.size(); ++l) {
        if (!lanes.has_stepped(l)) continue;
        const double now = lanes.time(l), middle = before[l] + 0.5 * (now - before[l]);
        for (const double t : {t_1, t_2, t_3, t_4, t_5}) {
          EXPECT_FALSE(before[l] < t && t < now) << "s: a step across " << t;
          n_met += now == t ? 1 : 0;
        }
        lanes.interpolate(l, middle, between);
        const auto here = exact(now), within = exact(middle);
        for (std::size_t i = 0; i < 3; ++i) {
          const double roundoff = std::vector{1e-17, 1e-14, 1e-10}[i];
          ASSERT_NEAR(lanes.state(l)[i], here[i], roundoff) << method.name << ", lane " << l << " at " << now;
          ASSERT_NEAR(between[i], within[i], roundoff) << method.name << ", lane " << l << " within";
        }
        before[l] = now;
      }
    }
    EXPECT_EQ(n_met, 5 + 5 + 3 + 1 + 2);
    for (std::size_t l = 0; l < ends.size(); ++l) {
      EXPECT_EQ(lanes.time(l), ends[l]);
      EXPECT_EQ(lanes.statistics(l).rejected_steps, 0);
    }
  }
}

}  // namespace
}  // namespace rotordrop
