#include "thermal/circuit/linear_flows.h"

#include <algorithm>
#include <cstring>

namespace rotordrop {
namespace {

ROTORDROP_KERNEL double flows(const double* columns, std::size_t stride, const double* T, double ambient,
                              std::size_t n_nodes, const HeatInput* heat, std::size_t n_places, double* dTdt) {
  double lost = 0.;
  for (std::size_t row = 0; row < stride; row += vector_length) {
    const double* column = columns + row;
    Octet sum;
    for (std::size_t j = 0; j < n_nodes; ++j, column += stride) add_product(sum, T[j] - ambient, column);
    for (std::size_t p = 0; p < n_places; ++p)
      for (const double watts : heat_by_port(heat[p])) {
        add_product(sum, watts, column);
        column += stride;
      }
    for (std::size_t l = 0; l < vector_length; ++l) {
      if (row + l < n_nodes) dTdt[row + l] = sum.value[l];
      if (row + l == n_nodes) lost = sum.value[l];
    }
  }
  return lost;
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
