// What a drop costs: right-hand sides, balls, and the whole reference case against real time. Figures are ratios within one run; nothing is
// asserted. Run: build/release/rotordrop_benchmarks
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "case/case.h"
#include "integrate/integrator.h"
#include "machine/build_machine.h"

namespace {

using namespace rotordrop;

const Case& settling() {
  static const Case c = read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml");
  return c;
}

/// A machine and its state in the middle of the first contact.
struct Contact {
  std::unique_ptr<Machine> machine = build_machine(settling().parameters, settling().tree);
  std::vector<double> y, dydt;
  double t = 0.0085;
  Contact() : y(machine->layout().size()), dydt(y.size()) {
    machine->initial_state(y);
    const MachineSystem system(*machine);
    auto integrator = make_integrator(system, settling().parameters.integration, 0., y, t);
    while (integrator->time() < t) integrator->advance();
    y.assign(integrator->state().begin(), integrator->state().end());
  }
  [[nodiscard]] int n_balls() const {
    int n = 0;
    for (const auto& entry : settling().parameters.bearings)
      n += entry.touchdown()->rows * entry.touchdown()->balls_per_row;
    return n;
  }
};

void right_hand_side(benchmark::State& state) {
  const Contact c;
  std::vector<double> dydt(c.y.size());
  Evaluation found;
  for (auto _ : state) {
    c.machine->evaluate(c.t, c.y, dydt, found);
    benchmark::DoNotOptimize(dydt.data());
  }
  state.counters["per_ball"] = benchmark::Counter(
      static_cast<double>(c.n_balls()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(right_hand_side);

/// Balls with inertia against those without, per right-hand side: in the first contact, but with the inner rings at a given part of the
/// rotor's speed. Both run by turns, a few milliseconds each; counters: the ratio of their CPU times, median, least and largest.
void inertia_ratio(benchmark::State& state, double part_of_speed) {
  const auto with = read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml", {"bearings.ball_model=inertial"});
  const Contact c;
  const auto machine = build_machine(with.parameters, with.tree);
  auto y = c.y;
  const auto& entries = machine->layout().entries();
  for (std::size_t i = 0; i < y.size(); ++i)
    if (entries[i].name.ends_with("inner ring spin")) y[i] = part_of_speed * settling().parameters.run.initial_speed;
  std::vector<double> dydt(y.size()), ratios;
  const auto cpu_time = [&](const Machine& m) {
    Evaluation found;
    const std::clock_t start = std::clock();
    for (int i = 0; i < 4000; ++i) {
      m.evaluate(c.t, y, dydt, found);
      benchmark::DoNotOptimize(dydt.data());
    }
    return static_cast<double>(std::clock() - start);
  };
  for (auto _ : state)
    for (int turn = 0; turn < 41; ++turn) {
      const double plain = cpu_time(*c.machine);
      ratios.push_back(cpu_time(*machine) / plain);
    }
  std::sort(ratios.begin(), ratios.end());
  state.counters["ratio"] = ratios[ratios.size() / 2];
  state.counters["least"] = ratios.front();
  state.counters["largest"] = ratios.back();
}
BENCHMARK_CAPTURE(inertia_ratio, ring_at_full_speed, 1.)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(inertia_ratio, ring_at_a_third, 0.33)->Unit(benchmark::kMillisecond)->Iterations(1);

/// 71914: 23 balls in one row.
void ball_row(benchmark::State& state) {
  const auto* p = settling().parameters.bearings[1].touchdown();
  const auto data =
      touchdown_data("TB2", *p, settling().parameters.contact, {{2e11, 0.3}, {2e11, 0.3}, {}, 0., false, 0., {}});
  const BallRow row(data.rows[0], {});
  BallRowInput in;
  in.displacement.y = -10e-6;
  in.rate.y = -0.01;
  BallRowOutput out;
  for (auto _ : state) {
    row.evaluate_translations(in, out);
    benchmark::DoNotOptimize(&out);
  }
  state.counters["per_ball"] =
      benchmark::Counter(static_cast<double>(p->balls_per_row),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(ball_row);

/// The reference drop, 0.3 s, without start-up and files. Counter "of_real_time": CPU time over simulated time.
void drop(benchmark::State& state, IntegrationMethod method, double step_or_tolerance) {
  const auto machine = build_machine(settling().parameters, settling().tree);
  IntegrationParameters integration = settling().parameters.integration;
  integration.method = method;
  if (method == IntegrationMethod::runge_kutta_4)
    integration.step = step_or_tolerance;
  else
    integration.tolerance = step_or_tolerance;
  std::vector<double> y(machine->layout().size());
  const double end = settling().parameters.run.end_time;
  double cpu = 0.;
  long n_drops = 0, n_rhs = 0;
  for (auto _ : state) {
    machine->initial_state(y);
    const std::clock_t start = std::clock();
    const MachineSystem system(*machine);
    auto integrator = make_integrator(system, integration, 0., y, end);
    while (integrator->time() < end) integrator->advance();
    cpu += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    n_rhs = integrator->statistics().rhs_evaluations;
    ++n_drops;
  }
  state.counters["of_real_time"] = cpu / static_cast<double>(n_drops) / end;
  state.counters["right_hand_sides"] = static_cast<double>(n_rhs);
}
BENCHMARK_CAPTURE(drop, runge_kutta_4_5us, IntegrationMethod::runge_kutta_4, 5e-6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, runge_kutta_4_10us, IntegrationMethod::runge_kutta_4, 10e-6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, dormand_prince_3e_7, IntegrationMethod::dormand_prince, 3e-7)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, adams_1e_6, IntegrationMethod::adams, 1e-6)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
