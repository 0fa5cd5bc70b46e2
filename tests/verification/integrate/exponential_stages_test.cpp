// Fast oscillators by exponentials, against closed forms and against classical Runge-Kutta with steps that resolve them.
//
// UNDER A FORCE THAT IS A POLYNOMIAL in time, f(t) = sum f_k t^k, an oscillator q'' + c q' + omega^2 q = f moves as
//   q = P(t) + exp(-c t / 2) (A cos(omega_d t) + B sin(omega_d t)),  omega^2 P_k = f_k - c (k + 1) P_(k+1) - (k + 1)(k + 2) P_(k+2),
// which the methods give exactly, whatever the step, if f has no more coefficients than the last stage has fitted rates. The two-step method has one less in
// its first step.
#include "integrate/exponential_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>

#include "integrate/integrator.h"
#include "integrate/pairs.h"

namespace rotordrop {
namespace {

/// Oscillators q'' = -omega^2 q - c q' + f(t) side by side, their velocities in another order than their coordinates.
class Forced final : public OdeSystem {
 public:
  Forced(std::vector<double> omega, std::vector<double> damping_ratio, std::vector<double> force)
      : omega_(std::move(omega)), ratio_(std::move(damping_ratio)), force_(std::move(force)) {
    std::vector<StateEntry> entries;
    for (std::size_t i = 0; i < 2 * omega_.size(); ++i) entries.push_back({std::to_string(i), "m", 1.});
    layout_.add_block("part", entries);
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { exact(0., y); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    double f = 0.;
    for (std::size_t k = force_.size(); k-- > 0;) f = f * t + force_[k];
    for (const Oscillator& o : oscillators()) {
      dydt[o.coordinate] = y[o.velocity];
      dydt[o.velocity] = f - o.omega_squared * y[o.coordinate] - o.damping_rate * y[o.velocity];
    }
  }
  [[nodiscard]] std::vector<Oscillator> oscillators() const override {
    const std::size_t n = omega_.size();
    std::vector<Oscillator> list;
    for (std::size_t i = 0; i < n; ++i) list.push_back({i, 2 * n - 1 - i, omega_[i] * omega_[i], rate(i)});
    return list;
  }
  void exact(double t, std::span<double> y) const {
    const std::size_t n = omega_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double c = rate(i), square = omega_[i] * omega_[i], damped = std::sqrt(square - 0.25 * c * c);
      std::vector<double> P(force_.size() + 2);
      for (std::size_t k = force_.size(); k-- > 0;) {
        const auto m = static_cast<double>(k);
        P[k] = (force_[k] - c * (m + 1.) * P[k + 1] - (m + 1.) * (m + 2.) * P[k + 2]) / square;
      }
      double p = 0., slope = 0.;
      for (std::size_t k = P.size(); k-- > 0;) {
        slope = slope * t + p;
        p = p * t + P[k];
      }
      const double A = 0.3 + 0.1 * static_cast<double>(i), B = -0.2;
      const double decay = std::exp(-0.5 * c * t), cosine = std::cos(damped * t), sine = std::sin(damped * t);
      y[i] = p + decay * (A * cosine + B * sine);
      y[2 * n - 1 - i] = slope + decay * (damped * (B * cosine - A * sine) - 0.5 * c * (A * cosine + B * sine));
    }
  }

 private:
  [[nodiscard]] double rate(std::size_t i) const { return 2. * ratio_[i] * omega_[i]; }
  std::vector<double> omega_, ratio_, force_;
  StateLayout layout_;
};

/// A method with steps of its own choice, for systems whose states are oscillators.
class Steps {
 public:
  Steps(IntegrationMethod method, const Forced& system)
      : method_(tableau_of(method)),
        system_(system),
        stages(method_, system.oscillators(), std::vector<double>(system.layout().size(), 1e6)),
        y(system.layout().size()),
        before_(y) {
    k_.assign(most_stages, y);
    system.initial_state(y);
    system.rhs(0., y, k_[start()]);
  }
  void advance(double step) {
    if (last_step_ > 0.) {
      std::swap(k_[0], k_[start()]);
      k_[start()] = k_[last()];
    }
    fit_to_step(method_, step, last_step_);
    stages.begin(step, last_step_, {y, k_[start()], before_, k_[0]});
    before_ = y;
    for (std::size_t i = start() + 1; i <= last(); ++i) {
      stages.place(static_cast<int>(i), y);
      system_.rhs(time + method_.c[i] * step, y, k_[i]);
      stages.take(static_cast<int>(i), k_[i]);
    }
    time += step;
    last_step_ = step;
  }

