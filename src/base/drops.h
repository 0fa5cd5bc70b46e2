#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/drop_mask.h"
#include "base/exponential_series.h"
#include "base/real.h"
#include "base/sine_cosine.h"

// A number for each of eight drops that run in lanes, held in vectors of the width that the source is compiled for. What runs in lanes is compiled once
// for each instruction set (cmake/LaneEngine.cmake); the width is part of the type, so that no two of them share a function.

namespace rotordrop {

/// A number of each lane.
/// @tparam lanes  how many: those of drops, or as many as one register holds
template <int width, int lanes = n_lanes>
struct Drops {
  static constexpr int n = lanes / width;
  using Numbers = typename lane_words::Vector<width>::Numbers;
  using Bits = typename lane_words::Vector<width>::Bits;
  using Unsigned = typename lane_words::Vector<width>::Unsigned;
  using Floats = typename lane_words::Vector<width>::Floats;  // twice as many
  using Mask = DropMask<width, lanes>;
  static constexpr int n_numbers = lanes;
  Numbers part[n];

  Drops() = default;
  /// The same number in all lanes.
  [[gnu::always_inline]] inline Drops(double value) {
    for (Numbers& p : part) p = value - Numbers{};  // zero plus a number would be an addition
  }
  /// @param from  [lanes]
  [[nodiscard, gnu::always_inline]] static inline Drops load(const double* from) {
    Drops r;
    std::memcpy(&r.part, from, sizeof r.part);
    return r;
  }
  /// @param to  [lanes]
  [[gnu::always_inline]] inline void store(double* to) const { std::memcpy(to, &part, sizeof part); }
  /// A table of each lane.
  struct Tables {
    Bits part[n];
    Tables() = default;
    [[gnu::always_inline]] inline explicit Tables(const float* of_all) {
      for (Bits& p : part) p = Bits{} + static_cast<long long>(reinterpret_cast<std::intptr_t>(of_all));
    }
    void set(int lane, const float* table) {
      part[lane / width][lane % width] = static_cast<long long>(reinterpret_cast<std::intptr_t>(table));
    }
  };
  /// Tables' straight lines between entries, each at its own place, from 0 to less than the number of the last entry.
  /// @param first  entry of the tables that counts as their first
  ROTORDROP_LANE_WORD Drops between_entries(const Tables& tables, const Drops& at, std::size_t first) {
    const auto offset = static_cast<long long>(first * sizeof(float));
    Drops r;
    for (int i = 0; i < n; ++i) {
#if defined(__AVX512F__)
      const __m256i entry = _mm512_maskz_cvttpd_epi32(0xff, at.part[i]);
      const Bits address = tables.part[i] + offset + ((Bits)_mm512_maskz_cvtepi32_epi64(0xff, entry) << 2);
      const auto both = (Floats)_mm512_mask_i64gather_epi64(__m512i{}, 0xff, (__m512i)address, nullptr, 1);
      const Numbers whole = _mm512_maskz_cvtepi32_pd(0xff, entry);
#else
      Floats both;
      Numbers whole;
      for (int l = 0; l < width; ++l) {
        const int entry = static_cast<int>(at.part[i][l]);
        const auto* table = reinterpret_cast<const float*>(static_cast<std::intptr_t>(tables.part[i][l] + offset));
        whole[l] = entry;
        both[2 * l] = table[entry];
        both[2 * l + 1] = table[entry + 1];
      }
#endif
      const Numbers here = every_second<0>(both), next = every_second<1>(both);
      r.part[i] = here + (at.part[i] - whole) * (next - here);
    }
    return r;
  }
  /// Sums over the lanes of eight numbers, each in the order ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)) at every width: the eight are transposed
  /// on the way, so that all take few more additions than one.
  /// @param sums  [8]
  [[gnu::always_inline]] static inline void sum_lanes(const Drops (&of)[8], double* sums) {
    Drops all;
    if constexpr (width == 8) {
      all.part[0] = pairs(quarters(halves(of[0].part[0], of[1].part[0]), halves(of[2].part[0], of[3].part[0])),
                          quarters(halves(of[4].part[0], of[5].part[0]), halves(of[6].part[0], of[7].part[0])));
    } else if constexpr (width == 4) {
      const auto half = [](const Drops& a) { return a.part[0] + a.part[1]; };
      for (int i = 0; i < n; ++i)
        all.part[i] =
            pairs(quarters(half(of[4 * i]), half(of[4 * i + 1])), quarters(half(of[4 * i + 2]), half(of[4 * i + 3])));
    } else {
      const auto quarter = [](const Drops& a) { return (a.part[0] + a.part[2]) + (a.part[1] + a.part[3]); };
      for (int i = 0; i < n; ++i) all.part[i] = pairs(quarter(of[2 * i]), quarter(of[2 * i + 1]));
    }
    all.store(sums);
  }
  /// The same of one number.
  [[nodiscard]] double sum() const {
    const Drops& v = *this;
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
  }
  [[nodiscard]] double operator[](int lane) const { return part[lane / width][lane % width]; }
  void set(int lane, double value) { part[lane / width][lane % width] = value; }

#define ROTORDROP_OPERATOR(op)                                            \
  ROTORDROP_LANE_WORD Drops operator op(const Drops& a, const Drops& b) { \
    Drops r;                                                              \
    for (int i = 0; i < n; ++i) r.part[i] = a.part[i] op b.part[i];       \
    return r;                                                             \
  }                                                                       \
  [[gnu::always_inline]] inline Drops& operator op##=(const Drops& b) {   \
    for (int i = 0; i < n; ++i) part[i] = part[i] op b.part[i];           \
    return *this;                                                         \
  }
  ROTORDROP_OPERATOR(+)
  ROTORDROP_OPERATOR(-)
  ROTORDROP_OPERATOR(*)
  ROTORDROP_OPERATOR(/)
#undef ROTORDROP_OPERATOR
  ROTORDROP_LANE_WORD Drops operator-(const Drops& a) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = -a.part[i];
    return r;
  }

