#include "thermal/circuit/bearing_circuit.h"

#include <array>
#include <cmath>

#include "laws/heat/strip_spreading.h"
#include "laws/ring_growth.h"

namespace rotordrop {

namespace {

double disc(double diameter) { return 0.25 * std::numbers::pi * diameter * diameter; }

/// From the middle of a shaft, or the bore of a hollow one, to its surface, where it warms evenly [K/W]: the fall over the wall of
/// r T'' + T' + q r / k = 0 with no flow through the bore, over the heat of all of it. 1/(4 pi k W) of a solid one.
double middle_to_surface(const BearingCircuitData& b) {
  const double whole = 1. / (4. * std::numbers::pi * b.shaft.conductivity * b.width);
  if (b.shaft_bore_radius == 0.) return whole;
  const double ratio = b.shaft_bore_radius / b.journal_radius, square = ratio * ratio;
  return whole * (1. + 2. * square * std::log(ratio) / (1. - square));
}

}  // namespace

double BearingCircuitData::shaft_section() const { return disc(2. * journal_radius) - disc(2. * shaft_bore_radius); }

CircuitResistances circuit_resistances(const BearingCircuitData& b) {
  using std::numbers::pi;
  const double k = b.ring.conductivity, k_b = b.ball.conductivity, W = b.width, Z = b.n_balls,
               d_s = 2. * b.journal_radius;
  const double d_mi = 0.5 * (b.inner_bore + b.inner_outside), d_om = 0.5 * (b.outer_bore + b.outer_outside),
               d_hm = 0.5 * (b.housing_bore + b.housing_outside);
  CircuitResistances R;
  R.R1 = 1. / (b.h_shaft * pi * d_s * b.shaft_length);
  R.R2 = middle_to_surface(b);
  R.R3 = std::log(d_mi / d_s) / (2. * pi * k * W);
  R.R4 = std::log(b.inner_outside / d_mi) / (2. * pi * k * W);
  R.R5_inside = 2. / (pi * k_b * b.ball_diameter * Z);
  R.R5_constriction = 2. / (4. * k_b * b.contact_half_width * Z);
  R.R6 = 1. / (b.h_ball * Z * pi * b.ball_diameter * b.ball_diameter);
  R.R7 = std::log(d_om / b.outer_bore) / (2. * pi * k * W);
  if (b.strips) {
    const auto& s = *b.strips;
    // The slab under the groove: half of it to its mean, instead of half the ring up to its shoulder.
    R.R4 = std::log(s.inner_radius / (s.inner_radius - 0.5 * s.inner_thickness)) / (2. * pi * k * W);
    R.R7 = std::log((s.outer_radius + 0.5 * s.outer_thickness) / s.outer_radius) / (2. * pi * k * W);
    R.R4_spreading = strip_spreading(W, s.inner_thickness, s.inner, s.half_width, k) / (2. * pi * s.inner_radius);
    R.R7_spreading =
        strip_spreading(W, s.outer_thickness, s.outer, s.half_width, k,
                        {b.fit_resistance * pi * b.outer_outside * W, 0.5 * (b.housing_outside - b.outer_outside)}) /
        (2. * pi * s.outer_radius);
  }
  R.R8_ring = std::log(b.outer_outside / d_om) / (2. * pi * k * W);
  R.R8_fit = b.fit_resistance;
  R.R8_housing = std::log(d_hm / b.outer_outside) / (2. * pi * k * b.housing_length);
  return R;
}

GrowthDimensions growth_dimensions(const BearingCircuitData& b) {
  return {b.ring.expansion,
          b.ball.expansion,
          b.shaft.expansion,
          b.journal_radius,
          0.5 * b.inner_bore,
          0.5 * b.ball_diameter,
          b.races,
          b.outer_growth != BearingCircuitData::OuterGrowth::ring};
}

namespace {

/// Growth of the outer raceway per rise of the outer ring's node and of the housing's [m/K].
std::array<double, 2> outer_race_growth(const BearingCircuitData& b, double ring_volume, double housing_volume,
                                        double constraint) {
  using Growth = BearingCircuitData::OuterGrowth;
  if (b.outer_growth == Growth::profile) {
    const auto u =
        ring_growth(b.ring.expansion, 0.5 * b.outer_bore, 0.5 * b.housing_outside, b.races.outer, constraint);
    return {u.per_rise_inside, u.per_rise_outside};
  }
  const double whole = constraint * b.ring.expansion * b.races.outer;
  const double of_ring = b.outer_growth == Growth::ring ? 1. : ring_volume / (ring_volume + housing_volume);
  return {of_ring * whole, (1. - of_ring) * whole};
}

}  // namespace

void add_bearing_circuit(const BearingCircuitData& b, ThermalNetworkData& network) {
  using std::numbers::pi;
  using Law = ThermalNetworkData::Law;
  const auto name = [&](const char* node) { return b.name + "/" + node; };
  const std::string s = name("shaft"), i = name("inner_ring"), ci = name("inner_contact"), ball = name("ball"),
                    co = name("outer_contact"), o = name("outer_ring"), h = name("housing");
  const std::size_t place = network.places.size();

  const double W = b.width, Z = b.n_balls;
  const auto sleeve = [&](double inside, double outside) { return disc(outside) - disc(inside); };

  const CircuitFactors& f = b.factors;
  const double volumetric = b.ring.volumetric_capacity();
  const double C_s = b.shaft.volumetric_capacity() * b.shaft_section() * b.shaft_length;
  const double C_i = f.inner_ring_capacity * b.ring_mass * b.ring.heat_capacity;
  const double C_b = Z * pi / 6. * std::pow(b.ball_diameter, 3) * b.ball.volumetric_capacity();
  const double V_o = sleeve(b.outer_bore, b.outer_outside) * W,
               V_h = sleeve(b.housing_bore, b.housing_outside) * b.housing_length;
  const double C_o = f.outer_ring_capacity * volumetric * V_o, C_h = f.housing_capacity * volumetric * V_h;

  const CircuitResistances R = circuit_resistances(b);
  const double R5 = R.R5_inside + R.R5_constriction, R8 = R.R8_ring + R.R8_fit + R.R8_housing;
  const double housing_area = pi * b.housing_outside * b.housing_length;  // R9 = 1 / (h_h area)

  network.nodes.insert(network.nodes.end(), {{s, C_s, "shaft under the bearing"},
                                             {i, C_i, "inner ring"},
                                             {ci, 0., "contact of balls and inner race"},
                                             {ball, C_b, "balls"},
                                             {co, 0., "contact of balls and outer race"},
                                             {o, C_o, "outer ring"},
                                             {h, C_h, "housing"}});
  const auto join = [&](const std::string& a, const std::string& c, double resistance) {
    network.resistors.push_back({a, c, resistance, Law::constant, 0., 0., 0});
  };
  join(s, ambient_node, R.R1);
  const double R23 = f.shaft_ring * (R.R2 + R.R3);
  if (b.shaft_ring_link == BearingCircuitData::Link::permanent)
    join(s, i, R23);
  else
    network.resistors.push_back({s, i, R23, Law::contact, 0., R23 + b.gap_resistance, place});
  join(i, ci, f.inner_race * (R.R4 + R.R4_spreading));
  if (b.ball_conduction) {
    join(ci, ball,
         1. / b.ball_conduction->inner_to_ball);  // as stated: the calibration's factor is on what is computed
    join(ball, co, 1. / b.ball_conduction->outer_to_ball);
    if (b.ball_conduction->inner_to_outer > 0.) join(ci, co, 1. / b.ball_conduction->inner_to_outer);
  } else if (!b.balls_roll) {
    join(ci, ball, f.ball * R5);
    join(ball, co, f.ball * R5);
  }
  join(ball, ambient_node, R.R6);
  join(co, o, f.outer_race * (R.R7 + R.R7_spreading));
  join(o, h, f.fit * R8);
  network.resistors.push_back({h, ambient_node, 0., Law::housing_convection, housing_area, 0., place});
  for (std::size_t n = 0; n < b.fins.size(); ++n) {
    const FinNode& fin = b.fins[n];
    network.nodes.push_back({name(fin.name.c_str()), fin.capacity, "shaft beside the bearing"});
    join(fin.is_first ? s : name(b.fins[n - 1].name.c_str()), name(fin.name.c_str()), fin.resistance);
    join(name(fin.name.c_str()), ambient_node, fin.to_ambient);
  }
  network.places.push_back({s, i, ci, co, b.balls_roll ? ball : std::string{}, f.ball});

  const double constraint = b.plane_strain_growth ? 1. + b.ring.poisson_ratio : 1.;
  const double a_i = 0.5 * b.inner_bore, b_i = 0.5 * b.inner_outside;
  const auto grow = [&](double Expansion::*surface, const std::string& node, double coefficient) {
    network.growths.push_back({place, surface, node, coefficient});
  };
  // Two nodes make a linear profile over the inner ring's wall.
  const GrowthPerRise whole = growth_per_rise(growth_dimensions(b), constraint);
  // With spreading the contact's node is a strip: the ring grows with the mean of its raceway, which is on the way from the ring to the strips.
  const double on_strips = R.R4 / (R.R4 + R.R4_spreading);
  const auto grow_inner = [&](double Expansion::*surface, double length) {
    const auto u = ring_growth(b.ring.expansion, a_i, b_i, length, constraint);
    grow(surface, i, u.per_rise_inside + (1. - on_strips) * u.per_rise_outside);
    grow(surface, ci, on_strips * u.per_rise_outside);
  };
  grow_inner(&Expansion::bore, a_i);
  grow_inner(&Expansion::inner_race, b.races.inner);
  const auto [of_ring, of_housing] = outer_race_growth(b, V_o, V_h, constraint);
  grow(&Expansion::outer_race, o, of_ring);
  if (of_housing != 0.) grow(&Expansion::outer_race, h, of_housing);
  grow(&Expansion::shaft, s, whole.shaft);
  grow(&Expansion::ball, ball, whole.ball);
  if (b.races.width == 0.) return;
  grow_inner(&Expansion::inner_width, b.races.width);
  grow(&Expansion::outer_width, o, whole.outer_width);
}

}  // namespace rotordrop
