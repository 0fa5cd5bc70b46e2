// Time integration against closed forms.
//
// Pendulum-free test problem with known solution, non-autonomous and nonlinear, so that every node and weight of a method counts:
//   y0' = y1,  y1' = -w^2 y0,                 y0 = cos w t
//   y2' = 2 t y2 / (1 + t^2)                  y2 = 1 + t^2
//   y3' = y3^2 (a quadrature-like blow-up)    y3 = 1 / (c - t),  c = 2
// A method of order p with step h errs by C h^p at a fixed time: halving h divides the error by 2^p.
#include "integrate/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "base/errors.h"

namespace rotordrop {
namespace {

class KnownSolution : public OdeSystem {
 public:
  static constexpr double w = 3.;
  KnownSolution() {
    layout_.add_block("part",
                      {{"cosine", "m", 1.}, {"sine", "m/s", 3.}, {"parabola", "1", 1.}, {"hyperbola", "1", 1.}});
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { exact(0., y); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    dydt[0] = y[1];
    dydt[1] = -w * w * y[0];
    dydt[2] = 2. * t * y[2] / (1. + t * t);
    dydt[3] = y[3] * y[3];
  }
  static void exact(double t, std::span<double> y) {
    y[0] = std::cos(w * t);
    y[1] = -w * std::sin(w * t);
    y[2] = 1. + t * t;
    y[3] = 1. / (2. - t);
  }

 private:
  StateLayout layout_;
};

double error_at_end(const OdeSystem& system, const IntegrationParameters& parameters, double end_time) {
  std::vector<double> y(4), exact(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, parameters, 0., y, end_time);
  while (integrator->time() < end_time) integrator->advance();
  KnownSolution::exact(end_time, exact);
  double largest = 0.;
  for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::fabs(integrator->state()[i] - exact[i]));
  return largest;
}

TEST(RungeKutta4, ConvergesWithOrderFour) {
  const KnownSolution system;
  IntegrationParameters p{IntegrationMethod::runge_kutta_4, 0.05, 1e-6};
  double before = 0., order = 0.;
  std::printf("%10s %12s %8s\n", "step", "error", "order");
  for (int i = 0; i < 4; ++i) {
    const double error = error_at_end(system, p, 1.);
    order = i > 0 ? std::log2(before / error) : 0.;
    std::printf("%10.4g %12.4e %8.3f\n", *p.step, error, order);
    before = error;
    *p.step *= 0.5;
  }
  // The error's next term is smaller by a step, 1/160: 0.004.
  EXPECT_NEAR(order, 4., 0.02);
}

TEST(RungeKutta4, TakesFourEvaluationsAStep) {
  const KnownSolution system;
  std::vector<double> y(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {IntegrationMethod::runge_kutta_4, 0.01, 1e-6}, 0., y, 1.);
  while (integrator->time() < 1.) integrator->advance();
  EXPECT_EQ(integrator->statistics().steps, 100);
  // and the rate at the last state, by which it interpolates
  EXPECT_NEAR(static_cast<double>(integrator->statistics().rhs_evaluations), 400., 1.);
}

// H(theta) = (1 + 2 theta) (1 - theta)^2 y_0 + theta (1 - theta)^2 h f_0 + theta^2 (3 - 2 theta) y_1 + theta^2 (theta - 1) h f_1, with the rates f at the
// states y. Those of the last stage in place of f_1 differ by 1e-4 here.
TEST(RungeKutta4, InterpolatesByStatesAndRatesAtBothEnds) {
  const KnownSolution system;
  std::vector<double> before(4), rates_before(4), rates(4), between(4);
  KnownSolution::exact(0.3, before);
  auto integrator = make_integrator(system, {IntegrationMethod::runge_kutta_4, 0.05, 1e-6}, 0.3, before, 1.);
  for (int step = 0; step < 3; ++step) {
    const double start = integrator->time();
    before.assign(integrator->state().begin(), integrator->state().end());
    integrator->advance();
    const double h = integrator->time() - start;
    const auto after = integrator->state();
    system.rhs(start, before, rates_before);
    system.rhs(integrator->time(), after, rates);
    if (step == 2) integrator->offer_rates(rates);
    for (const double theta : {0., 0.3, 0.8, 1.}) {
      integrator->interpolate(start + theta * h, between);
      const double rest = 1. - theta;
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(between[i],
                    (1. + 2. * theta) * rest * rest * before[i] + theta * rest * rest * h * rates_before[i] +
                        theta * theta * (3. - 2. * theta) * after[i] - theta * theta * rest * h * rates[i],
                    1e-14 * (1. + std::fabs(rates[i])));  // roundoff, also of the time
    }
  }
}

TEST(RungeKutta4, GoesOnFromAnyStepWithTheSameBits) {
  const KnownSolution system;
  std::vector<double> y(4), rates(4), between(4), between_of_other(4);
  system.initial_state(y);
  const IntegrationParameters p{IntegrationMethod::runge_kutta_4, 0.05, 1e-6};
  auto whole = make_integrator(system, p, 0., y, 1.);
  while (whole->time() < 0.42) {
    whole->advance();
    system.rhs(whole->time(), whole->state(), rates);
    whole->offer_rates(rates);
  }
  auto resumed = make_integrator(system, p, whole->time(), whole->state(), 1.);
  while (whole->time() < 1.) {
    const double start = whole->time();
    whole->advance();
    resumed->advance();
    ASSERT_EQ(whole->time(), resumed->time());
    whole->interpolate(0.6 * start + 0.4 * whole->time(), between);
    resumed->interpolate(0.6 * start + 0.4 * whole->time(), between_of_other);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(whole->state()[i], resumed->state()[i]);
      EXPECT_EQ(between[i], between_of_other[i]);
    }
  }
}

class ErrorControlled : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(ErrorControlled, ErrorFallsWithTheTolerance) {
  const KnownSolution system;
  double before = 1.;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const double error = error_at_end(system, {GetParam(), 1., tolerance},
                                      1.);  // the bound is the whole interval: the tolerance decides
    EXPECT_LT(error, 100. * tolerance);     // global over local error: about the number of steps
    EXPECT_LE(error, before);
    before = error;
  }
}

