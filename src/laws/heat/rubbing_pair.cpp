#include "laws/heat/rubbing_pair.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "base/wide_vectors.h"
#include "laws/arc_cells.h"
#include "laws/root_kernel.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

/// Of lists of whole vectors.
ROTORDROP_KERNEL double sum_of_products(const double* a, const double* b, std::size_t n) {
  Octet sum;
  for (std::size_t first = 0; first < n; first += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) sum[i] += a[first + i] * b[first + i];
  return sum.sum();
}

/// y <- decay y + gain flux. What has died away must not become denormal, which is slow to compute with.
ROTORDROP_KERNEL void go_on(const double* decay, const double* gain, double flux, std::size_t n, double* y) {
#pragma omp simd
  for (std::size_t i = 0; i < whole_vectors(n); ++i) y[i] = decay[i] * y[i] + gain[i] * flux + 1e-250;
}

}  // namespace

double RubbedBody::effusivity() const { return std::sqrt(conductivity * capacity); }

// ---------------------------------------------------------------------------------------------------------- the memory

TrackMemory::TrackMemory(const RubbedBody& body, std::size_t n_cells, double axial_width, double shortest_interval,
                         double duration)
    : scale_(1. / (std::sqrt(pi) * body.effusivity())),
      cell_area_(2. * pi * body.radius / static_cast<double>(n_cells) * axial_width),
      heated_at_(n_cells, 0.),
      heat_(n_cells, 0.),
      fresh_(n_cells, 0.),
      interval_(shortest_interval),
      per_interval_(1. / shortest_interval) {
  const RootKernel kernel(duration, shortest_interval);
  rate_.assign(kernel.rate.begin(), kernel.rate.end());
  weight_.assign(kernel.weight.begin(), kernel.weight.end());
  // Filled up to whole vectors with terms that stay zero.
  rate_.resize(filled_up(rate_.size()), 0.);
  weight_.resize(rate_.size(), 0.);
  memory_.assign(n_cells * rate_.size(), 0.);
  gain_.resize(rate_.size());
  decay_.resize((n_kept + 1) * rate_.size());
}

