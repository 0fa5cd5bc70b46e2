// Room that is touched ahead costs no faults of pages afterwards. Sanitizers have a heap of their own.
#if !defined(__SANITIZE_ADDRESS__)
#include "base/memory.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace rotordrop {
namespace {

long faults() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return used.ru_minflt;
}

/// Faults of pages by writing to blocks of this size altogether.
long faults_of_writing(std::size_t bytes) {
  constexpr std::size_t block = 50'000;
  std::vector<std::unique_ptr<char[]>> blocks(bytes / block);
  const long before = faults();
  for (auto& room : blocks) {
    room = std::make_unique_for_overwrite<char[]>(block);
    std::memset(room.get(), 1, block);
  }
  return faults() - before;
}

bool can_touch_ahead() {
#if defined(MADV_POPULATE_WRITE) && defined(__GLIBC__)
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* const room = ::mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool can = ::madvise(room, page, MADV_POPULATE_WRITE) == 0;
  ::munmap(room, page);
  return can;
#else
  return false;
#endif
}

TEST(Memory, IsTakenFromWhatWasMadeReady) {
  if (!can_touch_ahead()) GTEST_SKIP() << "the system cannot touch pages ahead";
  constexpr std::size_t bytes = 4'000'000;
  constexpr long pages = 900;  // of 4 kB that are written
  ::malloc_trim(0);            // what other tests have touched and given back
  make_heap_ready(bytes);
  const long ready = faults_of_writing(bytes * 9 / 10), fresh = faults_of_writing(4 * bytes);
  if (fresh < pages) GTEST_SKIP() << "the system gives large pages unasked, or counts no faults";
  EXPECT_LT(ready, pages / 10);
}

TEST(Memory, ThatTheSystemRefusesIsNotMissed) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const std::uint64_t own = own_memory();
  rlimit tight = before;
  tight.rlim_cur = own + 1'000'000;
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &tight), 0);
  EXPECT_NO_THROW(make_heap_ready(64'000'000));
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_LE(own_memory(), own);
}

}  // namespace
}  // namespace rotordrop
#endif
