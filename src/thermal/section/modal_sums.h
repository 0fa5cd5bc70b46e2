#pragma once

// Sums over the modes of reduced finite elements, many at once in vectors. States are absolute temperatures [n_modes]: their rises count from
// `zero`.
#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/row_tile.h"
#include "base/wide_vectors.h"

namespace rotordrop {

/// Shapes in vectors of eight, each vector mode after mode.
class ModalShapes {
 public:
  ModalShapes() = default;
  explicit ModalShapes(std::size_t n_modes) : n_modes_(n_modes) {}
  /// @param shape  [n_modes], or empty for zeros @returns its place among the shapes
  std::size_t add(std::span<const double> shape);
  [[nodiscard]] std::size_t size() const { return n_; }
  /// Sums shape . (y - zero) of all shapes, and zeros up to a whole vector. @param out  [filled_up(size())]
  void sums(const double* y, double zero, double* out) const;
  void sums(const double* y, double zero, std::vector<double>& out) const;
  /// Those of eight states. @param rises  y - zero of mode i and state l at [i * RowTile::width + l]; @param out  [RowTile::width][filled_up(size())]
  void sums_of_tile(const double* rises, double* out) const;

 private:
  std::size_t n_ = 0, n_modes_ = 0;
  AlignedNumbers values_;
};

/// Rates of the modes: each decays, and heats go into it.
class ModalRates {
 public:
  ModalRates() = default;
  explicit ModalRates(std::span<const double> rate);
  /// @param input  [K/(s W)] @returns its place among the inputs
  std::size_t add(std::span<const double> input);
  /// @param watts  of all inputs
  void rates(const double* y, double zero, const double* watts, double* dydt) const;
  /// States after `step` seconds under the same heats all the time, exactly.
  /// @param weights  [filled_up(n_modes)], zeros behind the modes
  /// @returns the mean over the step of weights . (y - zero)
  double advance(const double* y, double zero, const double* watts, double step, const AlignedNumbers& weights,
                 double* to) const;

 private:
  std::size_t n_modes_ = 0, n_inputs_ = 0;
  AlignedNumbers decay_, inputs_;
};

struct RiseRange {
  double lowest, highest;
};

/// Rises of a surface's points.
class SurfacePoints {
 public:
  /// @param by_point  mode after mode of a point, point after point [n_points * n_modes]
  /// @param at_once   rises per watt besides [n_points], or empty for zeros
  SurfacePoints(std::size_t n_modes, std::span<const double> by_point, std::span<const double> at_once);
  /// Of at least one point.
  [[nodiscard]] RiseRange extremes(const double* y, double zero, double watts) const;
  /// Those of eight states. @param rises  as for ModalShapes::sums_of_tile(); @param watts, out  [RowTile::width]
  void extremes_of_tile(const double* rises, const double* watts, RiseRange* out) const;

 private:
  std::size_t n_modes_;
  AlignedNumbers values_, at_once_;  // of whole vectors: the first point again behind the last
};

}  // namespace rotordrop
