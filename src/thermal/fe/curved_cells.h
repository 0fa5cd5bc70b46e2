#pragma once
// Cells whose conductivity or heat capacity depends on temperature: what a step of heat conduction spends its time on, eight cells at a time.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/wide_vectors.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// A property over temperature as lists: straight lines from point to point, constant outside.
struct PropertyLists {
  std::vector<double> T, value, slope;  ///< [n_points], [n_points], [n_points - 1]
  explicit PropertyLists(const PropertyTable& table);
};

/// Shape functions and their gradients on the unit cell, at the points of its quadrature.
struct CellShapes {
  std::size_t n = 0;                ///< of functions, and of points
  std::vector<double> value, x, r;  ///< [n points][n functions]
};

/// Integrals over such cells.
class CurvedCells {
 public:
  explicit CurvedCells(CellShapes shapes);

  struct Cell {
    std::span<const unsigned int> unknowns;  ///< [n]
    std::span<const double> weights;         ///< 2 pi r times the quadrature's weight [n]
    std::span<const std::array<double, 3>>
        metrics;  ///< xx, xr, rr of J^-1 J^-T: gradients on the unit cell to those in space [n]
  };
  /// @param body  must outlive this, at its place
  void add(const HeatBody& body, const Cell& cell);
  [[nodiscard]] bool empty() const { return parts_.empty(); }
  [[nodiscard]] const CellShapes& shapes() const { return shapes_; }

  /// out(v) += integral rho (H(T) - H(T_before)) v [J], over cells whose heat capacity depends on temperature.
  void add_enthalpy(const double* T, const double* T_before, double* out) const;
  /// out(v) -= integral k grad T . grad v [W], over cells whose conductivity does.
  void subtract_conduction(const double* T, double* out) const;

  /// One of the cells, as it stands among those beside it.
  struct View {
    const HeatBody& body;
    bool has_conductivity, has_capacity;  ///< that depends on temperature
    const std::uint32_t* unknowns;
    const double *weights, *xx, *xr, *rr;
    [[nodiscard]] unsigned int unknown(std::size_t i) const { return unknowns[i * vector_length]; }
    [[nodiscard]] double weight(std::size_t q) const { return weights[q * vector_length]; }
    [[nodiscard]] std::array<double, 3> metric(std::size_t q) const {
      return {xx[q * vector_length], xr[q * vector_length], rr[q * vector_length]};
    }
  };
  /// Calls what(View) for each cell, body after body.
  template <class What>
  void for_each(What&& what) const {
    for (const Part& p : parts_)
      for (std::size_t cell = 0; cell < p.n_cells; ++cell) {
        const std::size_t at = cell / vector_length * shapes_.n * vector_length + cell % vector_length;
        what(View{*p.body, p.has_conductivity, p.has_capacity, &p.unknowns[at], &p.weights[at], &p.xx[at], &p.xr[at],
                  &p.rr[at]});
      }
  }

 private:
  /// Of one body, in whole vectors: the last vector repeats its first cell with weights of zero.
  struct Part {
    explicit Part(const HeatBody& body);
    const HeatBody* body;
    PropertyLists k, c;
    bool has_conductivity, has_capacity;  ///< that depends on temperature
    std::size_t n_cells = 0;
    std::vector<std::uint32_t> unknowns;  ///< [vectors][n][vector_length]
    AlignedNumbers weights;               ///< the same; then xx, xr, rr of the metrics
    AlignedNumbers xx, xr, rr;
  };
  CellShapes shapes_;
  std::vector<Part> parts_;
};

}  // namespace rotordrop
