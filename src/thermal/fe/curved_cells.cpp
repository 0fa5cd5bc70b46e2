#include "thermal/fe/curved_cells.h"

#include <algorithm>
#include <stdexcept>

#include "base/real.h"
#include "base/wide_vectors.h"

namespace rotordrop {

namespace {

/// A number of each of eight cells.
using Eight = double[vector_length];

/// PropertyLists as kernels take them.
struct Lines {
  const double *T, *value, *slope;
  std::size_t n;
  explicit Lines(const PropertyLists& of)
      : T(of.T.data()), value(of.value.data()), slope(of.slope.data()), n(of.T.size()) {}

  /// Of eight temperatures.
  ROTORDROP_KERNEL void values(const Eight& x, Eight& out) const {
    for (double& sum : out) sum = value[0];
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double low = T[k], high = T[k + 1], rise = slope[k];
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) out[l] += rise * (smaller(larger(x[l], low), high) - low);
    }
  }
  /// From eight temperatures to others: exact, and without a difference of large numbers where both are near each other.
  ROTORDROP_KERNEL void integrals(const Eight& a, const Eight& b, Eight& out) const {
    const double first = T[0], last = T[n - 1], below = value[0], above = value[n - 1];
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l)
      out[l] =
          (smaller(b[l], first) - smaller(a[l], first)) * below + (larger(b[l], last) - larger(a[l], last)) * above;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double low = T[k], high = T[k + 1], at_low = value[k], rise = slope[k];
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) {
        const double from = smaller(larger(a[l], low), high), to = smaller(larger(b[l], low), high);
        out[l] += (to - from) * (at_low + rise * (0.5 * (from + to) - low));
      }
    }
  }
};

/// Lists of a part's cells, or of those from one vector on.
struct Cells {
  std::size_t n_cells;
  const std::uint32_t* unknowns;  // [vectors][n][vector_length]
  const double *weights, *xx, *xr, *rr;
  [[nodiscard]] ROTORDROP_KERNEL Cells from(std::size_t first, std::size_t n) const {
    const std::size_t at = first * n;
    return {n_cells - first, unknowns + at, weights + at, xx + at, xr + at, rr + at};
  }
};

template <std::size_t n>
ROTORDROP_KERNEL void gather(const double* T, const std::uint32_t* unknowns, Eight (&to)[n]) {
  for (std::size_t i = 0; i < n; ++i)
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) to[i][l] = T[unknowns[i * vector_length + l]];
}
/// Cells may share unknowns.
template <std::size_t n>
ROTORDROP_KERNEL void scatter(const Eight (&from)[n], const std::uint32_t* unknowns, double* out) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t l = 0; l < vector_length; ++l) out[unknowns[i * vector_length + l]] += from[i][l];
}

template <std::size_t n>
ROTORDROP_KERNEL void add_enthalpy_of(const Cells& cells, const double* shape, const Lines& c, double density,
                                      const double* T, const double* T_before, double* out) {
  Eight before[n], now[n], gained[n] = {};
  gather<n>(T_before, cells.unknowns, before);
  gather<n>(T, cells.unknowns, now);
  for (std::size_t q = 0; q < n; ++q, shape += n) {
    Eight from = {}, to = {}, gain;
    for (std::size_t i = 0; i < n; ++i)
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) {
        from[l] += before[i][l] * shape[i];
        to[l] += now[i][l] * shape[i];
      }
    const double* const weights = cells.weights + q * vector_length;
    c.integrals(from, to, gain);
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) gain[l] *= density * weights[l];
    for (std::size_t i = 0; i < n; ++i)
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) gained[i][l] += gain[l] * shape[i];
  }
  scatter<n>(gained, cells.unknowns, out);
}

template <std::size_t n>
ROTORDROP_KERNEL void subtract_conduction_of(const Cells& cells, const double* shape, const double* shape_x,
                                             const double* shape_r, const Lines& k, const double* T, double* out) {
  Eight here[n], flow[n] = {};
  gather<n>(T, cells.unknowns, here);
  for (std::size_t q = 0; q < n; ++q, shape += n, shape_x += n, shape_r += n) {
    Eight value = {}, x = {}, r = {}, conductivity;
    for (std::size_t i = 0; i < n; ++i)
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) {
        value[l] += here[i][l] * shape[i];
        x[l] += here[i][l] * shape_x[i];
        r[l] += here[i][l] * shape_r[i];
      }
    k.values(value, conductivity);
    const std::size_t at = q * vector_length;
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const double weighted = -conductivity[l] * cells.weights[at + l], T_x = x[l], T_r = r[l];
      x[l] = weighted * (cells.xx[at + l] * T_x + cells.xr[at + l] * T_r);
      r[l] = weighted * (cells.xr[at + l] * T_x + cells.rr[at + l] * T_r);
    }
    for (std::size_t i = 0; i < n; ++i)
