#include "base/trial.h"

#include <fcntl.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <new>

#include "base/memory.h"

namespace rotordrop {
namespace {

constexpr int status_of_memory = 2;

void limit_memory(std::uint64_t more) {
  rlimit limit{};
  const std::uint64_t own = own_memory();
  if (more == 0 || own == 0 || ::getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, own + more);
  ::setrlimit(RLIMIT_AS, &limit);
}

/// Ends this copy when the thread that made it ends. Otherwise it would hold on to a lock of a run that was killed, and whoever resumes that run would be
/// told that another one writes there.
void end_with(pid_t parent) {
#if defined(__linux__)
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it ended before
#else
  static_cast<void>(parent);
#endif
}

[[noreturn]] void work_and_leave(const std::function<void()>& work, const Trial::Limits& limits) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  for (const int signal : {SIGALRM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
  ::alarm(limits.seconds);
  limit_memory(limits.memory);
  try {
    work();
  } catch (const std::bad_alloc&) {
    ::_exit(status_of_memory);
  } catch (...) {
  }
  ::_exit(0);
}

}  // namespace

void Trial::start(const std::function<void()>& work) {
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ != 0) return;
  end_with(parent);
  work_and_leave(work, limits_);
}

Trial::End Trial::wait() const {
  if (child_ < 0) return End::not_tried;
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0)
    if (errno != EINTR) return End::not_tried;
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? End::out_of_time : End::crashed;
  if (WEXITSTATUS(status) == status_of_memory) return End::out_of_memory;
  return WEXITSTATUS(status) == 0 ? End::done : End::crashed;
}

Trial::Limits limits_of_reading(const std::filesystem::path& file, unsigned patience, const ReadingRates& rates) {
  std::error_code error;
  const std::uint64_t found = std::filesystem::file_size(file, error), size = error ? 0 : found;
  return {.seconds = patience + static_cast<unsigned>(std::min(size / rates.bytes_per_second, std::uint64_t{100'000})),
          .memory = rates.memory_besides + rates.memory_per_byte * size};
}

}  // namespace rotordrop
