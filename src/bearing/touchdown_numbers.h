#pragma once
#include <utility>
#include <vector>

#include "base/exponent.h"
#include "bearing/turned_wave.h"
#include "laws/bearing_friction.h"
#include "laws/contact.h"
#include "laws/heat/rolling_conduction.h"
#include "model/ports.h"

namespace rotordrop {

/// What a touchdown bearing's formulas need besides its rows, as numbers: nothing but these, so that those of several drops can be laid side by
/// side. Symbols and units as in TouchdownBearingData.
template <class Real>
struct TouchdownNumbers {
  Real ring_mass, ring_spin_inertia, bore_radius, rotor_radius, air_gap;
  HuntCrossleyOf<Real> contact;
  CoulombNumbers<Real> friction;
  Real f1_z, f1_y, static_rating, f2, drag_viscosity, drag_regularisation;
  Real race_friction_coefficient, spin_axis_factor, spin_elliptic_integral, heat_over_work;
  Real support_mass, support_stiffness_y, support_stiffness_z, support_damping_y, support_damping_z;
  ExpansionOf<Real> centrifugal_growth;
  Real gravity_y, gravity_z;
  RowConductionOf<Real> conduction;
  FrictionLoadFactorsOf<Real> friction_load_factors;
  Real pitch_diameter;
  Real strain_per_growth;    ///< of the rings' widths [1/m]
  Real cage_ratio;           ///< cage speed over ring speed
  Real rolling_speed_ratio;  ///< speed of the contacts over the surfaces, over omega_i [m]
  Real inner_heat_share;
  Real spin_speed_sum_ratio;  ///< (|omega_si| + |omega_so|) / omega_i
};

/// A wave on the bore: sin(order * (contact angle - ring angle) + phase).
template <class Real>
struct BoreWaveOf {
  int order = 1;
  Real amplitude = 0;  ///< [m]; positive means more penetration
  Real phase = 0;      ///< [rad]
  [[nodiscard]] TurnedWaveOf<Real> turned(const Real& ring_angle) const {
    return {static_cast<double>(order), amplitude, phase, ring_angle};
  }
};
using BoreWave = BoreWaveOf<double>;

/// The same with what powers with their exponents need, and with lists.
template <class Real>
struct TouchdownFormulas : TouchdownNumbers<Real> {
  TouchdownFormulas(const TouchdownNumbers<Real>& numbers, std::vector<BoreWaveOf<Real>> waves)
      : TouchdownNumbers<Real>(numbers),
        contact_exponent(numbers.contact.n),
        load_exponent(numbers.f1_y),
        bore_waves(std::move(waves)) {}
  ExponentOf<Real> contact_exponent, load_exponent;
  std::vector<BoreWaveOf<Real>> bore_waves;
};

}  // namespace rotordrop
