#include "cli/signals.h"

namespace rotordrop {
namespace {

volatile std::sig_atomic_t signal_number = 0;

extern "C" void remember_signal(int signal) { signal_number = signal; }

}  // namespace

const volatile std::sig_atomic_t& caught_signal() { return signal_number; }

void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A closed terminal; under nohup it is ignored and stays so.
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

}  // namespace rotordrop
