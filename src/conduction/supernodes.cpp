#include "conduction/supernodes.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace rotordrop {
namespace {

/// Below the diagonal, column after column, and filled up.
constexpr std::size_t triangle_numbers(std::size_t n_columns) { return filled_up(n_columns * (n_columns - 1) / 2); }

/// Of a solve with a supernode, about [cycles of a Zen 5]: to begin, to go through its vectors, to gather and scatter rows, and what its columns wait for each other.
double cost(std::size_t n_columns, std::size_t n_rows) {
  const auto vectors = static_cast<double>(filled_up(n_rows) / vector_length);
  return 20. + static_cast<double>(n_columns) * (vectors + 5.) + 12. * vectors;
}

}  // namespace

Supernodes::Supernodes(std::span<const int> start, std::span<const int> row)
    : n_(start.size() - 1), places_(row.size()) {
  const auto first = [&](std::size_t column) { return static_cast<std::size_t>(start[column]); };
  const auto n_below = [&](std::size_t column) { return first(column + 1) - first(column); };
  // Whether its first row is the next column, which has all of its other rows.
  const auto leads_to_next = [&](std::size_t column) {
    return n_below(column) > 0 && static_cast<std::size_t>(row[first(column)]) == column + 1;
  };
  for (std::size_t column = 0; column < n_; ++column) {
    if (!list_.empty() && leads_to_next(column - 1)) {
      Supernode& before = list_.back();
      const std::size_t n_columns = before.n_columns + 1;
      const bool has_same_rows = n_below(column - 1) == n_below(column) + 1;
      const double apart = cost(before.n_columns, n_below(column - 1)) + cost(1, n_below(column));
      if (n_columns <= most_columns && (has_same_rows || cost(n_columns, n_below(column)) < apart)) {
        before.n_columns = n_columns;
        continue;
      }
    }
    list_.push_back({column, 1, 0, 0, 0});
  }
  for (Supernode& node : list_) {
    const std::size_t end = node.column + node.n_columns, last = end - 1;
    node.triangle = n_numbers_;
    n_numbers_ += triangle_numbers(node.n_columns);
    node.tile = tile_rows_.size() / vector_length;
    node.n_tiles = filled_up(n_below(last)) / vector_length;
    const auto rows = row.subspan(first(last), n_below(last));
    for (std::size_t column = node.column; column < end; ++column) {
      std::size_t at = 0;
      for (std::size_t k = first(column); k < first(column + 1); ++k) {
        const auto r = static_cast<std::size_t>(row[k]);
        if (r < end) {
          const std::size_t c = column - node.column;
          places_[k] = node.triangle + c * (2 * node.n_columns - c - 1) / 2 + (r - column - 1);
          continue;
        }
        while (rows[at] != row[k]) ++at;
        places_[k] = n_numbers_ + (at / vector_length * node.n_columns + column - node.column) * vector_length +
                     at % vector_length;
      }
    }
    tile_rows_.insert(tile_rows_.end(), rows.begin(), rows.end());
    tile_rows_.resize((node.tile + node.n_tiles) * vector_length, static_cast<int>(n_));
    n_numbers_ += node.n_tiles * node.n_columns * vector_length;
  }
}

void SupernodalTriangle::set(std::span<const double> entries) {
  const auto& places = supernodes_.places();
  for (std::size_t k = 0; k < places.size(); ++k) numbers_[places[k]] = entries[k];
}

