#include "thermal/circuit/linear_flows.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace rotordrop {
namespace {

/// So many vectors of rows from one row on.
template <std::size_t n_vectors>
ROTORDROP_KERNEL void add_flows(const double* column, std::size_t stride, const double* T, double ambient,
                                std::size_t n_nodes, const HeatInput* heat, std::size_t n_places, double* rows) {
  std::array<Octet, n_vectors> sum;
  const auto add = [&](double factor) {
    for (std::size_t k = 0; k < n_vectors; ++k) add_product(sum[k], factor, column + k * vector_length);
    column += stride;
  };
  for (std::size_t j = 0; j < n_nodes; ++j) add(T[j] - ambient);
  for (std::size_t p = 0; p < n_places; ++p)
    for (const double watts : heat_by_port(heat[p])) add(watts);
  std::memcpy(rows, sum.data(), sizeof sum);
}

ROTORDROP_KERNEL double flows(const double* columns, std::size_t stride, const double* T, double ambient,
                              std::size_t n_nodes, const HeatInput* heat, std::size_t n_places, double* dTdt) {
  // The last rows, among them the heat lost, are fewer than whole vectors.
  std::size_t row = 0;
  for (; row + 2 * vector_length < stride; row += vector_length)
    add_flows<1>(columns + row, stride, T, ambient, n_nodes, heat, n_places, dTdt + row);
  std::array<double, 2 * vector_length> last;
  if (row + vector_length < stride)
    add_flows<2>(columns + row, stride, T, ambient, n_nodes, heat, n_places, last.data());
  else
    add_flows<1>(columns + row, stride, T, ambient, n_nodes, heat, n_places, last.data());
  std::copy_n(last.data(), n_nodes - row, dTdt + row);
  return last[n_nodes - row];
}

}  // namespace

struct LinearGrowth::Kernels {
  ROTORDROP_KERNEL static void growths(const LinearGrowth* places, std::size_t n_places, const double* T, double above,
                                       Expansion* out) {
    for (std::size_t p = 0; p < n_places; ++p) {
      const LinearGrowth& place = places[p];
      const double* column = place.columns_.data();
      Octet sum;
      for (const std::size_t node : place.nodes_) {
        add_product(sum, T[node] - above, column);
        column += n_surfaces;
      }
      std::memcpy(static_cast<void*>(&out[p]), &sum, sizeof sum);
    }
  }
};

LinearFlows::LinearFlows(std::size_t n_nodes, std::size_t n_places)
    : n_nodes_(n_nodes),
      n_places_(n_places),
      stride_(filled_up(n_nodes + 1)),
      columns_((n_nodes + 4 * n_places) * stride_, 0.) {}

double LinearFlows::rates(std::span<const double> T, double ambient, std::span<const HeatInput> heat,
                          std::span<double> dTdt) const {
  return wide<flows>(columns_.data(), stride_, T.data(), ambient, n_nodes_, heat.data(), n_places_, dTdt.data());
}

void LinearGrowth::add(std::size_t surface, std::size_t node, double coefficient) {
  const auto found = std::find(nodes_.begin(), nodes_.end(), node);
  const auto at = static_cast<std::size_t>(found - nodes_.begin());
  if (found == nodes_.end()) {
    nodes_.push_back(node);
    columns_.resize(nodes_.size() * n_surfaces, 0.);
  }
  columns_[at * n_surfaces + surface] += coefficient;
}

double LinearGrowth::factor(std::size_t surface, std::size_t node) const {
  const auto found = std::find(nodes_.begin(), nodes_.end(), node);
  return found == nodes_.end() ? 0. : columns_[static_cast<std::size_t>(found - nodes_.begin()) * n_surfaces + surface];
}

void LinearGrowth::of_all(std::span<const LinearGrowth> places, std::span<const double> T, double above,
                          std::span<Expansion> out) {
  const std::size_t n = std::min(places.size(), out.size());
  wide<Kernels::growths>(places.data(), n, T.data(), above, out.data());
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(n), out.end(), Expansion{});
}

}  // namespace rotordrop
