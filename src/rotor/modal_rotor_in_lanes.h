#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "base/drops.h"
#include "base/wide_vectors.h"
#include "rotor/modal_energy.h"
#include "rotor/modal_rotor.h"

namespace rotordrop {

/// Modal rotors of several drops side by side: the same equations as ModalRotor's.
template <class Real>
class ModalRotorInLanes {
 public:
  /// @param rotors  alike (is_alike()); lanes without one repeat the first
  explicit ModalRotorInLanes(std::span<const ModalRotor* const> rotors);

  /// Whether two rotors differ in nothing but their numbers: as many modes and stations, both with windage or an axial motion, or none.
  [[nodiscard]] static bool is_alike(const ModalRotor& a, const ModalRotor& b) {
    return a.n_modes_ == b.n_modes_ && a.n_stations_ == b.n_stations_ && a.n_nodes_ == b.n_nodes_ &&
           a.windage_.has_value() == b.windage_.has_value() && !a.axial_ && !b.axial_;
  }

  void motions(std::span<const Real> y, std::span<MotionOf<Real>> out) const;
  [[nodiscard]] SpinOf<Real> spin(std::span<const Real> y) const { return {y[4 * n_], y[4 * n_ + 1]}; }
  RotorPowerOf<Real> rates(const Real& t, std::span<const Real> y, std::span<const ForceOf<Real>> force_on_station,
                           std::span<Real> dydt) const;
  void observe(std::span<const Real> y, std::span<Real> out) const {
    if (n_ > 2) std::copy_n(y.begin(), 2 * n_, out.begin());
  }
  [[nodiscard]] Real energy(std::span<const Real> y) const {
    const Real& omega = y[4 * n_ + 1];
    return 0.5 *
           (mass_ * twice_energy_per_mass(y, n_, omega_squared_.data(), gravity_y_, gravity_z_) + Ip_ * omega * omega);
  }

 private:
  std::vector<const ModalRotor*> rotors_;  // [n_lanes]
  std::size_t n_ = 0, n_stations_ = 0;
  Real mass_, Ip_, gravity_y_, gravity_z_;
  std::vector<Real> omega_squared_, damping_rate_, unbalance_cos_, unbalance_sin_;  // [modes]
  std::vector<Real> gyroscopic_;                                                    // [modes][modes], by column
  std::vector<Real> force_influence_, station_shape_;                               // [stations][2][modes]
  bool is_driven_ = false;
};

template <class Real>
ModalRotorInLanes<Real>::ModalRotorInLanes(std::span<const ModalRotor* const> rotors)
    : n_(rotors.front()->n_modes_), n_stations_(rotors.front()->n_stations_) {
  for (int lane = 0; lane < n_lanes; ++lane)
    rotors_.push_back(static_cast<std::size_t>(lane) < rotors.size() ? rotors[static_cast<std::size_t>(lane)]
                                                                     : rotors.front());
  // Lists of modes are filled up to whole vectors in a single rotor.
  const auto lay = [&](std::vector<Real>& to, const AlignedNumbers ModalRotor::*list, std::size_t n_lists) {
    const std::size_t stride = filled_up(n_);
    to.resize(n_lists * n_);
    for (std::size_t k = 0; k < n_lists; ++k)
      for (std::size_t i = 0; i < n_; ++i)
        for (int lane = 0; lane < n_lanes; ++lane)
          to[k * n_ + i].set(lane, (rotors_[static_cast<std::size_t>(lane)]->*list)[k * stride + i]);
  };
  lay(omega_squared_, &ModalRotor::omega_squared_, 1);
  lay(damping_rate_, &ModalRotor::damping_rate_, 1);
  lay(unbalance_cos_, &ModalRotor::unbalance_cos_, 1);
  lay(unbalance_sin_, &ModalRotor::unbalance_sin_, 1);
  lay(gyroscopic_, &ModalRotor::gyroscopic_, n_);
  lay(force_influence_, &ModalRotor::force_influence_, 2 * n_stations_);
  station_shape_.resize(2 * n_stations_ * n_);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const ModalRotor& rotor = *rotors_[static_cast<std::size_t>(lane)];
    for (std::size_t s = 0; s < n_stations_; ++s)
      for (std::size_t i = 0; i < n_; ++i) {
        station_shape_[2 * s * n_ + i].set(lane, rotor.station_shape_.deflection(s, i));
        station_shape_[(2 * s + 1) * n_ + i].set(lane, rotor.station_shape_.slope(s, i));
      }
    mass_.set(lane, rotor.body_.mass);
    Ip_.set(lane, rotor.body_.Ip);
    gravity_y_.set(lane, rotor.gravity_y_);
    gravity_z_.set(lane, rotor.gravity_z_);
    is_driven_ |= !rotor.drive_torque_.empty();
  }
}

