// A circuit fitted to the response of a circuit: what was changed must be found again.
#include "analysis/facts/circuit_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

BearingCircuitData example() {
  BearingCircuitData b;
  b.name = "TB";
  b.ring = b.shaft = {45., 460., 7800., 1.2e-5, 0.3};
  b.ball = {30., 800., 3200., 3e-6, 0.26};
  b.width = 0.02;
  b.journal_radius = 0.035;
  b.ring_mass = 0.23;
  b.inner_bore = 0.07;
  b.inner_outside = 0.08;
  b.outer_bore = 0.1;
  b.outer_outside = 0.11;
  b.housing_bore = 0.11;
  b.housing_outside = 0.15;
  b.housing_length = 0.03;
  b.shaft_length = 0.05;
  b.n_balls = 13;
  b.ball_diameter = 0.012;
  b.h_shaft = 90.;
  b.h_ball = 30.;
  b.fit_resistance = 0.05;
  b.contact_half_width = 1e-3;
  return b;
}

/// A circuit in its own modes, as if a section had been reduced to them.
ReducedHeat in_modes(const BearingCircuitData& circuit) {
  ThermalNetworkData data;
  data.ambient = ambient;
  add_bearing_circuit(circuit, data);
  std::erase_if(data.resistors, [](const auto& r) { return r.law == ThermalNetworkData::Law::housing_convection; });
  const ThermalNetwork network(data);
  const auto entries = network.state_entries();
  const auto n = static_cast<Eigen::Index>(entries.size());
  Eigen::VectorXd C(n), y(n), rate(n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (const auto& node : data.nodes)
      if (node.name == entries[static_cast<std::size_t>(k)].name) C(k) = node.capacity;
  Eigen::MatrixXd A(n, n);
  const auto rates = [&](const HeatInput& h) {
    network.rates({y.data(), entries.size()}, {&h, 1}, {rate.data(), entries.size()});
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    y.setConstant(ambient);
    y(j) += 1.;
    rates({});
    A.col(j) = rate;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(-Eigen::MatrixXd(C.asDiagonal() * A),
                                                                        Eigen::MatrixXd(C.asDiagonal()));
  ReducedHeat heat;
  heat.capacity = C.sum();
  const Eigen::MatrixXd shape = modes.eigenvectors() * std::sqrt(heat.capacity);
  for (Eigen::Index i = 0; i < n; ++i) heat.rate.push_back(modes.eigenvalues()(i));
  const auto row = [&](const Eigen::VectorXd& weights) {
    const Eigen::VectorXd v = shape.transpose() * weights;
    return std::vector<double>(v.begin(), v.end());
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::string name = entries[static_cast<std::size_t>(k)].name.substr(3);
    ReducedHeat::Output output{name, row(Eigen::VectorXd::Unit(n, k)), C(k), 0.};
    (name == "ball" || name == "shaft" ? heat.nodes : heat.bodies).push_back(output);
  }
  y.setConstant(ambient);
  HeatInput bore, shaft, inner, outer;
  bore.rub = bore.rub_into_ring = shaft.rub = inner.inner = outer.outer = 1.;
  for (const auto& h : {bore, shaft, inner, outer}) {
    rates(h);
    heat.ports.push_back({"", row(C.asDiagonal() * rate), 0., 0.});
  }
  return heat;
}

CalibratedBearing fitted(const BearingCircuitData& truth) {
  return fit_circuit(example(), in_modes(truth), ambient, {}, uncertain_resistances(example(), example()));
}

TEST(Calibration, LeavesACircuitAloneThatIsRightAlready) {
  const auto found = fitted(example());
  EXPECT_LT(found.before.rms, 1e-10) << "the responses are those of the circuit";
  for (const auto& [name, member] : circuit_factors) EXPECT_NEAR(found.factors.*member, 1., 1e-8) << name;
  for (const auto& r : found.resistances) EXPECT_FALSE(r.is_at_lowest || r.is_at_highest) << r.uncertain.name;
}

TEST(Calibration, FindsFactorsWithinTheirBoundsAgain) {
  auto changed = example();
  changed.factors = {.shaft_ring = 0.6, .inner_race = 1.2, .outer_race = 0.85, .fit = 0.7};
  const auto found = fitted(changed);
  // Resistances in series with R5, forty times theirs, show little, so that the weak pull towards 1 is felt: those are held by what they do.
  EXPECT_GT(found.before.rms, 0.025);
  EXPECT_LT(found.after.rms, 0.02 * found.before.rms);
  // The pull, a hundredth of the factors' logarithms, moves these two by 4e-5.
  EXPECT_NEAR(found.factors.shaft_ring, 0.6, 1e-3);
  EXPECT_NEAR(found.factors.fit, 0.7, 1e-3);
  for (const auto& r : found.resistances) EXPECT_FALSE(r.is_at_lowest || r.is_at_highest) << r.uncertain.name;
}

TEST(Calibration, NamesTheResistanceThatCarriesTheError) {
  for (const auto& [name, member] :
       {std::pair("shaft_ring", &CircuitFactors::shaft_ring), std::pair("fit", &CircuitFactors::fit)}) {
    auto changed = example();
    changed.factors.*member = 0.7;
    const auto found = fitted(changed);
    ASSERT_NE(found.carrier(), nullptr);
    EXPECT_STREQ(found.carrier()->uncertain.name, name);
    EXPECT_NEAR(found.carrier()->rms_without, found.before.rms, 0.05 * found.before.rms) << "all the error there was";
  }
}

TEST(Calibration, StopsAtItsBoundsAndSaysSo) {
  for (const auto& [factor, bound] : {std::pair(0.2, 0.5), std::pair(5., 2.)}) {
    auto changed = example();
    changed.factors.shaft_ring = factor;
    const auto found = fitted(changed);
    EXPECT_NEAR(found.factors.shaft_ring, bound, 1e-12);
    const auto& r = found.resistances.front();
    EXPECT_EQ(r.is_at_lowest, factor < 1.);
    EXPECT_EQ(r.is_at_highest, factor > 1.);
    for (const auto& each : found.resistances) {
      EXPECT_GE(found.factors.*each.uncertain.member, each.uncertain.lowest * (1. - 1e-12)) << each.uncertain.name;
      EXPECT_LE(found.factors.*each.uncertain.member, each.uncertain.highest * (1. + 1e-12)) << each.uncertain.name;
    }
  }
}

TEST(Calibration, AllowsSpreadingWhereTheCircuitHasNone) {
  auto strips = example();
  strips.strips = {{0.01}, {0.01}, 3e-3, 3e-3, 0.039, 0.051, 0.5e-3};
  const auto none = uncertain_resistances(example(), strips), has = uncertain_resistances(strips, strips);
  const CircuitResistances R = circuit_resistances(example()), with = circuit_resistances(strips);
  EXPECT_DOUBLE_EQ(none[1].highest, 1.25 * (with.R4 + with.R4_spreading) / R.R4);
  EXPECT_DOUBLE_EQ(none[2].highest, 1.25 * (with.R7 + with.R7_spreading) / R.R7);
  EXPECT_GT(none[1].highest, 3.);
  EXPECT_DOUBLE_EQ(has[1].highest, 1.25);
}

TEST(Calibration, LeavesTheBallsResistanceToTheModelsThatShareIt) {
  auto changed = example();
  changed.factors.ball = 0.5;
  const auto found = fitted(changed);
  EXPECT_EQ(found.factors.ball, 1.);
  for (const auto& r : found.resistances) EXPECT_STRNE(r.uncertain.name, "ball");
  EXPECT_GT(found.after.rms, 0.5 * found.before.rms) << "no other resistance takes its error";
}

TEST(Calibration, LeavesCapacitiesAsTheyAreAndReportsWhatRemains) {
  auto changed = example();
  changed.factors.inner_ring_capacity = 1.25;
  const auto found = fitted(changed);
  EXPECT_EQ(found.factors.inner_ring_capacity, 1.);
  ASSERT_EQ(found.nodes.size(), 5u);
  for (const auto& [name, errors] : found.nodes) {
    if (name != "inner_ring") continue;
    // Heat into the ring raises it by E/C at first: a quarter too much with the smaller capacity, whatever the resistances.
    EXPECT_NEAR(errors[0].largest, 0.25, 0.01);
    EXPECT_NEAR(errors[1].largest, 0.25, 0.01);
  }
  auto own = example();
  own.factors.inner_ring_capacity = 1.25;
  own.factors.ball = 3.;  // an earlier calibration's
  const auto again = fit_circuit(own, in_modes(changed), ambient, {}, uncertain_resistances(own, own));
  EXPECT_EQ(again.factors.inner_ring_capacity, 1.25) << "the case's own";
  EXPECT_LT(again.before.rms, 1e-10);
}

}  // namespace
}  // namespace rotordrop