namespace {

using Supernode = Supernodes::Supernode;

struct Factor {
  const Supernode *begin, *end;
  const int* tile_rows;
  const double* numbers;
};

/// Of a register, or as many as it takes.
typedef double Row8 __attribute__((vector_size(64), may_alias));
static_assert(sizeof(Row8) == vector_length * sizeof(double));
typedef double Row4 __attribute__((vector_size(32), may_alias));
ROTORDROP_KERNEL double sum_of(const Row4& v) { return (v[0] + v[2]) + (v[1] + v[3]); }

/// n: columns of the supernode
template <std::size_t n>
ROTORDROP_KERNEL void solve_one(const Supernode& node, const Factor& factor, double* v) {
  double* const own = v + node.column;
  const double* entries = factor.numbers + node.triangle;
  double x[n];
#pragma GCC unroll 8
  for (std::size_t c = 0; c < n; ++c) x[c] = own[c];
#pragma GCC unroll 8
  for (std::size_t c = 0; c + 1 < n; ++c)
#pragma GCC unroll 8
    for (std::size_t r = c + 1; r < n; ++r) x[r] -= x[c] * *entries++;
#pragma GCC unroll 8
  for (std::size_t c = 1; c < n; ++c) own[c] = x[c];
  entries = factor.numbers + node.triangle + triangle_numbers(n);
  const int* rows = factor.tile_rows + node.tile * vector_length;
  for (std::size_t tile = 0; tile < node.n_tiles; ++tile, rows += vector_length) {
    Row8 sum{};
#pragma GCC unroll 8
    for (std::size_t c = 0; c < n; ++c, entries += vector_length) sum += x[c] * *reinterpret_cast<const Row8*>(entries);
    for (std::size_t i = 0; i < vector_length; ++i) v[rows[i]] -= sum[i];
  }
}

template <std::size_t n>
ROTORDROP_KERNEL void solve_one_transposed(const Supernode& node, const Factor& factor, double* v) {
  double* const own = v + node.column;
  Row4 sums[n] = {};
  const double* entries = factor.numbers + node.triangle + triangle_numbers(n);
  const int* rows = factor.tile_rows + node.tile * vector_length;
  for (std::size_t tile = 0; tile < node.n_tiles; ++tile, entries += (n - 1) * vector_length)
    for (std::size_t half = 0; half < 2; ++half, rows += 4, entries += 4) {
      const Row4 below = {v[rows[0]], v[rows[1]], v[rows[2]], v[rows[3]]};
#pragma GCC unroll 8
      for (std::size_t c = 0; c < n; ++c)
        sums[c] += below * *reinterpret_cast<const Row4*>(entries + c * vector_length);
    }
  double x[n];
#pragma GCC unroll 8
  for (std::size_t c = 0; c < n; ++c) x[c] = own[c] - sum_of(sums[c]);
  entries = factor.numbers + node.triangle + n * (n - 1) / 2;
#pragma GCC unroll 8
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t c = n - 1 - k;
    entries -= k;
#pragma GCC unroll 8
    for (std::size_t r = 0; r < k; ++r) x[c] -= x[c + 1 + r] * entries[r];
  }
#pragma GCC unroll 8
  for (std::size_t c = 0; c < n; ++c) own[c] = x[c];
}

/// Calls `of` with the number of columns as a constant.
template <std::size_t n = 1, class Of>
ROTORDROP_KERNEL void with_constant(std::size_t n_columns, const Of& of) {
  if constexpr (n < Supernodes::most_columns)
    if (n_columns > n) return with_constant<n + 1>(n_columns, of);
  of(std::integral_constant<std::size_t, n>());
}

ROTORDROP_KERNEL void solve_all(const Factor& factor, double* v) {
  for (const Supernode* node = factor.begin; node != factor.end; ++node)
    with_constant(
        node->n_columns, [&](auto n) __attribute__((always_inline)) { solve_one<n()>(*node, factor, v); });
}

ROTORDROP_KERNEL void solve_list_transposed(const Factor& factor, double* v) {
  for (const Supernode* node = factor.end; node-- != factor.begin;)
    with_constant(
        node->n_columns, [&](auto n) __attribute__((always_inline)) { solve_one_transposed<n()>(*node, factor, v); });
}

}  // namespace

void SupernodalTriangle::solve(std::span<double> v) const {
  const auto& list = supernodes_.list();
  v[supernodes_.n()] = 0.;
  wide<solve_all>(Factor{list.data(), list.data() + list.size(), supernodes_.tile_rows().data(), numbers_.data()},
                  v.data());
}

void SupernodalTriangle::solve_transposed(std::span<double> v) const {
  const auto& list = supernodes_.list();
  v[supernodes_.n()] = 0.;
  wide<solve_list_transposed>(
      Factor{list.data(), list.data() + list.size(), supernodes_.tile_rows().data(), numbers_.data()}, v.data());
}

}  // namespace rotordrop
