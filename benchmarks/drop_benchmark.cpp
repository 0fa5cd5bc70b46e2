// What a drop costs: balls beside a yardstick, right-hand sides by kind of ring and balls, recorded rows, and the whole reference case against real
// time. Nothing is asserted. Run: build/release/rotordrop_benchmarks; benchmarks/performance.py makes a table of it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "analysis/drop_lanes.h"
#include "analysis/facts/thermal_report.h"
#include "base/aligned_numbers.h"
#include "base/cpu_time.h"
#include "base/exponent.h"
#include "case/built_machine.h"
#include "case/case.h"
#include "integrate/integrator.h"
#include "io/hdf5/recorder.h"
#include "machine/build_machine.h"
#include "machine/lanes/machine_lanes.h"
#include "study/drop/drop_run.h"
#include "study/rub/bore_report.h"
#include "yardstick.h"

namespace {

using namespace rotordrop;

const Case& settling() {
  static const Case c = read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml");
  return c;
}

/// A machine and its state in the middle of the first contact.
struct Contact {
  std::unique_ptr<Machine> machine;
  std::vector<double> y;
  double t = 0.0085;
  int n_balls = 0;
  explicit Contact(const Case& c = settling())
      : machine(build_machine(c.parameters, c.tree)), y(machine->layout().size()) {
    machine->initial_state(y);
    const MachineSystem system(*machine);
    auto integrator = make_integrator(system, c.parameters.integration, 0., y, t);
    while (integrator->time() < t) integrator->advance();
    y.assign(integrator->state().begin(), integrator->state().end());
    for (const auto& entry : c.parameters.bearings)
      n_balls += entry.touchdown()->rows * entry.touchdown()->balls_per_row;
  }
};

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

/// Seconds of one cycle of the processor, the least that was seen so far: a chain of dependent additions takes one each. Every call looks again, since
/// a processor that is shared may be slow for seconds.
double cycle() {
  static double shortest = 1.;
  for (int turn = 0; turn < 4; ++turn) {
    constexpr long n = 1000000;
    long x = 0;
    const std::clock_t start = std::clock();
    for (long i = 0; i < 8 * n; ++i) {
      ++x;
      benchmark::DoNotOptimize(x);
    }
    shortest = std::min(shortest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / (8. * n));
  }
  return shortest;
}

/// Counters: time and cycles for each of `n` things in an iteration.
void count_each(benchmark::State& state, const char* thing, double n) {
  using benchmark::Counter;
  state.counters[std::string("per_") + thing] = Counter(n, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters[std::string("cycles_per_") + thing] =
      Counter(n * cycle(), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// All rows of the reference machine, each call's displacement following from the call before, as in an integrator.
struct Rows {
  std::vector<BallRow> rows;
  std::vector<yardstick::Row> plain;
  double n_balls = 0;
  Rows() {
    for (const auto& entry : settling().parameters.bearings) {
      const auto data = touchdown_data(entry.name, *entry.touchdown(), settling().parameters.contact,
                                       {{2e11, 0.3}, {2e11, 0.3}, {}, 0., false, 0., {}});
      for (const auto& g : data.rows) {
        rows.emplace_back(g, std::vector<RaceWave>{});
        yardstick::Row row;
        const auto n = static_cast<std::size_t>(g.n_balls);
        if (n > yardstick::most_balls) throw std::logic_error("a row of more balls than the yardstick has");
        row.idle.fill(-1.);
        for (std::size_t j = 0; j < n; ++j) {
          const double azimuth = g.phase + 2. * std::numbers::pi * static_cast<double>(j) / g.n_balls;
          row.cosine[j] = std::cos(azimuth);
          row.sine[j] = std::sin(azimuth);
          row.idle[j] = 0.;
        }
        row.n_vectors = filled_up(n) / vector_length;
        row.A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
        row.radial = row.A * std::cos(g.contact_angle) - g.radial_clearance;
        row.axial = g.direction * (row.A * std::sin(g.contact_angle) + g.preload_offset);
        row.K = g.stiffness;
        row.damping = 1.5 * g.damping_beta;
        plain.push_back(row);
        n_balls += g.n_balls;
      }
    }
  }
};
constexpr double lean = -10e-6;  // [m]
double displaced(double force) { return lean + 1e-13 * force; }

/// @param tractions  null: without them
void sum_balls(benchmark::State& state, RowTractions* tractions) {
  const Rows all;
  BallRowInput in;
  in.displacement.y = lean;
  in.rate.y = -0.01;
  in.cage_speed = 300.;
  BallRowOutput out;
  for (auto _ : state) {
    double force = 0.;
    for (const auto& row : all.rows) {
      row.evaluate_translations(in, out, tractions);
      force += out.force_y;
    }
    in.displacement.y = displaced(force);
  }
  count_each(state, "ball", all.n_balls);
  state.counters["force"] = in.displacement.y;
}
void balls(benchmark::State& state) { sum_balls(state, nullptr); }
BENCHMARK(balls);
/// As at the end of every step.
void balls_and_their_tractions(benchmark::State& state) {
  RowTractions tractions{};
  sum_balls(state, &tractions);
  state.counters["outer_load"] = tractions.outer_load;
}
BENCHMARK(balls_and_their_tractions);

void balls_of_the_yardstick(benchmark::State& state) {
  const Rows all;
  if (all.plain.size() != 3) return state.SkipWithError("the reference machine has three rows");
  yardstick::Motion m;
  m.y = lean;
  m.vy = -0.01;
  std::array<yardstick::Sums, 3> sums;
  for (auto _ : state) {
    wide<yardstick::sum_rows<3>>(all.plain.data(), m, sums.data());
    m.y = displaced(sums[0].fy + sums[1].fy + sums[2].fy);
  }
  count_each(state, "ball", all.n_balls);
  state.counters["force"] = m.y;
}
BENCHMARK(balls_of_the_yardstick);

/// A contact's power, each argument following from the power before, as penetrations do from forces.
template <class Exponent>
void contact_power(benchmark::State& state, const Exponent& n) {
  using std::pow;
  double delta = 1e-6;
  for (auto _ : state) {
    delta = 1e-6 + 1e-9 * pow(delta, n);
    benchmark::DoNotOptimize(delta);
  }
  count_each(state, "power", 1.);
}
void power_from_tables(benchmark::State& state) { contact_power(state, ExponentOf<double>(10. / 9.)); }
BENCHMARK(power_from_tables);
void power_of_the_library(benchmark::State& state) { contact_power(state, 10. / 9.); }
BENCHMARK(power_of_the_library);

/// A right-hand side in the first contact, by kind of rings and balls.
void right_hand_side_of(benchmark::State& state, const std::vector<std::string>& settings) {
  const Case c = read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml", settings);
  const Contact contact(c);
  std::vector<double> dydt(contact.y.size());
  Evaluation found;
  for (auto _ : state) {
    contact.machine->evaluate(contact.t, contact.y, dydt, found);
    benchmark::DoNotOptimize(dydt.data());
  }
  count_each(state, "call", 1.);
  count_each(state, "ball", static_cast<double>(contact.n_balls));
  state.counters["states"] = static_cast<double>(contact.y.size());
}
const std::string free_rings = "bearings.ring_motion=free", inertial = "bearings.ball_model=inertial",
                  bent = "bearings.ring_bending=arc";
// The third order of Neisi 2019, table 4: on both races and in the bore.
const std::string wavy =
    "bearings.waviness=[{surface=\"inner\",order=3,amplitude=\"1 um\"},"
    "{surface=\"outer\",order=3,amplitude=\"1 um\"},{surface=\"bore\",order=3,amplitude=\"1 um\"}]";
BENCHMARK_CAPTURE(right_hand_side_of, rigid_rings, std::vector<std::string>{});
BENCHMARK_CAPTURE(right_hand_side_of, free_rings, std::vector<std::string>{free_rings});
BENCHMARK_CAPTURE(right_hand_side_of, wavy_races_and_bores, std::vector<std::string>{wavy});
BENCHMARK_CAPTURE(right_hand_side_of, inertial_balls, std::vector<std::string>{inertial});
BENCHMARK_CAPTURE(right_hand_side_of, bent_rings, std::vector<std::string>{bent});
BENCHMARK_CAPTURE(right_hand_side_of, bent_rings_and_inertial_balls, std::vector<std::string>{bent, inertial});

/// A row of the reference drop's results, appended and written.
void recorded_row(benchmark::State& state) {
  const auto machine = build_machine(settling().parameters, settling().tree);
  SeriesGroup group{"/time", {}};
  for (const auto* list : {&machine->step_observables(), &machine->state_observables()})
    for (const auto& o : *list) group.channels.push_back({o.name, o.unit, o.long_name, o.size, o.columns});
  const auto file =
      std::filesystem::temp_directory_path() / ("rotordrop-benchmark-" + std::to_string(::getpid()) + ".h5");
  constexpr int n_rows = 6000;
  std::size_t n_values = 0;
  for (auto _ : state) {
    state.PauseTiming();
    RecorderOptions options;
    options.overwrite = true;
    Recorder recorder(file, {}, {group}, options);
    n_values = recorder.row_size(0);
    std::vector<double> row(n_values, 1.);
    state.ResumeTiming();
    for (int i = 0; i < n_rows; ++i) {
      row[static_cast<std::size_t>(i) % n_values] = i;
      recorder.append(0, 5e-5 * i, row);
    }
    recorder.close();
  }
  std::filesystem::remove(file);
  count_each(state, "row", n_rows);
  state.counters["values"] = static_cast<double>(n_values);
}
BENCHMARK(recorded_row)->Unit(benchmark::kMillisecond);

/// Local temperatures and wear of the reference drop's first bearing, from its rows.
void local_rub(benchmark::State& state) {
  const auto machine = build_machine(settling().parameters, settling().tree);
  const FinishedDrop finished = run_drop_in_memory(settling(), *machine, {});
  const auto [name, bearing] = finished.recorded->bearings().front();
  const RubRecord record = rub_record(*finished.recorded, name);
  const LocalRubSettings settings = local_rub_settings(settling().parameters, name, bearing);
  for (auto _ : state) benchmark::DoNotOptimize(local_rub(record, settings));
  count_each(state, "row", static_cast<double>(record.times.size()));
}
BENCHMARK(local_rub)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

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
BENCHMARK_CAPTURE(drop, two_step_1e_6, IntegrationMethod::two_step_runge_kutta, 1e-6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, tsitouras_1e_6, IntegrationMethod::tsitouras, 1e-6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, dormand_prince_3e_7, IntegrationMethod::dormand_prince, 3e-7)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drop, adams_1e_6, IntegrationMethod::adams, 1e-6)->Unit(benchmark::kMillisecond);

/// Eight drops over friction and damping by the method of their case, in memory with all that is watched in a drop, without series.
class EightDrops {
 public:
  EightDrops() {
    for (int k = 0; k < 8; ++k) {
      cases_.push_back(read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml",
                                 {"contact.friction_coefficient=" + std::to_string(0.06 + 0.01 * k),
                                  "bearings.TB1.support.C_y=" + std::to_string(3000 + 200 * k)}));
      machines_.push_back(build_machine(cases_.back().parameters, cases_.back().tree));
    }
  }
  /// CPU time of all of them [s]. @param run  of their drops
  template <class Run>
  double cpu_time(Run&& run) const {
    std::vector<std::unique_ptr<Drop>> drops;
    std::vector<Drop*> list;
    for (std::size_t k = 0; k < cases_.size(); ++k) {
      const auto& p = cases_[k].parameters;
      drops.push_back(std::make_unique<Drop>(*machines_[k], p, p.integration, p.output));
      list.push_back(drops.back().get());
    }
    const double start = cpu_seconds();
    run(list);
    return cpu_seconds() - start;
  }

 private:
  std::vector<Case> cases_;
  std::vector<std::unique_ptr<Machine>> machines_;
};

/// Drops in lanes beside the same drops one by one, by turns. Counters: milliseconds of each per drop, and how many times the throughput is.
void lanes(benchmark::State& state) {
  const EightDrops eight;
  std::vector<double> together, one_by_one, ratios;
  for (auto _ : state)
    for (int turn = 0; turn < 5; ++turn) {
      one_by_one.push_back(eight.cpu_time([](const std::vector<Drop*>& drops) {
        for (Drop* drop : drops) drop->run();
      }));
      together.push_back(eight.cpu_time([](const std::vector<Drop*>& drops) { run_in_lanes(drops); }));
      ratios.push_back(one_by_one.back() / together.back());
    }
  for (auto* list : {&together, &one_by_one, &ratios}) std::sort(list->begin(), list->end());
  const auto middle = [](const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; };
  state.counters["lane_drop_ms"] = 1e3 * middle(together) / 8.;
  state.counters["single_drop_ms"] = 1e3 * middle(one_by_one) / 8.;
  state.counters["times"] = middle(ratios);
  state.counters["times_least"] = ratios.front();
  state.counters["times_largest"] = ratios.back();
}
BENCHMARK(lanes)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The settling drop of a machine, in memory with all that is watched in a drop, almost without rows.
class OneDrop {
 public:
  explicit OneDrop(std::vector<std::string> settings) : case_(with_few_rows(std::move(settings))), built_(case_) {}
  /// CPU time of a drop [s].
  double cpu_time() {
    const auto& p = case_.parameters;
    Drop drop(built_.machine(), p, p.integration, p.output, &built_.elements());
    const double start = cpu_seconds();
    drop.run();
    return cpu_seconds() - start;
  }

 private:
  static Case with_few_rows(std::vector<std::string> settings) {
    settings.insert(settings.end(), {"output.interval=0.1", "output.detail_interval=0.1"});
    return read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019-settling.toml", settings);
  }
  Case case_;
  BuiltMachine built_;
};

/// Drops with more than the reference case has, by turns with it. Counters: milliseconds of each, and by how much one takes longer.
void drop_with(benchmark::State& state, const std::vector<std::string>& settings) {
  OneDrop plain({}), with(settings);
  std::vector<double> of_plain, of_with, ratios;
  for (auto _ : state)
    for (int turn = 0; turn < 15; ++turn) {
      of_plain.push_back(plain.cpu_time());
      of_with.push_back(with.cpu_time());
      ratios.push_back(of_with.back() / of_plain.back());
    }
  for (auto* list : {&of_plain, &of_with, &ratios}) std::sort(list->begin(), list->end());
  state.counters["drop_ms"] = 1e3 * of_with.front();
  state.counters["plain_drop_ms"] = 1e3 * of_plain.front();
  state.counters["times"] = ratios[ratios.size() / 2];
  state.counters["times_low"] = ratios[ratios.size() / 4];
  state.counters["times_high"] = ratios[3 * ratios.size() / 4];
}
// What the turns themselves leave: 1 by right.
BENCHMARK_CAPTURE(drop_with, nothing, std::vector<std::string>{})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(drop_with, finite_elements_beside, std::vector<std::string>{"thermal.models=[\"lumped\", \"fe\"]"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(drop_with, waves, std::vector<std::string>{wavy})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(drop_with, inertial_balls, std::vector<std::string>{inertial})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(drop_with, bent_rings, std::vector<std::string>{bent})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(drop_with, all_modes, std::vector<std::string>{"rotor.model=full"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// A right-hand side in lanes, of all eight.
void right_hand_side_in_lanes(benchmark::State& state) {
  const Contact contact;
  const std::vector<const Machine*> machines(LaneSystem::width, contact.machine.get());
  const auto system = make_lanes(machines);
  constexpr std::size_t width = LaneSystem::width;
  std::vector<double> t(width, contact.t);
  AlignedNumbers y, dydt(contact.y.size() * width);
  for (const double value : contact.y) y.insert(y.end(), width, value);
  for (auto _ : state) {
    system->rates(t, y, dydt);
    benchmark::DoNotOptimize(dydt.data());
  }
  count_each(state, "drop", width);
}
BENCHMARK(right_hand_side_in_lanes);

}  // namespace

BENCHMARK_MAIN();
