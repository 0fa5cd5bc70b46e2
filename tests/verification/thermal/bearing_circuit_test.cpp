// The built-in circuit of a touchdown bearing (docs/theory/model.md):
//   ambient -R1- s -R2- x -R3- i -R4- ci -R5- b -R5- co -R7- o -R8- h -R9- ambient,   b -R6- ambient.
//
// RESISTANCES of a cylinder wall ln(d2/d1)/(2 pi k W), of a surface 1/(h area), of a rod from centre to surface 1/(4 pi k W), and of the path
// ball centre - spot: 2/(pi k d Z) plus the constriction 1/(2 k a Z) of Z spots of radius a. d_mi, d_om, d_hm: mid-wall diameters.
// CAPACITIES: volume * rho c, the inner ring's from its mass. They are computed here again from the bearings' dimensions, and compared with the values that an
// independent implementation of the same formulas gave.
//
// STEADY STATE BY HAND. Choose the housing's rise and H_i, H_o; the flows follow from the outside in:
//   q_h = 23 rise^1.25 area;  T_o = T_h + q_h R8;  co passes q_h, of which H_o is its own:  T_co = T_o + q_h R7,  T_b = T_co + (q_h - H_o) R5;
//   b gives (T_b - T_amb)/R6 away and takes q_b = q_h - H_o + (T_b - T_amb)/R6 from ci:  T_ci = T_b + q_b R5;
//   ci takes q_b - H_i from i:  T_i = T_ci + (q_b - H_i) R4;
//   x: i takes q_b - H_i = share H_r + (T_s - T_i)/(R2 + R3), and s:  (1 - share) H_r = (T_s - T_amb)/R1 + (T_s - T_i)/(R2 + R3).
// The last two give T_s and H_r.
//
// GROWTH. Free rings: alpha r times the volume-mean rise; of the inner ring of a linear profile, here by quadrature, from the i node (bore) to ci (race); of outer ring and
// housing, one body in a fit, of their volumes. By the paper's equation (26) of a linear profile from o (race) to h (outside); of a ring on a soft support o alone. ci's temperature without its own heat is the mean of i and b weighted by 1/R4 and 1/R5.
#include "thermal/circuit/bearing_circuit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <map>
#include <random>

