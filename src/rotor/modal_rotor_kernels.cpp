// A rotor's motion at its points and the rates of its modes, for several widths of vectors.
#include <array>
#include <cassert>

#include "base/sine_cosine.h"
#include "base/wide_vectors.h"
#include "rotor/modal_rotor.h"

namespace rotordrop {

// Points are looked at two at a time, from any one on: behind the last one lies another.
ModalRotor::Shapes::Shapes(std::size_t modes, std::size_t n_points)
    : n_modes(modes), stride(2 * n_points + 2), columns(modes * stride, 0.) {}

struct ModalRotor::Kernels {
  /// Two points at a time: their deflections and slopes lie side by side for each mode.
  ROTORDROP_KERNEL static void motions(const Shapes& shapes, const double* y, std::size_t first_point,
                                       std::size_t n_points, Motion* out) {
    const std::size_t n = shapes.n_modes, stride = shapes.stride;
    const double* columns = shapes.columns.data() + 2 * first_point;
    for (std::size_t p = 0; p < n_points; p += 2, columns += Quartet::length) {
      // Two sums of each, so that an addition need not wait for the one before it.
      std::array<Quartet, 2> sum_q_y, sum_q_z, sum_v_y, sum_v_z;
      const double* column = columns;
      const auto add = [&](std::size_t i, std::size_t to) {
        add_product(sum_q_y[to], y[i], column);
        add_product(sum_q_z[to], y[n + i], column);
        add_product(sum_v_y[to], y[2 * n + i], column);
        add_product(sum_v_z[to], y[3 * n + i], column);
        column += stride;
      };
      std::size_t i = 0;
      for (; i + 1 < n; i += 2) {
        add(i, 0);
        add(i + 1, 1);
      }
      if (i < n) add(i, 0);
      Quartet q_y = sum_of(sum_q_y), q_z = sum_of(sum_q_z), v_y = sum_of(sum_v_y), v_z = sum_of(sum_v_z);
      out[p] = {0, q_y[0], q_z[0], -q_z[1], q_y[1], 0, v_y[0], v_z[0], -v_z[1], v_y[1]};
      if (p + 1 < n_points) out[p + 1] = {0, q_y[2], q_z[2], -q_z[3], q_y[3], 0, v_y[2], v_z[2], -v_z[3], v_y[3]};
    }
  }

  /// What all modes have in common while they are looked at, and their sums.
  struct Turning {
    double omega, along_cos, along_sin;
    Octet unbalance_work, damping;
  };
  static constexpr std::size_t most_vectors = 4;

  /// Of so many vectors of modes from one on.
  template <std::size_t n_vectors>
  ROTORDROP_KERNEL static void accelerations(const ModalRotor& rotor, std::size_t first, const double* __restrict y,
                                             const Force* __restrict force_on_station, Turning& turning,
                                             double* __restrict dydt) {
    const std::size_t n = rotor.n_modes_, stride = filled_up(n);
    const double *q_y = y, *q_z = y + n, *v_y = y + 2 * n, *v_z = y + 3 * n;
    const double omega = turning.omega, along_cos = turning.along_cos, along_sin = turning.along_sin;
    const double gravity_y = rotor.gravity_y_, gravity_z = rotor.gravity_z_;
    const double *u_cos = rotor.unbalance_cos_.data(), *u_sin = rotor.unbalance_sin_.data();
    const double *c = rotor.damping_rate_.data(), *k = rotor.omega_squared_.data();
    std::array<Octet, n_vectors> a_y, a_z;
    // Eq. (1) of Neisi 2019 solved for the modes' accelerations, term by term; here w^2 Q_1 - C q' - K q, C and K being diagonal.
    for (std::size_t b = 0; b < n_vectors; ++b) {
      const std::size_t from = first + b * vector_length, count = n - from;
      const Octet displacement_y = first_of(q_y + from, count), displacement_z = first_of(q_z + from, count);
      const Octet velocity_y = first_of(v_y + from, count), velocity_z = first_of(v_z + from, count);
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        const std::size_t m = from + i;
        const double vy = velocity_y.value[i], vz = velocity_z.value[i];
        const double unbalance_y = along_cos * u_cos[m] - along_sin * u_sin[m];
        const double unbalance_z = along_sin * u_cos[m] + along_cos * u_sin[m];
        turning.unbalance_work[i] += unbalance_y * vy + unbalance_z * vz;
        turning.damping[i] += c[m] * (vy * vy + vz * vz);
        // Uniform gravity moves the centre of gravity alone.
        a_y[b][i] = unbalance_y - c[m] * vy - k[m] * displacement_y.value[i] + (m == 0 ? gravity_y : 0.);
        a_z[b][i] = unbalance_z - c[m] * vz - k[m] * displacement_z.value[i] + (m == 0 ? gravity_z : 0.);
      }
      store_first(velocity_y, count, dydt + from);
      store_first(velocity_z, count, dydt + n + from);
    }
    const auto add = [](std::array<Octet, n_vectors>& to, double factor, const double* column) {
      for (std::size_t b = 0; b < n_vectors; ++b) add_product(to[b], factor, column + b * vector_length);
    };
    // eq. (1): - w G q'. The translation (mode 0) has no slope and so no gyroscopic term.
    const double* G = rotor.gyroscopic_.data() + stride + first;
    for (std::size_t j = 1; j < n; ++j, G += stride) {
      add(a_y, -omega * v_z[j], G);
      add(a_z, omega * v_y[j], G);
    }
    // eq. (1): Q_2, the forces and moments on the stations.
    const double* per_force = rotor.force_influence_.data() + first;
    for (std::size_t s = 0; s < rotor.n_stations_; ++s, per_force += 2 * stride) {
      const double* per_moment = per_force + stride;
      const Force& f = force_on_station[s];
      add(a_y, f.y, per_force);
      add(a_y, f.moment_z, per_moment);
      add(a_z, f.z, per_force);
      add(a_z, -f.moment_y, per_moment);
    }
    for (std::size_t b = 0; b < n_vectors; ++b) {
      const std::size_t from = first + b * vector_length;
      store_first(a_y[b], n - from, dydt + 2 * n + from);
      store_first(a_z[b], n - from, dydt + 3 * n + from);
    }
  }
  /// Of those that are left, so many vectors at most.
  template <std::size_t n_vectors>
  ROTORDROP_KERNEL static void rest_of_accelerations(const ModalRotor& rotor, std::size_t first, const double* y,
                                                     const Force* force_on_station, Turning& turning, double* dydt) {
    if (filled_up(rotor.n_modes_) - first == n_vectors * vector_length)
      return accelerations<n_vectors>(rotor, first, y, force_on_station, turning, dydt);
    if constexpr (n_vectors > 1) rest_of_accelerations<n_vectors - 1>(rotor, first, y, force_on_station, turning, dydt);
  }

