#include "laws/heat/track_memory.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/real.h"
#include "base/wide_vectors.h"
#include "laws/root_kernel.h"

namespace rotordrop {

using std::numbers::pi;

namespace {

constexpr double never = -std::numeric_limits<double>::infinity();

/// Decays of the terms over several lags: all that cells of a memory need to be brought to one time.
struct Decays {
  const double* of_lag;         ///< [lags][n_terms], whole vectors of terms
  const std::uint32_t* places;  ///< of each cell's lag
  std::size_t n_terms;
};

/// Sums over the terms of some cells, of one flux after another.
/// @param terms  [all cells][n_fluxes][n_terms]; @param sums  [n_fluxes][stride]
ROTORDROP_KERNEL void sums_of_terms(const Decays& of, const double* terms, const std::uint32_t* cells, std::size_t n,
                                    std::size_t n_fluxes, std::size_t stride, double* sums) {
  const Decays decays = of;  // what is written below cannot change it
  const std::size_t n_terms = whole_vectors(decays.n_terms);
  for (std::size_t k = 0; k < n; ++k) {
    const bool is_same = k > 0 && cells[k] == cells[k - 1];
    const double* const decay = decays.of_lag + decays.places[k] * n_terms;
    const double* of_flux = terms + cells[k] * n_fluxes * n_terms;
    for (std::size_t f = 0; f < n_fluxes; ++f, of_flux += n_terms) {
      double& found = sums[f * stride + k];
      if (is_same) {
        found = sums[f * stride + k - 1];
        continue;
      }
      Octet sum;
      for (std::size_t first = 0; first < n_terms; first += vector_length)
#pragma omp simd
        for (std::size_t i = 0; i < vector_length; ++i) sum[i] += decay[first + i] * of_flux[first + i];
      found = sum.sum();
    }
  }
}

/// Cells at some angles, and when they were heated.
/// @param heated_at  of all cells; @param cells, times  [at.n, filled up]
ROTORDROP_KERNEL void cells_of(const EvenAngles& at, std::size_t n_cells, const double* heated_at, std::uint32_t* cells,
                               double* times) {
  const double n = static_cast<double>(n_cells), per_angle = 0.5 / pi * n, per_turn = 1. / n;
  const double first = at.first * per_angle, step = at.step * per_angle;
  const auto last = static_cast<std::int32_t>(n_cells - 1);
  for (std::size_t k = 0; k < at.n; k += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const double place = first + static_cast<double>(k + i) * step;
      const auto cell = static_cast<std::int32_t>(place - std::floor(place * per_turn) * n);
      cells[k + i] = static_cast<std::uint32_t>(std::clamp(cell, 0, last));
      times[k + i] = heated_at[cells[k + i]];
    }
}

/// Lags since some times in whole intervals; `most` for those that are no whole number of intervals, or `most` of them and more.
/// @param heated_at, lags  [n, filled up]; @return the largest
ROTORDROP_KERNEL double whole_intervals(const double* heated_at, std::size_t n, double t, double per_interval,
                                        double most, std::uint32_t* lags) {
  Octet largest;
  for (std::size_t at = 0; at < n; at += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const double count = (t - heated_at[at + i]) * per_interval, limited = count < most ? count : most;
      const double whole = std::floor(limited + 0.5), distance = std::fabs(limited - whole);
      const double lag = distance < 1e-6 ? larger(whole, 0.) : most;
      lags[at + i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(lag));
      largest[i] = largest.value[i] < lag ? lag : largest.value[i];
    }
  return largest.largest();
}

/// Heat of some cells, of one flux after another.
struct CellHeat {
  const double* joules;  ///< [n_fluxes][stride]
  std::size_t n_cells, n_fluxes, stride;
  double flux_per_joule;
  double* total;  ///< of every cell so far, flux after flux [n_fluxes][total_stride]
  std::size_t total_stride;
};

/// y <- decay y + gain flux of neighbouring cells. What has died away must not become denormal, which is slow to compute with.
/// @param y  [n_cells][n_fluxes][n_terms]
ROTORDROP_KERNEL void go_on(const Decays& of, const double* gains, const CellHeat& given, double* y) {
  const Decays decays = of;
  const CellHeat heat = given;
  const std::size_t n_terms = whole_vectors(decays.n_terms), per_cell = heat.n_fluxes * n_terms;
  for (std::size_t f = 0; f < heat.n_fluxes; ++f)
    for (std::size_t cell = 0; cell < heat.n_cells; ++cell)
      heat.total[f * heat.total_stride + cell] += heat.joules[f * heat.stride + cell];
  for (std::size_t begin = 0, end = 0; begin < heat.n_cells; begin = end) {
    const std::uint32_t lag = decays.places[begin];
    for (end = begin + 1; end < heat.n_cells && decays.places[end] == lag;) ++end;
    for (std::size_t first = 0; first < n_terms; first += vector_length) {
      double decay[vector_length], gain[vector_length];
      std::copy_n(decays.of_lag + lag * n_terms + first, vector_length, decay);
      std::copy_n(gains + first, vector_length, gain);
      for (std::size_t cell = begin; cell < end; ++cell)
        for (std::size_t f = 0; f < heat.n_fluxes; ++f) {
          const double flux = heat.joules[f * heat.stride + cell] * heat.flux_per_joule;
          double* const terms = y + cell * per_cell + f * n_terms + first;
#pragma omp simd
          for (std::size_t i = 0; i < vector_length; ++i) terms[i] = decay[i] * terms[i] + gain[i] * flux + 1e-250;
        }
    }
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
      n_cells_(n_cells),
      heated_at_(filled_up(n_cells) + vector_length, never),
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
  decay_.resize(n_kept * rate_.size());
}

void TrackMemory::set_decay(std::size_t place, double lag) const {
  for (std::size_t l = 0; l < rate_.size(); ++l) decay_[place * rate_.size() + l] = std::exp(-rate_[l] * lag);
}

void TrackMemory::keep_decays_to(std::size_t lag) const {
  const std::size_t n_terms = rate_.size();
  for (; n_filled_ <= lag; ++n_filled_) {
    double* const decay = &decay_[n_filled_ * n_terms];
    if (n_filled_ < 2)
      set_decay(n_filled_, static_cast<double>(n_filled_) * interval_);
    else
      std::transform(decay - n_terms, decay, &decay_[n_terms], decay, std::multiplies<>());
  }
}

void TrackMemory::find_decays(const double* heated_at, std::size_t n, double t) const {
  if (lags_.size() < filled_up(n)) lags_.resize(filled_up(n));
  const double largest = wide<whole_intervals>(heated_at, n, t, per_interval_, n_kept, lags_.data());
  if (largest < n_kept) return keep_decays_to(static_cast<std::size_t>(largest));
  if (decay_.size() < (n_kept + n) * rate_.size()) decay_.resize((n_kept + n) * rate_.size());
  std::uint32_t place = n_kept;
  for (std::size_t k = 0; k < n; ++k) {
    if (lags_[k] < n_kept) {
      keep_decays_to(lags_[k]);
    } else if (heated_at[k] == never) {
      lags_[k] = 0;  // nothing is there that could decay
    } else if (k > 0 && heated_at[k] == heated_at[k - 1]) {
      lags_[k] = lags_[k - 1];
    } else {
      set_decay(place, t - heated_at[k]);
      lags_[k] = place++;
    }
  }
}

void TrackMemory::rises(const EvenAngles& at, double t, double* out, std::size_t stride) const {
  const std::size_t n = filled_up(at.n);
  if (cells_.size() < n) {
    cells_.resize(n);
    times_.resize(n);
  }
  wide<cells_of>(at, n_cells(), heated_at_.data(), cells_.data(), times_.data());
  find_decays(times_.data(), at.n, t);
  wide<sums_of_terms>(Decays{decay_.data(), lags_.data(), rate_.size()}, memory_.data(), cells_.data(), at.n, n_fluxes_,
                      stride, out);
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
  if (n == 0) return;
  find_decays(&heated_at_[first_cell], n, t);
  wide<go_on>(Decays{decay_.data(), lags_.data(), rate_.size()}, gain_.data(),
              CellHeat{heat, n, n_fluxes_, stride, 1. / (step * cell_area_), &heat_[first_cell], n_cells()},
              &memory_[first_cell * n_fluxes_ * rate_.size()]);
  std::fill_n(heated_at_.data() + first_cell, n, t);
}

}  // namespace rotordrop
