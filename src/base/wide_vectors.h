#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

// Plain loops compiled for several widths of vectors; which of them runs is chosen when the program starts. Loops are marked "omp simd" if they
// are to be reordered. Levels of x86-64, not names of processors: those match the models of one maker only.

namespace rotordrop {

/// v4_newton is v4 with roots of the balls' geometry by Newton's method from an estimate, for processors that take long for roots and quotients of eight
/// numbers: Intel's 25 and 17 cycles (Granite Rapids), where AMD's Zen 5 has two roots and a quotient every 20.
enum class VectorLevel { base, v3, v4, v4_newton };

/// Level of this process: the one that is fastest on this machine, or that of the environment's ROTORDROP_ISA (base | v3 | v4 | v4-newton).
extern const VectorLevel vector_level;

/// "base", "v3", "v4" or "v4-newton".
std::string name_of(VectorLevel level);

/// @throws InputError for a ROTORDROP_ISA that is no level, or one that this machine does not have
void check_vector_level();

/// Marks a function that wide<> calls, or that such a function calls: it must be inlined into each level's version.
#define ROTORDROP_KERNEL [[gnu::always_inline]] inline

/// Lists that kernels go through are filled up to whole vectors of this length, so that loops leave no remainder.
inline constexpr std::size_t vector_length = 8;
/// The next multiple of it.
[[nodiscard]] constexpr std::size_t filled_up(std::size_t n) {
  return (n + vector_length - 1) / vector_length * vector_length;
}
/// The same number if it is a multiple, known to the compiler to leave no remainder.
[[nodiscard]] ROTORDROP_KERNEL constexpr std::size_t whole_vectors(std::size_t n) {
  return n / vector_length * vector_length;
}

/// A value for every element of a vector. Sums that a loop over vectors keeps in one are reduced once, after the loop, and in the same order at
/// every level.
struct Octet {
  std::array<double, vector_length> value{};
  ROTORDROP_KERNEL double& operator[](std::size_t i) { return value[i]; }
  [[nodiscard]] ROTORDROP_KERNEL double sum() const {
    const auto& v = value;
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
  }
  [[nodiscard]] ROTORDROP_KERNEL double largest() const {
    const auto& v = value;
    return std::max(std::max(std::max(v[0], v[4]), std::max(v[2], v[6])),
                    std::max(std::max(v[1], v[5]), std::max(v[3], v[7])));
  }
};
static_assert(vector_length == 8);

/// Half as many, for what comes in fours.
struct Quartet {
  static constexpr std::size_t length = 4;
  std::array<double, length> value{};
  ROTORDROP_KERNEL double& operator[](std::size_t i) { return value[i]; }
};
ROTORDROP_KERNEL Quartet sum_of(const std::array<Quartet, 2>& a) {
  Quartet sum;
#pragma omp simd
  for (std::size_t i = 0; i < Quartet::length; ++i) sum[i] = a[0].value[i] + a[1].value[i];
  return sum;
}

/// The first values of a list in a vector, zeros behind them.
ROTORDROP_KERNEL Octet first_of(const double* list, std::size_t count) {
  Octet a;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) a[i] = i < count ? list[i] : 0.;
  return a;
}
/// The first values of a vector to a list.
ROTORDROP_KERNEL void store_first(const Octet& a, std::size_t count, double* list) {
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i)
    if (i < count) list[i] = a.value[i];
}
/// a + f b
ROTORDROP_KERNEL void add_product(Octet& a, double f, const double* b) {
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) a[i] += f * b[i];
}
ROTORDROP_KERNEL void add_product(Quartet& a, double f, const double* b) {
#pragma omp simd
  for (std::size_t i = 0; i < Quartet::length; ++i) a[i] += f * b[i];
}

template <auto kernel>
struct Wide;

template <class Result, class... Arguments, Result (*kernel)(Arguments...)>
struct Wide<kernel> {
#if defined(__x86_64__)
  [[gnu::target("arch=x86-64-v4"), gnu::noinline]] static Result v4(Arguments... a) { return kernel(a...); }
  [[gnu::target("arch=x86-64-v3"), gnu::noinline]] static Result v3(Arguments... a) { return kernel(a...); }
#endif
  [[gnu::noinline]] static Result base(Arguments... a) { return kernel(a...); }

  Result operator()(Arguments... a) const {
#if defined(__x86_64__)
    if (vector_level >= VectorLevel::v4) return v4(a...);
    if (vector_level == VectorLevel::v3) return v3(a...);
#endif
    return base(a...);
  }
};

/// wide<kernel>(arguments...) calls the kernel at this process's level.
template <auto kernel>
inline constexpr Wide<kernel> wide{};

}  // namespace rotordrop
