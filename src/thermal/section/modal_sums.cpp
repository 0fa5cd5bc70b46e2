#include "thermal/section/modal_sums.h"

#include <algorithm>
#include <array>

#include "base/exponential_series.h"
#include "base/split_exponential.h"

namespace rotordrop {
namespace {

/// Even and odd modes by themselves: each waits for the sum before it.
ROTORDROP_KERNEL void add_modes(Octet& even, Octet& odd, const double* y, double zero, const double* column,
                                std::size_t n_modes) {
  std::size_t i = 0;
  for (; i + 1 < n_modes; i += 2, column += 2 * vector_length) {
    add_product(even, y[i] - zero, column);
    add_product(odd, y[i + 1] - zero, column + vector_length);
  }
  if (i < n_modes) add_product(even, y[i] - zero, column);
}

ROTORDROP_KERNEL void sums_kernel(const double* y, double zero, const double* column, std::size_t n_modes,
                                  std::size_t n_vectors, double* out) {
  for (std::size_t v = 0; v < n_vectors; ++v, column += n_modes * vector_length, out += vector_length) {
    Octet even, odd;
    add_modes(even, odd, y, zero, column, n_modes);
    add_product(even, 1., odd.value.data());
    store_first(even, vector_length, out);
  }
}

ROTORDROP_KERNEL void rates_kernel(const double* y, double zero, const double* decay, const double* inputs,
                                   const double* watts, std::size_t n_inputs, std::size_t n_modes, double* dydt) {
  const std::size_t stride = filled_up(n_modes);
  for (std::size_t at = 0; at < n_modes; at += vector_length) {
    const std::size_t n = std::min(vector_length, n_modes - at);
    const Octet state = first_of(y + at, n);
    Octet rate;
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) rate[l] = decay[at + l] * (state.value[l] - zero);
    const double* input = inputs + at;
    for (std::size_t p = 0; p < n_inputs; ++p, input += stride) add_product(rate, watts[p], input);
    store_first(rate, n, dydt + at);
  }
}

/// 1 - exp(-x) for 0 <= x <= 700, without a branch.
ROTORDROP_KERNEL double decayed(double x) {
  const auto [power, f] = split_exponential(-x);
  // For a power of 1 only the second term is left: a small x loses no digits.
  return (1. - power) - power * (f + f * f * exponential_tail(f));
}

/// To states from their rates at the beginning: y + step first(x) dydt with x = decay step; over the step their mean is y + step second(x) dydt.
ROTORDROP_KERNEL double advance_kernel(const double* y, double zero, const double* decay, double step,
                                       std::size_t n_modes, const double* weights, double* to) {
  // Below it second(x) would lose more than three digits, and its series to x^3 lacks 1e-15; above the other nothing is left of exp(-x).
  constexpr double small = 1e-3, large = 700., no_decay = 1e-200;
  Octet sum;
  for (std::size_t at = 0; at < n_modes; at += vector_length) {
    const std::size_t n = std::min(vector_length, n_modes - at);
    const Octet rate = first_of(to + at, n);
    Octet state = first_of(y + at, n);
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const double x = -decay[at + l] * step, within = x < large ? x : large, inverse = 1. / (x > no_decay ? x : 1.);
      const double first = x > no_decay ? decayed(within) * inverse : 1.;
      const double series = ((x * (-1. / 120.) + 1. / 24.) * x - 1. / 6.) * x + 0.5;
      const double second = x > small ? (1. - first) * inverse : series;
      sum[l] += weights[at + l] * (state.value[l] - zero + step * second * rate.value[l]);
      state[l] += step * first * rate.value[l];
    }
    store_first(state, n, to + at);
  }
  return sum.sum();
}

/// States of a tile that are summed at a time: their sums stay in registers, and each vector of shapes is read for all of them.
constexpr std::size_t at_a_time = 4;
static_assert(RowTile::width % at_a_time == 0);
using Sums = std::array<Octet, at_a_time>;

/// @param rises  of the first of these states, mode after mode of a tile
ROTORDROP_KERNEL void add_modes_of_tile(Sums& sum, const double* rises, const double* column, std::size_t n_modes) {
  for (std::size_t i = 0; i < n_modes; ++i, column += vector_length, rises += RowTile::width)
    for (std::size_t l = 0; l < at_a_time; ++l) add_product(sum[l], rises[l], column);
}

ROTORDROP_KERNEL void tile_sums_kernel(const double* rises, const double* column, std::size_t n_modes,
                                       std::size_t n_vectors, double* out) {
  for (std::size_t v = 0; v < n_vectors; ++v, column += n_modes * vector_length, out += vector_length)
    for (std::size_t first = 0; first < RowTile::width; first += at_a_time) {
      Sums sum;
      add_modes_of_tile(sum, rises + first, column, n_modes);
      for (std::size_t l = 0; l < at_a_time; ++l)
        store_first(sum[l], vector_length, out + (first + l) * n_vectors * vector_length);
    }
}

ROTORDROP_KERNEL void take_extremes(const Octet& sum, Octet& lowest, Octet& highest) {
#pragma omp simd
  for (std::size_t l = 0; l < vector_length; ++l) {
    lowest[l] = sum.value[l] < lowest.value[l] ? sum.value[l] : lowest.value[l];
    highest[l] = sum.value[l] > highest.value[l] ? sum.value[l] : highest.value[l];
  }
}

