#include "base/memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace rotordrop {
namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// As `ulimit -v` says it.
std::uint64_t address_limit() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : no_limit;
}

}  // namespace

std::uint64_t own_memory() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_left() {
  const std::uint64_t own = own_memory(), limit = address_limit();
  if (own == 0 || limit == no_limit) return no_limit;
  return limit > own ? limit - own : 0;
}

std::uint64_t most_memory() {
  const auto machine =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return std::min(machine, address_limit());
}

void make_heap_ready(std::size_t bytes) {
#if defined(MADV_POPULATE_WRITE) && defined(MADV_HUGEPAGE)
  // glibc takes from its heap, and keeps there, what is smaller than the largest block that was ever given back.
  void* volatile larger = std::malloc(bytes + large_page);  // volatile: else compilers leave both calls out
  std::free(larger);
  void* const room = std::malloc(bytes);
  if (!room) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(room), end = begin + bytes;
  const auto advise = [begin, end](std::uintptr_t page, int advice) {
    const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
    if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, advice);
  };
  advise(large_page, MADV_HUGEPAGE);
  advise(static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE)), MADV_POPULATE_WRITE);
  std::free(room);
#else
  static_cast<void>(bytes);
#endif
}

std::string bytes_in_words(double bytes) {
  for (const auto& [unit, size] : {std::pair{"GB", 1e9}, {"MB", 1e6}, {"kB", 1e3}})
    if (bytes >= size) return fmt::format("{:.3g} {}", bytes / size, unit);
  return fmt::format("{:.0f} bytes", bytes);
}

}  // namespace rotordrop
