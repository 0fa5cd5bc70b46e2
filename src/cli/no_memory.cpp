#include "cli/no_memory.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>

namespace rotordrop {

void end_without_handler() {
  try {
    if (const auto cause = std::current_exception()) std::rethrow_exception(cause);
  } catch (const std::bad_alloc&) {
    [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, no_memory.data(), no_memory.size());
    ::_exit(1);
  } catch (...) {
  }
  std::abort();
}

}  // namespace rotordrop
