#include "laws/heat/moving_band.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/expint.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/rotation.h"
#include "base/wide_vectors.h"
#include "laws/arc_cells.h"
#include "laws/root_kernel.h"

namespace rotordrop {
namespace {

using std::numbers::egamma;
using std::numbers::pi;

// exp(x) K0(x) and exp(x) K1(x); the asymptotic series where the plain functions would leave the range of numbers.
double scaled_K(int order, double x) {
  if (x < 100.) return std::exp(x) * boost::math::cyl_bessel_k(order, x);
  const double m = 4. * order * order;
  double term = 1., sum = 1.;
  for (int j = 1; j < 8; ++j) {
    term *= (m - (2. * j - 1.) * (2. * j - 1.)) / (8. * j * x);
    sum += term;
  }
  return std::sqrt(0.5 * pi / x) * sum;
}

/// Integral of exp(u) K0(u) from 0 to x >= 0: x exp(x) [K0(x) + K1(x)] - 1.
double slow_side(double x) {
  if (x < 1e-8) return x > 0. ? x * (1. - std::log(0.5 * x) - egamma) : 0.;
  return x * (scaled_K(0, x) + scaled_K(1, x)) - 1.;
}

/// Integral of exp(-u) K0(u) from 0 to x >= 0: x exp(-x) [K0(x) - K1(x)] + 1.
double fast_side(double x) {
  if (x < 1e-8) return slow_side(x);
  return x * std::exp(-2. * x) * (scaled_K(0, x) - scaled_K(1, x)) + 1.;
}

/// Largest value over (-1, 1) of a function with one hump.
template <class Function>
double largest(Function f) {
  return -boost::math::tools::brent_find_minima([&](double x) { return -f(x); }, -1., 1., 30).second;
}

/// Largest rise of a band at rest over q b/k, after the time Fo b^2/kappa.
double rise_at_rest(double Fo) {
  if (!(Fo > 0.)) return 0.;
  const double root = std::sqrt(Fo), z = 0.25 / Fo;
  return 2. * root / std::sqrt(pi) * std::erf(0.5 / root) + (z < 700. ? boost::math::expint(1, z) / pi : 0.);
}

}  // namespace

double surface_rise(double flux, double time, double conductivity, double capacity) {
  return 2. * flux * std::sqrt(time / (pi * conductivity * capacity));
}

// ---------------------------------------------------------------------------------------------------------- moving band

double MovingBand::peclet() const { return 0.5 * std::fabs(speed) * half_width * capacity / conductivity; }

double MovingBand::rise(double x, double t) const {
  if (!(t > 0.)) return 0.;
  // In units of b and b^2/kappa, with s = p^2; the band moves towards positive x. The integrand is smooth except where an edge passes at small p, so
  // it is cut there and in decades.
  const double L = peclet(), X = (speed < 0. ? -x : x) / half_width;
  const double last = std::sqrt(t * conductivity / capacity) / half_width;
  const auto integrand = [&](double p) {
    if (p == 0.) return std::fabs(X) < 1. ? 2. : (std::fabs(X) > 1. ? 0. : 1.);
    const double place = X + 2. * L * p * p;
    return std::erf(0.5 * (place + 1.) / p) - std::erf(0.5 * (place - 1.) / p);
  };
  std::vector<double> cuts = {0., last};
  for (double p = 0.1 * last; p > 1e-6 * last; p *= 0.1) cuts.push_back(p);
  for (const double edge : {-1., 1.})
    if (L > 0. && edge > X) {
      const double passed = std::sqrt(0.5 * (edge - X) / L);
      // The edge is smeared over the heat's way in that time: sqrt(time).
      for (const double factor : {1., 0.5, 2.}) cuts.push_back(factor * passed);
      for (const double n : {-4., 4.}) {
        const double place = edge - X + n * passed;
        if (place > 0.) cuts.push_back(std::sqrt(0.5 * place / L));
      }
    }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.;
  for (std::size_t i = 1; i < cuts.size() && cuts[i - 1] < last; ++i)
    if (cuts[i] > cuts[i - 1])
      sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(integrand, cuts[i - 1],
                                                                           std::min(cuts[i], last), 8, 1e-9);
  return flux * half_width / conductivity * sum / std::sqrt(pi);
}

double MovingBand::steady_rise(double x) const {
  const double L = peclet(), ahead = L * (1. - (speed < 0. ? -x : x) / half_width), behind = 2. * L - ahead;
  if (L == 0.) return std::numeric_limits<double>::infinity();
  // Heat that fell on a place when the band's front passed it decays slowly; heat from behind would have to run after it.
  double sum = 0.;
  if (ahead >= 0. && behind >= 0.)
    sum = slow_side(ahead) + fast_side(behind);
  else if (behind < 0.)  // the place is behind the band
    sum = slow_side(ahead) - slow_side(-behind);
  else  // in front of it
    sum = fast_side(behind) - fast_side(-ahead);
  return flux * half_width / (pi * conductivity * L) * sum;
}

double MovingBand::largest_rise(double t) const {
  return largest([&](double place) { return rise(place * half_width, t); });
}

double MovingBand::largest_rise_estimate(double t) const {
  constexpr double p = 1.4;
  const double L = peclet(), n = 1.4 + 1.6 * std::sqrt(L);
  const double limit =
      L > 0. ? std::pow(1. + std::pow(std::exp(-egamma) / L, p), 1. / p) / L : std::numeric_limits<double>::infinity();
  const double Fo_t = t * conductivity / (capacity * half_width * half_width);
  const double less = std::min(Fo_t, limit), ratio = less / std::max(Fo_t, limit);
  if (!(less > 0.)) return 0.;
  if (std::isinf(less)) return less;
  return flux * half_width / conductivity * rise_at_rest(less * std::pow(1. + std::pow(ratio, n), -1. / n));
}

// ------------------------------------------------------------------------------------------------------------ swept arc

std::size_t SweptArcHistory::cells_for(double radius, double half_width) {
  return std::max<std::size_t>(720, static_cast<std::size_t>(std::ceil(2. * pi * radius / (0.5 * half_width))) + 1);
}

SweptArcHistory::SweptArcHistory(const BoreSurface& surface, const Options& options, double start_time)
    : surface_(surface), slot_of_cell_(options.n_cells, untouched) {
  state_.time = start_time;
  RootKernel kernel(options.duration, options.shortest_interval);
  rate_ = std::move(kernel.rate);
  weight_ = std::move(kernel.weight);
  decay_.resize(rate_.size());
  gain_.resize(rate_.size());
}

void SweptArcHistory::set_interval(double step) {
  if (step == interval_) return;
  interval_ = step;
  const double scale = 1. / std::sqrt(pi * surface_.conductivity * surface_.capacity);
  for (std::size_t l = 0; l < rate_.size(); ++l) {
    decay_[l] = std::exp(-rate_[l] * step);
    gain_[l] = scale * weight_[l] * (rate_[l] > 0. ? -std::expm1(-rate_[l] * step) / rate_[l] : step);
  }
}

std::size_t SweptArcHistory::slot_for(std::size_t cell) {
  std::size_t& slot = slot_of_cell_[cell];
  if (slot == untouched) {
    slot = cell_of_slot_.size();
    cell_of_slot_.push_back(cell);
    const std::size_t n = filled_up(cell_of_slot_.size());
    for (auto* column : {&flux_, &rise_, &total_}) column->resize(n, 0.);
    memory_.resize(n * rate_.size(), 0.);
  }
  return slot;
}

void SweptArcHistory::deposit(double from, double to, const RubbingSpot& spot, double heat) {
  const double area = surface_.radius * 2. * pi / static_cast<double>(n_cells()) * spot.axial_width;
  spread_over_cells(n_cells(), from, to, spot.half_width / surface_.radius, [&](std::size_t cell, double share) {
    const std::size_t slot = slot_for(cell);
    total_[slot] += share * heat;
    flux_[slot] += share * heat / (interval_ * area);
  });
}

namespace {

struct RisesFound {
  double largest, sum;
};

/// Each vector of cells through all terms. What has died away must not become denormal, which is slow to compute with.
ROTORDROP_KERNEL RisesFound decay_cells(double direct, const double* decay, const double* gain, std::size_t n_terms,
                                        const double* flux, double* memory, double* rise, std::size_t n_cells) {
  Octet largest, sum;
  for (std::size_t at = 0; at < n_cells; at += vector_length) {
    const Octet into = first_of(flux + at, vector_length);
    Octet total;
    add_product(total, direct, into.value.data());
    for (std::size_t l = 0; l < n_terms; ++l, memory += vector_length) {
      const double d = decay[l], g = gain[l];
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        const double old = d * memory[i];
        total[i] += old;
        memory[i] = old + g * into.value[i] + 1e-250;
      }
    }
    store_first(total, vector_length, rise + at);
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      largest[i] = largest.value[i] > total.value[i] ? largest.value[i] : total.value[i];
      sum[i] += total.value[i];
    }
  }
  return {largest.largest(), sum.sum()};
}

}  // namespace

