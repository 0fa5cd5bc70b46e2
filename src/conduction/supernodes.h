#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/wide_vectors.h"

namespace rotordrop {

/// Neighbouring columns of a sparse Cholesky factor that have entries in nearly the same rows, so that solves go through whole vectors of them; the few
/// entries that are missing are zeros. Source: Davis, Direct Methods for Sparse Linear Systems (2006), section 4.8; relaxed as in Ashcraft & Grimes, ACM
/// Transactions on Mathematical Software 15 (1989) 291-309.
class Supernodes {
 public:
  static constexpr std::size_t most_columns = 8;
  /// @param start, row  where the entries of each column begin [n + 1], and their rows below the diagonal, rising: those of a symmetric matrix's factor. The
  ///                    rows of a column are, but for the first, rows of the column that the first one names.
  Supernodes(std::span<const int> start, std::span<const int> row);

  struct Supernode {
    std::size_t column, n_columns;
    std::size_t triangle;       ///< where its entries between its own columns begin
    std::size_t tile, n_tiles;  ///< of the rows below
  };
  [[nodiscard]] const std::vector<Supernode>& list() const { return list_; }
  [[nodiscard]] std::size_t n() const { return n_; }
  /// Rows below the columns of each supernode, tile after tile of vector_length; n() where a tile has fewer.
  [[nodiscard]] const std::vector<int>& tile_rows() const { return tile_rows_; }
  /// Where each entry of the factor stands among SupernodalTriangle's numbers, in the order in which their rows were given.
  [[nodiscard]] const std::vector<std::size_t>& places() const { return places_; }
  [[nodiscard]] std::size_t n_numbers() const { return n_numbers_; }

 private:
  std::size_t n_, n_numbers_ = 0;
  std::vector<Supernode> list_;
  std::vector<int> tile_rows_;
  std::vector<std::size_t> places_;
};

/// A Cholesky factor L with ones on its diagonal.
class SupernodalTriangle {
 public:
  /// @param supernodes  of L's pattern; must outlive this
  explicit SupernodalTriangle(const Supernodes& supernodes)
      : supernodes_(supernodes), numbers_(supernodes.n_numbers()) {}
  /// @param entries  below the diagonal, in the order of their rows
  void set(std::span<const double> entries);
  /// v <- L^-1 v @param v  [n + 1], the last one has no meaning
  void solve(std::span<double> v) const;
  /// v <- L^-T v @param v  likewise
  void solve_transposed(std::span<double> v) const;

 private:
  const Supernodes& supernodes_;
  AlignedNumbers numbers_;
};

}  // namespace rotordrop