  ROTORDROP_KERNEL static RotorPower rates(const ModalRotor& rotor, double t, const double* __restrict y,
                                           const Force* __restrict force_on_station, double* __restrict dydt) {
    const std::size_t n = rotor.n_modes_, stride = filled_up(n);
    const double spin_angle = y[4 * n], omega = y[4 * n + 1];

    // The spin first: the unbalance needs its acceleration.
    const double drive = rotor.drive_torque_.empty() ? 0 : rotor.drive_torque(t);
    double torque = drive;
    for (std::size_t s = 0; s < rotor.n_stations_; ++s) torque += force_on_station[s].torque;
    double windage = 0;
    if (rotor.windage_) {
      windage = (*rotor.windage_)(omega);
      torque -= windage;
    }
    const double omega_rate = torque / rotor.body_.Ip;
    dydt[4 * n] = omega;
    dydt[4 * n + 1] = omega_rate;

    // eq. (1): w^2 Q_1. The unbalance vector turns with the spin; along it acts me omega^2, across it me omega'.
    const auto [sine, cosine] = sine_cosine(spin_angle);
    const double along_cos = omega * omega * cosine + omega_rate * sine,
                 along_sin = omega * omega * sine - omega_rate * cosine;
    // Several vectors of modes at a time, so that each mode's gyroscopic coupling is looked up once for all of them.
    Turning turning{omega, along_cos, along_sin, {}, {}};
    std::size_t first = 0;
    for (; first + most_vectors * vector_length <= stride; first += most_vectors * vector_length)
      accelerations<most_vectors>(rotor, first, y, force_on_station, turning, dydt);
    rest_of_accelerations<most_vectors - 1>(rotor, first, y, force_on_station, turning, dydt);
    return {rotor.body_.mass * turning.damping.sum(), rotor.body_.mass * turning.unbalance_work.sum(), drive * omega,
            windage * omega, omega_rate};
  }
};

void ModalRotor::motions(std::span<const double> y, std::span<Motion> out) const {
  assert(y.size() == n_state() && out.size() == n_stations_);
  wide<Kernels::motions>(station_shape_, y.data(), 0, n_stations_, out.data());
  if (axial_) add_axial_motion(y, out);
}

Motion ModalRotor::node_motion(int node, std::span<const double> y) const {
  assert(y.size() == n_state() && node >= 1 && static_cast<std::size_t>(node) <= n_nodes_);
  Motion motion;
  wide<Kernels::motions>(node_shape_, y.data(), static_cast<std::size_t>(node - 1), 1, &motion);
  if (axial_) add_axial_motion(y, {&motion, 1});
  return motion;
}

RotorPower ModalRotor::rates(double t, std::span<const double> y, std::span<const Force> force_on_station,
                             std::span<double> dydt) const {
  assert(y.size() == n_state() && dydt.size() == n_state() && force_on_station.size() == n_stations_);
  RotorPower power = wide<Kernels::rates>(*this, t, y.data(), force_on_station.data(), dydt.data());
  if (axial_) add_axial_rates(t, y, force_on_station, dydt, power);
  return power;
}

}  // namespace rotordrop