namespace rotordrop {
namespace {

using std::numbers::pi;
constexpr double ambient = 293.15;
const ThermalMaterial steel{70., 510., 7800., 11.8e-6, 0.3}, silicon_nitride{35., 673., 3200., 3.2e-6, 0.26};

BearingCircuitData tb1() {
  BearingCircuitData b;
  b.name = "TB1";
  b.ring = b.shaft = steel;
  b.ball = silicon_nitride;
  b.width = b.shaft_length = 20e-3;
  b.journal_radius = 34.75e-3;
  b.ring_mass = 0.21;
  b.inner_bore = 70e-3;
  b.inner_outside = 78e-3;
  b.outer_bore = 97.2e-3;
  b.outer_outside = b.housing_bore = 110e-3;
  b.housing_outside = 130e-3;
  b.housing_length = 25e-3;
  b.n_balls = 14;
  b.ball_diameter = 11.906e-3;
  b.h_shaft = b.h_ball = 50.;
  b.fit_resistance = 0.005;
  b.contact_half_width = 0.4e-3;
  b.races = contact_point_surfaces(b.ball_diameter, 90e-3, 0., b.width);
  return b;
}

BearingCircuitData tb2() {
  auto b = tb1();
  b.name = "TB2";
  b.ball = steel;
  b.width = b.shaft_length = 32e-3;
  b.outer_bore = 92e-3;
  b.outer_outside = b.housing_bore = 100e-3;
  b.housing_outside = 120e-3;
  b.housing_length = 50e-3;
  b.n_balls = 46;
  b.ball_diameter = 9.525e-3;
  b.races = contact_point_surfaces(b.ball_diameter, 85e-3, 25. * pi / 180., b.width);
  return b;
}

struct Circuit {
  std::array<double, 9> R{};  // R[1] .. R[8]
  double C_s = 0, C_i = 0, C_b = 0, C_o = 0, C_h = 0, area = 0;
};

Circuit by_hand(const BearingCircuitData& b) {
  const auto wall = [&](double d1, double d2, double length) {
    return std::log(d2 / d1) / (2. * pi * b.ring.conductivity * length);
  };
  const double d_mi = 0.5 * (b.inner_bore + b.inner_outside), d_om = 0.5 * (b.outer_bore + b.outer_outside),
               d_hm = 0.5 * (b.housing_bore + b.housing_outside);
  Circuit c;
  c.R[1] = 1. / (b.h_shaft * pi * 2. * b.journal_radius * b.width);
  c.R[2] = 1. / (4. * pi * b.shaft.conductivity * b.width);
  c.R[3] = wall(2. * b.journal_radius, d_mi, b.width);
  c.R[4] = wall(d_mi, b.inner_outside, b.width);
  c.R[5] = (2. / (pi * b.ball_diameter) + 0.5 / b.contact_half_width) / (b.ball.conductivity * b.n_balls);
  c.R[6] = 1. / (b.h_ball * b.n_balls * pi * b.ball_diameter * b.ball_diameter);
  c.R[7] = wall(b.outer_bore, d_om, b.width);
  c.R[8] = wall(d_om, b.outer_outside, b.width) + b.fit_resistance + wall(b.outer_outside, d_hm, b.housing_length);
  const auto sleeve = [](double d1, double d2, double length) { return 0.25 * pi * (d2 * d2 - d1 * d1) * length; };
  const double rho_c = 7800. * 510.;
  c.C_s = b.shaft.density * b.shaft.heat_capacity * sleeve(0., 2. * b.journal_radius, b.shaft_length);
  c.C_i = b.ring_mass * 510.;
  c.C_b = b.n_balls * pi / 6. * std::pow(b.ball_diameter, 3) * b.ball.density * b.ball.heat_capacity;
  c.C_o = rho_c * sleeve(b.outer_bore, b.outer_outside, b.width);
  c.C_h = rho_c * sleeve(b.housing_bore, b.housing_outside, b.housing_length);
  c.area = pi * b.housing_outside * b.housing_length;
  return c;
}

ThermalNetworkData data_of(const BearingCircuitData& b) {
  ThermalNetworkData d;
  d.ambient = ambient;
  add_bearing_circuit(b, d);
  return d;
}

double resistance(const ThermalNetworkData& d, const std::string& a, const std::string& b) {
  for (const auto& r : d.resistors)
    if ((r.between == a && r.and_node == b) || (r.between == b && r.and_node == a)) return r.resistance;
  ADD_FAILURE() << "no resistor between " << a << " and " << b;
  return 0.;
}
double capacity(const ThermalNetworkData& d, const std::string& name) {
  for (const auto& n : d.nodes)
    if (n.name == name) return n.capacity;
  ADD_FAILURE() << "no node " << name;
  return 0.;
}

/// States in the circuit's order: s, i, b, o, h.
std::vector<double> rates(const ThermalNetwork& network, const std::vector<double>& T, const HeatInput& heat,
                          double* lost = nullptr) {
  std::vector<double> rate(T.size());
  const double away = network.rates(T, {&heat, 1}, rate);
  if (lost) *lost = away;
  return rate;
}
constexpr double share_to_ring = 0.66;
HeatInput heat(double rub, double inner, double outer) {
  HeatInput h;
  h.rub = rub;
  h.rub_into_ring = share_to_ring * rub;
  h.inner = inner;
  h.outer = outer;
  return h;
}

std::vector<double> random_temperatures(std::mt19937& random, std::size_t n = 5) {
  std::uniform_real_distribution<double> rise(0., 40.);
  std::vector<double> T(n);
  for (auto& value : T) value = ambient + rise(random);
  return T;
}

TEST(BearingCircuit, HasTheResistancesAndCapacitiesOfItsDimensions) {
  // s-x-i is one resistor R2 + R3: the rub enters s and i by the share.
  const std::map<std::string, std::array<double, 13>> published = {
      {"TB1",
       {4.5799984, 0.05684105, 0.00713223, 0.00598465, 2.6601439, 3.2078964, 0.00724912, 0.01972776, 301.8243, 107.1,
        26.6434, 165.7236, 374.9177}},
      {"TB2",
       {2.8624990, 0.03552566, 0.00445764, 0.00374041, 0.4089555, 1.5254301, 0.00302392, 0.01223448, 482.9189, 107.1,
        82.7973, 153.5663, 687.3491}}};
  for (const auto& b : {tb1(), tb2()}) {
    const auto d = data_of(b);
    const auto hand = by_hand(b);
    const auto& peer = published.at(b.name);
    const auto name = [&](const char* node) { return b.name + "/" + node; };
    const std::array<double, 8> R = {resistance(d, name("shaft"), "ambient"),
                                     resistance(d, name("shaft"), name("inner_ring")),
                                     resistance(d, name("inner_ring"), name("inner_contact")),
                                     resistance(d, name("inner_contact"), name("ball")),
                                     resistance(d, name("ball"), name("outer_contact")),
                                     resistance(d, name("ball"), "ambient"),
                                     resistance(d, name("outer_contact"), name("outer_ring")),
                                     resistance(d, name("outer_ring"), name("housing"))};
    const std::array<double, 8> expected = {
        hand.R[1], hand.R[2] + hand.R[3], hand.R[4], hand.R[5], hand.R[5], hand.R[6], hand.R[7], hand.R[8]};
    const std::array<double, 8> theirs = {peer[0], peer[1] + peer[2], peer[3], peer[4],
                                          peer[4], peer[5],           peer[6], peer[7]};
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(R[i] / expected[i], 1., 1e-12) << b.name << " " << i;
      EXPECT_NEAR(R[i] / theirs[i], 1., 2e-6) << b.name << " " << i << ": digits of the independent implementation";
    }
    const std::array<double, 5> C = {capacity(d, name("shaft")), capacity(d, name("inner_ring")),
                                     capacity(d, name("ball")), capacity(d, name("outer_ring")),
                                     capacity(d, name("housing"))};
    const std::array<double, 5> C_hand = {hand.C_s, hand.C_i, hand.C_b, hand.C_o, hand.C_h};
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(C[i] / C_hand[i], 1., 1e-12) << b.name << " " << i;
      EXPECT_NEAR(C[i] / peer[8 + i], 1., 2e-6) << b.name << " " << i << ": digits of the independent implementation";
    }
    EXPECT_EQ(capacity(d, name("inner_contact")), 0.);
    EXPECT_EQ(capacity(d, name("outer_contact")), 0.);
  }
}

