#pragma once
#include <memory>
#include <mutex>

#include "case/case.h"
#include "machine/heat/finite_elements.h"
#include "model/heat_conduction.h"
#include "model/section_mesher.h"
#include "model/thermo_elasticity.h"

namespace rotordrop {

/// Entry points of the finite-element modules for a case with finite elements, which must outlive them. What was computed before comes from the cache; the module is
/// loaded when something new is asked.
FiniteElements finite_elements_of(const Case& drop_case);

/// To be held while machines with finite elements are built: meshes come from one generator for the whole process.
std::mutex& section_lock();

/// Processes that mpirun has started together: 1 without it.
[[nodiscard]] int ranks_of_mpirun();

/// A solver of the finite-element room, which is a module beside the program: loaded once something is asked that is not in the cache.
/// @throws InputError then, if the program was built without it
std::unique_ptr<HeatConductionSolver> make_heat_solver(const HeatConductionProblem& problem);

/// Loads its elasticity solver. @throws InputError likewise
std::unique_ptr<ElasticSolver> make_elastic_solver(const ElasticProblem& problem);

/// The mesh of a plan, from the cache or from the mesh room. @throws InputError if it is needed and the program was built without it
SectionMesh section_mesh_of(const SectionPlan& plan);

/// Loads the mesh room, another module beside the program. It keeps its one generator, and stays loaded.
/// @throws InputError if the program was built without it
SectionMesher& section_mesher();

}  // namespace rotordrop
