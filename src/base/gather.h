#pragma once
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <type_traits>

#include "base/drops.h"

namespace rotordrop {

/// Lays the numbers of several drops side by side, number by number. Lanes without a drop repeat the first one.
/// @tparam Numbers  a struct of nothing but its scalar, in whatever order and depth
/// @param of        1 to n_lanes of them
template <template <class> class Numbers, class Real>
Numbers<Real> gathered(std::span<const Numbers<double>* const> of) {
  constexpr std::size_t n = sizeof(Numbers<double>) / sizeof(double);
  static_assert(std::is_trivially_copyable_v<Numbers<Real>> && sizeof(Numbers<Real>) == n * sizeof(Real));
  std::array<Real, n> columns;
  for (int lane = 0; lane < n_lanes; ++lane) {
    std::array<double, n> one;
    std::memcpy(one.data(), of[static_cast<std::size_t>(lane) < of.size() ? static_cast<std::size_t>(lane) : 0],
                sizeof one);
    for (std::size_t i = 0; i < n; ++i) columns[i].set(lane, one[i]);
  }
  return std::bit_cast<Numbers<Real>>(columns);
}

/// A number of several drops side by side. Lanes without a drop repeat the first one.
/// @param n_drops  1 to n_lanes; @param of  the number of a drop, by its place
template <class Real, class Of>
Real side_by_side(std::size_t n_drops, const Of& of) {
  Real all = 0.;
  for (int lane = 0; lane < n_lanes; ++lane)
    all.set(lane, of(static_cast<std::size_t>(lane) < n_drops ? static_cast<std::size_t>(lane) : 0));
  return all;
}

/// The numbers of one lane, as they were before they were gathered.
template <template <class> class Numbers, class Real>
Numbers<double> of_lane(const Numbers<Real>& all, int lane) {
  constexpr std::size_t n = sizeof(Numbers<double>) / sizeof(double);
  static_assert(std::is_trivially_copyable_v<Numbers<Real>> && sizeof(Numbers<Real>) == n * sizeof(Real));
  const auto columns = std::bit_cast<std::array<Real, n>>(all);
  std::array<double, n> one;
  for (std::size_t i = 0; i < n; ++i) one[i] = columns[i][lane];
  return std::bit_cast<Numbers<double>>(one);
}

/// Number by number, those of a where a condition holds, else those of b.
template <template <class> class Numbers, class Real>
Numbers<Real> select_all(const MaskOf<Real>& condition, const Numbers<Real>& a, const Numbers<Real>& b) {
  using Columns = std::array<Real, sizeof(Numbers<Real>) / sizeof(Real)>;
  static_assert(std::is_trivially_copyable_v<Numbers<Real>> && sizeof(Columns) == sizeof(Numbers<Real>));
  auto chosen = std::bit_cast<Columns>(a);
  const auto others = std::bit_cast<Columns>(b);
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = select(condition, chosen[i], others[i]);
  return std::bit_cast<Numbers<Real>>(chosen);
}

}  // namespace rotordrop