TEST(BearingCircuit, RestsInTheSteadyStateSolvedByHand) {
  for (const auto& b : {tb1(), tb2()}) {
    const ThermalNetwork network(data_of(b));
    const auto c = by_hand(b);
    const double rise = 9., H_i = 25., H_o = 3.;
    const double q_h = 23. * std::pow(rise, 1.25) * c.area;
    const double T_h = ambient + rise, T_o = T_h + q_h * c.R[8], T_co = T_o + q_h * c.R[7],
                 T_b = T_co + (q_h - H_o) * c.R[5];
    const double q_b = q_h - H_o + (T_b - ambient) / c.R[6], T_ci = T_b + q_b * c.R[5],
                 T_i = T_ci + (q_b - H_i) * c.R[4];
    const double q_i = q_b - H_i, R_x = c.R[2] + c.R[3], share = share_to_ring;
    // share H_r + (T_s - T_i)/R_x = q_i;  (1 - share) H_r - (T_s - ambient)/R1 - (T_s - T_i)/R_x = 0
    Eigen::Matrix2d A;
    A << share, 1. / R_x, 1. - share, -1. / c.R[1] - 1. / R_x;
    const Eigen::Vector2d solution = A.inverse() * Eigen::Vector2d(q_i + T_i / R_x, -ambient / c.R[1] - T_i / R_x);
    const double H_r = solution[0], T_s = solution[1];
    ASSERT_GT(T_b, ambient);
    double lost = 0.;
    const auto rate = rates(network, {T_s, T_i, T_b, T_o, T_h}, heat(H_r, H_i, H_o), &lost);
    const std::array<double, 5> C = {c.C_s, c.C_i, c.C_b, c.C_o, c.C_h};
    const double scale = std::fabs(H_r) + H_i + H_o;
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(C[k] * rate[k], 0., 1e-9 * scale) << b.name << " W into node " << k;
    EXPECT_NEAR(lost, H_r + H_i + H_o, 1e-9 * scale) << "W";
    std::vector<double> shown(7);
    const auto h = heat(H_r, H_i, H_o);
    network.observe(std::vector<double>{T_s, T_i, T_b, T_o, T_h}, {&h, 1}, shown);
    EXPECT_NEAR(shown[2], T_ci, 1e-9) << "K, inner contact";
    EXPECT_NEAR(shown[4], T_co, 1e-9) << "K, outer contact";
  }
}

