#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// Vectors of the width that a source is compiled for, and truth by lane: what base/drops.h is made of.

namespace rotordrop {

/// Drops that run in lanes.
inline constexpr int n_lanes = 8;

/// Numbers in a register of what this source is compiled for.
#if defined(__AVX512F__)
inline constexpr int register_width = 8;
#elif defined(__AVX__)
inline constexpr int register_width = 4;
#else
inline constexpr int register_width = 2;
#endif

#define ROTORDROP_LANE_WORD [[gnu::always_inline]] friend inline

namespace lane_words {
typedef float FourFloats __attribute__((vector_size(16)));
/// Vector types of a width.
template <int width>
struct Vector;
#define ROTORDROP_VECTOR(W)                                                  \
  template <>                                                                \
  struct Vector<W> {                                                         \
    typedef double Numbers __attribute__((vector_size(8 * W)));              \
    typedef long long Bits __attribute__((vector_size(8 * W)));              \
    typedef unsigned long long Unsigned __attribute__((vector_size(8 * W))); \
    typedef int Entries __attribute__((vector_size(4 * W)));                 \
    typedef float Singles __attribute__((vector_size(4 * W)));               \
  };
ROTORDROP_VECTOR(2)
ROTORDROP_VECTOR(4)
ROTORDROP_VECTOR(8)
#undef ROTORDROP_VECTOR
}  // namespace lane_words

/// Truth of each lane: all bits or none.
template <int width, int lanes = n_lanes>
struct DropMask {
  static constexpr int n = lanes / width;
  using Bits = typename lane_words::Vector<width>::Bits;
  Bits part[n];
  DropMask() = default;
  [[gnu::always_inline]] inline DropMask(bool value) {
    for (Bits& p : part) p = Bits{} - static_cast<long long>(value);
  }
  [[nodiscard]] bool operator[](int lane) const { return part[lane / width][lane % width] != 0; }
  ROTORDROP_LANE_WORD DropMask operator&(const DropMask& a, const DropMask& b) {
    DropMask r;
    for (int i = 0; i < n; ++i) r.part[i] = a.part[i] & b.part[i];
    return r;
  }
  ROTORDROP_LANE_WORD DropMask operator|(const DropMask& a, const DropMask& b) {
    DropMask r;
    for (int i = 0; i < n; ++i) r.part[i] = a.part[i] | b.part[i];
    return r;
  }
  ROTORDROP_LANE_WORD DropMask operator!(const DropMask& a) {
    DropMask r;
    for (int i = 0; i < n; ++i) r.part[i] = ~a.part[i];
    return r;
  }
  DropMask& operator|=(const DropMask& b) { return *this = *this | b; }
  // By one instruction where there is one: GCC would take the lanes out of a register one by one.
  ROTORDROP_LANE_WORD bool any(const DropMask& a) {
    Bits all = a.part[0];
    for (int i = 1; i < n; ++i) all |= a.part[i];
#if defined(__AVX512DQ__)
    if constexpr (width == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(all)) != 0;
#endif
#if defined(__AVX__)
    if constexpr (width == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(all)) != 0;
#endif
#if defined(__SSE2__)
    if constexpr (width == 2) return _mm_movemask_pd(reinterpret_cast<__m128d>(all)) != 0;
#endif
    long long sum = 0;
    for (int i = 0; i < width; ++i) sum |= all[i];
    return sum != 0;
  }
};

}  // namespace rotordrop
