#include "integrate/exponential_stages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/exponential_series.h"
#include "base/rotation.h"
#include "base/sine_cosine.h"
#include "base/split_exponential.h"
#include "integrate/pairs.h"

namespace rotordrop {
namespace {

/// exp(f z) of whole vectors from `first` to `last` - 1; Re(f z) <= 0 and |Im(f z)| up to a million radians.
ROTORDROP_KERNEL void exponentials(std::size_t first, std::size_t last, double f, const double* z_re,
                                   const double* z_im, double* __restrict re, double* __restrict im) {
#pragma omp simd
  for (std::size_t i = first; i < last; ++i) {
    const double decay = f * z_re[i];
    const SplitExponential e = split_exponential(decay > -700. ? decay : -700.);
    const double size = e.power * (1. + (e.rest + e.rest * e.rest * exponential_tail(e.rest)));
    const auto [sine, cosine] = sine_cosine_within(f * z_im[i]);
    re[i] = size * cosine;
    im[i] = size * sine;
  }
}

}  // namespace

struct ExponentialStages::Kernels {
  /// z of a step, and 1 / z. @param first  of whole vectors of kinds, from it on
  ROTORDROP_KERNEL static void find_z(const Kinds& kinds, std::size_t first, double step, Complexes& z,
                                      Complexes& inverse) {
    const double *half_damping = kinds.half_damping.data(), *omega_damped = kinds.omega_damped.data(),
                 *omega_squared = kinds.omega_squared.data();
    double *re = z.re.data(), *im = z.im.data(), *inverse_re = inverse.re.data(), *inverse_im = inverse.im.data();
#pragma omp simd
    for (std::size_t i = first; i < kinds.omega.size(); ++i) {
      re[i] = -step * half_damping[i];
      im[i] = step * omega_damped[i];
      const double by_square = 1. / (step * omega_squared[i]);
      inverse_re[i] = -half_damping[i] * by_square;
      inverse_im[i] = -omega_damped[i] * by_square;
    }
  }

  /// to = (f a + g) b
  ROTORDROP_KERNEL static void multiply(std::size_t first, double f, const Complexes& a, double g, const Complexes& b,
                                        Complexes& to) {
    const double *a_re = a.re.data(), *a_im = a.im.data(), *b_re = b.re.data(), *b_im = b.im.data();
    double* __restrict re = to.re.data(), * __restrict im = to.im.data();
#pragma omp simd
    for (std::size_t i = first; i < a.re.size(); ++i) {
      const double x = f * a_re[i] + g, y = f * a_im[i];
      re[i] = x * b_re[i] - y * b_im[i];
      im[i] = x * b_im[i] + y * b_re[i];
    }
  }
  /// to = g to + f a; with g = 0 whatever `to` was.
  ROTORDROP_KERNEL static void add(std::size_t first, double f, const Complexes& a, double g, Complexes& to) {
    const double *a_re = a.re.data(), *a_im = a.im.data();
    double* __restrict re = to.re.data(), * __restrict im = to.im.data();
#pragma omp simd
    for (std::size_t i = first; i < a.re.size(); ++i) {
      re[i] = (g == 0. ? 0. : g * re[i]) + f * a_re[i];
      im[i] = (g == 0. ? 0. : g * im[i]) + f * a_im[i];
    }
  }

