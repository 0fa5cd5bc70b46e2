#include "integrate/exponential_stages.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/rotation.h"
#include "integrate/complex_vectors.h"
#include "integrate/pairs.h"

namespace rotordrop {
namespace {

/// Largest number of fitted rates of a stage.
constexpr std::size_t most_fitted = 5;

}  // namespace

struct ExponentialStages::Kernels {
  ROTORDROP_KERNEL static ComplexOctet at(const Complexes& list, std::size_t i) {
    return {octet_at(list.re.data() + i), octet_at(list.im.data() + i)};
  }
  ROTORDROP_KERNEL static void put(const ComplexOctet& a, std::size_t i, Complexes& list) {
    store(a.re, list.re.data() + i);
    store(a.im, list.im.data() + i);
  }

  /// Weights of a stage with n_fitted fitted rates for all kinds that are active. @param n  whole vectors
  template <std::size_t n_fitted>
  ROTORDROP_KERNEL static void weights_of(const Kinds& kinds, double step, const Fit& fit, std::size_t n,
                                          Weights& weights) {
    std::array<double, n_fitted> power;  // of the node
    power[0] = 1.;
    for (std::size_t k = 1; k < n_fitted; ++k) power[k] = power[k - 1] * fit.node;
    for (std::size_t at = 0; at < n; at += vector_length) {
      ComplexOctet z;
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        z.re[i] = -step * kinds.half_damping[at + i];
        z.im[i] = step * kinds.omega_damped[at + i];
      }
      const ComplexOctet own = exponential(fit.node, z), by_z = inverse(z);
      put(own, at, weights.exponential);
      // The integral of exp((c - s) z) s^k from 0 to c, by parts: (k times that of s^(k - 1), less c^k) / z.
      std::array<ComplexOctet, n_fitted> integral;
      integral[0] = product(scaled(1., own, -1.), by_z);
      for (std::size_t k = 1; k < n_fitted; ++k)
        integral[k] = product(scaled(static_cast<double>(k), integral[k - 1], -power[k]), by_z);
      for (std::size_t j = 0; j < fit.n_others; ++j) {
        const double c = fit.other_node[j];
        const ComplexOctet weight = scaled(fit.other_weight[j], exponential(fit.node - c, z));
        put(weight, at, weights.of_rate[fit.others[j]]);
        double c_power = 1.;
        for (std::size_t k = 0; k < n_fitted; ++k, c_power *= c) add(integral[k], -c_power, weight);
      }
      for (std::size_t j = 0; j < n_fitted; ++j) {
        ComplexOctet weight = scaled(fit.polynomial[j][0], integral[0]);
        for (std::size_t k = 1; k < n_fitted; ++k) add(weight, fit.polynomial[j][k], integral[k]);
        put(weight, at, weights.of_rate[fit.fitted[j]]);
      }
    }
  }
  template <std::size_t n_fitted = 1>
  ROTORDROP_KERNEL static void find_weights(const Kinds& kinds, double step, const Fit& fit, std::size_t n,
                                            Weights& weights) {
    if constexpr (n_fitted < most_fitted)
      if (fit.n_fitted > n_fitted) return find_weights<n_fitted + 1>(kinds, step, fit, n, weights);
    weights_of<n_fitted>(kinds, step, fit, n, weights);
  }

