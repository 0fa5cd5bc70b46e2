#include "laws/heat/rubbing_pair.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/rotation.h"
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

// ---------------------------------------------------------------------------------------------------------- the memory

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
  const auto count = static_cast<long>(n);
  const auto first = static_cast<std::size_t>(((under.first % count) + count) % count);
  const std::size_t n_touched = std::min(under.n, n), n_to_end = std::min(n_touched, n - first);
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

// ------------------------------------------------------------------------------------------------------------ the pair

struct RubbingPair::Passage {
  double b, h;                                          // half of the band, length of a piece [m]
  double ring_place, ring_way, rotor_place, rotor_way;  // of the band's middle over either body [rad]
  double ring_radius, ring_speed, rotor_speed;          // [m], [m/s]
  double time, step, contact_age;                       // [s]
  double front;                                         // 1 or -1: the edge at which the rotor's material enters
  [[nodiscard]] bool ring_is_slow() const { return std::fabs(ring_way) * ring_radius <= b; }
};

namespace {

/// Time of the present interval for which a body's material has been under the band, whose edge it passed so far back.
ROTORDROP_KERNEL double time_under_band(double way, double speed, double whole) {
  const double v = std::fabs(speed);
  return v * whole > way ? way / v : whole;
}

template <class Passage>
ROTORDROP_KERNEL void responses(const Passage& p, double per_flux_ring, double per_flux_rotor, std::size_t n,
                                const PieceResponses& out) {
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const double way = (static_cast<double>(k) + 0.5) * p.h, xi = p.front * (p.b - way);
    // The ring's material under this piece came in at the front of the band's way over the ring.
    const double from_edge = p.ring_speed < 0. ? p.b + xi : p.b - xi;
    out.direct[k] = per_flux_ring * std::sqrt(time_under_band(from_edge, p.ring_speed, p.step));
    out.rotor_rise[k] = per_flux_rotor * std::sqrt(time_under_band(way, p.rotor_speed, p.contact_age));
  }
  out.kernel[0] = out.rotor_rise[0];
#pragma omp simd
  for (std::size_t k = 1; k < n; ++k) out.kernel[k] = out.rotor_rise[k] - out.rotor_rise[k - 1];
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) out.inverse[k] = 1. / (out.kernel[0] + out.direct[k]);
}

/// Largest in a band's pieces.
struct Hottest {
  double ring, rotor, difference;
  double sum_of_fluxes;  ///< into the ring [W/m2]
};

ROTORDROP_KERNEL double larger_of(double a, double b) { return a > b ? a : b; }

struct HottestSoFar {
  Octet ring, rotor, difference, sum;
  ROTORDROP_KERNEL void take(std::size_t i, bool is_piece, double on_ring, double on_rotor, double flux) {
    ring[i] = larger_of(is_piece ? on_ring : 0., ring.value[i]);
    rotor[i] = larger_of(is_piece ? on_rotor : 0., rotor.value[i]);
    difference[i] = larger_of(is_piece ? std::fabs(on_ring - on_rotor) : 0., difference.value[i]);
    sum[i] += is_piece ? flux : 0.;
  }
  [[nodiscard]] ROTORDROP_KERNEL Hottest found() const {
    return {ring.largest(), rotor.largest(), difference.largest(), sum.sum()};
  }
};

/// Under even fluxes. Lists are whole vectors.
ROTORDROP_KERNEL Hottest hottest_of_even(std::size_t n, double q_ring, double q_rotor, double before,
                                         const double* kept, const double* direct, const double* rotor_rise) {
  HottestSoFar hottest;
  for (std::size_t first = 0; first < n; first += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const std::size_t k = first + i;
      hottest.take(i, k < n, kept[k] + direct[k] * q_ring, before + rotor_rise[k] * q_rotor, q_ring);
    }
  return hottest.found();
}

/// Under fluxes of each piece. Lists are whole vectors.
ROTORDROP_KERNEL Hottest hottest_of(std::size_t n, const double* q_ring, const double* on_rotor, const double* kept,
                                    const double* direct) {
  HottestSoFar hottest;
  for (std::size_t first = 0; first < n; first += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const std::size_t k = first + i;
      hottest.take(i, k < n, kept[k] + direct[k] * q_ring[k], on_rotor[k], q_ring[k]);
    }
  return hottest.found();
}