  /// Weights of a stage.
  ROTORDROP_KERNEL static void find_weights(std::size_t first, const Fit& fit, Exponents& exponents, Weights& weights) {
    auto& [z, by_z, integrals] = exponents;
    const std::size_t n = z.re.size();
    Complexes& own = weights.exponential;
    exponentials(first, n, fit.node, z.re.data(), z.im.data(), own.re.data(), own.im.data());
    // The integral of exp((c - s) z) s^k from 0 to c, by parts: (k times that of s^(k - 1), less c^k) / z.
    multiply(first, 1., own, -1., by_z, integrals[0]);
    double power = 1.;
    for (std::size_t k = 1; k < fit.n_fitted; ++k) {
      power *= fit.node;
      multiply(first, static_cast<double>(k), integrals[k - 1], -power, by_z, integrals[k]);
    }
    for (std::size_t j = 0; j < fit.n_others; ++j) {
      const double c = fit.other_node[j];
      Complexes& weight = weights.of_rate[fit.others[j]];
      exponentials(first, n, fit.node - c, z.re.data(), z.im.data(), weight.re.data(), weight.im.data());
      add(first, 0., z, fit.other_weight[j], weight);
      double c_power = 1.;
      for (std::size_t k = 0; k < fit.n_fitted; ++k, c_power *= c) add(first, -c_power, weight, 1., integrals[k]);
    }
    for (std::size_t j = 0; j < fit.n_fitted; ++j)
      for (std::size_t k = 0; k < fit.n_fitted; ++k)
        add(first, fit.polynomial[j][k], integrals[k], k == 0 ? 0. : 1., weights.of_rate[fit.fitted[j]]);
  }

  /// w of a stage, as coordinates and velocities. @param rates  which of them count
  ROTORDROP_KERNEL static void combine(const Kinds& kinds, std::size_t first, double step, const Weights& weights,
                                       const Plane& plane, std::span<const std::size_t> rates,
                                       double* __restrict coordinate, double* __restrict velocity) {
    const std::size_t n = kinds.omega.size();
    double *re = velocity, *im = coordinate;
    const double *e_re = weights.exponential.re.data(), *e_im = weights.exponential.im.data();
    const double *start_re = plane.start.re.data(), *start_im = plane.start.im.data();
#pragma omp simd
    for (std::size_t i = first; i < n; ++i) {
      re[i] = e_re[i] * start_re[i] - e_im[i] * start_im[i];
      im[i] = e_re[i] * start_im[i] + e_im[i] * start_re[i];
    }
    for (const std::size_t j : rates) {
      const double *w_re = weights.of_rate[j].re.data(), *w_im = weights.of_rate[j].im.data();
      const double* N = plane.rest[j].data();
#pragma omp simd
      for (std::size_t i = first; i < n; ++i) {
        re[i] += step * N[i] * w_re[i];
        im[i] += step * N[i] * w_im[i];
      }
    }
    const double *inverse = kinds.inverse_omega_damped.data(), *half_damping = kinds.half_damping.data();
#pragma omp simd
    for (std::size_t i = first; i < n; ++i) {
      coordinate[i] *= inverse[i];
      velocity[i] -= half_damping[i] * coordinate[i];
    }
  }

  /// Makes what acts on each oscillator of its rate. @param N  the rates of velocities
  ROTORDROP_KERNEL static void take_off_free_motion(const Kinds& kinds, std::size_t first, const Plane& plane,
                                                    double* N) {
    const double *q = plane.coordinate.data(), *v = plane.velocity.data();
    const double *c = kinds.damping_rate.data(), *omega_squared = kinds.omega_squared.data();
#pragma omp simd
    for (std::size_t i = first; i < kinds.omega.size(); ++i) N[i] += c[i] * v[i] + omega_squared[i] * q[i];
  }

  /// @param first  whole vectors; @param from, to  what counts of them
  ROTORDROP_KERNEL static double squared_error(const Kinds& kinds, std::size_t first, std::size_t from, std::size_t to,
                                               double step, const EmbeddedTableau& method, const Plane& plane) {
    Octet sum;
    for (std::size_t at = first; at < kinds.omega.size(); at += vector_length) {
      Octet N;
      for (std::size_t j = 0; j < static_cast<std::size_t>(method.n_stages); ++j)
        if (method.e[j] != 0.) add_product(N, method.e[j], plane.rest[j].data() + at);
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        // What a force moves in a step, or in a radian if that is shorter.
        const double time = step / (1. + step * kinds.omega[at + i]);
        const double velocity = time * N.value[i] / (plane.velocity_scale[at + i] + std::fabs(plane.velocity[at + i]));
        const double coordinate =
            time * time * N.value[i] / (plane.coordinate_scale[at + i] + std::fabs(plane.coordinate[at + i]));
        sum[i] += at + i >= from && at + i < to ? velocity * velocity + coordinate * coordinate : 0.;
      }
    }
    return sum.sum();
  }
};