TEST(BearingCircuit, KeepsEveryJoule) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> watts(0., 3e4);
  for (const auto& b : {tb1(), tb2()})
    for (const double share : {0.66, 0.3}) {
      const ThermalNetwork network(data_of(b));
      for (int i = 0; i < 50; ++i) {
        const auto T = random_temperatures(random);
        auto h = heat(watts(random), 0.01 * watts(random), 0.01 * watts(random));
        h.rub_into_ring = share * h.rub;
        double lost = 0.;
        const auto rate = rates(network, T, h, &lost);
        // Stored energy is linear in the temperatures: its rate is its value at ambient + rates.
        std::vector<double> at = rate;
        for (auto& value : at) value += ambient;
        EXPECT_NEAR(network.stored_energy(at) + lost, h.rub + h.inner + h.outer, 1e-9 * 3e4)
            << "W; 1e-9: ambient + rate rounds to 6e-14 K of some K";
      }
    }
}

TEST(BearingCircuit, MasslessContactsAreWhatSmallCapacitiesTendTo) {
  // The same circuit with capacities on ci and co: where these nodes' own balance holds, all other rates agree exactly.
  std::mt19937 random(2);
  for (const auto& b : {tb1(), tb2()}) {
    const auto d = data_of(b);
    auto full_data = d;
    for (auto& node : full_data.nodes)
      if (node.capacity == 0.) node.capacity = 1e-3;
    const ThermalNetwork network(d), full(full_data);
    for (int i = 0; i < 20; ++i) {
      const auto T = random_temperatures(random);
      const auto h = heat(5000., 50., 60.);
      std::vector<double> all(7);
      network.observe(T, {&h, 1}, all);  // s, i, ci, b, co, o, h
      const auto small = rates(network, T, h), rate = rates(full, all, h);
      EXPECT_NEAR(1e-3 * rate[2], 0., 1e-9) << "W, balance of ci";
      EXPECT_NEAR(1e-3 * rate[4], 0., 1e-9) << "W, balance of co";
      const std::array<std::size_t, 5> index = {0, 1, 3, 5, 6};
      for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(rate[index[k]], small[k], 1e-10 * 100.) << "K/s, node " << k;
    }
  }
}

TEST(BearingCircuit, SmallCapacitiesGiveTheSameHistory) {
  // Both integrated through a pulse of heat and the time after it; a capacity of 1e-4 J/K on the contacts has settled after 1e-3 s.
  const auto d = data_of(tb2());
  auto full_data = d;
  for (auto& node : full_data.nodes)
    if (node.capacity == 0.) node.capacity = 1e-4;
  const ThermalNetwork network(d), full(full_data);
  std::vector<double> T(5), T_full(7);
  network.initial_state(T);
  full.initial_state(T_full);
  const double h = 2e-7;  // below 2 R C of the small nodes
  const auto advance = [&](const ThermalNetwork& n, std::vector<double>& state, const HeatInput& input) {
    std::vector<double> k1(state.size()), k2(state.size()), middle = state;
    n.rates(state, {&input, 1}, k1);
    for (std::size_t i = 0; i < state.size(); ++i) middle[i] = state[i] + 0.5 * h * k1[i];
    n.rates(middle, {&input, 1}, k2);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += h * k2[i];
  };
  for (int i = 0; i < 50000; ++i) {  // 10 ms
    const auto input = i < 10000 ? heat(3e4, 300., 400.) : heat(0., 0., 0.);
    advance(network, T, input);
    advance(full, T_full, input);
  }
  const std::array<std::size_t, 5> index = {0, 1, 3, 5, 6};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(T_full[index[k]], T[k], 2e-5) << "K, node " << k << "; 1e-4 J/K keeps about 1e-5 of the heat";
  EXPECT_GT(T[1], ambient + 0.3) << "K: 60 J, two thirds of them into 107 J/K";
}

TEST(BearingCircuit, LinkOfShaftAndRingDependsOnContactIfAsked) {
  auto b = tb1();
  b.shaft_ring_link = BearingCircuitData::Link::in_contact;
  b.gap_resistance = 1.4;
  const ThermalNetwork network(data_of(b)), permanent(data_of(tb1()));
  const auto c = by_hand(b);
  const std::vector<double> T = {ambient + 10., ambient, ambient, ambient, ambient};
  auto h = heat(0., 0., 0.);
  h.is_in_contact = true;
  EXPECT_NEAR(rates(network, T, h)[1], 10. / (c.R[2] + c.R[3]) / c.C_i, 1e-9) << "K/s";
  EXPECT_NEAR(rates(permanent, T, h)[1], 10. / (c.R[2] + c.R[3]) / c.C_i, 1e-9) << "K/s";
  h.is_in_contact = false;
  EXPECT_NEAR(rates(network, T, h)[1], 10. / (c.R[2] + c.R[3] + 1.4) / c.C_i, 1e-9) << "K/s";
  EXPECT_NEAR(rates(permanent, T, h)[1], 10. / (c.R[2] + c.R[3]) / c.C_i, 1e-9) << "K/s: the paper's link stays";
}

