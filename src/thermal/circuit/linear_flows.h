#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/wide_vectors.h"
#include "model/ports.h"

namespace rotordrop {

/// Watts of a place by port: ring, shaft, inner contact, outer contact.
template <class Real>
std::array<Real, 4> heat_by_port(const HeatInputOf<Real>& h) {
  return {h.rub_into_ring, h.rub - h.rub_into_ring, h.inner, h.outer};
}

/// The linear part of a small network as dense columns, which is quicker than link by link:
///   rate_i = sum_j by_rise_ij (T_j - T_ambient) + sum_p by_port_ip H_p   [K/s],
/// with one more row for what the surroundings take [W].
class LinearFlows {
 public:
  [[nodiscard]] std::size_t n_rows() const { return n_nodes_ + 1; }
  [[nodiscard]] std::size_t n_columns() const { return n_nodes_ + 4 * n_places_; }
  /// Of nodes' rises, then of ports' heats.
  [[nodiscard]] double factor(std::size_t row, std::size_t column) const { return columns_[column * stride_ + row]; }

  LinearFlows() = default;
  LinearFlows(std::size_t n_nodes, std::size_t n_places);

  /// Of a row, a node's rate, or for the number of nodes the heat lost, by a node's rise.
  double& by_rise(std::size_t row, std::size_t node) { return columns_[node * stride_ + row]; }
  /// The same by the heat at a port of a place, in the order of heat_by_port().
  double& by_port(std::size_t row, std::size_t place, std::size_t port) {
    return columns_[(n_nodes_ + 4 * place + port) * stride_ + row];
  }

  /// @param T     [n_nodes]
  /// @param heat  [n_places]
  /// @param dTdt  [n_nodes]
  /// @return heat lost [W]
  double rates(std::span<const double> T, double ambient, std::span<const HeatInput> heat,
               std::span<double> dTdt) const;

 private:
  std::size_t n_nodes_ = 0, n_places_ = 0, stride_ = 0;
  AlignedNumbers columns_;  ///< [n_nodes + 4 n_places][stride]
};

/// Growth of one place by the temperatures of a network: of each node that makes something grow a column of surfaces [m/K].
class LinearGrowth {
 public:
  static constexpr std::size_t n_surfaces = growth_surfaces.size();
  static_assert(n_surfaces == vector_length && sizeof(Expansion) == n_surfaces * sizeof(double));
  /// @param surface  its place in growth_surfaces; @param coefficient  [m/K], added to what is there
  void add(std::size_t surface, std::size_t node, double coefficient);
  [[nodiscard]] double factor(std::size_t surface, std::size_t node) const;
  /// Growth of places by the temperatures above one [m], or its rate by their rates above zero [m/s]. Places that are not among these do not grow.
  /// @param T of all nodes
  static void of_all(std::span<const LinearGrowth> places, std::span<const double> T, double above,
                     std::span<Expansion> out);

 private:
  struct Kernels;
  std::vector<std::size_t> nodes_;
  AlignedNumbers columns_;  ///< [nodes_][n_surfaces]
};

}  // namespace rotordrop
