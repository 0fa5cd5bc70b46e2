#include <cstdlib>

#include "case/modules/load_module.h"
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
  return function_in_module<MakeRanks>(
      {"rotordrop_mpi.so", "the MPI module", "mpirun",
       "Install openmpi-bin and libopenmpi-dev and build again, or start shards with --shard I/N."},
      Symbols::at_once, make_ranks_name)();
}

}  // namespace rotordrop