TEST(BearingCircuit, GrowsByTheVolumeMeanRise) {
  std::mt19937 random(3);
  for (const auto& b : {tb1(), tb2()}) {
    const ThermalNetwork network(data_of(b));
    const auto c = by_hand(b);
    const auto T = random_temperatures(random);
    Expansion growth;
    network.growth(T, {&growth, 1});
    const double T_ci = (T[1] / c.R[4] + T[2] / c.R[5]) / (1. / c.R[4] + 1. / c.R[5]);
    const auto mean_rise = [](double d1, double d2, double T1,
                              double T2) {  // by Gauss' two points: exact for T r, quadratic
      const double a = 0.5 * d1, e = 0.5 * d2, m = 0.5 * (a + e), w = 0.5 * (e - a) / std::sqrt(3.);
      double sum = 0.;
      for (const double r : {m - w, m + w}) sum += (T1 + (T2 - T1) * (r - a) / (e - a) - ambient) * r * 0.5 * (e - a);
      return 2. * sum / (e * e - a * a);
    };
    const double inner = mean_rise(b.inner_bore, b.inner_outside, T[1], T_ci);
    const auto square = [](double d) { return d * d; };
    const double ring = (square(b.outer_outside) - square(b.outer_bore)) * b.width,
                 housing = (square(b.housing_outside) - square(b.housing_bore)) * b.housing_length,
                 outer = (ring * (T[3] - ambient) + housing * (T[4] - ambient)) / (ring + housing);
    EXPECT_NEAR(growth.bore, 11.8e-6 * 35e-3 * inner, 1e-16) << "m";
    // Where a ball touches: d_m / 2 -+ d / 2 cos phi; of TB1 45 -+ 5.953 mm, of TB2 42.5 mm -+ 4.7625 mm cos 25 degrees.
    const bool is_first = b.name == "TB1";
    const double projected = is_first ? 5.953e-3 : 4.7625e-3 * 0.9063077870366499, middle = is_first ? 45e-3 : 42.5e-3;
    EXPECT_NEAR(growth.inner_race, 11.8e-6 * (middle - projected) * inner, 1e-16) << "m";
    EXPECT_NEAR(growth.outer_race, 11.8e-6 * (middle + projected) * outer, 1e-16) << "m";
    using Growth = BearingCircuitData::OuterGrowth;
    for (const auto& [by, rise] : {std::pair{Growth::profile, mean_rise(b.outer_bore, b.housing_outside, T[3], T[4])},
                                   std::pair{Growth::ring, T[3] - ambient}}) {
      auto other = b;
      other.outer_growth = by;
      Expansion found;
      ThermalNetwork(data_of(other)).growth(T, {&found, 1});
      EXPECT_NEAR(found.outer_race, 11.8e-6 * (middle + projected) * rise, 1e-16) << "m";
    }
    EXPECT_NEAR(growth.inner_width, 11.8e-6 * b.width * inner, 1e-16) << "m";
    EXPECT_NEAR(growth.outer_width, 11.8e-6 * b.width * (T[3] - ambient), 1e-16) << "m: the outer ring's own";
    EXPECT_NEAR(growth.shaft, 11.8e-6 * 34.75e-3 * (T[0] - ambient), 1e-16) << "m";
    EXPECT_NEAR(growth.ball, b.ball.expansion * 0.5 * b.ball_diameter * (T[2] - ambient), 1e-16) << "m: of the radius";
  }
}

