#include "thermal/circuit/lumping.h"

#include <cmath>
#include <numbers>

#include "laws/heat/heat_flow.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

double diffusivity(const ThermalMaterial& m) { return m.conductivity / m.volumetric_capacity(); }

}  // namespace

double LumpedBody::fourier(double time) const { return diffusivity * time / (length * length); }

double LumpedBody::evening_time(double part) const {
  return std::log(2. / part) / (pi * pi) * length * length / diffusivity;
}

double LumpedBody::depth(double time) const { return std::sqrt(diffusivity * time); }

std::vector<LumpedBody> lumped_bodies(const BearingCircuitData& b) {
  const CircuitResistances R = circuit_resistances(b);
  const double W = b.width, d_s = 2. * b.journal_radius;
  const double R5 = R.R5_inside + R.R5_constriction;
  const double gap = b.shaft_ring_link == BearingCircuitData::Link::in_contact ? b.gap_resistance : 0.;
  const auto body = [](const char* name, const ThermalMaterial& m, double L, double conductance, double area) {
    return LumpedBody{name, L, diffusivity(m), conductance / area * L / m.conductivity};
  };
  const double housing_film = housing_convection(1.) * pi * b.housing_outside * b.housing_length;
  return {
      body("shaft", b.shaft, b.journal_radius - b.shaft_bore_radius, 1. / R.R1 + 1. / (R.R3 + gap), pi * d_s * W),
      body("inner_ring", b.ring, 0.5 * (b.inner_outside - b.inner_bore), 1. / (R.R2 + gap) + 1. / R5,
           pi * b.inner_bore * W),
      body("ball", b.ball, 0.5 * b.ball_diameter, 2. / R.R5_constriction + 1. / R.R6,
           b.n_balls * pi * b.ball_diameter * b.ball_diameter),
      body("outer_ring", b.ring, 0.5 * (b.outer_outside - b.outer_bore), 1. / R5 + 1. / (R.R8_fit + R.R8_housing),
           pi * b.outer_bore * W),
      body("housing", b.ring, 0.5 * (b.housing_outside - b.outer_outside), 1. / (R.R8_ring + R.R8_fit) + housing_film,
           pi * b.outer_outside * b.housing_length),
  };
}

}  // namespace rotordrop