ROTORDROP_KERNEL void tile_extremes_kernel(const double* rises, const double* columns, std::size_t n_modes,
                                           const double* at_once, const double* watts, std::size_t n_vectors,
                                           RiseRange* out) {
  for (std::size_t first = 0; first < RowTile::width; first += at_a_time) {
    Sums lowest, highest;
    for (std::size_t v = 0; v < n_vectors; ++v) {
      Sums sum;
      for (std::size_t l = 0; l < at_a_time; ++l) add_product(sum[l], watts[first + l], at_once + v * vector_length);
      add_modes_of_tile(sum, rises + first, columns + v * n_modes * vector_length, n_modes);
      if (v == 0) lowest = highest = sum;
      for (std::size_t l = 0; l < at_a_time; ++l) take_extremes(sum[l], lowest[l], highest[l]);
    }
    for (std::size_t l = 0; l < at_a_time; ++l)
      out[first + l] = {*std::min_element(lowest[l].value.begin(), lowest[l].value.end()), highest[l].largest()};
  }
}

ROTORDROP_KERNEL RiseRange extremes_kernel(const double* y, double zero, const double* column, std::size_t n_modes,
                                           const double* at_once, double watts, std::size_t n_vectors) {
  Octet lowest, highest;
  for (std::size_t v = 0; v < n_vectors; ++v, column += n_modes * vector_length, at_once += vector_length) {
    Octet even, odd;
    add_product(odd, watts, at_once);
    add_modes(even, odd, y, zero, column, n_modes);
    add_product(even, 1., odd.value.data());
    if (v == 0) lowest = highest = even;
    take_extremes(even, lowest, highest);
  }
  return {*std::min_element(lowest.value.begin(), lowest.value.end()), highest.largest()};
}

}  // namespace

std::size_t ModalShapes::add(std::span<const double> shape) {
  if (n_ % vector_length == 0) values_.resize(values_.size() + n_modes_ * vector_length, 0.);
  double* column = values_.data() + n_ / vector_length * n_modes_ * vector_length + n_ % vector_length;
  for (std::size_t i = 0; i < shape.size(); ++i) column[i * vector_length] = shape[i];
  return n_++;
}

void ModalShapes::sums(const double* y, double zero, double* out) const {
  wide<sums_kernel>(y, zero, values_.data(), n_modes_, filled_up(n_) / vector_length, out);
}

void ModalShapes::sums(const double* y, double zero, std::vector<double>& out) const {
  out.resize(filled_up(n_));
  sums(y, zero, out.data());
}

void ModalShapes::sums_of_tile(const double* rises, double* out) const {
  wide<tile_sums_kernel>(rises, values_.data(), n_modes_, filled_up(n_) / vector_length, out);
}

ModalRates::ModalRates(std::span<const double> rate) : n_modes_(rate.size()), decay_(filled_up(rate.size()), 0.) {
  std::transform(rate.begin(), rate.end(), decay_.begin(), [](double r) { return -r; });
}

std::size_t ModalRates::add(std::span<const double> input) {
  inputs_.insert(inputs_.end(), input.begin(), input.end());
  inputs_.resize(++n_inputs_ * filled_up(n_modes_), 0.);
  return n_inputs_ - 1;
}

void ModalRates::rates(const double* y, double zero, const double* watts, double* dydt) const {
  wide<rates_kernel>(y, zero, decay_.data(), inputs_.data(), watts, n_inputs_, n_modes_, dydt);
}

double ModalRates::advance(const double* y, double zero, const double* watts, double step,
                           const AlignedNumbers& weights, double* to) const {
  rates(y, zero, watts, to);
  return wide<advance_kernel>(y, zero, decay_.data(), step, n_modes_, weights.data(), to);
}

SurfacePoints::SurfacePoints(std::size_t n_modes, std::span<const double> by_point, std::span<const double> at_once)
    : n_modes_(n_modes) {
  const std::size_t n_points = by_point.size() / n_modes;
  at_once_.resize(filled_up(n_points), 0.);
  values_.resize(at_once_.size() * n_modes);
  for (std::size_t k = 0; k < at_once_.size(); ++k) {
    const std::size_t point = k < n_points ? k : 0;
    if (point < at_once.size()) at_once_[k] = at_once[point];
    double* column = values_.data() + k / vector_length * n_modes * vector_length + k % vector_length;
    for (std::size_t i = 0; i < n_modes; ++i) column[i * vector_length] = by_point[point * n_modes + i];
  }
}

RiseRange SurfacePoints::extremes(const double* y, double zero, double watts) const {
  return wide<extremes_kernel>(y, zero, values_.data(), n_modes_, at_once_.data(), watts,
                               at_once_.size() / vector_length);
}

void SurfacePoints::extremes_of_tile(const double* rises, const double* watts, RiseRange* out) const {
  wide<tile_extremes_kernel>(rises, values_.data(), n_modes_, at_once_.data(), watts, at_once_.size() / vector_length,
                             out);
}

}  // namespace rotordrop
