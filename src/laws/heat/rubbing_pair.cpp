#include "laws/heat/rubbing_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "base/real.h"
#include "base/rotation.h"
#include "base/wide_vectors.h"

namespace rotordrop {

using std::numbers::pi;

struct BandPassage {
  double b, h;                                          // half of the band, length of a piece [m]
  double ring_place, ring_way, rotor_place, rotor_way;  // of the band's middle over either body [rad]
  double ring_radius, ring_speed, rotor_speed;          // [m], [m/s]
  double time, step, contact_age;                       // [s]
  double heat, flux;                                    // of both bodies together [J], [W/m2]
  double front;                                         // 1 or -1: the edge at which the rotor's material enters
  [[nodiscard]] bool ring_is_slow() const { return std::fabs(ring_way) * ring_radius <= b; }
};

namespace {

constexpr std::size_t many_pieces = 12;

/// Time of the present interval for which a body's material has been under the band, whose edge it passed so far back.
ROTORDROP_KERNEL double time_under_band(double way, double speed, double whole) {
  const double v = std::fabs(speed);
  return v * whole > way ? way / v : whole;
}

ROTORDROP_KERNEL void responses(const BandPassage& p, double per_flux_ring, double per_flux_rotor, std::size_t n,
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

/// Lists are filled up to whole vectors with zeros.
ROTORDROP_KERNEL Hottest hottest_of(std::size_t n, const double* q_ring, const double* on_rotor, const double* kept,
                                    const double* direct) {
  Octet ring, rotor, difference, sum;
  for (std::size_t first = 0; first < n; first += vector_length)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const std::size_t k = first + i;
      const double on_ring = kept[k] + direct[k] * q_ring[k];
      ring[i] = larger(ring.value[i], on_ring);
      rotor[i] = larger(rotor.value[i], on_rotor[k]);
      difference[i] = larger(difference.value[i], std::fabs(on_ring - on_rotor[k]));
      sum[i] += q_ring[k];
    }
  return {ring.largest(), rotor.largest(), difference.largest(), sum.sum()};
}

/// A given flux into the ring, even over all pieces.
/// @param on_rotor  the rise at each piece's middle
ROTORDROP_KERNEL void share_out(std::size_t n, double given, double q_rotor, double before, const PieceResponses& by,
                                double* q_ring, double* on_rotor) {
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    q_ring[k] = given;
    on_rotor[k] = before + by.rotor_rise[k] * q_rotor;
  }
}

/// From the front on: q_ring so that both temperatures are one in each piece. With R_k the rotor's rise by the pieces before,
///   q_rotor = [kept + direct q - R_k] / (direct + kernel_0),
/// written so that little has to wait for the piece before.
/// @param before    the rotor's rise ahead of the band
/// @param on_rotor  the rise at each piece's middle
template <std::size_t n>
ROTORDROP_KERNEL void meet(double q, double before, const PieceResponses& by, const double* kept, double* q_ring,
                           double* on_rotor) {
  // alone: q_rotor of a piece if no other heated the rotor, and the rotor came cold.
  double rotor[n], alone[n], kernel[n];
  std::copy_n(by.kernel, n, kernel);
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    alone[k] = (kept[k] + by.direct[k] * q) * by.inverse[k];
    rotor[k] = before;
  }
#pragma GCC unroll 12
  for (std::size_t k = 0; k < n; ++k) {
    const double q_rotor = alone[k] - rotor[k] * by.inverse[k];
    q_ring[k] = q - q_rotor;
#pragma GCC unroll 12
    for (std::size_t j = k; j < n; ++j) rotor[j] += kernel[j - k] * q_rotor;
    on_rotor[k] = rotor[k];
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
  if (options.n_pieces != 1 && options.n_pieces != many_pieces)
    throw std::invalid_argument("a rubbing band has 1 or 12 pieces");
  const std::size_t n = filled_up(options.n_pieces);
  kept_.resize(n * options.divisions.size());
  for (auto* list : {&rotor_rise_, &direct_, &kernel_, &inverse_, &q_ring_, &on_rotor_}) list->resize(n);
  ring_joules_.resize(options.n_pieces * options.divisions.size());
  rotor_joules_.resize(options.divisions.size());
}

void RubbingPair::advance(double time, double ring_angle, double rotor_angle) {
  time_ = time;
  std::fill(states_.begin(), states_.end(), State{});
  last_ring_angle_ = ring_angle;
  last_rotor_angle_ = rotor_angle;
  was_in_contact_ = false;
}

BandPassage RubbingPair::passage(double time, const RubbingBand& band) {
  BandPassage p{};
  p.time = time;
  p.step = time - time_;
  p.b = std::min(band.half_width, pi * ring_.radius);
  p.h = 2. * p.b / static_cast<double>(options_.n_pieces);
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
  p.heat = band.heat;
  p.flux = band.heat / (p.step * 2. * p.b * options_.axial_width);
  return p;
}

void RubbingPair::look_at_tracks(const BandPassage& p) {
  const std::size_t n = options_.n_pieces, stride = direct_.size();
  const double pieces = static_cast<double>(n), cell = 2. * pi / static_cast<double>(rotor_memory_.n_cells());
  // What comes under the band in an interval lies all along its way: each sample is of another part of it. What lies at its end alone would decide on
  // heat for all the way, and two surfaces that roll on each other in long intervals would heat each other without end.
  const auto along = [&](double end, double way, double step) {
    return EvenAngles{end - 0.5 * way / pieces, step - way / pieces, n};
  };
  // The rotor's own are needed as means alone, before the list is taken for the ring's.
  const double ahead = p.rotor_place + p.front * (p.b / rotor_.radius + cell);
  rotor_memory_.rises(along(ahead, p.rotor_way, 0.), p.time, kept_.data(), stride);
  for (std::size_t d = 0; d < before_.size(); ++d) {
    const auto first = kept_.begin() + static_cast<std::ptrdiff_t>(d * stride);
    before_[d] = std::accumulate(first, first + static_cast<std::ptrdiff_t>(n), 0.) / pieces;
  }
  const double front_piece = p.ring_place + p.front * (p.b - 0.5 * p.h) / ring_.radius;
  ring_memory_.rises(along(front_piece, p.ring_is_slow() ? 0. : p.ring_way, -p.front * p.h / ring_.radius), p.time,
                     kept_.data(), stride);
  wide<responses>(p, 2. / (std::sqrt(pi) * ring_.effusivity()), 2. / (std::sqrt(pi) * rotor_.effusivity()), n,
                  piece_responses());
}

void RubbingPair::divide(const BandPassage& p, std::size_t division, double share_to_ring) {
  const std::size_t n = options_.n_pieces;
  const double* kept = &kept_[division * direct_.size()];
  const double before = before_[division], q = p.flux;
  if (options_.divisions[division] == RubDivision::given)
    wide<share_out>(n, share_to_ring * q, q - share_to_ring * q, before, piece_responses(), q_ring_.data(),
                    on_rotor_.data());
  else if (n == many_pieces)
    wide<meet<many_pieces>>(q, before, piece_responses(), kept, q_ring_.data(), on_rotor_.data());
  else
    wide<meet<1>>(q, before, piece_responses(), kept, q_ring_.data(), on_rotor_.data());
  const Hottest found = wide<hottest_of>(q_ring_.size(), q_ring_.data(), on_rotor_.data(), kept, direct_.data());
  const double area_time = p.h * options_.axial_width * p.step, into_ring = found.sum_of_fluxes * area_time;
  states_[division] = {found.ring, found.rotor, found.difference, p.heat > 0. ? into_ring / p.heat : 0.};
  into_ring_[division] += into_ring;
  rotor_joules_[division] = p.heat - into_ring;
  into_rotor_[division] += rotor_joules_[division];
  if (!p.ring_is_slow()) {
    ring_joules_[division] = into_ring;
    return;
  }
  double* const joules = &ring_joules_[division * n];  // from the lower angle up
  for (std::size_t k = 0; k < n; ++k) joules[k] = q_ring_[p.front > 0. ? n - 1 - k : k] * area_time;
}

void RubbingPair::advance(double time, const RubbingBand& band, std::span<const double> shares_to_ring) {
  if (!(time > time_)) return;
  const BandPassage p = passage(time, band);
  look_at_tracks(p);
  const std::size_t n_divisions = options_.divisions.size();
  for (std::size_t d = 0; d < n_divisions; ++d) divide(p, d, d < shares_to_ring.size() ? shares_to_ring[d] : 0.);
  const auto swept = [](double place, double way, double half_angle) {
    return SweptBand{std::min(place - way, place), std::max(place - way, place), std::min(half_angle, pi)};
  };
  // A band that has gone by more than half of its length smears what was under which piece.
  ring_memory_.add(swept(p.ring_place, p.ring_way, p.b / ring_.radius),
                   {ring_joules_.data(), p.ring_is_slow() ? options_.n_pieces : 1, n_divisions}, time, p.step);
  rotor_memory_.add(swept(p.rotor_place, p.rotor_way, p.b / rotor_.radius), {rotor_joules_.data(), 1, n_divisions},
                    time, p.step);
  time_ = time;
}

}  // namespace rotordrop
