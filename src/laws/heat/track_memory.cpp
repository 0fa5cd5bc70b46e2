#include "laws/heat/track_memory.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/wide_vectors.h"
#include "laws/root_kernel.h"

namespace rotordrop {

using std::numbers::pi;

namespace {

constexpr double never = -std::numeric_limits<double>::infinity();

/// Lists of terms one after another, each times the same factors. Terms are whole vectors.
ROTORDROP_KERNEL void sums_of_products(const double* factors, const double* lists, std::size_t n_terms,
                                       std::size_t n_lists, std::size_t stride, double* sums) {
  for (std::size_t list = 0; list < n_lists; ++list, lists += whole_vectors(n_terms)) {
    Octet sum;
    for (std::size_t first = 0; first < n_terms; first += vector_length)
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) sum[i] += factors[first + i] * lists[first + i];
    sums[list * stride] = sum.sum();
  }
}

ROTORDROP_KERNEL void cells_of(const EvenAngles& at, std::size_t n_cells, std::uint32_t* cells) {
  const double n = static_cast<double>(n_cells), per_angle = 0.5 / pi * n;
  const auto last = static_cast<std::int32_t>(n_cells - 1);
#pragma omp simd
  for (std::size_t k = 0; k < at.n; ++k) {
    const double place = (at.first + static_cast<double>(k) * at.step) * per_angle;
    const auto cell = static_cast<std::int32_t>(place - std::floor(place / n) * n);
    cells[k] = static_cast<std::uint32_t>(std::clamp(cell, 0, last));
  }
}

/// Heat of some cells, of one flux after another.
struct CellHeat {
  const double* joules;  ///< [n_fluxes][stride]
  std::size_t n_cells, n_fluxes, stride;
  double flux_per_joule;
  double* total;  ///< of every cell so far, flux after flux [n_fluxes][total_stride]
  std::size_t total_stride;
};

/// y <- decay y + gain flux. What has died away must not become denormal, which is slow to compute with.
/// @param y  [n_cells][n_fluxes][n_terms]
ROTORDROP_KERNEL void go_on(const double* decay, const double* gain, std::size_t n_terms, const CellHeat& of,
                            double* y) {
  const CellHeat heat = of;  // what is written below cannot change it
  for (std::size_t cell = 0; cell < heat.n_cells; ++cell)
    for (std::size_t f = 0; f < heat.n_fluxes; ++f, y += whole_vectors(n_terms)) {
      const double joules = heat.joules[f * heat.stride + cell], flux = joules * heat.flux_per_joule;
      heat.total[f * heat.total_stride + cell] += joules;
#pragma omp simd
      for (std::size_t i = 0; i < whole_vectors(n_terms); ++i) y[i] = decay[i] * y[i] + gain[i] * flux + 1e-250;
    }
}

}  // namespace

double RubbedBody::effusivity() const { return std::sqrt(conductivity * capacity); }

TrackMemory::TrackMemory(const RubbedBody& body, std::size_t n_cells, std::size_t n_fluxes, double axial_width,
                         double shortest_interval, double duration)
    : scale_(1. / (std::sqrt(pi) * body.effusivity())),
      cell_angle_(2. * pi / static_cast<double>(n_cells)),
      cell_area_(cell_angle_ * body.radius * axial_width),
      n_fluxes_(n_fluxes),
      heated_at_(n_cells, never),
      heat_(n_fluxes * n_cells, 0.),
      interval_(shortest_interval),
      per_interval_(1. / shortest_interval) {
  const RootKernel kernel(duration, shortest_interval);
  rate_.assign(kernel.rate.begin(), kernel.rate.end());
  weight_.assign(kernel.weight.begin(), kernel.weight.end());
  // Filled up to whole vectors with terms that stay zero.
  rate_.resize(filled_up(rate_.size()), 0.);
  weight_.resize(rate_.size(), 0.);
  memory_.assign(n_cells * n_fluxes * rate_.size(), 0.);
  gain_.resize(rate_.size());
  decay_.resize((n_kept + 1) * rate_.size());
}

const double* TrackMemory::decay_over(double lag) const {
  if (lag != found_lag_) {
    found_ = place_of_decay(lag);
    found_lag_ = lag;
  }
  return &decay_[found_ * rate_.size()];
}

