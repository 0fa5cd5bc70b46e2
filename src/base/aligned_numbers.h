#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace rotordrop {

/// Places lists at whole lines of the cache: a load of the widest vectors then touches one of them.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};  // [bytes]
  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* list, std::size_t) noexcept { ::operator delete(list, line); }
  bool operator==(const LineAllocator&) const = default;
};

using AlignedNumbers = std::vector<double, LineAllocator<double>>;

}  // namespace rotordrop
