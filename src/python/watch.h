#pragma once
// A run without Python's lock, and what Python wants of it: Ctrl-C, news of its progress, an end before the interpreter's.
#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>

namespace rotordrop::python {

/// Exists while a run goes on. The interpreter waits for all of them before it ends: a thread that asks for its lock after that is torn off.
class ActiveRun {
 public:
  ActiveRun();
  ~ActiveRun();
  ActiveRun(const ActiveRun&) = delete;
  ActiveRun& operator=(const ActiveRun&) = delete;
};
/// Asks all runs to end, and waits for them. Called by the interpreter at its end, with its lock.
void end_active_runs();

/// Looks for Ctrl-C every 50 ms of wall time. Made and destroyed with Python's lock, called without it.
class Watch {
 public:
  /// @throws pybind11::error_already_set (KeyboardInterrupt), or SolverError if the interpreter ends
  void look();
  /// As a condition for the end of a run, which is asked after every step.
  [[nodiscard]] std::function<bool()> as_condition();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  unsigned calls_ = 0;
};

}  // namespace rotordrop::python