std::vector<Oscillator> fast_oscillators(std::vector<Oscillator> all, const IntegrationParameters& parameters) {
  std::erase_if(all, [](const Oscillator& o) { return 0.25 * o.damping_rate * o.damping_rate >= o.omega_squared; });
  const double above = two_pi * parameters.exponential_above;
  const auto is_fast = [above](const Oscillator& o) { return o.omega_squared >= above * above; };
  if (!is_own_pair(parameters.method) || std::none_of(all.begin(), all.end(), is_fast)) all.clear();
  return all;
}

ExponentialStages::ExponentialStages(const EmbeddedTableau& method, std::vector<Oscillator> oscillators,
                                     std::span<const double> scale)
    : method_(method) {
  const auto kind = [](const Oscillator& o) { return std::pair(o.omega_squared, o.damping_rate); };
  std::stable_sort(oscillators.begin(), oscillators.end(),
                   [kind](const Oscillator& a, const Oscillator& b) { return kind(a) < kind(b); });
  std::size_t plane = 0;
  for (std::size_t i = 0; i < oscillators.size(); ++i) {
    const Oscillator& o = oscillators[i];
    const bool is_new = i == 0 || kind(o) != kind(oscillators[i - 1]);
    plane = is_new ? 0 : plane + 1;
    if (is_new) {
      kinds_.omega_squared.push_back(o.omega_squared);
      kinds_.damping_rate.push_back(o.damping_rate);
    }
    if (plane == planes_.size()) planes_.emplace_back();
    const std::size_t at = kinds_.omega_squared.size() - 1;
    auto& runs = planes_[plane].runs;
    if (!runs.empty() && at == runs.back().at + runs.back().size &&
        o.coordinate == runs.back().coordinate + runs.back().size &&
        o.velocity == runs.back().velocity + runs.back().size)
      ++runs.back().size;
    else
      runs.push_back({o.coordinate, o.velocity, at, 1});
  }
  n_kinds_ = kinds_.omega_squared.size();
  first_active_ = n_kinds_;
  // What fills up a vector is as the fastest.
  const std::size_t n = filled_up(n_kinds_);
  for (auto* list : {&kinds_.omega_squared, &kinds_.damping_rate})
    if (n > 0) list->resize(n, list->back());
  for (std::size_t k = 0; k < n; ++k) {
    const double half = 0.5 * kinds_.damping_rate[k], damped = std::sqrt(kinds_.omega_squared[k] - half * half);
    kinds_.omega.push_back(std::sqrt(kinds_.omega_squared[k]));
    kinds_.half_damping.push_back(half);
    kinds_.omega_damped.push_back(damped);
    kinds_.inverse_omega_damped.push_back(1. / damped);
  }
  exponents_ = {Complexes(n), Complexes(n), std::vector<Complexes>(most_stages, Complexes(n))};
  within_.exponential = Complexes(n);
  within_.of_rate.assign(most_stages, Complexes(n));
  weights_.assign(most_stages, within_);
  within_coordinate_.resize(n);
  within_velocity_.resize(n);
  for (Plane& p : planes_) {
    p.coordinate.resize(n);
    p.velocity.resize(n);
    p.start = Complexes(n);
    p.rest.assign(most_stages, AlignedNumbers(n));
    p.coordinate_scale.assign(n, 1.);
    p.velocity_scale.assign(n, 1.);
    for (const Run& r : p.runs) {
      std::copy_n(scale.data() + r.coordinate, r.size, p.coordinate_scale.data() + r.at);
      std::copy_n(scale.data() + r.velocity, r.size, p.velocity_scale.data() + r.at);
    }
  }
}

