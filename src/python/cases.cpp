#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "case/case_text.h"
#include "machine/build_machine.h"
#include "python/bindings.h"
#include "python/faults.h"
#include "python/values.h"
#include "python/watch.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

Case read_from(const std::filesystem::path& file, const py::object& text, const py::object& tree,
               const std::vector<py::dict>& layers, const std::filesystem::path& folder) {
  GivenCase given{file, {}, {}, folder};
  if (!text.is_none()) given.text = text.cast<std::string>();
  if (!tree.is_none()) given.tree = to_node(tree, "");
  const auto settings = to_settings(layers);
  const OthersMayRun others_may_run;
  return read_given_case(given, settings);
}

}  // namespace

void add_cases(py::module_& core) {
  py::class_<Case, std::shared_ptr<Case>>(core, "Case", "A case as read, checked and completed.")
      .def_readonly("name", &Case::name)
      .def_readonly("file", &Case::file)
      .def_property_readonly("resolved", [](const Case& c) { return c.resolved.text; })
      .def_property_readonly("warnings", [](const Case& c) { return faults_to_python(c.warnings); })
      .def_property_readonly("bearings",
                             [](const Case& c) {
                               py::dict kinds;
                               for (const auto& entry : c.parameters.bearings)
                                 kinds[py::str(entry.name)] = entry.touchdown() ? "touchdown"
                                                              : entry.linear()  ? "linear"
                                                              : entry.magnet()  ? "magnet"
                                                                                : "other";
                               return kinds;
                             })
      .def_property_readonly("asks_for_second_opinion", [](const Case& c) { return c.parameters.run.second_opinion; })
      .def_property_readonly("initial_speed", [](const Case& c) { return c.parameters.run.initial_speed; });
  core.def("read_case", &read_from, py::arg("file"), py::arg("text"), py::arg("tree"), py::arg("layers"),
           py::arg("folder"));
}

}  // namespace rotordrop::python
