#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/drop_mask.h"
#include "base/exponential_series.h"
#include "base/pair_lines.h"
#include "base/real.h"
#include "base/sine_cosine.h"
#if defined(ROTORDROP_ROOTS_BY_NEWTON)
#include "base/newton_root.h"
#endif

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
  using Entries = typename lane_words::Vector<width>::Entries;
  using Singles = typename lane_words::Vector<width>::Singles;
  using FourFloats = lane_words::FourFloats;
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
  struct Pair {
    Drops first, second;
  };
  /// The weighted sum of two lines' pairs between entries by straight lines, of each lane at its own place, from 0 to less than the number of the last
  /// entry. Loads from each lane's address take less time than instructions that gather.
  /// @param lines  of all lanes, or PairLinesOf<lanes>
  template <class Lines>
  ROTORDROP_LANE_WORD Pair between_entries(const Lines& lines, const Drops& at) {
    Pair r;
    for (int i = 0; i < n; ++i) {
      const auto entries = __builtin_convertvector(at.part[i], Entries);
      const Singles t = __builtin_convertvector(at.part[i] - __builtin_convertvector(entries, Numbers), Singles);
      FourFloats around[width];  // two pairs
      for (int l = 0; l < width; ++l) {
        const PairLines& line = lines.of_lane(i * width + l);
        const float* from = line.first + 2 * static_cast<std::ptrdiff_t>(entries[l]);
        around[l] = line.weight[0] * loaded(from) + line.weight[1] * loaded(from + line.length);
      }
      Singles of[4];
      turn_fours(around, of);
      r.first.part[i] = __builtin_convertvector(of[0] + t * (of[2] - of[0]), Numbers);
      r.second.part[i] = __builtin_convertvector(of[1] + t * (of[3] - of[1]), Numbers);
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
#if defined(ROTORDROP_ROOTS_BY_NEWTON)
  ROTORDROP_LANE_WORD RootOf<Drops> root_and_inverse(const Drops& a) {
    RootOf<Drops> r;
    for (int i = 0; i < n; ++i) root_by_newton(a.part[i], r.root.part[i], r.inverse.part[i]);
    return r;
  }
  ROTORDROP_LANE_WORD Drops inverse_root(const Drops& a) { return root_and_inverse(a).inverse; }
#else
  ROTORDROP_LANE_WORD RootOf<Drops> root_and_inverse(const Drops& a) {
    const Drops root = sqrt(a);
    return {root, root * (1. / a)};
  }
  ROTORDROP_LANE_WORD Drops inverse_root(const Drops& a) { return 1. / sqrt(a); }
#endif
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

  [[gnu::always_inline]] static inline FourFloats loaded(const float* from) {
    FourFloats four;
    std::memcpy(&four, from, sizeof four);
    return four;
  }
  /// The first numbers of all fours, their second ones, and so on.
  [[gnu::always_inline]] static inline void turn_fours(const FourFloats (&fours)[width], Singles (&of)[4]) {
    if constexpr (width == 2) {
      for (int k = 0; k < 4; ++k) of[k] = Singles{fours[0][k], fours[1][k]};
    } else {
      FourFloats turned[4][width / 4];
      for (int i = 0; i < width / 4; ++i) {
        const FourFloats* f = fours + 4 * i;
        const FourFloats low_0 = __builtin_shufflevector(f[0], f[1], 0, 4, 1, 5);
        const FourFloats low_2 = __builtin_shufflevector(f[2], f[3], 0, 4, 1, 5);
        const FourFloats high_0 = __builtin_shufflevector(f[0], f[1], 2, 6, 3, 7);
        const FourFloats high_2 = __builtin_shufflevector(f[2], f[3], 2, 6, 3, 7);
        turned[0][i] = __builtin_shufflevector(low_0, low_2, 0, 1, 4, 5);
        turned[1][i] = __builtin_shufflevector(low_0, low_2, 2, 3, 6, 7);
        turned[2][i] = __builtin_shufflevector(high_0, high_2, 0, 1, 4, 5);
        turned[3][i] = __builtin_shufflevector(high_0, high_2, 2, 3, 6, 7);
      }
      for (int k = 0; k < 4; ++k)
        if constexpr (width == 8)
          of[k] = __builtin_shufflevector(turned[k][0], turned[k][1], 0, 1, 2, 3, 4, 5, 6, 7);
        else
          of[k] = turned[k][0];
    }
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
