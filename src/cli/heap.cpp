#include "cli/heap.h"

#include <cstdint>
#include <cstdlib>
#include <limits>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/memory.h"

namespace rotordrop {

void grow_heap_in_large_pages() {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
  constexpr int page = 2'097'152, reserve = 32 * page;  // [bytes]; of the reserve nothing is taken before it is touched
  if (memory_left() != std::numeric_limits<std::uint64_t>::max()) return;
  // What is freed stays in the heap, so that it is not touched for the first time again.
  ::mallopt(M_MMAP_THRESHOLD, reserve / 2);  // the most that glibc takes
  ::mallopt(M_TRIM_THRESHOLD, 2 * reserve);
  ::mallopt(M_TOP_PAD, reserve);
  const auto end_of_heap = [] { return reinterpret_cast<std::uintptr_t>(::sbrk(0)); };
  const std::uintptr_t before = end_of_heap();
  void* volatile more_than_is_at_hand = std::malloc(page);  // the heap grows by this and the reserve
  std::free(more_than_is_at_hand);
  ::mallopt(M_TOP_PAD, page);
  const std::uintptr_t first = (before + page - 1) / page * page, end = end_of_heap() / page * page;
  if (end > first) ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

}  // namespace rotordrop
