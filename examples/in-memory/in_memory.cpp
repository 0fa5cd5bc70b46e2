// Two drops in two threads, each from the text of a case to numbers, without a file: peak force, the course of the contact force, and how far the
// lumped circuit and the finite elements are apart.
//
//   in-memory FOLDER      FOLDER holds neisi2019-settling.toml, such as rotordrop's params
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "analysis/memory_series.h"
#include "case/built_machine.h"
#include "case/case_text.h"
#include "study/time_series.h"

using namespace rotordrop;

namespace {

/// What one wants to know of a drop.
struct Findings {
  double peak_force = 0, peak_time = 0;  // of TB1 [N], [s]
  SeriesInMemory force;                  // of TB1 [N]
  Difference inner_ring, bore;           // finite elements less circuit: temperature [K], growth of the bore [m]
  double energy_residual = 0;            // [J]
  std::exception_ptr error;
};

TimeSeries line(const SeriesInMemory& s) { return {s.times, s.values}; }

Findings find(const std::string& text, const std::string& folder) {
  const Case c = read_case_text(text, folder);
  BuiltMachine built(c);
  Drop drop(built.machine(), c.parameters, c.parameters.integration, c.parameters.output, &built.elements());
  const MemorySeries series(built.machine(), drop);
  drop.run();

  Findings found;
  found.peak_force = drop.scalars().of(0).contact_force.value;
  found.peak_time = drop.scalars().of(0).contact_force.time;
  found.force = series.series("/bearings/TB1/contact_force");
  found.inner_ring = difference_of(line(series.series("/thermal/TB1/inner_ring")),
                                   line(series.series("/fe/TB1/inner_ring")), {.floor = 0.01});
  constexpr std::size_t bore = 1;  // after the shaft
  found.bore = difference_of(line(series.series("/growth/lumped/TB1", bore)),
                             line(series.series("/growth/fe/TB1", bore)), {.floor = 1e-9});
  const DropResult result = drop.result();
  found.energy_residual = built.machine().energy_balance(result.end_time, result.state).residual;
  return found;
}

std::string case_text(const std::string& speed) {
  return "base = \"neisi2019-settling.toml\"\n"
         "[run]\n"
         "end_time = \"20 ms\"\n"
         "initial_speed = \"" +
         speed +
         "\"\n"
         "[thermal]\n"
         "models = [\"lumped\", \"fe\"]\n"
         "[thermal.fe]\n"
         "section = \"plain\"\n"
         "degree = 1\n"
         "refinement = 0.5\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  const std::array<std::string, 2> speeds = {"15200 rpm", "7600 rpm"};
  std::array<Findings, 2> found;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] {
      try {
        found[i] = find(case_text(speeds[i]), argv[1]);
      } catch (...) {
        found[i].error = std::current_exception();
      }
    });
  for (auto& thread : threads) thread.join();
  try {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Findings& f = found[i];
      if (f.error) std::rethrow_exception(f.error);
      const double largest = *std::max_element(f.force.values.begin(), f.force.values.end());
      std::printf(
          "%s: peak force %.6f N at %.4f ms, largest of %zu rows %.6f N; inner ring %.6g K and bore %.6g nm apart; "
          "energy residual %.1e J\n",
          speeds[i].c_str(), f.peak_force, f.peak_time * 1e3, f.force.values.size(), largest, f.inner_ring.largest,
          f.bore.largest * 1e9, f.energy_residual);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
