// The first milliseconds of the reference drop.
//
// FALL through the gap c = 250 um from rest: t = sqrt(2 c/g) = 7.1392 ms, v = sqrt(2 g c) = 0.0700 m/s. The free rotor falls as a rigid body, straight: both bearings alike.
// With a mass-proportional damping alpha: v' = g - alpha v, so v = g (1 - exp(-alpha t))/alpha and the fall is g (alpha t - 1 + exp(-alpha t))/alpha^2 = c: 7.40 ms at 30 1/s.
//
// RUB HEAT is mu F v_s: far above the regularisation speed force and heat peak together.
//
// SPIN-UP BALANCE. The ring's equation J omega_i' + M = F_t r_b, the slip v_s = omega_r r_r - omega_i r_b + v_t: integrating F_t v_s,
//   E_slip = (r_r/r_b) int omega_r (J omega_i' + M) dt - J omega_i^2/2 - int M omega_i dt + int F_t v_t dt.
// The ring's speed and four ledgers that are integrated independently of each other must agree.
#include <gtest/gtest.h>

#include "integrate/integrator.h"
#include "test_machines.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

struct Sample {
  double time, penetration[2], velocity_y[2], force[2], heat[2], ring_speed[2], rotor_speed;
};

class Drop {
 public:
  explicit Drop(const std::vector<std::string>& overrides, const std::string& file = "neisi2019.toml")
      : machine(reference_machine(overrides, file)) {}

  void to(double end_time) {
    const auto& system = *machine;
    std::vector<double> y(system.layout().size());
    Evaluation found;
    found.wants_step = true;
    system.initial_state(y);
    IntegrationParameters parameters = machine.settings.parameters.integration;
    parameters.method = IntegrationMethod::runge_kutta_4;
    parameters.step = 5e-6;
    const MachineSystem equations(system);
    const auto integrator = make_integrator(equations, parameters, 0., y, end_time);
    const auto observed = [&](const std::string& name, std::size_t column = 0) {
      std::size_t at = 0;
      for (const auto& o : system.step_observables()) {
        if (o.name == name) return found.step[at + column];
        at += o.size;
      }
      throw std::out_of_range(name);
    };
    while (integrator->time() < end_time) {
      integrator->advance();
      system.evaluate(integrator->time(), integrator->state(), found);
      Sample s{};
      s.time = integrator->time();
      s.rotor_speed = system.spin(integrator->state()).speed;
      for (std::size_t i = 0; i < 2; ++i) {
        const std::string path = std::string("/bearings/") + (i == 0 ? "TB1/" : "TB2/");
        s.penetration[i] = observed(path + "penetration");
        s.velocity_y[i] = observed(path + "rotor_velocity");
        s.force[i] = observed(path + "contact_force");
        s.heat[i] = observed(path + "rub_heat_rate");
        s.ring_speed[i] = observed(path + "ring_speed");
      }
      samples.push_back(s);
    }
    state.assign(integrator->state().begin(), integrator->state().end());
  }

  /// When a bearing's penetration first passes zero, and the rotor's velocity there.
  [[nodiscard]] std::pair<double, double> first_contact(std::size_t bearing) const {
    for (std::size_t k = 1; k < samples.size(); ++k) {
      const double a = samples[k - 1].penetration[bearing], b = samples[k].penetration[bearing];
      if (b <= 0.) continue;
      const double part = -a / (b - a);
      return {samples[k - 1].time + part * (samples[k].time - samples[k - 1].time), samples[k].velocity_y[bearing]};
    }
    return {0., 0.};
  }

  Example machine;
  std::vector<Sample> samples;
  std::vector<double> state;
};

double fall_time(double alpha) {
  double low = 0., high = 0.1;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 * (low + high), x = alpha * t;
    const double fallen = alpha > 0. ? 9.81 * (x + std::expm1(-x)) / (alpha * alpha) : 0.5 * 9.81 * t * t;
    (fallen < 250e-6 ? low : high) = t;
  }
  return low;
}

TEST(FirstImpact, RotorFallsThroughTheGapIn7Point14Milliseconds) {
  EXPECT_NEAR(fall_time(0.), 7.14e-3, 0.005e-3) << "s";
  Drop run({"rotor.unbalance=[]"});
  run.to(7.3e-3);
  for (const std::size_t bearing : {0u, 1u}) {
    const auto [t, v] = run.first_contact(bearing);
    printf("bearing %zu touches at %.5f ms with %.5f m/s\n", bearing + 1, t * 1e3, v);
    EXPECT_NEAR(t, fall_time(0.), 2e-8)
        << "s; the penetration is interpolated within a step of 5 us: 3e-11 m at 0.07 m/s";
    EXPECT_NEAR(v, -0.0700, 0.0001) << "m/s";
  }
}