 private:
  [[nodiscard]] std::size_t start() const { return static_cast<std::size_t>(method_.start); }
  [[nodiscard]] std::size_t last() const { return static_cast<std::size_t>(method_.n_stages) - 1; }
  EmbeddedTableau method_;
  const Forced& system_;
  double last_step_ = 0.;

 public:
  double time = 0.;
  ExponentialStages stages;
  std::vector<double> y;

 private:
  std::vector<double> before_;
  std::vector<std::vector<double>> k_;
};

struct Exact {
  IntegrationMethod method;
  std::size_t n_coefficients;  // of a force that it integrates exactly
};

class ExponentialStagesOf : public testing::TestWithParam<Exact> {
 protected:
  static void expect_exact(const Forced& system, double t, std::span<const double> found) {
    std::vector<double> exact(found.size());
    system.exact(t, exact);
    // Coordinates are up to 1, velocities to 500; rounding adds up over twenty steps.
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], exact[i], i < found.size() / 2 ? 1e-12 : 1e-10) << "state " << i << " at " << t;
  }
};

TEST_P(ExponentialStagesOf, AreExactUnderPolynomialForcesWhateverTheStep) {
  std::vector<double> force = {3., -2., 1.5, -0.7, 0.25};
  force.resize(GetParam().n_coefficients);
  // Eleven oscillators of nine kinds, so that a vector of eight is not enough; three of them alike. Some follow each other by frequency as by coordinate, but
  // not by velocity. The fastest turns 13 times in the longest step.
  const Forced system({19., 20., 22., 500., 40., 33., 40., 28., 26., 24., 40.},
                      {0.9, 0.01, 0.01, 0.02, 0.005, 0., 0.005, 0.3, 0.01, 0.01, 0.005}, force);
  Steps steps(GetParam().method, system);
  std::vector<double> within(system.layout().size());
  for (int k = 0; k < 20; ++k) {
    const double before = steps.time, step = k % 3 == 0 ? 0.16 : k % 3 == 1 ? 0.06 : 0.09;
    steps.advance(step);
    ASSERT_TRUE(steps.stages.is_active());
    expect_exact(system, steps.time, steps.y);
    for (const double theta : {0., 0.03, 0.31, 0.77, 1.}) {
      steps.stages.interpolate(theta, within);
      expect_exact(system, before + theta * step, within);
    }
    ASSERT_FALSE(HasFailure());
  }
}

TEST_P(ExponentialStagesOf, LeaveToTheMethodWhatTurnsByLessThanHalfARadian) {
  const Forced system({1., 40.}, {0., 0.}, {3.});
  Steps steps(GetParam().method, system);
  const auto start = steps.y;
  steps.advance(0.0124);
  EXPECT_FALSE(steps.stages.is_active());
  EXPECT_EQ(steps.y, start);
  steps.advance(0.0126);
  EXPECT_TRUE(steps.stages.is_active());
  std::vector<double> scale(4, 7.);
  steps.stages.hide(scale);
  for (const std::size_t slow : {0U, 3U}) {
    EXPECT_EQ(steps.y[slow], start[slow]);
    EXPECT_TRUE(std::isfinite(scale[slow]));
  }
  for (const std::size_t fast : {1U, 2U}) {
    EXPECT_NE(steps.y[fast], start[fast]);
    EXPECT_TRUE(std::isinf(scale[fast]));
  }
}

TEST(FastOscillators, AreAllOfASystemWithOneAboveTheFrequencyOfTheCaseIfTheMethodIsOurOwn) {
  const Forced system({100., 50., 49., 30.}, {0., 1., 0.5, 0.}, {0.});
  IntegrationParameters parameters;
  parameters.exponential_above = 99. / 6.283185307179586;
  const auto found = fast_oscillators(system.oscillators(), parameters);
  ASSERT_EQ(found.size(), 3U) << "the second is damped critically";
  EXPECT_EQ(found[0].omega_squared, 1e4);
  EXPECT_EQ(found[1].coordinate, 2U);
  for (const auto& kind : integration_methods) {
    parameters.method = kind.method;
    EXPECT_EQ(fast_oscillators(system.oscillators(), parameters).empty(), kind.make != make_embedded_pair) << kind.name;
  }
  parameters.exponential_above = 101. / 6.283185307179586;
  EXPECT_TRUE(fast_oscillators(system.oscillators(), parameters).empty());
}

