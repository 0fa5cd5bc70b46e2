#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "io/own_files.h"
#include "python/bindings.h"
#include "python/faults.h"
#include "python/values.h"
#include "python/watch.h"
#include "study/many/answers/study_report.h"
#include "study/many/search/search_run.h"
#include "study/many/search/search_space.h"
#include "study/many/study_folder.h"
#include "study/many/study_run.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

struct StudyCall {
  std::filesystem::path directory;
  unsigned n_workers = 0;
  bool force = false, resume = false;
};

/// Ctrl-C, and what the caller's function raises, stop it as Ctrl-C stops the program: the journal keeps the points that are finished.
py::dict run(const std::filesystem::path& file, const std::vector<std::string>& overrides, const StudyCall& call,
             const py::object& progress, const py::object& warn) {
  StoppableRun stoppable(progress);
  std::vector<std::string> notes;
  StudyOptions options;
  options.directory = call.directory;
  options.n_workers = call.n_workers;
  options.force = call.force;
  options.resume = call.resume;
  options.stop = stoppable.stop();
  options.tell = [&](const std::string& note) { notes.push_back(note); };
  options.report = [&](const StudyProgress& p) { stoppable.report(p); };
  StudyOutcome outcome;
  {
    const py::gil_scoped_release others_may_run;
    Study study = read_study(file, overrides);
    {
      const py::gil_scoped_acquire lock;
      warn(faults_to_python(study.base.warnings));
    }
    const Design design = study.is_search() ? SearchSpace(study).corners() : make_design(study);
    Watch watch;
    const auto unusual = check_points(study, design, call.n_workers, [&watch] { watch.look(); });
    {
      const py::gil_scoped_acquire lock;
      warn(faults_to_python(unusual));
    }
    probe_results(study, design, options.evaluate);
    if (const auto note = choose_lanes(study, design); !note.empty()) options.tell(note);
    outcome = study.is_search() ? run_search(study, options) : run_study(study, design, options);
    if (outcome.is_complete) renew_page(options.directory);
  }
  stoppable.raise();
  py::dict told;
  told["points"] = outcome.n_points;
  told["done"] = outcome.done;
  told["failed"] = outcome.failed;
  told["complete"] = outcome.is_complete;
  told["cpu_time"] = outcome.cpu_time;
  told["wall_time"] = outcome.wall_time;
  told["notes"] = notes;
  return told;
}

}  // namespace

void add_studies(py::module_& core) {
  py::class_<StudyProgress>(core, "StudyProgress", "Progress of a study.")
      .def_readonly("done", &StudyProgress::done, "drops that are done")
      .def_readonly("failed", &StudyProgress::failed, "drops that failed")
      .def_readonly("total", &StudyProgress::total, "drops of the study")
      .def_readonly("per_second", &StudyProgress::per_second, "drops a second")
      .def_readonly("time_left", &StudyProgress::time_left, "estimate [s], NaN at first")
      .def_readonly("making", &StudyProgress::making,
                    "what is made of the results, once all drops are finished: surrogates; empty before");
  core.def(
      "run_study",
      [](const std::filesystem::path& file, const std::vector<std::string>& overrides,
         const std::filesystem::path& directory, unsigned jobs, bool force, bool resume, const py::object& progress,
         const py::object& warn) {
        return run(file, overrides, {directory, jobs, force, resume}, progress, warn);
      },
      py::arg("file"), py::arg("overrides"), py::arg("directory"), py::arg("jobs"), py::arg("force"), py::arg("resume"),
      py::arg("progress"), py::arg("warn"));
  core.def("write_study_report", [](const std::filesystem::path& directory, const std::filesystem::path& file) {
    const OthersMayRun others_may_run;
    write_page(file, study_report_page(study_report_data(directory)));
  });
}

}  // namespace rotordrop::python