#define ROTORDROP_COMPARISON(op)                                         \
  ROTORDROP_LANE_WORD Mask operator op(const Drops& a, const Drops& b) { \
    Mask r;                                                              \
    for (int i = 0; i < n; ++i) r.part[i] = a.part[i] op b.part[i];      \
    return r;                                                            \
  }
  ROTORDROP_COMPARISON(<)
  ROTORDROP_COMPARISON(<=)
  ROTORDROP_COMPARISON(>)
  ROTORDROP_COMPARISON(>=)
  ROTORDROP_COMPARISON(==)
  ROTORDROP_COMPARISON(!=)
#undef ROTORDROP_COMPARISON

  ROTORDROP_LANE_WORD Drops select(const Mask& condition, const Drops& a, const Drops& b) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = condition.part[i] ? a.part[i] : b.part[i];
    return r;
  }
  /// a < b ? b : a
  ROTORDROP_LANE_WORD Drops larger(const Drops& a, const Drops& b) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = larger_of(a.part[i], b.part[i]);
    return r;
  }
  /// b < a ? b : a
  ROTORDROP_LANE_WORD Drops smaller(const Drops& a, const Drops& b) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = smaller_of(a.part[i], b.part[i]);
    return r;
  }
  ROTORDROP_LANE_WORD Drops abs(const Drops& a) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = (Numbers)((Bits)a.part[i] & 0x7fffffffffffffffLL);
    return r;
  }
  ROTORDROP_LANE_WORD Drops sqrt(const Drops& a) {
    Drops r;
    // GCC makes one instruction of a register's roots, but not of two.
    for (int i = 0; i < n; ++i)
#if defined(__SSE2__) && !defined(__AVX__)
      r.part[i] = _mm_sqrt_pd(a.part[i]);
#else
      for (int l = 0; l < width; ++l) r.part[i][l] = __builtin_sqrt(a.part[i][l]);
#endif
    return r;
  }
  ROTORDROP_LANE_WORD Drops exp(const Drops& a) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = exp_of(a.part[i]);
    return r;
  }
  /// x^y for x >= 0 and one exponent, or one of each lane.
  ROTORDROP_LANE_WORD Drops pow(const Drops& a, const Drops& b) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = pow_of(a.part[i], b.part[i]);
    return r;
  }
  ROTORDROP_LANE_WORD Drops tanh(const Drops& a) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = tanh_of(a.part[i]);
    return r;
  }
  ROTORDROP_LANE_WORD Drops cbrt(const Drops& a) {
    Drops r;
    for (int i = 0; i < n; ++i) r.part[i] = cbrt_of(a.part[i]);
    return r;
  }
  /// Beyond a million radians as the library has them.
  ROTORDROP_LANE_WORD SineCosineOf<Drops> sine_cosine(const Drops& a) {
    SineCosineOf<Drops> r;
    for (int i = 0; i < n; ++i) sine_cosine_of(a.part[i], r.sine.part[i], r.cosine.part[i]);
    const Mask is_beyond = !(abs(a) < 1e6);
    if (any(is_beyond))
      for (int lane = 0; lane < lanes; ++lane)
        if (is_beyond[lane]) {
          r.sine.set(lane, std::sin(a[lane]));
          r.cosine.set(lane, std::cos(a[lane]));
        }
    return r;
  }

 private:
  // Steps of sum_lanes(): the parts of a and b that belong together side by side, and added.
  [[gnu::always_inline]] static inline Numbers halves(Numbers a, Numbers b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
  [[gnu::always_inline]] static inline Numbers quarters(Numbers a, Numbers b) {
    if constexpr (width == 8)
      return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13) +
             __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
    else
      return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
  }
  [[gnu::always_inline]] static inline Numbers pairs(Numbers a, Numbers b) {
    if constexpr (width == 8)
      return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14) +
             __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
    else if constexpr (width == 4)
      return __builtin_shufflevector(a, b, 0, 2, 4, 6) + __builtin_shufflevector(a, b, 1, 3, 5, 7);
    else
      return __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
  }

  /// Every second of twice as many numbers, from the first (0) or the second (1) on.
  template <int first>
  [[gnu::always_inline]] static inline Numbers every_second(Floats a) {
    constexpr int f = first;
    if constexpr (width == 8)
      return __builtin_convertvector(
          __builtin_shufflevector(a, a, f, f + 2, f + 4, f + 6, f + 8, f + 10, f + 12, f + 14), Numbers);
    else if constexpr (width == 4)
      return __builtin_convertvector(__builtin_shufflevector(a, a, f, f + 2, f + 4, f + 6), Numbers);
    else
      return Numbers{a[f], a[f + 2]};
  }

  // SSE2 and AVX have both in one instruction, which gives the second of its numbers where one of them is not a number.
  [[gnu::always_inline]] static inline Numbers larger_of(Numbers a, Numbers b) {
#if defined(__AVX512F__)
    return _mm512_maskz_max_pd(0xff, b, a);
#elif defined(__AVX__)
    return _mm256_max_pd(b, a);
#elif defined(__SSE2__)
    return _mm_max_pd(b, a);
#else
    return a < b ? b : a;
#endif
  }
  [[gnu::always_inline]] static inline Numbers smaller_of(Numbers a, Numbers b) {
#if defined(__AVX512F__)
    return _mm512_maskz_min_pd(0xff, b, a);
#elif defined(__AVX__)
    return _mm256_min_pd(b, a);
#elif defined(__SSE2__)
    return _mm_min_pd(b, a);
#else
    return b < a ? b : a;
#endif
  }

  // Of one register: plain arithmetic and the numbers' bits (unsigned, which may wrap around), so that every instruction set does the same.

  /// The nearest integer of |x| < 2^51, and its bits: adding 1.5 * 2^52 rounds.
  [[gnu::always_inline]] static inline Numbers nearest(Numbers x, Bits& k) {
    const Numbers shifted = x + 6755399441055744.;
    k = (Bits)((Unsigned)shifted - 0x4338000000000000ULL);
    return shifted - 6755399441055744.;
  }
  /// p 2^k, both of them normal numbers.
  [[gnu::always_inline]] static inline Numbers times_power_of_two(Numbers p, Bits k) {
    return (Numbers)((Unsigned)p + ((Unsigned)k << 52));
  }
  [[gnu::always_inline]] static inline Numbers limited(Numbers x, double low, double high) {
    x = x < low ? low - Numbers{} : x;
    return x > high ? high - Numbers{} : x;
  }
  /// exp(r) for |r| < 0.35.
  [[gnu::always_inline]] static inline Numbers exp_small(Numbers r) { return 1. + (r + r * r * exponential_tail(r)); }
  [[gnu::always_inline]] static inline Numbers exp_of(Numbers x) {
    Bits k;
    const Numbers within = limited(x, -708., 709.);
    const Numbers n_twos = nearest(within * 1.4426950408889634074, k);
    // ln 2 in two parts, the first with 32 bits.
    const Numbers r = (within - n_twos * 6.93147180369123816490e-01) - n_twos * 1.90821492927058770002e-10;
    return times_power_of_two(exp_small(r), k) + (x - x);  // what is not a number stays so
  }
  /// x = 2^e m with m from sqrt(1/2) to sqrt(2): e, and ln m by FDLIBM's polynomial (Sun Microsystems, 1993).
  [[gnu::always_inline]] static inline Numbers split_logarithm(Numbers x, Numbers& e) {
    constexpr unsigned long long root_half = 0x3fe6a09e667f3bcdULL, one = 0x3ff0000000000000ULL;
    const Unsigned k = ((Unsigned)x + (one - root_half)) >> 52;  // biased by 1023
    e = (Numbers)(k | 0x4330000000000000ULL) - 4503599627371519.;
    const Numbers f = (Numbers)((Unsigned)x - ((k - 1023ULL) << 52)) - 1.;
    const Numbers s = f / (2. + f), z = s * s, w = z * z;
    const Numbers odd = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    const Numbers even =
        z * (6.666666666666735130e-01 +
             w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    const Numbers half = 0.5 * f * f;
    return f - (half - s * (half + (odd + even)));
  }
  /// e times the exponent's leading part is exact, so that a large |ln x| costs no digits. Zero to a positive power is zero.
  [[gnu::always_inline]] static inline Numbers pow_of(Numbers x, Numbers y) {
    Numbers e;
    const Numbers logarithm = y * split_logarithm(x, e);
    const Numbers y_leading = (Numbers)((Bits)y & ~0x3ffffffLL), twos = e * y_leading;
    const Numbers sum = twos + logarithm * 1.4426950408889634074;
    Bits k;
    const Numbers n_twos = nearest(limited(sum, -1021., 1022.), k);
    const Numbers rest = ((twos - n_twos) + e * (y - y_leading)) * 6.93147180559945309417e-01 + logarithm;
    const Numbers power = times_power_of_two(exp_small(rest), k) + (x - x);
    const Numbers below = x == 0. ? Numbers{} : Numbers{} / Numbers{};
    return x >= 2.2250738585072014e-308 ? power : (x > 0. ? Numbers{} : below);
  }
  /// By exp(2 x), but by a series of fractions near zero. Source: Cephes (S. L. Moshier), tanh.c.
  [[gnu::always_inline]] static inline Numbers tanh_of(Numbers x) {
    constexpr long long sign_bit = static_cast<long long>(0x8000000000000000ULL);
    const Bits sign = (Bits)x & sign_bit;
    const Numbers a = (Numbers)((Bits)x ^ sign), z = x * x;
    const Numbers p = (-9.64399179425052238628e-1 * z - 9.92877231001918586564e1) * z - 1.61468768441708447952e3;
    const Numbers q = ((z + 1.12811678491632931402e2) * z + 2.23548839060100448583e3) * z + 4.84406305325125486048e3;
    const Numbers small = x + x * z * (p / q);
    const Numbers large = 1. - 2. / (exp_of(2. * limited(a, 0., 20.)) + 1.);
    return a < 0.625 ? small : (Numbers)((Bits)large | sign) + (x - x);
  }
  /// Of numbers from zero on: a third of the bits as a first guess, then three steps of Halley's.
  [[gnu::always_inline]] static inline Numbers cbrt_of(Numbers x) {
    const Numbers bits = (Numbers)((Bits)((Unsigned)(Bits)x >> 20) | 0x4330000000000000LL) - 4503599627370496.;
    Bits k;
    nearest(bits * (1. / 3.) + 715094163. * 4096., k);
    Numbers t = (Numbers)(k << 20);
    for (int i = 0; i < 3; ++i) {
      const Numbers cube = t * t * t;
      t = t - t * (cube - x) / (2. * cube + x);
    }
    return x > 0. ? t : x;
  }
  [[gnu::always_inline]] static inline void sine_cosine_of(Numbers x, Numbers& sine, Numbers& cosine) {
    Bits k;
    const Numbers quarters = nearest(limited(x, -1e6, 1e6) * quarter_turns::per_radian, k);
    const Numbers r = quarter_turns::rest(x, quarters);
    const Numbers s = quarter_turns::sine(r), c = quarter_turns::cosine(r);
    const Bits is_odd = (k & 1) != 0;
    sine = (Numbers)((Unsigned)(is_odd ? c : s) ^ ((Unsigned)(k & 2) << 62));
    cosine = (Numbers)((Unsigned)(is_odd ? s : c) ^ ((Unsigned)((k + 1) & 2) << 62));
  }
};
#undef ROTORDROP_LANE_WORD

template <int width, int lanes>
struct RealTraits<Drops<width, lanes>> {
  using Mask = DropMask<width, lanes>;
  static constexpr bool is_in_lanes = true;
};

/// Lanes of what this source is compiled for.
using EightDrops = Drops<register_width>;
/// As many numbers as one register of it holds.
using OneRegister = Drops<register_width, register_width>;

}  // namespace rotordrop