std::size_t ExponentialStages::n_states() const {
  std::size_t n = 0;
  for (const Plane& plane : planes_)
    for (const Run& r : plane.runs) n += 2 * r.size;
  return n;
}

ExponentialStages::Fit ExponentialStages::fit_of(int stage, double node, std::span<const double> own_weights) const {
  Fit fit;
  fit.node = node;
  std::array<double, most_stages> nodes{};
  for (std::size_t j = 0; j < static_cast<std::size_t>(stage); ++j) {
    const bool is_past = static_cast<int>(j) < method_.start;
    if (is_past && ratio_ == 0.) continue;
    const double c = is_past ? -1. / ratio_ : method_.c[j];
    if ((method_.fitted[static_cast<std::size_t>(stage)] >> j & 1U) != 0) {
      nodes[fit.n_fitted] = c;
      fit.fitted[fit.n_fitted++] = j;
    } else if (own_weights[j] != 0.) {
      fit.other_node[fit.n_others] = c;
      fit.other_weight[fit.n_others] = own_weights[j];
      fit.others[fit.n_others++] = j;
    }
  }
  // Lagrange's polynomials by their coefficients, one root after the other.
  for (std::size_t j = 0; j < fit.n_fitted; ++j) {
    auto& p = fit.polynomial[j];
    p[0] = 1.;
    std::size_t degree = 0;
    for (std::size_t m = 0; m < fit.n_fitted; ++m) {
      if (m == j) continue;
      const double by_distance = 1. / (nodes[j] - nodes[m]);
      ++degree;
      for (std::size_t k = degree; k > 0; --k) p[k] = (p[k - 1] - nodes[m] * p[k]) * by_distance;
      p[0] *= -nodes[m] * by_distance;
    }
  }
  return fit;
}

void ExponentialStages::begin(double step, double before, const Start& start) {
  step_ = step;
  ratio_ = before > 0. ? step / before : 0.;
  constexpr double least_turn = 0.5;  // [rad]
  const auto first = std::partition_point(kinds_.omega.begin(), kinds_.omega.end(),
                                          [step](double omega) { return omega * step < least_turn; });
  first_active_ = std::min(static_cast<std::size_t>(first - kinds_.omega.begin()), n_kinds_);
  first_vector_ = whole_vectors(first_active_);
  if (!is_active()) return;
  wide<Kernels::find_z>(kinds_, first_vector_, step_, exponents_.z, exponents_.inverse);
  for (int i = method_.start + 1; i < method_.n_stages; ++i) {
    const auto at = static_cast<std::size_t>(i);
    fits_[at] = fit_of(i, method_.c[at], method_.a[at]);
    wide<Kernels::find_weights>(first_vector_, fits_[at], exponents_, weights_[at]);
  }
  for (Plane& plane : planes_) {
    if (ratio_ > 0.) {
      gather(plane, start.state_before);
      for (int i = 0; i < method_.start; ++i) take(plane, i, start.rates_before);
    }
    gather(plane, start.state);
    take(plane, method_.start, start.rates);
    for (std::size_t i = first_vector_; i < kinds_.omega.size(); ++i) {
      plane.start.re[i] = plane.velocity[i] + kinds_.half_damping[i] * plane.coordinate[i];
      plane.start.im[i] = kinds_.omega_damped[i] * plane.coordinate[i];
    }
  }
}

/// Calls what(run) with those parts of a plane's runs that lie from a kind on.
template <class Do>
void ExponentialStages::for_runs(const Plane& plane, std::size_t from, Do&& what) {
  for (const Run& r : plane.runs) {
    if (r.at + r.size <= from) continue;
    const std::size_t skipped = from > r.at ? from - r.at : 0;
    what(Run{r.coordinate + skipped, r.velocity + skipped, r.at + skipped, r.size - skipped});
  }
}

