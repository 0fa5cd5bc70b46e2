#pragma once
// Laws of heat: free convection, share of rubbing heat.
#include "base/real.h"

namespace rotordrop {

/// Free convection from a bearing housing h = 23 (T - T_inf)^0.25 [W/m^2 K], clamped at zero rise.
/// Source: Neisi 2019, eq. (16), after Harris.
template <class Real>
Real housing_convection(const Real& rise) {
  return 23. * sqrt(sqrt(larger(rise, Real(0.))));
}

/// Share of the rubbing heat that enters the ring, after Blok and Jaeger, from the time that a point of each surface
/// spends under the band of heat:
///   share = 1 / (1 + (e_rotor/e_ring) sqrt(t_ring/t_rotor)),  t = band_length / |surface speed|,
/// the time of a surface at rest being the contact's own duration. e = sqrt(k rho c).
/// Valid for thin heated layers (high Peclet number), as in a rub at tens of m/s.
template <class Real>
struct JaegerShareOf {
  Real band_length = 0;       ///< of the contact along the surface [m]
  Real contact_duration = 0;  ///< [s]
  Real effusivity_ratio = 1;  ///< e_rotor / e_ring
  [[nodiscard]] Real to_ring(const Real& rotor_surface_speed, const Real& ring_surface_speed) const {
    const Real slowest = band_length / contact_duration;  // a surface at rest is heated for the contact's duration
    const Real v_rotor = larger(abs(rotor_surface_speed), slowest), v_ring = larger(abs(ring_surface_speed), slowest);
    return 1. / (1. + effusivity_ratio * sqrt(v_rotor / v_ring));
  }
};
using JaegerShare = JaegerShareOf<double>;

/// How the rubbing heat divides between ring and rotor: a constant, or Blok and Jaeger's share.
template <class Real>
struct RubNumbers {
  Real constant = 0.5;  ///< into the ring
  JaegerShareOf<Real> jaeger;
  [[nodiscard]] Real to_ring(bool by_jaeger, const Real& rotor_surface_speed, const Real& ring_surface_speed) const {
    return by_jaeger ? jaeger.to_ring(rotor_surface_speed, ring_surface_speed) : constant;
  }
};
struct RubShare {
  double constant = 0.5;  ///< into the ring
  bool by_jaeger = false;
  JaegerShare jaeger;
  [[nodiscard]] RubNumbers<double> numbers() const { return {constant, jaeger}; }
  [[nodiscard]] double to_ring(double rotor_surface_speed, double ring_surface_speed) const {
    return numbers().to_ring(by_jaeger, rotor_surface_speed, ring_surface_speed);
  }
};

}  // namespace rotordrop