template <class Real>
void ModalRotorInLanes<Real>::motions(std::span<const Real> y, std::span<MotionOf<Real>> out) const {
  const Real* shape = station_shape_.data();
  for (std::size_t s = 0; s < n_stations_; ++s, shape += 2 * n_) {
    const Real* slope = shape + n_;
    MotionOf<Real> m;
    for (std::size_t i = 0; i < n_; ++i) {
      const Real &q_y = y[i], &q_z = y[n_ + i], &v_y = y[2 * n_ + i], &v_z = y[3 * n_ + i];
      m.y += shape[i] * q_y;
      m.z += shape[i] * q_z;
      m.velocity_y += shape[i] * v_y;
      m.velocity_z += shape[i] * v_z;
      m.theta_z += slope[i] * q_y;
      m.theta_y -= slope[i] * q_z;
      m.tilt_rate_z += slope[i] * v_y;
      m.tilt_rate_y -= slope[i] * v_z;
    }
    out[s] = m;
  }
}

template <class Real>
RotorPowerOf<Real> ModalRotorInLanes<Real>::rates(const Real& t, std::span<const Real> y,
                                                  std::span<const ForceOf<Real>> force_on_station,
                                                  std::span<Real> dydt) const {
  const std::size_t n = n_;
  const Real *q_y = y.data(), *q_z = q_y + n, *v_y = q_z + n, *v_z = v_y + n;
  const Real omega = y[4 * n + 1];

  // The spin first: the unbalance needs its acceleration.
  Real drive = 0., windage = 0.;
  if (is_driven_)
    for (int lane = 0; lane < n_lanes; ++lane)
      drive.set(lane, rotors_[static_cast<std::size_t>(lane)]->drive_torque(t[lane]));
  if (rotors_.front()->windage_)
    for (int lane = 0; lane < n_lanes; ++lane)
      windage.set(lane, (*rotors_[static_cast<std::size_t>(lane)]->windage_)(omega[lane]));
  Real torque = drive - windage;
  for (std::size_t s = 0; s < n_stations_; ++s) torque += force_on_station[s].torque;
  const Real omega_rate = torque / Ip_;
  dydt[4 * n] = omega;
  dydt[4 * n + 1] = omega_rate;

  // eq. (1): w^2 Q_1. The unbalance vector turns with the spin; along it acts me omega^2, across it me omega'.
  const auto turned = sine_cosine(y[4 * n]);
  const Real along_cos = omega * omega * turned.cosine + omega_rate * turned.sine,
             along_sin = omega * omega * turned.sine - omega_rate * turned.cosine;
  Real unbalance_work = 0., damping = 0.;
  // Eq. (1) of Neisi 2019 solved for the modes' accelerations, term by term; here w^2 Q_1 - C q' - K q, C and K being diagonal.
  for (std::size_t i = 0; i < n; ++i) {
    const Real unbalance_y = along_cos * unbalance_cos_[i] - along_sin * unbalance_sin_[i];
    const Real unbalance_z = along_sin * unbalance_cos_[i] + along_cos * unbalance_sin_[i];
    unbalance_work += unbalance_y * v_y[i] + unbalance_z * v_z[i];
    damping += damping_rate_[i] * (v_y[i] * v_y[i] + v_z[i] * v_z[i]);
    Real a_y = unbalance_y - damping_rate_[i] * v_y[i] - omega_squared_[i] * q_y[i];
    Real a_z = unbalance_z - damping_rate_[i] * v_z[i] - omega_squared_[i] * q_z[i];
    // Uniform gravity moves the centre of gravity alone.
    if (i == 0) {
      a_y += gravity_y_;
      a_z += gravity_z_;
    }
    // eq. (1): - w G q'. The translation (mode 0) has no slope and so no gyroscopic term.
    Real turning_y = 0., turning_z = 0.;
    for (std::size_t j = 1; j < n; ++j) {
      turning_y += gyroscopic_[j * n + i] * v_z[j];
      turning_z += gyroscopic_[j * n + i] * v_y[j];
    }
    a_y -= omega * turning_y;
    a_z += omega * turning_z;
    // eq. (1): Q_2, the forces and moments on the stations.
    const Real* per_force = force_influence_.data() + i;
    for (std::size_t s = 0; s < n_stations_; ++s, per_force += 2 * n) {
      const ForceOf<Real>& f = force_on_station[s];
      a_y += f.y * per_force[0] + f.moment_z * per_force[n];
      a_z += f.z * per_force[0] - f.moment_y * per_force[n];
    }
    dydt[i] = v_y[i];
    dydt[n + i] = v_z[i];
    dydt[2 * n + i] = a_y;
    dydt[3 * n + i] = a_z;
  }
  return {mass_ * damping, mass_ * unbalance_work, drive * omega, windage * omega, omega_rate};
}

}  // namespace rotordrop
