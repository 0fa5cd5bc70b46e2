#pragma once
#include <cstddef>
#include <span>

namespace rotordrop {

/// Twice the kinetic (without spin), elastic and gravitational energy of modal motions over the rotor's mass [m^2/s^2], of one drop or of eight in lanes.
/// @param y              state of a ModalRotor of n modes
/// @param omega_squared  [n] [1/s^2]
template <class Real>
Real twice_energy_per_mass(std::span<const Real> y, std::size_t n, const Real* omega_squared, const Real& gravity_y,
                           const Real& gravity_z) {
  Real sum = -2. * (gravity_y * y[0] + gravity_z * y[n]);
  for (std::size_t i = 0; i < n; ++i) {
    const Real &q_y = y[i], &q_z = y[n + i], &v_y = y[2 * n + i], &v_z = y[3 * n + i];
    sum += v_y * v_y + v_z * v_z + omega_squared[i] * (q_y * q_y + q_z * q_z);
  }
  return sum;
}

}  // namespace rotordrop