/// From the front on: q_ring so that both temperatures are one in each piece. With R_k the rotor's rise by the pieces before,
///   q_rotor = [kept + direct q - R_k] / (direct + kernel_0),
/// written so that little has to wait for the piece before.
/// @param before    the rotor's rise ahead of the band
/// @param on_rotor  the rise at each piece's middle
ROTORDROP_KERNEL void meet(std::size_t n, double q, double before, const PieceResponses& by, const double* kept,
                           double* q_ring, double* on_rotor) {
  for (std::size_t k = 0; k < n; ++k) {
    q_ring[k] = (kept[k] + by.direct[k] * q) * by.inverse[k];
    on_rotor[k] = before;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double q_rotor = q_ring[k] - on_rotor[k] * by.inverse[k];
    q_ring[k] = q - q_rotor;
    for (std::size_t j = k; j < n; ++j) on_rotor[j] += by.kernel[j - k] * q_rotor;
  }
}

}  // namespace

RubbingPair::RubbingPair(const RubbedBody& ring, const RubbedBody& rotor, const Options& options, double start_time)
    : ring_(ring),
      rotor_(rotor),
      options_(options),
      ring_memory_(ring, options.ring_cells, options.divisions.size(), options.axial_width, options.shortest_interval,
                   options.duration),
      rotor_memory_(rotor, options.rotor_cells, options.divisions.size(), options.axial_width,
                    options.shortest_interval, options.duration),
      time_(start_time),
      into_ring_(options.divisions.size()),
      into_rotor_(options.divisions.size()),
      before_(options.divisions.size()),
      states_(options.divisions.size()) {
  const std::size_t n = filled_up(options.n_nodes);
  kept_.resize(n * options.divisions.size());
  for (auto* list : {&rotor_rise_, &direct_, &kernel_, &inverse_, &q_ring_, &on_rotor_}) list->resize(n);
  ring_joules_.resize(options.n_nodes * options.divisions.size());
  rotor_joules_.resize(options.divisions.size());
  for (State& state : states_) state.time = start_time;
}

void RubbingPair::advance(double time, double ring_angle, double rotor_angle) {
  time_ = time;
  for (State& state : states_) state = {.time = time};
  last_ring_angle_ = ring_angle;
  last_rotor_angle_ = rotor_angle;
  was_in_contact_ = false;
}

RubbingPair::Passage RubbingPair::passage(double time, const RubbingBand& band) {
  Passage p{};
  p.time = time;
  p.step = time - time_;
  p.b = std::min(band.half_width, pi * ring_.radius);
  p.h = 2. * p.b / static_cast<double>(options_.n_nodes);
  if (!was_in_contact_) touched_at_ = time_;
  const double turned = was_in_contact_ ? shorter_way(band.contact_angle - last_contact_angle_) : 0.;
  p.ring_way = turned - (band.ring_angle - last_ring_angle_);
  p.rotor_way = turned - (band.rotor_angle - last_rotor_angle_);
  p.ring_place = band.contact_angle - band.ring_angle;
  p.rotor_place = band.contact_angle - band.rotor_angle;
  last_contact_angle_ = band.contact_angle;
  last_ring_angle_ = band.ring_angle;
  last_rotor_angle_ = band.rotor_angle;
  was_in_contact_ = true;
  p.contact_age = time - touched_at_;
  p.ring_radius = ring_.radius;
  p.ring_speed = p.ring_way * ring_.radius / p.step;
  p.rotor_speed = p.rotor_way * rotor_.radius / p.step;
  p.front = p.rotor_speed < 0. ? -1. : 1.;
  return p;
}