  /// w of a stage, as coordinates and velocities. @param rates  which of them count
  ROTORDROP_KERNEL static void combine(const Kinds& kinds, std::size_t n, double step, const Weights& weights,
                                       const Plane& plane, std::span<const std::size_t> rates, double* coordinate,
                                       double* velocity) {
    for (std::size_t at = 0; at < n; at += vector_length) {
      ComplexOctet w = product(Kernels::at(weights.exponential, at), Kernels::at(plane.start, at));
      for (const std::size_t j : rates) {
        const ComplexOctet weight = Kernels::at(weights.of_rate[j], at);
        const double* N = plane.rest[j].data() + at;
#pragma omp simd
        for (std::size_t i = 0; i < vector_length; ++i) {
          w.re[i] += step * (weight.re.value[i] * N[i]);
          w.im[i] += step * (weight.im.value[i] * N[i]);
        }
      }
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        const double q = w.im[i] * kinds.inverse_omega_damped[at + i];
        coordinate[at + i] = q;
        velocity[at + i] = w.re[i] - kinds.half_damping[at + i] * q;
      }
    }
  }

  /// Makes what acts on each oscillator of its rate. @param N  [n], the rates of velocities
  ROTORDROP_KERNEL static void take_off_free_motion(const Kinds& kinds, std::size_t n, const Plane& plane, double* N) {
    const double *q = plane.coordinate.data(), *v = plane.velocity.data();
    const double *c = kinds.damping_rate.data(), *omega_squared = kinds.omega_squared.data();
#pragma omp simd
    for (std::size_t i = 0; i < whole_vectors(n); ++i) N[i] += c[i] * v[i] + omega_squared[i] * q[i];
  }

  ROTORDROP_KERNEL static double squared_error(const Kinds& kinds, std::size_t n, double step,
                                               const EmbeddedTableau& method, const Plane& plane) {
    Octet sum;
    for (std::size_t at = 0; at < n; at += vector_length) {
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
        sum[i] += at + i < n ? velocity * velocity + coordinate * coordinate : 0.;
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

ExponentialStages::ExponentialStages(std::vector<Oscillator> oscillators, std::span<const double> scale) {
  const auto kind = [](const Oscillator& o) { return std::pair(o.omega_squared, o.damping_rate); };
  std::stable_sort(oscillators.begin(), oscillators.end(),
                   [kind](const Oscillator& a, const Oscillator& b) { return kind(a) > kind(b); });
  std::size_t plane = 0;
  for (std::size_t i = 0; i < oscillators.size(); ++i) {
    const bool is_new = i == 0 || kind(oscillators[i]) != kind(oscillators[i - 1]);
    plane = is_new ? 0 : plane + 1;
    if (is_new) {
      kinds_.omega_squared.push_back(oscillators[i].omega_squared);
      kinds_.damping_rate.push_back(oscillators[i].damping_rate);
    }
    if (plane == planes_.size()) planes_.emplace_back();
    planes_[plane].members.push_back(
        {oscillators[i].coordinate, oscillators[i].velocity, kinds_.omega_squared.size() - 1});
  }
  n_kinds_ = kinds_.omega_squared.size();
  // What fills up a vector is as the slowest.
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
    for (const Member& m : p.members) {
      p.coordinate_scale[m.at] = scale[m.coordinate];
      p.velocity_scale[m.at] = scale[m.velocity];
    }
  }
}

std::size_t ExponentialStages::n_states() const {
  std::size_t n = 0;
  for (const Plane& plane : planes_) n += 2 * plane.members.size();
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

void ExponentialStages::begin(const EmbeddedTableau& method, double step, double before, const Start& start) {
  method_ = method;
  step_ = step;
  ratio_ = before > 0. ? step / before : 0.;
  constexpr double least_turn = 0.5;  // [rad]
  const auto end = std::partition_point(kinds_.omega.begin(), kinds_.omega.end(),
                                        [step](double omega) { return omega * step >= least_turn; });
  n_active_ = std::min(static_cast<std::size_t>(end - kinds_.omega.begin()), n_kinds_);
  if (!is_active()) return;
  for (int i = method_.start + 1; i < method_.n_stages; ++i) {
    const auto at = static_cast<std::size_t>(i);
    fits_[at] = fit_of(i, method_.c[at], method_.a[at]);
    wide<Kernels::find_weights<1>>(kinds_, step_, fits_[at], filled_up(n_active_), weights_[at]);
  }
  for (Plane& plane : planes_) {
    const auto last = std::partition_point(plane.members.begin(), plane.members.end(),
                                           [this](const Member& m) { return m.at < n_active_; });
    plane.n_active = static_cast<std::size_t>(last - plane.members.begin());
    if (ratio_ > 0.) {
      gather(plane, start.state_before);
      for (int i = 0; i < method_.start; ++i) take(plane, i, start.rates_before);
    }
    gather(plane, start.state);
    take(plane, method_.start, start.rates);
    for (std::size_t i = 0; i < n_active_; ++i) {
      plane.start.re[i] = plane.velocity[i] + kinds_.half_damping[i] * plane.coordinate[i];
      plane.start.im[i] = kinds_.omega_damped[i] * plane.coordinate[i];
    }
  }
}

void ExponentialStages::gather(Plane& plane, std::span<const double> state) const {
  for (std::size_t i = 0; i < plane.n_active; ++i) {
    const Member& m = plane.members[i];
    plane.coordinate[m.at] = state[m.coordinate];
    plane.velocity[m.at] = state[m.velocity];
  }
}

void ExponentialStages::take(Plane& plane, int stage, std::span<const double> rates) const {
  double* N = plane.rest[static_cast<std::size_t>(stage)].data();
  for (std::size_t i = 0; i < plane.n_active; ++i) N[plane.members[i].at] = rates[plane.members[i].velocity];
  wide<Kernels::take_off_free_motion>(kinds_, filled_up(n_active_), plane, N);
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
  wide<Kernels::combine>(kinds_, filled_up(n_active_), step_, weights, plane,
                         std::span<const std::size_t>(rates).first(n), coordinate, velocity);
}

void ExponentialStages::write(const Plane& plane, const double* coordinate, const double* velocity,
                              std::span<double> y) {
  for (std::size_t i = 0; i < plane.n_active; ++i) {
    const Member& m = plane.members[i];
    y[m.coordinate] = coordinate[m.at];
    y[m.velocity] = velocity[m.at];
  }
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
  for (const Plane& plane : planes_) sum += wide<Kernels::squared_error>(kinds_, n_active_, step_, method_, plane);
  return sum / (tolerance * tolerance);
}

void ExponentialStages::hide(std::span<double> scale) const {
  for (const Plane& plane : planes_)
    for (const Member& m : plane.members) {
      const bool is_hidden = m.at < n_active_;
      scale[m.coordinate] = is_hidden ? std::numeric_limits<double>::infinity() : plane.coordinate_scale[m.at];
      scale[m.velocity] = is_hidden ? std::numeric_limits<double>::infinity() : plane.velocity_scale[m.at];
    }
}

void ExponentialStages::interpolate(double theta, std::span<double> y) const {
  if (!is_active()) return;
  std::array<double, most_stages> own{};
  for (std::size_t j = 0; j < own.size(); ++j) own[j] = method_.weight(j, theta);
  const Fit fit = fit_of(method_.n_stages - 1, theta, own);
  wide<Kernels::find_weights<1>>(kinds_, step_, fit, filled_up(n_active_), within_);
  for (const Plane& plane : planes_) {
    combine(plane, within_, fit, within_coordinate_.data(), within_velocity_.data());
    write(plane, within_coordinate_.data(), within_velocity_.data(), y);
  }
}

}  // namespace rotordrop
