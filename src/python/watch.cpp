#include "python/watch.h"

#include <atomic>
#include <thread>

#include "base/errors.h"

namespace rotordrop::python {

namespace {

std::atomic<int> n_active = 0;
std::atomic<bool> is_leaving = false;

}  // namespace

ActiveRun::ActiveRun() {
  if (is_leaving) throw SolverError("Python ends.");
  ++n_active;
}
ActiveRun::~ActiveRun() { --n_active; }

void end_active_runs() {
  is_leaving = true;
  const py::gil_scoped_release others_may_run;
  while (n_active > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void Watch::look() {
  if (is_leaving) throw SolverError("Python ends, and with it this run.");
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

std::function<bool()> Watch::as_condition() {
  // A look at the clock costs a hundredth of a cheap step.
  return [this] {
    if (++calls_ % 8 == 0) look();
    return false;
  };
}

}  // namespace rotordrop::python
