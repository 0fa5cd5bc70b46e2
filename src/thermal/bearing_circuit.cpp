#include "thermal/bearing_circuit.h"

#include <cmath>

#include "laws/ring_growth.h"

namespace rotordrop {

CircuitResistances circuit_resistances(const BearingCircuitData& b) {
  using std::numbers::pi;
  const double k = b.ring.conductivity, k_b = b.ball.conductivity, W = b.width, Z = b.n_balls,
               d_s = 2. * b.journal_radius;
  const double d_mi = 0.5 * (b.inner_bore + b.inner_outside), d_om = 0.5 * (b.outer_bore + b.outer_outside),
               d_hm = 0.5 * (b.housing_bore + b.housing_outside);
  CircuitResistances R;
  R.R1 = 1. / (b.h_shaft * pi * d_s * W);
  R.R2 = 1. / (4. * pi * k * W);  // centre to surface
  R.R3 = std::log(d_mi / d_s) / (2. * pi * k * W);
  R.R4 = std::log(b.inner_outside / d_mi) / (2. * pi * k * W);
  R.R5_inside = 2. / (pi * k_b * b.ball_diameter * Z);
  R.R5_constriction = 2. / (4. * k_b * b.contact_half_width * Z);
  R.R6 = 1. / (b.h_ball * Z * pi * b.ball_diameter * b.ball_diameter);
  R.R7 = std::log(d_om / b.outer_bore) / (2. * pi * k * W);
  R.R8_ring = std::log(b.outer_outside / d_om) / (2. * pi * k * W);
  R.R8_fit = b.fit_resistance;
  R.R8_housing = std::log(d_hm / b.outer_outside) / (2. * pi * k * b.housing_length);
  return R;
}

GrowthDimensions growth_dimensions(const BearingCircuitData& b) {
  return {b.ring.expansion, b.ball.expansion, b.journal_radius, 0.5 * b.inner_bore, 0.5 * b.ball_diameter, b.races};
}

void add_bearing_circuit(const BearingCircuitData& b, ThermalNetworkData& network) {
  using std::numbers::pi;
  using Law = ThermalNetworkData::Law;
  const auto name = [&](const char* node) { return b.name + "/" + node; };
  const std::string s = name("shaft"), i = name("inner_ring"), ci = name("inner_contact"), ball = name("ball"),
                    co = name("outer_contact"), o = name("outer_ring"), h = name("housing");
  const std::size_t place = network.places.size();

  const double W = b.width, d_s = 2. * b.journal_radius, Z = b.n_balls;
  const auto disc = [](double diameter) { return 0.25 * pi * diameter * diameter; };
  const auto sleeve = [&](double inside, double outside) { return disc(outside) - disc(inside); };

  const CircuitFactors& f = b.factors;
  const double volumetric = b.ring.density * b.ring.heat_capacity;
  const double C_s = volumetric * disc(d_s) * b.shaft_length;
  const double C_i = f.inner_ring_capacity * b.ring_mass * b.ring.heat_capacity;
  const double C_b = Z * pi / 6. * std::pow(b.ball_diameter, 3) * b.ball.density * b.ball.heat_capacity;
  const double C_o = f.outer_ring_capacity * volumetric * sleeve(b.outer_bore, b.outer_outside) * W;
  const double C_h = f.housing_capacity * volumetric * sleeve(b.housing_bore, b.housing_outside) * b.housing_length;

  const auto [R1, R2, R3, R4, R5_inside, R5_constriction, R6, R7, R8_ring, R8_fit, R8_housing] = circuit_resistances(b);
  const double R5 = R5_inside + R5_constriction, R8 = R8_ring + R8_fit + R8_housing;
  const double housing_area = pi * b.housing_outside * b.housing_length;  // R9 = 1 / (h_h area)

  network.nodes.insert(network.nodes.end(), {{s, C_s, "shaft under the bearing"},
                                             {i, C_i, "inner ring"},
                                             {ci, 0., "contact of balls and inner race"},
                                             {ball, C_b, "balls"},
                                             {co, 0., "contact of balls and outer race"},
                                             {o, C_o, "outer ring"},
                                             {h, C_h, "housing"}});
  const auto join = [&](const std::string& a, const std::string& c, double R) {
    network.resistors.push_back({a, c, R, Law::constant, 0., 0., 0});
  };
  join(s, ambient_node, R1);
  const double R23 = f.shaft_ring * (R2 + R3);
  if (b.shaft_ring_link == BearingCircuitData::Link::permanent)
    join(s, i, R23);
  else
    network.resistors.push_back({s, i, R23, Law::contact, 0., R23 + b.gap_resistance, place});
  join(i, ci, f.inner_race * R4);
  join(ci, ball, f.ball * R5);
  join(ball, co, f.ball * R5);
  join(ball, ambient_node, R6);
  join(co, o, f.outer_race * R7);
  join(o, h, f.fit * R8);
  network.resistors.push_back({h, ambient_node, 0., Law::housing_convection, housing_area, 0., place});
  network.places.push_back({s, i, ci, co});

  const double constraint = b.plane_strain_growth ? 1. + b.ring.poisson_ratio : 1.;
  const double a_i = 0.5 * b.inner_bore, b_i = 0.5 * b.inner_outside, a_o = 0.5 * b.outer_bore,
               b_o = 0.5 * b.housing_outside;
  const auto grow = [&](double Expansion::*surface, const std::string& node, double coefficient) {
    network.growths.push_back({place, surface, node, coefficient});
  };
  // Two nodes make a linear profile over the wall: of the inner ring, and of outer ring and housing together.
  const GrowthPerRise whole = growth_per_rise(growth_dimensions(b), constraint);
  const auto grow_ring = [&](double Expansion::*surface, const std::string& inside, const std::string& outside, double a,
                             double c, double length) {
    const auto u = ring_growth(b.ring.expansion, a, c, length, constraint);
    grow(surface, inside, u.per_rise_inside);
    grow(surface, outside, u.per_rise_outside);
  };
  grow_ring(&Expansion::bore, i, ci, a_i, b_i, a_i);
  grow_ring(&Expansion::inner_race, i, ci, a_i, b_i, b.races.inner);
  grow_ring(&Expansion::outer_race, o, h, a_o, b_o, b.races.outer);
  grow(&Expansion::shaft, s, whole.shaft);
  grow(&Expansion::ball, ball, whole.ball);
  if (b.races.width == 0.) return;
  grow_ring(&Expansion::inner_width, i, ci, a_i, b_i, b.races.width);
  grow(&Expansion::outer_width, o, whole.outer_width);
}

}  // namespace rotordrop
