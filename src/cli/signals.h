#pragma once
#include <csignal>

namespace rotordrop {

/// Number of the signal that was caught; 0 until then.
const volatile std::sig_atomic_t& caught_signal();
/// From now on a first SIGINT or SIGTERM ends the work after its current step; a second one kills the program.
void catch_signals();

}  // namespace rotordrop