void RubbingPair::look_at_tracks(const Passage& p) {
  const std::size_t n = options_.n_nodes, stride = direct_.size();
  const double pieces = static_cast<double>(n), cell = 2. * pi / static_cast<double>(rotor_memory_.n_cells());
  // What comes under the band in an interval lies all along its way: each sample is of another part of it. What lies at its end alone would decide on
  // heat for all the way, and two surfaces that roll on each other in long intervals would heat each other without end.
  const auto along = [&](double end, double way, double step) {
    return EvenAngles{end - 0.5 * way / pieces, step - way / pieces, n};
  };
  const double ahead = p.rotor_place + p.front * (p.b / rotor_.radius + cell);
  rotor_memory_.rises(along(ahead, p.rotor_way, 0.), p.time, kept_.data(), stride);
  for (std::size_t d = 0; d < before_.size(); ++d) {
    const auto first = kept_.begin() + static_cast<std::ptrdiff_t>(d * stride);
    before_[d] = std::accumulate(first, first + static_cast<std::ptrdiff_t>(n), 0.) / pieces;
  }
  const double front_piece = p.ring_place + p.front * (p.b - 0.5 * p.h) / ring_.radius;
  ring_memory_.rises(along(front_piece, p.ring_is_slow() ? 0. : p.ring_way, -p.front * p.h / ring_.radius), p.time,
                     kept_.data(), stride);
  wide<responses<Passage>>(p, 2. / (std::sqrt(pi) * ring_.effusivity()), 2. / (std::sqrt(pi) * rotor_.effusivity()), n,
                           piece_responses());
}

void RubbingPair::divide(const Passage& p, double q, std::size_t division, double share_to_ring) {
  const std::size_t n = options_.n_nodes;
  const double* kept = &kept_[division * direct_.size()];
  const double before = before_[division];
  Hottest found;
  if (options_.divisions[division] == RubDivision::given) {
    const double q_ring = share_to_ring * q;
    found = wide<hottest_of_even>(n, q_ring, q - q_ring, before, kept, direct_.data(), rotor_rise_.data());
    std::fill_n(q_ring_.begin(), n, q_ring);
  } else {
    wide<meet>(n, q, before, piece_responses(), kept, q_ring_.data(), on_rotor_.data());
    found = wide<hottest_of>(n, q_ring_.data(), on_rotor_.data(), kept, direct_.data());
  }
  const double area_time = p.h * options_.axial_width * p.step, into_ring = found.sum_of_fluxes * area_time;
  const double heat = q * area_time * static_cast<double>(n);
  states_[division] = {p.time, found.ring, found.rotor, found.difference, heat > 0. ? into_ring / heat : 0.};
  into_ring_[division] += into_ring;
  into_rotor_[division] += heat - into_ring;
  rotor_joules_[division] = heat - into_ring;
  if (!p.ring_is_slow()) {
    ring_joules_[division] = into_ring;
    return;
  }
  double* const joules = &ring_joules_[division * n];  // from the lower angle up
  for (std::size_t k = 0; k < n; ++k) joules[k] = q_ring_[p.front > 0. ? n - 1 - k : k] * area_time;
}

void RubbingPair::advance(double time, const RubbingBand& band, std::span<const double> shares_to_ring) {
  if (!(time > time_)) return;
  const Passage p = passage(time, band);
  look_at_tracks(p);
  const double q = band.heat / (p.step * 2. * p.b * options_.axial_width);
  const std::size_t n_divisions = options_.divisions.size();
  for (std::size_t d = 0; d < n_divisions; ++d) divide(p, q, d, d < shares_to_ring.size() ? shares_to_ring[d] : 0.);
  const auto swept = [](double place, double way, double half_angle) {
    return SweptBand{std::min(place - way, place), std::max(place - way, place), std::min(half_angle, pi)};
  };
  // A band that has gone by more than half of its length smears what was under which piece.
  ring_memory_.add(swept(p.ring_place, p.ring_way, p.b / ring_.radius),
                   {ring_joules_.data(), p.ring_is_slow() ? options_.n_nodes : 1, n_divisions}, time, p.step);
  rotor_memory_.add(swept(p.rotor_place, p.rotor_way, p.b / rotor_.radius), {rotor_joules_.data(), 1, n_divisions},
                    time, p.step);
  time_ = time;
}

}  // namespace rotordrop