std::size_t TrackMemory::cell_at(double angle) const {
  const double turns = angle * (0.5 / pi);
  double whole = static_cast<double>(static_cast<long>(turns));
  if (whole > turns) whole -= 1.;
  const auto cell = static_cast<std::size_t>((turns - whole) * static_cast<double>(n_cells()));
  return std::min(cell, n_cells() - 1);
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

double TrackMemory::rise(double angle, double t) const {
  const std::size_t cell = cell_at(angle);
  if (heat_[cell] == 0.) return 0.;
  // Pieces of a band ask for the same cell one after another.
  if (cell != risen_cell_ || t != risen_at_) {
    risen_ = wide<sum_of_products>(decay_over(t - heated_at_[cell]), &memory_[cell * rate_.size()], rate_.size());
    risen_cell_ = cell;
    risen_at_ = t;
  }
  return risen_;
}

void TrackMemory::add(double from, double to, double half_angle, double heat) {
  if (heat == 0.) return;
  spread_over_cells(n_cells(), from, to, half_angle, [&](std::size_t cell, double share) {
    if (fresh_[cell] == 0.) fresh_cells_.push_back(cell);
    fresh_[cell] += share * heat;
  });
}

void TrackMemory::commit(double t, double step) {
  // Steps of equal length differ by the roundoff of the times between which they lie.
  if (!(std::fabs(step - gain_step_) <= 1e-9 * step)) {
    gain_step_ = step;
    for (std::size_t l = 0; l < rate_.size(); ++l)
      gain_[l] = scale_ * weight_[l] * (rate_[l] > 0. ? -std::expm1(-rate_[l] * step) / rate_[l] : step);
  }
  for (const std::size_t cell : fresh_cells_) {
    const double heat = fresh_[cell], flux = heat / (step * cell_area_);
    wide<go_on>(decay_over(t - heated_at_[cell]), gain_.data(), flux, rate_.size(), &memory_[cell * rate_.size()]);
    heated_at_[cell] = t;
    heat_[cell] += heat;
    fresh_[cell] = 0.;
  }
  fresh_cells_.clear();
  risen_cell_ = n_cells();
}

// ------------------------------------------------------------------------------------------------------------ the pair

RubbingPair::RubbingPair(const RubbedBody& ring, const RubbedBody& rotor, const Options& options, double start_time)
    : ring_(ring),
      rotor_(rotor),
      options_(options),
      ring_memory_(ring, options.ring_cells, options.axial_width, options.shortest_interval, options.duration),
      rotor_memory_(rotor, options.rotor_cells, options.axial_width, options.shortest_interval, options.duration),
      q_ring_(options.n_nodes),
      middle_(options.n_nodes),
      kernel_(options.n_nodes) {
  state_.time = start_time;
}

void RubbingPair::advance(double time, double ring_angle, double rotor_angle) {
  state_ = {};
  state_.time = time;
  last_ring_angle_ = ring_angle;
  last_rotor_angle_ = rotor_angle;
  was_in_contact_ = false;
}

void RubbingPair::advance(double time, const RubbingBand& band) {
  const double step = time - state_.time;
  if (!(step > 0.)) return;
  const std::size_t n = options_.n_nodes;
  const double b = std::min(band.half_width, pi * ring_.radius), h = 2. * b / static_cast<double>(n);
  if (!was_in_contact_) touched_at_ = state_.time;
  const double turned = was_in_contact_ ? std::remainder(band.contact_angle - last_contact_angle_, 2. * pi) : 0.;
  const double ring_way = turned - (band.ring_angle - last_ring_angle_);
  const double rotor_way = turned - (band.rotor_angle - last_rotor_angle_);
  const double ring_place = band.contact_angle - band.ring_angle;
  const double rotor_place = band.contact_angle - band.rotor_angle;
  last_contact_angle_ = band.contact_angle;
  last_ring_angle_ = band.ring_angle;
  last_rotor_angle_ = band.rotor_angle;
  was_in_contact_ = true;
  const double contact_age = time - touched_at_;
  const double ring_speed = ring_way * ring_.radius / step, rotor_speed = rotor_way * rotor_.radius / step;

  // Pieces are counted from the edge at which the rotor's material enters: the front of the band's way over the rotor.
  const double front = rotor_speed < 0. ? -1. : 1.;
  const auto place = [&](std::size_t k) { return front * (b - (static_cast<double>(k) + 0.5) * h); };
  const double per_flux_ring = 2. / (std::sqrt(pi) * ring_.effusivity());
  const double per_flux_rotor = 2. / (std::sqrt(pi) * rotor_.effusivity());
  const auto age = [&](double way) {  // of the rotor's material that has come so far under the band
    const double v = std::fabs(rotor_speed);
    return v * contact_age > way ? way / v : contact_age;
  };
  for (std::size_t j = 0; j < n; ++j) middle_[j] = per_flux_rotor * std::sqrt(age((static_cast<double>(j) + 0.5) * h));
  std::adjacent_difference(middle_.begin(), middle_.end(), kernel_.begin());
  // What earlier turns left on the rotor, just ahead of the band.
  const double cell = 2. * pi / static_cast<double>(rotor_memory_.n_cells());
  const double before = rotor_memory_.rise(rotor_place + front * (b / rotor_.radius + cell), time);
  const bool is_given = options_.division == RubDivision::given;
  const double q = band.heat / (step * 2. * b * options_.axial_width);

  state_ = {};
  state_.time = time;
  double sum = 0.;
  for (std::size_t k = 0; k < n; ++k) {
    const double xi = place(k);
    // The ring's material under this piece came in at the front of the band's way over the ring.
    const double from_edge = ring_speed < 0. ? b + xi : b - xi, v = std::fabs(ring_speed);
    const double dwell = v * step > from_edge ? from_edge / v : step;
    const double direct = per_flux_ring * std::sqrt(dwell);
    const double kept = ring_memory_.rise(ring_place + xi / ring_.radius, time);
    double rotor = before;
    if (is_given) {
      q_ring_[k] = band.share_to_ring * q;
      rotor += middle_[k] * (q - q_ring_[k]);
    } else {
      for (std::size_t l = 0; l < k; ++l) rotor += kernel_[k - l] * (q - q_ring_[l]);
      q_ring_[k] = (rotor + kernel_[0] * q - kept) / (kernel_[0] + direct);
      rotor += kernel_[0] * (q - q_ring_[k]);
    }
    const double ring = kept + direct * q_ring_[k];
    sum += q_ring_[k];
    state_.ring_rise = std::max(state_.ring_rise, ring);
    state_.rotor_rise = std::max(state_.rotor_rise, rotor);
    state_.largest_difference = std::max(state_.largest_difference, std::fabs(ring - rotor));
  }
  const double area_time = h * options_.axial_width * step, into_ring = sum * area_time;
  state_.share_to_ring = band.heat > 0. ? into_ring / band.heat : 0.;
  // A band that has gone by more than half of its length smears what was under which piece.
  if (std::fabs(ring_way) * ring_.radius > b || is_given) {
    ring_memory_.add(ring_place - ring_way, ring_place, b / ring_.radius, into_ring);
  } else {
    for (std::size_t k = 0; k < n; ++k) {
      const double at = ring_place + place(k) / ring_.radius;
      ring_memory_.add(at - ring_way, at, 0.5 * h / ring_.radius, q_ring_[k] * area_time);
    }
  }
  rotor_memory_.add(rotor_place - rotor_way, rotor_place, b / rotor_.radius, band.heat - into_ring);
  ring_memory_.commit(time, step);
  rotor_memory_.commit(time, step);
  into_ring_ += into_ring;
  into_rotor_ += band.heat - into_ring;
}

}  // namespace rotordrop