void ExponentialStages::gather(Plane& plane, std::span<const double> state) const {
  for_runs(plane, first_vector_, [&](const Run& r) {
    std::copy_n(state.data() + r.coordinate, r.size, plane.coordinate.data() + r.at);
    std::copy_n(state.data() + r.velocity, r.size, plane.velocity.data() + r.at);
  });
}

void ExponentialStages::take(Plane& plane, int stage, std::span<const double> rates) const {
  double* N = plane.rest[static_cast<std::size_t>(stage)].data();
  for_runs(plane, first_vector_, [&](const Run& r) { std::copy_n(rates.data() + r.velocity, r.size, N + r.at); });
  wide<Kernels::take_off_free_motion>(kinds_, first_vector_, plane, N);
}

void ExponentialStages::take(int stage, std::span<const double> rates) {
  if (!is_active()) return;
  for (Plane& plane : planes_) take(plane, stage, rates);
}

void ExponentialStages::combine(const Plane& plane, const Weights& weights, const Fit& fit, double* coordinate,
                                double* velocity) const {
  std::array<std::size_t, most_stages> rates{};
  std::size_t n = 0;
  for (std::size_t j = 0; j < fit.n_fitted; ++j) rates[n++] = fit.fitted[j];
  for (std::size_t j = 0; j < fit.n_others; ++j) rates[n++] = fit.others[j];
  wide<Kernels::combine>(kinds_, first_vector_, step_, weights, plane, std::span<const std::size_t>(rates).first(n),
                         coordinate, velocity);
}

void ExponentialStages::write(const Plane& plane, const double* coordinate, const double* velocity,
                              std::span<double> y) const {
  for_runs(plane, first_active_, [&](const Run& r) {
    std::copy_n(coordinate + r.at, r.size, y.data() + r.coordinate);
    std::copy_n(velocity + r.at, r.size, y.data() + r.velocity);
  });
}

void ExponentialStages::place(int stage, std::span<double> y) {
  if (!is_active()) return;
  const auto at = static_cast<std::size_t>(stage);
  for (Plane& plane : planes_) {
    combine(plane, weights_[at], fits_[at], plane.coordinate.data(), plane.velocity.data());
    write(plane, plane.coordinate.data(), plane.velocity.data(), y);
  }
}

double ExponentialStages::squared_error(double tolerance) const {
  double sum = 0.;
  if (!is_active()) return sum;
  // Kinds that a plane has none of are at rest.
  for (const Plane& plane : planes_)
    sum += wide<Kernels::squared_error>(kinds_, first_vector_, first_active_, n_kinds_, step_, method_, plane);
  return sum / (tolerance * tolerance);
}

void ExponentialStages::hide(std::span<double> scale) const {
  for (const Plane& plane : planes_) {
    for (const Run& r : plane.runs) {
      std::copy_n(plane.coordinate_scale.data() + r.at, r.size, scale.data() + r.coordinate);
      std::copy_n(plane.velocity_scale.data() + r.at, r.size, scale.data() + r.velocity);
    }
    for_runs(plane, first_active_, [&](const Run& r) {
      for (const std::size_t at : {r.coordinate, r.velocity})
        std::fill_n(scale.data() + at, r.size, std::numeric_limits<double>::infinity());
    });
  }
}

void ExponentialStages::interpolate(double theta, std::span<double> y) const {
  if (!is_active()) return;
  std::array<double, most_stages> own{};
  for (std::size_t j = 0; j < own.size(); ++j) own[j] = method_.weight(j, theta);
  const Fit fit = fit_of(method_.n_stages - 1, theta, own);
  wide<Kernels::find_weights>(first_vector_, fit, exponents_, within_);
  for (const Plane& plane : planes_) {
    combine(plane, within_, fit, within_coordinate_.data(), within_velocity_.data());
    write(plane, within_coordinate_.data(), within_velocity_.data(), y);
  }
}

}  // namespace rotordrop