/// A slow oscillator with a hard spring, u = (x, x'), which shakes fast ones by a soft spring and is pushed by them: three masses of different inertia.
///   x'' = -x - x^3 + sum_i k (q_i - x),  q_i'' = -Omega_i^2 q_i + m_i k (x - q_i) - d q_i'^3
class Coupled final : public OdeSystem {
 public:
  Coupled() {
    std::vector<StateEntry> entries;
    for (int i = 0; i < 6; ++i) entries.push_back({std::to_string(i), "m", 1.});
    layout_.add_block("part", entries);
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override {
    std::fill(y.begin(), y.end(), 0.);
    y[0] = 1.;
    y[2] = 0.001;
  }
  void rhs(double, std::span<const double> y, std::span<double> dydt) const override {
    dydt[0] = y[1];
    dydt[1] = -y[0] - y[0] * y[0] * y[0];
    for (std::size_t i = 0; i < 2; ++i) {
      const double q = y[2 + 2 * i], v = y[3 + 2 * i];
      dydt[1] += k * (q - y[0]);
      dydt[2 + 2 * i] = v;
      dydt[3 + 2 * i] = -omega[i] * omega[i] * q + mass[i] * k * (y[0] - q) - 0.1 * v * v * v;
    }
  }
  [[nodiscard]] std::vector<Oscillator> oscillators() const override {
    return {{2, 3, omega[0] * omega[0], 0.}, {4, 5, omega[1] * omega[1], 0.}};
  }

 private:
  static constexpr double k = 2., omega[] = {150., 90.}, mass[] = {20., 3.};
  StateLayout layout_;
};

std::vector<double> end_of(const OdeSystem& system, const IntegrationParameters& parameters, double end) {
  std::vector<double> y(system.layout().size());
  system.initial_state(y);
  const auto integrator = make_integrator(system, parameters, 0., y, end);
  while (integrator->time() < end) integrator->advance();
  return {integrator->state().begin(), integrator->state().end()};
}

TEST_P(ExponentialStagesOf, FollowASlowMotionThroughFastOnesThatTurnSeveralTimesInAStep) {
  const Coupled system;
  const auto fine = end_of(system, {IntegrationMethod::runge_kutta_4, 1e-4, 1e-6}, 3.);
  std::vector<double> errors;
  for (const double step : {0.1, 0.05, 0.025, 0.0125}) {  // 15 to 1.9 radians of the faster one
    const auto found = end_of(system, {GetParam().method, step, 1e-2, 1.}, 3.);
    errors.push_back(std::fabs(found[0] - fine[0]));
    std::printf("%8.4g %12.4e   of the faster one %12.4e\n", step, errors.back(), std::fabs(found[2] - fine[2]));
    EXPECT_NEAR(found[2], fine[2], 5e-4) << "by itself it would be at some thousandth";
  }
  // Errors do not fall smoothly while fast ones turn by so much; over three halvings the mean order is the method's, give or take 0.7.
  EXPECT_GT(std::log2(errors.front() / errors.back()) / 3., tableau_of(GetParam().method).order - 0.7);
}

TEST_P(ExponentialStagesOf, InterpolateFastOnesWithinTheLastStep) {
  const Coupled system;
  std::vector<double> y(6);
  system.initial_state(y);
  const auto integrator = make_integrator(system, {GetParam().method, 0.05, 1e-2, 1.}, 0., y, 3.);
  double before = 0.;
  while (integrator->time() < 0.5) {
    before = integrator->time();
    integrator->advance();
  }
  for (const double theta : {0.3, 0.6}) {
    const double t = before + theta * (integrator->time() - before);
    integrator->interpolate(t, y);
    const auto fine = end_of(system, {IntegrationMethod::runge_kutta_4, 1e-4, 1e-6}, t);
    // Velocities by Hermite's cubic between the ends would be off by most of their 0.15 m/s.
    EXPECT_NEAR(y[2], fine[2], 1e-4);
    EXPECT_NEAR(y[3], fine[3], 1e-2);
    EXPECT_NEAR(y[0], fine[0], 1e-3);
  }
}

TEST_P(ExponentialStagesOf, SetNoStepByWhatTheyFollowExactly) {
  // Free oscillators, whose errors by the method itself would be a hundred times what is allowed.
  const Forced system({100., 90., 80.}, {0.01, 0., 0.}, {2.});
  std::vector<double> y(6);
  system.initial_state(y);
  const auto integrator = make_integrator(system, {GetParam().method, 0.1, 1e-2, 1.}, 0., y, 10.);
  while (integrator->time() < 1.) integrator->advance();  // steps grow from a first one that the method resolves
  const auto begun = integrator->statistics();
  const double from = integrator->time();
  while (integrator->time() < 9.9) integrator->advance();
  EXPECT_EQ(integrator->statistics().rejected_steps, begun.rejected_steps);
  // The last step passes 9.9 s.
  EXPECT_NEAR(static_cast<double>(integrator->statistics().steps - begun.steps), (9.9 - from) / 0.1, 1.);
}

TEST_P(ExponentialStagesOf, ErrByWhatIsAllowed) {
  // A force that no method's polynomial follows: sums of steps that are too long, unless their errors are controlled.
  const Forced system({50., 40.}, {0.01, 0.}, {0., 0., 0., 0., 0., 0., 0., 5e2});
  std::vector<double> y(4), exact(4);
  const auto error = [&](double tolerance) {
    system.initial_state(y);
    const auto integrator = make_integrator(system, {GetParam().method, 1., tolerance, 1.}, 0., y, 4.);
    while (integrator->time() < 4.) integrator->advance();
    system.exact(4., exact);
    return std::fabs(integrator->state()[0] - exact[0]) / std::fabs(exact[0]);
  };
  const double rough = error(1e-3), fine = error(1e-9);
  std::printf("%.2g with 1e-3, %.2g with 1e-9\n", rough, fine);
  EXPECT_LT(fine, 1e-7);
  EXPECT_LT(rough, 1e-4);
  EXPECT_LT(fine, rough);
}

TEST_P(ExponentialStagesOf, CountErrorsForLessWhereTheyTurnInAStep) {
  // A force moves an oscillator for a radian, no longer: by 1 / (1 + z) of what it would in a step.
  const auto error = [](const std::vector<double>& omega) {
    const Forced system(omega, std::vector<double>(omega.size()), {0., 0., 0., 0., 0., 0., 0., 1.});
    Steps steps(GetParam().method, system);
    steps.advance(0.1);
    return std::sqrt(steps.stages.squared_error(1.));
  };
  // The slower one's coordinate, off by 0.1/3 s times its velocity's error, adds 5e-4 to the norm.
  EXPECT_NEAR(error({20.}) / error({200.}), 21. / 3., 0.01);
  EXPECT_EQ(error({200., 1.}), error({200.})) << "the method controls what it keeps";
}

/// A slow nonlinear motion beside oscillators that rest.
class BesideRest final : public OdeSystem {
 public:
  explicit BesideRest(std::size_t n_resting) : n_(n_resting) {
    std::vector<StateEntry> entries(2 + 2 * n_, {"state", "m", 1.});
    layout_.add_block("part", entries);
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override {
    std::fill(y.begin(), y.end(), 0.);
    y[0] = 1.;
  }
  void rhs(double, std::span<const double> y, std::span<double> dydt) const override {
    dydt[0] = y[1];
    dydt[1] = -std::sin(4. * y[0]);
    for (const Oscillator& o : oscillators()) {
      dydt[o.coordinate] = y[o.velocity];
      dydt[o.velocity] = -o.omega_squared * y[o.coordinate];
    }
  }
  [[nodiscard]] std::vector<Oscillator> oscillators() const override {
    std::vector<Oscillator> list;
    for (std::size_t i = 0; i < n_; ++i) list.push_back({2 + 2 * i, 3 + 2 * i, 1e6, 0.});
    return list;
  }

 private:
  std::size_t n_;
  StateLayout layout_;
};

TEST_P(ExponentialStagesOf, DoNotLoosenTheToleranceOfOthers) {
  const auto steps = [](std::size_t n_resting) {
    const BesideRest system(n_resting);
    std::vector<double> y(system.layout().size());
    system.initial_state(y);
    const auto integrator = make_integrator(system, {GetParam().method, 1., 1e-8, 1.}, 0., y, 20.);
    while (integrator->time() < 20.) integrator->advance();
    return integrator->statistics().steps;
  };
  // Sums over 80 zeros more may round otherwise.
  EXPECT_NEAR(static_cast<double>(steps(40)), static_cast<double>(steps(0)), 1.);
}

INSTANTIATE_TEST_SUITE_P(Methods, ExponentialStagesOf,
                         testing::Values(Exact{IntegrationMethod::tsitouras, 5},
                                         Exact{IntegrationMethod::bogacki_shampine, 3},
                                         Exact{IntegrationMethod::sofroniou_spaletta, 4},
                                         Exact{IntegrationMethod::two_step_runge_kutta, 3}));

}  // namespace
}  // namespace rotordrop
