#include "base/number_pool.h"

#include <sys/mman.h>

#include <new>
#include <utility>

namespace rotordrop {
namespace {

/// Large pages of x86-64, and of 64-bit ARM with small pages of 4 kB [bytes].
constexpr std::size_t large_page = std::size_t{2} << 20;
/// A large page costs as much as some hundred kilobytes in small ones [numbers].
constexpr std::size_t most_small = (std::size_t{512} << 10) / sizeof(double);

std::size_t whole_pages(std::size_t n) { return (n * sizeof(double) + large_page - 1) / large_page * large_page; }

}  // namespace

void NumberPool::Free::operator()(double* numbers) const { ::operator delete (numbers, std::align_val_t{large_page}); }

double* NumberPool::take(std::size_t n) {
  if (n_small_ + n <= most_small) {
    n_small_ += n;
    return small_.emplace_back(std::make_unique_for_overwrite<double[]>(n)).get();
  }
  if (large_.empty() || n_taken_ + n > n_large_) {
    const std::size_t bytes = whole_pages(n);
    Large piece(static_cast<double*>(::operator new (bytes, std::align_val_t{large_page})));
#if defined(MADV_HUGEPAGE)
    ::madvise(piece.get(), bytes, MADV_HUGEPAGE);  // advice: without it small pages do
#endif
    large_.push_back(std::move(piece));
    n_large_ = bytes / sizeof(double);
    n_taken_ = 0;
  }
  return large_.back().get() + std::exchange(n_taken_, n_taken_ + n);
}

}  // namespace rotordrop
