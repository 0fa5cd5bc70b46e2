#pragma once
#include <cstdint>

namespace rotordrop {

/// Finaliser of splitmix64 (Steele, Lea & Flood 2014): 64 well mixed bits of 64 bits.
inline std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}
/// Bits of a row and a column: the same in any order of calls, on any machine.
inline std::uint64_t bits_of(std::uint64_t seed, std::uint64_t row, std::uint64_t column) {
  return mixed(mixed(mixed(seed) ^ row) ^ column);
}
/// A number in (0, 1), so that quantiles are finite.
inline double unit_interval(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }
inline double uniform_number(std::uint64_t seed, std::uint64_t row, std::uint64_t column) {
  return unit_interval(bits_of(seed, row, column));
}

}  // namespace rotordrop
