#pragma once
#include <csignal>

namespace rotordrop {

/// Number of the signal that was caught; 0 until then.
const volatile std::sig_atomic_t& caught_signal();
/// From now on a first SIGINT, SIGTERM or (unless it is ignored, as under nohup) SIGHUP ends the work after its current step; a second one kills the program.
void catch_signals();

}  // namespace rotordrop
