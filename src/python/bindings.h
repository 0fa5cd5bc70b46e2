#pragma once
// The parts of the compiled module `rotordrop._core`; each adds its names.
#include <pybind11/pybind11.h>

namespace rotordrop::python {

void add_errors(pybind11::module_& core);        ///< InputError, SolverError as exceptions of the package
void add_cases(pybind11::module_& core);         ///< reading, checking
void add_drops(pybind11::module_& core);         ///< runs, and their series in memory or in a folder
void add_analyses(pybind11::module_& core);      ///< modes, critical speeds, statics, preload, comparison
void add_studies(pybind11::module_& core);       ///< many drops of one case
void add_own_supports(pybind11::module_& core);  ///< supports written in Python
void add_own_thermal(pybind11::module_& core);   ///< thermal models written in Python

}  // namespace rotordrop::python
