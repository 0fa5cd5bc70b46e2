#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "base/parameters/suggestion.h"
#include "case/built_machine.h"
#include "io/own_files.h"
#include "python/bindings.h"
#include "python/values.h"
#include "python/watch.h"
#include "study/drop/drop_run.h"
#include "study/finished_run.h"
#include "study/report/report.h"
#include "study/result_names.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

using Recorded = std::shared_ptr<const RecordedDrop>;

/// What Python gets of a drop that has run.
struct PythonRun {
  Recorded recorded;
  nlohmann::ordered_json summary;
  bool is_completed = false;
  std::vector<std::string> notes;
};

/// Calls a Python function from a run without Python's lock. None: nothing.
std::function<void(const Progress&)> report_to(const py::object& progress) {
  if (progress.is_none()) return {};
  return [&progress](const Progress& p) {
    const py::gil_scoped_acquire lock;
    progress(p);
  };
}

/// @throws InputError for a path that no series of the case's drop has; windows' are known to the drop alone
void require_known_series(const Machine& machine, const std::set<std::string>& paths) {
  const auto known = series_of(machine);
  for (const auto& path : paths)
    if (!path.starts_with("/windows/") && std::find(known.begin(), known.end(), path) == known.end())
      throw InputError({"keep", 0, 0}, "a drop of this case has no series " + path + ".",
                       suggestion(path, known, "docs/reference/results.md lists them."));
}

PythonRun run_in_memory(const Case& c, const std::optional<std::set<std::string>>& kept, const py::object& progress) {
  const ActiveRun active;
  PythonRun drop;
  Watch watch;
  MemoryRunOptions options;
  options.is_stopped = watch.as_condition();
  if (kept) options.is_kept = [&](const std::string& path) { return kept->contains(path); };
  options.report = report_to(progress);
  options.tell = [&](const std::string& note) { drop.notes.push_back(note); };
  const py::gil_scoped_release others_may_run;
  BuiltMachine built(c);
  if (kept) require_known_series(built.machine(), *kept);
  options.elements = &built.elements();
  FinishedDrop run = run_drop_in_memory(c, built.machine(), options);
  drop.recorded = std::move(run.recorded);
  drop.summary = summary_json(run.summary);
  drop.is_completed = run.completed;
  return drop;
}

PythonRun run_in_folder(const Case& c, const std::filesystem::path& directory, bool force, bool resume,
                        const py::object& progress) {
  StoppableRun stoppable(progress);
  PythonRun drop;
  RunOptions options;
  options.directory = directory;
  options.force = force;
  options.resume = resume;
  options.stop = stoppable.stop();
  options.tell = [&](const std::string& note) { drop.notes.push_back(note); };
  options.report = [&](const Progress& p) { stoppable.report(p); };
  {
    const py::gil_scoped_release others_may_run;
    BuiltMachine built(c);
    options.elements = &built.elements();
    FinishedDrop run = run_drop(c, built.machine(), options);
    drop.summary = summary_json(run.summary);
    drop.is_completed = run.completed;
    if (run.completed) write_files_of_finished_run(directory, *run.recorded, resume, options.tell);
    drop.recorded = std::make_shared<const RecordedDrop>(directory, c);  // all of its series
  }
  stoppable.raise();
  return drop;
}

/// Numbers of a dataset without a copy: [rows], or [rows, columns] if it has columns.
py::array values_of(const Recorded& recorded, const std::string& path, bool has_columns) {
  const auto& table = recorded->table(path);
  const auto n_columns = static_cast<py::ssize_t>(table.n_columns);
  const auto n = static_cast<py::ssize_t>(table.values.size()) / n_columns;
  const py::capsule keeper(new Recorded(recorded), [](void* p) { delete static_cast<Recorded*>(p); });
  py::array_t<double> array = has_columns || n_columns > 1
                                  ? py::array_t<double>({n, n_columns}, table.values.data(), keeper)
                                  : py::array_t<double>(n, table.values.data(), keeper);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace

void add_drops(py::module_& core) {
  py::class_<Progress>(core, "Progress", "Progress of a run.")
      .def_readonly("time", &Progress::time, "simulated [s]")
      .def_readonly("end_time", &Progress::end_time, "simulated, at the latest [s]")
      .def_readonly("wall_time", &Progress::wall_time, "since the start [s]")
      .def_readonly("wall_time_left", &Progress::wall_time_left, "estimate [s]")
      .def_readonly("rotor_speed", &Progress::rotor_speed, "[rad/s]")
      .def_readonly("largest_contact_force", &Progress::largest_contact_force, "so far [N]")
      .def_readonly("inner_ring_temperature", &Progress::inner_ring_temperature, "warmest inner ring [K], or NaN");

  py::class_<RecordedDrop, std::shared_ptr<RecordedDrop>>(core, "RecordedDrop", "Series of a drop.")
      .def_property_readonly("case_name", &RecordedDrop::case_name)
      .def_property_readonly("driver", &RecordedDrop::driver)
      .def_property_readonly("datasets", &RecordedDrop::datasets)
      .def("meaning",
           [](const RecordedDrop& drop, const std::string& path) {
             const auto m = drop.meaning(path);
             return py::make_tuple(m.unit, m.long_name, m.time_path, m.columns);
           })
      .def("values", [](const std::shared_ptr<RecordedDrop>& drop, const std::string& path, bool has_columns) {
        return values_of(drop, path, has_columns);
      });
  core.def("open_results",
           [](const std::filesystem::path& directory) { return std::make_shared<RecordedDrop>(directory); });

  py::class_<PythonRun>(core, "Drop", "A drop that has run.")
      .def_property_readonly("recorded",
                             [](const PythonRun& drop) { return std::const_pointer_cast<RecordedDrop>(drop.recorded); })
      .def_property_readonly("summary", [](const PythonRun& drop) { return to_python(drop.summary); })
      .def_readonly("completed", &PythonRun::is_completed)
      .def_readonly("notes", &PythonRun::notes);
  core.def("run_in_memory", &run_in_memory, py::arg("case"), py::arg("kept"), py::arg("progress"));
  core.def("run_in_folder", &run_in_folder, py::arg("case"), py::arg("directory"), py::arg("force"), py::arg("resume"),
           py::arg("progress"));
  core.def("meaning_of", [](const std::string& name) {
    const auto m = meaning_of(name);
    return py::make_tuple(m.unit, m.long_name);
  });
  core.def("summary_text", [](const std::string& json) {
    try {
      return summary_text(recorded_summary(nlohmann::ordered_json::parse(json)));
    } catch (const nlohmann::json::exception& error) {
      throw InputError({"summary.json", 0, 0},
                       std::string("this summary is not what the program wrote: ") + error.what() + ".",
                       "Run the case again.");
    }
  });
  core.def("write_report", [](const std::filesystem::path& directory, const std::filesystem::path& file) {
    const OthersMayRun others_may_run;
    const RecordedDrop drop(directory);
    write_page(file, report_page(report_data(drop)));
  });

  py::module_::import("atexit").attr("register")(py::cpp_function(&end_active_runs));
}

}  // namespace rotordrop::python
