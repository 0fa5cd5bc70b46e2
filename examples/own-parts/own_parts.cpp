// A drop with two parts that rotordrop does not have: a snubber around the shaft, and a thermal model of the inner rings' walls.
//
//   own-parts CASE DIR [lumped|wall]
//
// The last word says whose growth the clearances feel. Results and report are those of rotordrop, with the series of both parts.
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "case/case.h"
#include "machine/build_machine.h"
#include "ring_wall.h"
#include "snubber.h"
#include "study/drop/drop_run.h"
#include "study/report/report.h"

using namespace rotordrop;

namespace {

std::unique_ptr<Machine> machine_of(const Case& drop_case, bool wall_drives) {
  const auto& p = drop_case.parameters;
  Machine::Parts parts = machine_parts(p, drop_case.tree);
  std::vector<BearingCircuitData> bearings;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) bearings.push_back(circuit_data(p, entry.name, *b));
  if (wall_drives) parts.driver = parts.thermal.size();
  parts.thermal.push_back({"wall", "/wall/", std::make_unique<RingWall>(bearings, p.run.ambient)});
  return std::make_unique<Machine>(std::move(parts));
}

void print(const Machine& machine, const DropResult& result) {
  const EnergyBalance e = machine.energy_balance(result.end_time, result.state);
  std::printf("%ld steps to %.6g s\n", result.statistics.steps, result.end_time);
  std::printf("energy [J]: %.3f dissipated, residual %.1e\n", e.dissipated, e.residual);
  for (std::size_t k = 0; k < e.heat.size(); ++k)
    std::printf("heat [J], model %s: %.3f deposited, %.3f stored, %.6f lost, residual %.1e\n",
                machine.thermal_name(k).c_str(), e.heat_deposited, e.heat[k].stored, e.heat[k].lost,
                e.heat[k].residual);
  for (std::size_t i = 0; i < machine.n_supports(); ++i)
    if (dynamic_cast<const Snubber*>(&machine.support(i)))
      std::printf("snubber %s: %.3f J of friction\n", machine.support(i).name().c_str(),
                  machine.ledger(i, "bush friction heat", result.state));
}

}  // namespace

int main(int argc, char** argv) {
  const bool wall_drives = argc == 4 && std::strcmp(argv[3], "wall") == 0;
  if (argc < 3 || argc > 4 || (argc == 4 && !wall_drives && std::strcmp(argv[3], "lumped") != 0)) {
    std::fprintf(stderr, "usage: %s CASE DIR [lumped|wall]\n", argv[0]);
    return 2;
  }
  try {
    add_support_kind("snubber", snubber_section(), [](const std::string& name, const SnubberParameters& p) {
      return std::make_unique<Snubber>(name, p);
    });
    const Case drop_case = read_case(argv[1]);
    const auto machine = machine_of(drop_case, wall_drives);
    RunOptions options;
    options.directory = argv[2];
    print(*machine, run_drop(drop_case, *machine, options));
    const RecordedDrop recorded(options.directory, drop_case);
    std::ofstream(options.directory / "report.html") << report_page(report_data(recorded));
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