#pragma omp simd
      for (std::size_t l = 0; l < vector_length; ++l) flow[i][l] += x[l] * shape_x[i] + r[l] * shape_r[i];
  }
  scatter<n>(flow, cells.unknowns, out);
}

template <std::size_t n>
ROTORDROP_KERNEL void add_enthalpies(const Cells& cells, const double* shape, const Lines& c, double density,
                                     const double* T, const double* T_before, double* out) {
  for (std::size_t first = 0; first < cells.n_cells; first += vector_length)
    add_enthalpy_of<n>(cells.from(first, n), shape, c, density, T, T_before, out);
}
template <std::size_t n>
ROTORDROP_KERNEL void subtract_conductions(const Cells& cells, const double* shape, const double* shape_x,
                                           const double* shape_r, const Lines& k, const double* T, double* out) {
  for (std::size_t first = 0; first < cells.n_cells; first += vector_length)
    subtract_conduction_of<n>(cells.from(first, n), shape, shape_x, shape_r, k, T, out);
}

/// Calls what(n), n known to the compiler: elements of degree 1 to 4.
template <class What>
void with_number(std::size_t n, const What& what) {
  switch (n) {
    case 4:
      return what(std::integral_constant<std::size_t, 4>{});
    case 9:
      return what(std::integral_constant<std::size_t, 9>{});
    case 16:
      return what(std::integral_constant<std::size_t, 16>{});
    case 25:
      return what(std::integral_constant<std::size_t, 25>{});
    default:
      throw std::invalid_argument("cells of this degree are not known");
  }
}

}  // namespace

PropertyLists::PropertyLists(const PropertyTable& table) {
  for (const auto& [temperature, of_it] : table.points()) {
    T.push_back(temperature);
    value.push_back(of_it);
  }
  for (std::size_t k = 0; k + 1 < T.size(); ++k) slope.push_back((value[k + 1] - value[k]) / (T[k + 1] - T[k]));
}

CurvedCells::Part::Part(const HeatBody& of)
    : body(&of),
      k(of.conductivity),
      c(of.heat_capacity),
      has_conductivity(!of.conductivity.is_constant()),
      has_capacity(!of.heat_capacity.is_constant()) {}

CurvedCells::CurvedCells(CellShapes shapes) : shapes_(std::move(shapes)) {}

void CurvedCells::add(const HeatBody& body, const Cell& cell) {
  auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.body == &body; });
  if (part == parts_.end()) {
    parts_.emplace_back(body);
    part = parts_.end() - 1;
  }
  const std::size_t n = shapes_.n, lane = part->n_cells++ % vector_length;
  if (lane == 0) {
    for (auto* list : {&part->weights, &part->xx, &part->xr, &part->rr}) list->resize(list->size() + n * vector_length);
    for (const unsigned int unknown : cell.unknowns)
      part->unknowns.insert(part->unknowns.end(), vector_length, unknown);
  }
  const std::size_t first = part->weights.size() - n * vector_length + lane;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = first + i * vector_length;
    part->unknowns[at] = cell.unknowns[i];
    part->weights[at] = cell.weights[i];
    part->xx[at] = cell.metrics[i][0];
    part->xr[at] = cell.metrics[i][1];
    part->rr[at] = cell.metrics[i][2];
  }
}

namespace {

Cells lists_of(const auto& part) {
  return {part.n_cells, part.unknowns.data(), part.weights.data(), part.xx.data(), part.xr.data(), part.rr.data()};
}

}  // namespace

void CurvedCells::add_enthalpy(const double* T, const double* T_before, double* out) const {
  for (const Part& p : parts_)
    if (p.has_capacity)
      with_number(shapes_.n, [&](auto n) {
        wide<add_enthalpies<n>>(lists_of(p), shapes_.value.data(), Lines(p.c), p.body->density, T, T_before, out);
      });
}

void CurvedCells::subtract_conduction(const double* T, double* out) const {
  for (const Part& p : parts_)
    if (p.has_conductivity)
      with_number(shapes_.n, [&](auto n) {
        wide<subtract_conductions<n>>(lists_of(p), shapes_.value.data(), shapes_.x.data(), shapes_.r.data(), Lines(p.k),
                                      T, out);
      });
}

}  // namespace rotordrop
