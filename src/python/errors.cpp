#include "base/errors.h"

#include <filesystem>
#include <string_view>

#include "python/bindings.h"
#include "python/faults.h"
#include "python/own_parts.h"
#include "python/values.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

/// Fault of the package. A value that a program has given is in no file.
py::object to_python(const Fault& fault) {
  const bool is_given = fault.where.file.text().starts_with(given_mark);
  const std::string key = is_given ? fault.where.file.text().substr(std::string_view(given_mark).size()) : fault.key;
  return py::module_::import("rotordrop.errors")
      .attr("Fault")(key, is_given ? "" : fault.where.file.text(), fault.where.line, fault.where.column, fault.message,
                     fault.advice);
}

void raise(const char* name, const std::string& text, const py::tuple& faults) {
  const py::object kind = py::module_::import("rotordrop.errors").attr(name);
  const py::object error = kind(text, *faults);
  PyErr_SetObject(kind.ptr(), error.ptr());
}

}  // namespace

py::tuple faults_to_python(const std::vector<Fault>& faults) {
  py::list list;
  for (const auto& fault : faults) list.append(to_python(fault));
  return py::tuple(list);
}

void add_errors(py::module_& core) {
  static_cast<void>(core);
  // NOLINTNEXTLINE(performance-unnecessary-value-param): as pybind11 wants it
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error.what(), py::make_tuple(faults_to_python(error.faults())));
    } catch (const SolverError& error) {
      raise("SolverError", error.what(), py::tuple());
    } catch (const PartError& error) {
      raise("SolverError", error.what(), py::tuple());
    } catch (const Interruption& interruption) {
      try {
        std::rethrow_exception(interruption.raised);
      } catch (py::error_already_set& error) {
        error.restore();
      }
    } catch (const std::filesystem::filesystem_error& error) {
      py::object os_error = py::reinterpret_borrow<py::object>(PyExc_OSError);
      const py::object made = os_error(error.code().value(), error.code().message(), py::str(error.path1().string()));
      PyErr_SetObject(PyExc_OSError, made.ptr());
    }
  });
}

}  // namespace rotordrop::python