std::size_t TrackMemory::place_of_decay(double lag) const {
  const std::size_t n = rate_.size();
  const auto fill = [&](std::size_t place, double over) {
    for (std::size_t l = 0; l < n; ++l) decay_[place * n + l] = std::exp(-rate_[l] * over);
  };
  const double count = lag * per_interval_;
  if (count < static_cast<double>(n_kept) - 1.) {
    const auto k = static_cast<std::size_t>(count + 0.5);  // NOLINT(bugprone-incorrect-roundings): never negative
    if (std::fabs(count - static_cast<double>(k)) < 1e-6) {
      for (; n_filled_ <= k; ++n_filled_) {
        double* const decay = &decay_[n_filled_ * n];
        if (n_filled_ < 2)
          fill(n_filled_, static_cast<double>(n_filled_) * interval_);
        else
          std::transform(decay - n, decay, &decay_[n], decay, std::multiplies<>());
      }
      return k;
    }
  }
  if (lag != other_lag_) fill(n_kept, lag);
  other_lag_ = lag;
  return n_kept;
}

void TrackMemory::rises(const EvenAngles& at, double t, double* out, std::size_t stride) const {
  if (cells_.size() < at.n) cells_.resize(at.n);
  wide<cells_of>(at, n_cells(), cells_.data());
  for (std::size_t k = 0; k < at.n; ++k) {
    const std::size_t cell = cells_[k];
    if (k > 0 && cell == cells_[k - 1]) {
      for (std::size_t f = 0; f < n_fluxes_; ++f) out[f * stride + k] = out[f * stride + k - 1];
    } else if (heated_at_[cell] == never) {
      for (std::size_t f = 0; f < n_fluxes_; ++f) out[f * stride + k] = 0.;
    } else {
      wide<sums_of_products>(decay_over(t - heated_at_[cell]), &memory_[cell * n_fluxes_ * rate_.size()], rate_.size(),
                             n_fluxes_, stride, out + k);
    }
  }
}

void TrackMemory::set_gain(double step) {
  // Steps of equal length differ by the roundoff of the times between which they lie.
  if (std::fabs(step - gain_step_) <= 1e-9 * step) return;
  gain_step_ = step;
  for (std::size_t l = 0; l < rate_.size(); ++l)
    gain_[l] = scale_ * weight_[l] * (rate_[l] > 0. ? -std::expm1(-rate_[l] * step) / rate_[l] : step);
}

void TrackMemory::add(const SweptBand& band, const PiecesOfBand& pieces, double t, double step) {
  set_gain(step);
  const CellRange under = cells_under(band, cell_angle_);
  const std::size_t n = n_cells(), stride = filled_up(under.n);
  if (fresh_.size() < n_fluxes_ * stride) fresh_.resize(n_fluxes_ * stride);
  spread_pieces(band, pieces, cell_angle_, under, stride, fresh_.data());
  // A band that goes round comes to some cells more than once.
  for (std::size_t i = n; i < under.n; ++i)
    for (std::size_t f = 0; f < n_fluxes_; ++f) fresh_[f * stride + i % n] += fresh_[f * stride + i];
  const std::size_t first = under.first_of(n), n_touched = std::min(under.n, n),
                    n_to_end = std::min(n_touched, n - first);
  take(first, n_to_end, fresh_.data(), stride, t, step);
  take(0, n_touched - n_to_end, fresh_.data() + n_to_end, stride, t, step);
}

void TrackMemory::take(std::size_t first_cell, std::size_t n, const double* heat, std::size_t stride, double t,
                       double step) {
  double* const heated_at = heated_at_.data() + first_cell;
  for (std::size_t i = 0; i < n;) {
    const double before = heated_at[i];
    std::size_t end = i + 1;
    while (end < n && heated_at[end] == before) ++end;
    // What was never heated has nothing that could decay.
    wide<go_on>(
        decay_over(before == never ? step : t - before), gain_.data(), rate_.size(),
        CellHeat{heat + i, end - i, n_fluxes_, stride, 1. / (step * cell_area_), &heat_[first_cell + i], n_cells()},
        &memory_[(first_cell + i) * n_fluxes_ * rate_.size()]);
    i = end;
  }
  std::fill_n(heated_at, n, t);
}

}  // namespace rotordrop
