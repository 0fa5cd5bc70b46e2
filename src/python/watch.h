#pragma once
// A run without Python's lock, and what Python wants of it: Ctrl-C, news of its progress, an end before the interpreter's.
#include <pybind11/pybind11.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <functional>

namespace rotordrop::python {
namespace py = pybind11;

/// Exists while a run goes on. The interpreter waits for all of them before it ends: a thread that asks for its lock after that is torn off.
class ActiveRun {
 public:
  /// With Python's lock. @throws SolverError if the interpreter ends: nothing begins any more
  ActiveRun();
  ~ActiveRun();
  ActiveRun(const ActiveRun&) = delete;
  ActiveRun& operator=(const ActiveRun&) = delete;
};
/// Python's lock given back for as long as this exists; so long the interpreter does not end.
class OthersMayRun {
  ActiveRun active_;
  py::gil_scoped_release released_;  // taken again before the interpreter may end
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

/// A run that ends as the program does after a signal. Ctrl-C, and what the caller's function raises, stop it after the step under way; they
/// are raised when it has saved its state. Made and destroyed with Python's lock.
class StoppableRun {
 public:
  /// @param progress  called with what the run reports; None: nothing
  explicit StoppableRun(py::object progress) : progress_(std::move(progress)) {}
  [[nodiscard]] const volatile std::sig_atomic_t* stop() const { return &stop_; }
  /// Called by the run, without Python's lock.
  template <class News>
  void report(const News& news) {
    if (interruption_) return;
    try {
      watch_.look();
      if (progress_.is_none()) return;
      const py::gil_scoped_acquire lock;
      progress_(news);
    } catch (...) {
      interruption_ = std::current_exception();
      stop_ = 1;
    }
  }
  /// Raises what stopped it, if anything did. With Python's lock.
  void raise() const {
    if (interruption_) std::rethrow_exception(interruption_);
  }

 private:
  const ActiveRun active_;
  Watch watch_;
  py::object progress_;
  volatile std::sig_atomic_t stop_ = 0;
  std::exception_ptr interruption_;
};

}  // namespace rotordrop::python
