#include "study/fe_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/errors.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

// Beside the program, or in the folder that ROTORDROP_MODULES names.
fs::path module_file() {
  const fs::path name = ROTORDROP_FE_MODULE;
  if (name.empty()) return {};
  if (const char* chosen = std::getenv("ROTORDROP_MODULES")) return fs::path(chosen) / name;
  return fs::read_symlink("/proc/self/exe").parent_path() / name;
}

MakeHeatSolver* load() {
  const fs::path file = module_file();
  if (file.empty() || !fs::exists(file))
    throw InputError({}, "this program was built without the finite-element room, which `rotordrop heat` needs",
                     "Install its libraries with ./install-dependencies --fe, then build with\n"
                     "cmake --preset release -DROTORDROP_FE=ON && cmake --build build/release");
  // Local symbols: the room brings libraries of its own, among them another build of HDF5 than ours.
  void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!module) throw SolverError("the finite-element room cannot be loaded: " + std::string(dlerror()));
  auto* const make = reinterpret_cast<MakeHeatSolver*>(dlsym(module, make_heat_solver_name));
  if (!make) throw SolverError("the finite-element room " + file.string() + " is of another version");
  return make;
}

}  // namespace

std::unique_ptr<HeatConductionSolver> make_heat_solver(const HeatConductionProblem& problem) {
  static MakeHeatSolver* const make = load();
  return std::unique_ptr<HeatConductionSolver>(make(problem));
}

FiniteElements finite_elements_of(const Case& drop_case) {
  FiniteElements elements;
  elements.make_solver = make_heat_solver;
  (void)drop_case;
  return elements;
}

}  // namespace rotordrop
