#include "case/modules/fe_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/errors.h"
#include "base/version.h"
#include "cache/kept_elastic_solver.h"
#include "cache/kept_heat_solver.h"
#include "cache/kept_mesh.h"
#include "cache/kept_values.h"
#include "case/bearing_mesh.h"
#include "case/modules/load_module.h"
#include "case/program_files.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

template <class Function>
Function* load(const char* file, const char* room, const char* needed_by, const char* function) {
  return function_in_module<Function>({file, room, needed_by,
                                       "Install its libraries with ./install-dependencies, then build with\n"
                                       "cmake --preset release -DROTORDROP_FE=ON && cmake --build build/release"},
                                      Symbols::when_called, function);
}

/// Tells one build of a module from another, without loading it.
std::string version_of(const std::string& module) {
  std::error_code error;
  const fs::path file = module_file(module);
  const auto size = fs::file_size(file, error);
  if (module.empty() || error) return {};
  return fmt::format("{} {} {} {}", version(), module, size,
                     fs::last_write_time(file, error).time_since_epoch().count());
}

/// The room's own.
std::unique_ptr<HeatConductionSolver> real_heat_solver(const HeatConductionProblem& problem) {
  static auto* const make =
      load<MakeHeatSolver>(ROTORDROP_FE_MODULE, "the finite-element module", "`rotordrop heat`", make_heat_solver_name);
  return std::unique_ptr<HeatConductionSolver>(make(problem));
}

}  // namespace

std::mutex& section_lock() {
  static std::mutex lock;
  return lock;
}

int ranks_of_mpirun() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(variable)) return std::max(std::atoi(text), 1);
  return 1;
}

std::unique_ptr<HeatConductionSolver> make_heat_solver(const HeatConductionProblem& problem) {
  // Several ranks share each step.
  if (ranks_of_mpirun() > 1) return real_heat_solver(problem);
  return kept_heat_solver(cache_folder(), version_of(ROTORDROP_FE_MODULE), problem, real_heat_solver);
}

std::unique_ptr<ElasticSolver> make_elastic_solver(const ElasticProblem& problem) {
  static auto* const make = load<MakeElasticSolver>(ROTORDROP_FE_MODULE, "the finite-element module",
                                                    "thermal.expansion = \"elastic\"", make_elastic_solver_name);
  return std::unique_ptr<ElasticSolver>(make(problem));
}

FiniteElements finite_elements_of(const Case& drop_case) {
  FiniteElements elements;
  elements.make_solver = make_heat_solver;
  elements.make_elastic_solver = [](const ElasticProblem& problem) {
    return kept_elastic_solver(cache_folder(), version_of(ROTORDROP_FE_MODULE), problem, make_elastic_solver);
  };
  elements.make_mesh = [&drop_case](const std::string& bearing) { return bearing_mesh(drop_case, bearing); };
  return elements;
}

SectionMesh section_mesh_of(const SectionPlan& plan) {
  return kept_mesh(cache_folder(), version_of(ROTORDROP_MESH_MODULE), plan,
                   [](const SectionPlan& p) { return section_mesher().mesh(p); });
}

SectionMesher& section_mesher() {
  static auto* const get = load<GetSectionMesher>(ROTORDROP_MESH_MODULE, "the mesh module", "the mesh of a bearing",
                                                  get_section_mesher_name);
  return *get();
}

}  // namespace rotordrop
