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
  ::mallopt(M_MMAP_THRESHOLD, reserve);
  ::mallopt(M_TRIM_THRESHOLD, 2 * reserve);
  ::mallopt(M_TOP_PAD, reserve);
  void* volatile more_than_is_at_hand = std::malloc(page);  // the heap grows by this and the reserve
  std::free(more_than_is_at_hand);
  ::mallopt(M_TOP_PAD, page);
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) / page * page;
  ::madvise(reinterpret_cast<void*>(end - reserve), reserve, MADV_HUGEPAGE);
#endif
}

}  // namespace rotordrop
