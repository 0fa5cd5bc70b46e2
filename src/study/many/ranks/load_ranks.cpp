#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/errors.h"
#include "case/program_files.h"
#include "study/many/ranks/ranks.h"

namespace rotordrop {
namespace {

/// What the launchers of Open MPI, MPICH and Slurm tell their processes.
bool is_started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

Ranks* ranks_of_this_process() {
  if (!is_started_by_mpi()) return nullptr;
  const auto file = module_file("rotordrop_mpi.so");
  if (!std::filesystem::exists(file))
    throw InputError({}, "this program was built without its MPI module, which mpirun needs",
                     "Install openmpi-bin and libopenmpi-dev and build again, or start shards with --shard I/N.");
  // Local: other modules bring libraries with an MPI of their own.
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw SolverError("the MPI module cannot be loaded: " + std::string(dlerror()));
  auto* const make = reinterpret_cast<MakeRanks*>(dlsym(handle, make_ranks_name));
  if (!make) throw SolverError("the MPI module " + file.string() + " belongs to another version of the program");
  return make();
}

}  // namespace rotordrop
