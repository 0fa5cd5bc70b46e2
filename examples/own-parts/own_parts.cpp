// A drop with two parts that rotordrop does not have: a snubber around the shaft, and a thermal model of the inner rings' walls.
//
//   own-parts CASE DIR [lumped|wall]
//
// The last word says whose growth the clearances feel. Results and report are those of rotordrop, with the series of both parts. `rotordrop` itself does the
// same with the module of this folder (module.cpp).
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/errors.h"
#include "case/case.h"
#include "machine/build_machine.h"
#include "parts.h"
#include "snubber.h"
#include "study/drop/drop_run.h"
#include "study/report/report.h"

using namespace rotordrop;

namespace {

void print(const Machine& machine, const DropResult& result) {
  const EnergyBalance e = machine.energy_balance(result.end_time, result.state);
  std::printf("%ld steps to %.6g s\n", result.statistics.steps, result.end_time);
  std::printf("energy [J]: %.3f dissipated, residual %.1e\n", e.dissipated, e.residual);
  for (std::size_t k = 0; k < e.heat.size(); ++k)
    std::printf("heat [J], model %s: %.3f deposited, %.3f stored, %.6f lost, residual %.1e\n",
                machine.thermal_name(k).c_str(), e.heat[k].deposited, e.heat[k].stored, e.heat[k].lost,
                e.heat[k].residual);
  for (std::size_t i = 0; i < machine.n_supports(); ++i)
    if (dynamic_cast<const Snubber*>(&machine.support(i)))
      std::printf("snubber %s: %.3f J of friction\n", machine.support(i).name().c_str(),
                  machine.ledger(i, "bush friction heat", result.state));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string driver = argc == 4 ? argv[3] : "lumped";
  if (argc < 3 || argc > 4 || (driver != "lumped" && driver != "wall")) {
    std::fprintf(stderr, "usage: %s CASE DIR [lumped|wall]\n", argv[0]);
    return 2;
  }
  try {
    LinkedParts parts;
    add_parts(parts);
    const Case drop_case = read_case(argv[1], {"thermal.driver=" + driver});
    const auto machine = build_machine(drop_case.parameters, drop_case.tree);
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