TEST(BearingCircuit, AShaftOfAnotherMaterialChangesItsOwnNumbersAlone) {
  const ThermalMaterial titanium{7., 540., 4430., 8.6e-6, 0.34};
  auto b = tb1();
  const auto d = data_of(b);
  const auto c = by_hand(b);
  b.shaft = titanium;
  b.plane_strain_growth = true;  // a shaft stays free
  const auto other = data_of(b);
  ASSERT_EQ(other.nodes.size(), d.nodes.size());
  const std::string shaft = "TB1/shaft", ring = "TB1/inner_ring";
  EXPECT_NEAR(capacity(other, shaft), 540. * 4430. * pi * 34.75e-3 * 34.75e-3 * 20e-3, 1e-10) << "J/K";
  EXPECT_NEAR(resistance(other, shaft, ring), c.R[2] * 70. / 7. + c.R[3], 1e-12) << "K/W";
  for (std::size_t i = 1; i < d.nodes.size(); ++i) EXPECT_EQ(other.nodes[i].capacity, d.nodes[i].capacity);
  for (std::size_t i = 0; i < d.resistors.size(); ++i) {
    if (i == 1) continue;
    EXPECT_EQ(other.resistors[i].resistance, d.resistors[i].resistance) << d.resistors[i].between;
  }
  const std::vector<double> T = {ambient + 10., ambient, ambient, ambient, ambient};
  Expansion growth;
  ThermalNetwork(other).growth(T, {&growth, 1});
  EXPECT_NEAR(growth.shaft, 8.6e-6 * 34.75e-3 * 10., 1e-16) << "m";
  EXPECT_NEAR(growth_per_rise(growth_dimensions(b), 1.34).shaft, 8.6e-6 * 34.75e-3, 1e-18) << "m/K";
}

TEST(BearingCircuit, PlaneStrainGrowsRingsByOnePlusPoissonMore) {
  auto b = tb2();
  const std::vector<double> T = {ambient + 3., ambient + 9., ambient + 4., ambient + 2., ambient + 1.};
  Expansion free, strained;
  b.races = {39e-3, 46e-3, 0.};  // the paper's: shoulders, no width
  ThermalNetwork(data_of(b)).growth(T, {&free, 1});
  b.plane_strain_growth = true;
  ThermalNetwork(data_of(b)).growth(T, {&strained, 1});
  EXPECT_NEAR(strained.bore / free.bore, 1.3, 1e-12);
  EXPECT_NEAR(free.inner_race / free.bore, 39. / 35., 1e-12);
  EXPECT_EQ(free.inner_width, 0.);
  EXPECT_EQ(free.outer_width, 0.);
  EXPECT_NEAR(strained.inner_race / free.inner_race, 1.3, 1e-12);
  EXPECT_NEAR(strained.outer_race / free.outer_race, 1.3, 1e-12);
}

TEST(BearingCircuit, AnImpactsHeatRaisesTheRingByShareOverCapacityBeforeItFlows) {
  // 60 J in 0.1 ms: nothing flows yet; 0.66 * 60 J / 107.1 J/K = 0.3697 K into the ring, 0.34 * 60 / 301.82 = 0.0676 K into the shaft.
  const ThermalNetwork network(data_of(tb1()));
  std::vector<double> T(5);
  network.initial_state(T);
  const double dt = 1e-7;
  for (int i = 0; i < 1000; ++i) {
    const auto rate = rates(network, T, heat(6e5, 0., 0.));
    for (std::size_t k = 0; k < 5; ++k) T[k] += dt * rate[k];
  }
  EXPECT_NEAR(T[1] - ambient, 0.66 * 60. / 107.1, 1e-4) << "K";
  EXPECT_NEAR(T[0] - ambient, 0.34 * 60. / 301.8243, 1e-4) << "K";
}

TEST(BearingCircuit, BearingsAreIndependentPlaces) {
  ThermalNetworkData d;
  d.ambient = ambient;
  add_bearing_circuit(tb1(), d);
  add_bearing_circuit(tb2(), d);
  const ThermalNetwork both(d), first(data_of(tb1())), second(data_of(tb2()));
  std::mt19937 random(4);
  const auto T = random_temperatures(random, 10);
  const std::array<HeatInput, 2> h = {heat(1000., 10., 20.), heat(3000., 40., 50.)};
  std::vector<double> rate(10);
  const double lost = both.rates(T, h, rate);
  double lost_1 = 0., lost_2 = 0.;
  auto apart = rates(first, {T.begin(), T.begin() + 5}, h[0], &lost_1);
  const auto others = rates(second, {T.begin() + 5, T.end()}, h[1], &lost_2);
  apart.insert(apart.end(), others.begin(), others.end());
  for (std::size_t k = 0; k < 10; ++k) EXPECT_NEAR(rate[k], apart[k], 1e-11 * (1. + std::fabs(apart[k])));
  EXPECT_NEAR(lost, lost_1 + lost_2, 1e-10);
}

}  // namespace
}  // namespace rotordrop