TEST_P(ErrorControlled, StepsNoLongerThanTheBound) {
  const KnownSolution system;
  std::vector<double> y(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {GetParam(), 1e-3, 1e-2}, 0., y, 0.1);
  double before = 0.;
  while (integrator->time() < 0.1) {
    integrator->advance();
    EXPECT_LE(integrator->time() - before, 1e-3 * (1. + 1e-9));
    before = integrator->time();
  }
  EXPECT_EQ(integrator->time(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Methods, ErrorControlled,
                         testing::Values(IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                                         IntegrationMethod::sofroniou_spaletta, IntegrationMethod::two_step_runge_kutta,
                                         IntegrationMethod::dormand_prince, IntegrationMethod::fehlberg_8,
                                         IntegrationMethod::adams));

class AnyMethod : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(AnyMethod, InterpolatesWithinTheLastStep) {
  const KnownSolution system;
  std::vector<double> y(4), exact(4), between(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {GetParam(), 1e-2, 1e-9}, 0., y, 1.);
  double before = 0.;
  for (int i = 0; i < 20; ++i) {
    before = integrator->time();
    integrator->advance();
  }
  const double t = 0.5 * (before + integrator->time());
  integrator->interpolate(t, between);
  KnownSolution::exact(t, exact);
  // Cubic Hermite: h^4 w^5 / 384 = 6e-9 at most, and the fourth-order method's own error of 2e-8 after 0.2.
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(between[i], exact[i], 5e-8);
}

TEST_P(AnyMethod, RatesThatTheCallerOffersAreUsedAndChangeNothing) {
  const KnownSolution system;
  std::vector<double> y(4), rates(4);
  system.initial_state(y);
  const IntegrationParameters p{GetParam(), 1e-2, 1e-8};
  auto plain = make_integrator(system, p, 0., y, 0.5);
  auto offered = make_integrator(system, p, 0., y, 0.5);
  while (plain->time() < 0.5) plain->advance();
  while (offered->time() < 0.5) {
    offered->advance();
    system.rhs(offered->time(), offered->state(), rates);
    offered->offer_rates(rates);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(plain->state()[i], offered->state()[i]);
}

/// Rates turn into NaN, or throw, after a time.
class Failing final : public KnownSolution {
 public:
  explicit Failing(bool throws) : throws_(throws) {}
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    KnownSolution::rhs(t, y, dydt);
    if (t < 0.1) return;
    if (throws_) throw std::runtime_error("out of balls");
    dydt[2] = std::nan("");
  }

 private:
  bool throws_;
};

TEST_P(AnyMethod, NamesTheComponentThatIsNoNumber) {
  const Failing system(false);
  std::vector<double> y(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {GetParam(), 1e-2, 1e-6}, 0., y, 1.);
  try {
    while (integrator->time() < 1.) integrator->advance();
    FAIL() << "NaN went through";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("\"part/parabola [1]\""), std::string::npos) << error.what();
  }
}

TEST_P(AnyMethod, ExceptionsComeOutOfTheIntegratorAsTheyWentIn) {
  const Failing system(true);
  std::vector<double> y(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {GetParam(), 1e-2, 1e-6}, 0., y, 1.);
  EXPECT_THROW(
      {
        try {
          while (integrator->time() < 1.) integrator->advance();
        } catch (const std::runtime_error& error) {
          EXPECT_STREQ(error.what(), "out of balls");
          throw;
        }
      },
      std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Methods, AnyMethod,
                         testing::Values(IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                                         IntegrationMethod::sofroniou_spaletta, IntegrationMethod::two_step_runge_kutta,
                                         IntegrationMethod::runge_kutta_4, IntegrationMethod::dormand_prince,
                                         IntegrationMethod::fehlberg_8, IntegrationMethod::adams));

// With any error allowed every step but the first few is the longest one: a fixed step, whose halving shows the order. The interpolant's error in one step
// of length h is of order h^(p + 1), p its own order: 4 of Tsitouras', 3 of Hermite's cubic.
struct OwnPair {
  IntegrationMethod method;
  double order, interpolant_order;
  int evaluations;  // a step
};
/// Tsitouras' coefficients of the leading error are so small that the next order still shows at these steps.
void expect_order(double found, double order) {
  EXPECT_GT(found, order - 0.1);
  EXPECT_LT(found, order + 0.8);
}
class EmbeddedPairs : public testing::TestWithParam<OwnPair> {};

TEST_P(EmbeddedPairs, ConvergeWithTheirOrder) {
  const KnownSolution system;
  const double coarse = error_at_end(system, {GetParam().method, 0.02, 1e6}, 1.),
               fine = error_at_end(system, {GetParam().method, 0.01, 1e6}, 1.);
  std::printf("order %.3f (%.3e, %.3e)\n", std::log2(coarse / fine), coarse, fine);
  expect_order(std::log2(coarse / fine), GetParam().order);
}

TEST_P(EmbeddedPairs, InterpolateWithTheirOrder) {
  const KnownSolution system;
  const auto error_in_a_step = [&](double h) {
    std::vector<double> y(4), exact(4), between(4);
    KnownSolution::exact(0.3, y);
    auto integrator = make_integrator(system, {GetParam().method, h, 1e6}, 0.3, y, 0.3 + h);
    integrator->advance();
    EXPECT_EQ(integrator->time(), 0.3 + h);
    double largest = 0.;
    for (const double theta : {0.2, 0.5, 0.9}) {
      integrator->interpolate(0.3 + theta * h, between);
      KnownSolution::exact(0.3 + theta * h, exact);
      for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::fabs(between[i] - exact[i]));
    }
    return largest;
  };
  const double order = std::log2(error_in_a_step(0.05) / error_in_a_step(0.025));
  std::printf("order of one step %.3f\n", order);
  expect_order(order, GetParam().interpolant_order + 1.);
}

TEST_P(EmbeddedPairs, EvaluateEndsOfStepsAsTheyAreAsked) {
  const KnownSolution system;
  std::vector<double> y(4);
  system.initial_state(y);
  auto plain = make_integrator(system, {GetParam().method, 1e-2, 1e-8}, 0., y, 0.5);
  auto observed = make_integrator(system, {GetParam().method, 1e-2, 1e-8}, 0., y, 0.5);
  double last_time = 0.;
  std::vector<double> last_state;
  ASSERT_TRUE(observed->evaluate_ends_with([&](double t, std::span<const double> at, std::span<double> rates) {
    last_time = t;
    last_state.assign(at.begin(), at.end());
    system.rhs(t, at, rates);
  }));
  while (plain->time() < 0.5) plain->advance();
  while (observed->time() < 0.5) {
    observed->advance();
    ASSERT_EQ(last_time, observed->time());
    ASSERT_TRUE(std::equal(last_state.begin(), last_state.end(), observed->state().begin()));
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(plain->state()[i], observed->state()[i]);
  EXPECT_EQ(plain->statistics().rhs_evaluations, observed->statistics().rhs_evaluations);
}

TEST_P(EmbeddedPairs, EvaluateTheLastStageOfAStepOnceForTheNext) {
  const KnownSolution system;
  std::vector<double> y(4);
  system.initial_state(y);
  auto integrator = make_integrator(system, {GetParam().method, 1., 1e-8}, 0., y, 1.);
  while (integrator->time() < 1.) integrator->advance();
  const auto& made = integrator->statistics();
  EXPECT_GT(made.steps, 10);
  EXPECT_EQ(made.rhs_evaluations, 1 + GetParam().evaluations * (made.steps + made.rejected_steps));
}

INSTANTIATE_TEST_SUITE_P(Methods, EmbeddedPairs,
                         testing::Values(OwnPair{IntegrationMethod::tsitouras, 5., 4., 6},
                                         OwnPair{IntegrationMethod::bogacki_shampine, 3., 3., 3},
                                         OwnPair{IntegrationMethod::sofroniou_spaletta, 4., 3., 4},
                                         OwnPair{IntegrationMethod::two_step_runge_kutta, 4., 3., 3}));

/// y' = cos t is a quadrature after an oscillator that it does not act on.
class WithQuadrature final : public OdeSystem {
 public:
  /// @param last      time from which the quadrature has no rate
  /// @param bad_call  evaluation, from 1, that gives it none
  explicit WithQuadrature(double last = 1e9, int bad_call = 0) : last_(last), bad_call_(bad_call) {
    layout_.add_block("part", {{"cosine", "m", 1.}, {"sine", "m/s", 1.}, {"work", "J", 1.}});
  }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override { y[0] = 1., y[1] = y[2] = 0.; }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    dydt[0] = y[1];
    dydt[1] = -y[0];
    dydt[2] = t < last_ && ++n_calls_ != bad_call_ ? y[0] * y[0] : std::nan("");
  }
  [[nodiscard]] std::size_t first_quadrature() const override { return 2; }

 private:
  StateLayout layout_;
  double last_;
  int bad_call_;
  mutable int n_calls_ = 0;
};

// integral of cos^2 from 0 to t is t/2 + sin(2 t)/4.
TEST_P(EmbeddedPairs, IntegrateQuadraturesWithTheirOwnOrder) {
  const WithQuadrature system;
  const auto error = [&](double h) {
    std::vector<double> y(3);
    system.initial_state(y);
    auto integrator = make_integrator(system, {GetParam().method, h, 1e6}, 0., y, 2.);
    while (integrator->time() < 2.) integrator->advance();
    return std::fabs(integrator->state()[2] - (1. + 0.25 * std::sin(4.)));
  };
  const double order = std::log2(error(0.1) / error(0.05));
  std::printf("order %.3f\n", order);
  expect_order(order, GetParam().order);
}

// The error control does not see a quadrature.
TEST(EmbeddedPair, NamesAQuadratureThatIsNoNumber) {
  for (const auto method : {IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                            IntegrationMethod::sofroniou_spaletta, IntegrationMethod::two_step_runge_kutta}) {
    const WithQuadrature system(0.5);
    std::vector<double> y(3);
    system.initial_state(y);
    auto integrator = make_integrator(system, {method, 0.1, 1e-6}, 0., y, 1.);
    try {
      while (integrator->time() < 1.) integrator->advance();
      FAIL() << "NaN went through";
    } catch (const SolverError& error) {
      EXPECT_NE(std::string(error.what()).find("\"part/work [J]\""), std::string::npos) << error.what();
      EXPECT_LT(integrator->time(), 0.5 + 1e-9);
      EXPECT_TRUE(std::isfinite(integrator->state()[2])) << "the state before stands";
    }
  }
}

TEST(EmbeddedPair, TriesAgainWhereAStageHadNoRate) {
  for (const auto method : {IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine,
                            IntegrationMethod::sofroniou_spaletta, IntegrationMethod::two_step_runge_kutta}) {
    const WithQuadrature system(1e9, 15);  // amid a step
    std::vector<double> y(3);
    system.initial_state(y);
    auto integrator = make_integrator(system, {method, 0.1, 1e-6}, 0., y, 2.);
    while (integrator->time() < 2.) integrator->advance();
    // The error of a quadrature is not controlled: up to 4e-6 by these methods and steps.
    EXPECT_NEAR(integrator->state()[2], 1. + 0.25 * std::sin(4.), 1e-5);
    EXPECT_GT(integrator->statistics().rejected_steps, 0);
  }
}

TEST(WorstComponents, AreNamedWithTheirSharesOfTheSquaredNorm) {
  StateLayout layout;
  layout.add_block("TB1", {{"inner ring y", "m", 1.}, {"inner ring z", "m", 1.}});
  layout.add_block("rotor", {{"spin speed", "rad/s", 1.}});
  const std::vector<double> error = {4., 0., -3.};
  EXPECT_EQ(worst_components(layout, error), "\"TB1/inner ring y [m]\" (64 %), \"rotor/spin speed [rad/s]\" (36 %)");
}

/// A quadrature under a power that changes where a step ends, beside a state that rests.
class ChangedPower final : public OdeSystem {
 public:
  ChangedPower() { layout_.add_block("part", {{"place", "m", 1.}, {"work", "J", 1.}}); }
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  [[nodiscard]] std::size_t first_quadrature() const override { return 1; }
  void initial_state(std::span<double> y) const override { std::fill(y.begin(), y.end(), 0.); }
  void rhs(double, std::span<const double>, std::span<double> dydt) const override {
    dydt[0] = 0.;
    dydt[1] = power;
  }
  double power = 1.;

 private:
  StateLayout layout_;
};

// Methods that take the last stage's rates for those of the next step's start are told where they changed. That with two steps keeps the rate at the
// start of the step before as it was.
TEST(OwnPairs, TakeRatesThatChangedAtAStepsEnd) {
  for (const IntegrationMethod method :
       {IntegrationMethod::tsitouras, IntegrationMethod::bogacki_shampine, IntegrationMethod::sofroniou_spaletta}) {
    ChangedPower system;
    const std::vector<double> rest(2, 0.);
    const auto integrator = make_integrator(system, {method, 0.01, 1e-6}, 0., rest, 1.);
    for (int k = 0; k < 5; ++k) integrator->advance();
    const double changed = integrator->time();
    system.power = 3.;
    integrator->offer_rates(std::vector<double>{0., 3.});
    integrator->advance();
    EXPECT_NEAR(integrator->state()[1], changed + 3. * (integrator->time() - changed), 1e-14)
        << static_cast<int>(method);
  }
}

}  // namespace
}  // namespace rotordrop