void SweptArcHistory::decay_and_heat(double step) {
  const double direct = 2. * std::sqrt(step / (pi * surface_.conductivity * surface_.capacity));
  const RisesFound found = wide<decay_cells>(direct, decay_.data(), gain_.data(), rate_.size(), flux_.data(),
                                             memory_.data(), rise_.data(), rise_.size());
  state_.largest_rise = found.largest;
  state_.mean_rise = found.sum / static_cast<double>(n_cells());
}

void SweptArcHistory::advance(double time, const RubbingSpot& spot) {
  const double step = time - state_.time;
  if (!(step > 0.)) return;
  set_interval(step);
  const bool is_in_contact = spot.heat_rate > 0.;
  if (!has_begun_) start_ring_angle_ = spot.ring_angle;
  has_begun_ = true;
  const double angle = shorter_way(spot.contact_angle - spot.ring_angle);

  std::fill(flux_.begin(), flux_.end(), 0.);
  double way = 0.;
  if (is_in_contact) {
    if (was_in_contact_) way = shorter_way(angle - last_angle_);
    deposit(angle - way, angle, spot, spot.heat_rate * step);
  }
  decay_and_heat(step);

  const double cell_angle = 2. * pi / static_cast<double>(n_cells());
  State& s = state_;
  s.time = time;
  s.arc_of_contact = is_in_contact && was_in_contact_ ? s.arc_of_contact + std::fabs(way) : 0.;
  s.arc_total += std::fabs(way);
  s.heated_arc = cell_angle * static_cast<double>(cell_of_slot_.size());
  s.ring_turns = (spot.ring_angle - start_ring_angle_) / (2. * pi);
  s.rise_at_contact = 0.;
  if (is_in_contact) {
    const auto cell = static_cast<std::size_t>((angle < 0. ? angle + 2. * pi : angle) / cell_angle) % n_cells();
    const std::size_t slot = slot_of_cell_[cell];
    if (slot != untouched) s.rise_at_contact = rise_[slot];
  }
  const auto hottest = static_cast<std::size_t>(std::find(rise_.begin(), rise_.end(), s.largest_rise) - rise_.begin());
  if (hottest < cell_of_slot_.size())
    s.largest_rise_angle = (static_cast<double>(cell_of_slot_[hottest]) + 0.5) * cell_angle;
  was_in_contact_ = is_in_contact;
  last_angle_ = angle;
}

std::vector<double> SweptArcHistory::rises() const {
  std::vector<double> result(n_cells(), 0.);
  for (std::size_t slot = 0; slot < cell_of_slot_.size(); ++slot) result[cell_of_slot_[slot]] = rise_[slot];
  return result;
}

std::vector<double> SweptArcHistory::heat() const {
  std::vector<double> result(n_cells(), 0.);
  for (std::size_t slot = 0; slot < cell_of_slot_.size(); ++slot) result[cell_of_slot_[slot]] = total_[slot];
  return result;
}

double SweptArcHistory::valid_until() const {
  return 0.25 * surface_.wall_thickness * surface_.wall_thickness * surface_.capacity / surface_.conductivity;
}

}  // namespace rotordrop
