// The compiled part of the Python package `rotordrop`. What users see is written in Python, in the folder rotordrop beside this file.
#include "base/version.h"
#include "case/program_files.h"
#include "python/bindings.h"

#include <pybind11/stl/filesystem.h>

PYBIND11_MODULE(_core, core) {
  namespace py = pybind11;
  using namespace rotordrop;
  core.doc() = "Compiled part of rotordrop; use the package rotordrop.";
  core.attr("version") = version();
  core.attr("git_revision") = git_revision();
  core.attr("relative_data") = ROTORDROP_RELATIVE_DATA;
  core.attr("relative_modules") = ROTORDROP_RELATIVE_MODULES;
  core.def("params_folder", &params_folder);
  core.def(
      "set_program_folders",
      [](const std::filesystem::path& params, const std::filesystem::path& modules) {
        set_program_folders({params, modules});
      },
      py::arg("params"), py::arg("modules"));
  python::add_errors(core);
  python::add_cases(core);
  python::add_drops(core);
  python::add_analyses(core);
  python::add_studies(core);
  python::add_own_supports(core);
  python::add_own_thermal(core);
}