TEST(FirstImpact, ReferenceUnbalanceShiftsTheFallByMicroseconds) {
  // me omega / m = 3.85e-6 * 1592 / 110 = 5.6e-5 m/s at most: 0.4 um in 7 ms, 6 us at 0.07 m/s.
  Drop run({});
  run.to(7.3e-3);
  for (const std::size_t bearing : {0u, 1u}) EXPECT_NEAR(run.first_contact(bearing).first, fall_time(0.), 6e-6) << "s";
}

TEST(FirstImpact, RotorWithMassProportionalDampingFallsIn7Point40Milliseconds) {
  EXPECT_NEAR(fall_time(30.), 7.40e-3, 0.005e-3) << "s";
  Drop run({"rotor.unbalance=[]"}, "neisi2019-settling.toml");
  run.to(7.6e-3);
  for (const std::size_t bearing : {0u, 1u}) {
    printf("bearing %zu touches at %.5f ms, closed form %.5f ms\n", bearing + 1, run.first_contact(bearing).first * 1e3,
           fall_time(30.) * 1e3);
    EXPECT_NEAR(run.first_contact(bearing).first, fall_time(30.), 2e-8) << "s";
  }
}

TEST(FirstImpact, PeakForceAndPeakHeatBelongTogether) {
  Drop run({});
  run.to(9e-3);
  for (const std::size_t bearing : {0u, 1u}) {
    const auto strongest =
        *std::max_element(run.samples.begin(), run.samples.end(),
                          [&](const Sample& a, const Sample& b) { return a.force[bearing] < b.force[bearing]; });
    const auto hottest =
        *std::max_element(run.samples.begin(), run.samples.end(),
                          [&](const Sample& a, const Sample& b) { return a.heat[bearing] < b.heat[bearing]; });
    const double slip = strongest.rotor_speed * 34.75e-3 - strongest.ring_speed[bearing] * 35e-3;
    printf("bearing %zu: %.0f N at %.3f ms, slip %.2f m/s, %.0f W; hottest %.0f W at %.3f ms\n", bearing + 1,
           strongest.force[bearing], strongest.time * 1e3, slip, strongest.heat[bearing], hottest.heat[bearing],
           hottest.time * 1e3);
    EXPECT_GT(strongest.force[bearing], 1000.) << "N: there was an impact";
    // The centres' tangential speed, some 0.01 m/s of 55, is left out here.
    EXPECT_NEAR(strongest.heat[bearing], 0.1 * strongest.force[bearing] * slip, 2e-3 * strongest.heat[bearing]) << "W";
    EXPECT_NEAR(hottest.heat[bearing], strongest.heat[bearing], 0.02 * hottest.heat[bearing]) << "W";
    EXPECT_NEAR(hottest.time, strongest.time, 0.2e-3) << "s";
  }
}

TEST(FirstImpact, SpinUpHeatIsThatOfItsBalance) {
  Drop run({});
  run.to(30e-3);
  for (const std::size_t i : {0u, 1u}) {
    const auto& machine = *run.machine;
    const auto ledger = [&](const char* name) { return machine.ledger(i, name, run.state); };
    const double J = i == 0 ? 3.4e-4 : 3.9e-4, omega = run.samples.back().ring_speed[i];
    const double balance = 34.75 / 35. * ledger("spin-up drive") - 0.5 * J * omega * omega - ledger("inner heat") -
                           ledger("outer heat") + ledger("spin-up centres");
    printf("bearing %zu: ring at %.1f rad/s, rub heat %.5f J, by its balance %.5f J\n", i + 1, omega,
           ledger("rub heat"), balance);
    EXPECT_GT(omega, 100.) << "rad/s";
    EXPECT_NEAR(balance / ledger("rub heat"), 1., 1e-6) << "the step's error";
  }
}

TEST(FirstImpact, EveryJouleIsFoundAfterThirtyMilliseconds) {
  Drop run({"bearings.TB2.waviness=[{ surface = \"inner_race\", order = 2, amplitude = \"2 um\" }]"});
  run.to(30e-3);
  const auto b = run.machine->energy_balance(30e-3, run.state);
  printf(
      "dissipated %.4f J, growth work %.3g J, prescribed %.3g J, unbalance %.3g J, residual %.2g J; heat residual %.2g "
      "J\n",
      b.dissipated, b.growth_work, b.prescribed_work, b.unbalance_work, b.residual, b.heat.at(0).residual);
  EXPECT_GT(b.dissipated, 50.) << "J";
  EXPECT_NEAR(b.residual, 0., 1e-6 * b.dissipated) << "J: the step's error";
  EXPECT_NEAR(b.heat.at(0).residual, 0., 1e-9 * b.heat_deposited) << "J: roundoff, whatever the step";
}

}  // namespace
}  // namespace rotordrop
