#include "base/number_pool.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

#include "base/memory.h"

namespace rotordrop {
namespace {

/// A large page costs as much as some hundred kilobytes in small ones [numbers].
constexpr std::size_t most_small = (std::size_t{512} << 10) / sizeof(double);

std::size_t whole_pages(std::size_t n) { return (n * sizeof(double) + large_page - 1) / large_page * large_page; }

}  // namespace

void NumberPool::Free::operator()(double* numbers) const { ::munmap(numbers, bytes); }

/// From the system itself: room of the heap may have been touched in small pages.
NumberPool::Large NumberPool::large_piece(std::size_t bytes) {
  void* const room = ::mmap(nullptr, bytes + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  std::byte* const begin = static_cast<std::byte*>(room);
  const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(begin) % large_page) % large_page;
  if (before > 0) ::munmap(begin, before);
  ::munmap(begin + before + bytes, large_page - before);
#if defined(MADV_HUGEPAGE)
  ::madvise(begin + before, bytes, MADV_HUGEPAGE);  // advice: without it small pages do
#endif
  return Large(reinterpret_cast<double*>(begin + before), {bytes});
}

double* NumberPool::take(std::size_t n) {
  if (n_small_ + n <= most_small) {
    n_small_ += n;
    return small_.emplace_back(std::make_unique_for_overwrite<double[]>(n)).get();
  }
  if (large_.empty() || n_taken_ + n > n_large_) {
    const std::size_t bytes = whole_pages(n);
    large_.push_back(large_piece(bytes));
    n_large_ = bytes / sizeof(double);
    n_taken_ = 0;
  }
  return large_.back().get() + std::exchange(n_taken_, n_taken_ + n);
}

}  // namespace rotordrop
