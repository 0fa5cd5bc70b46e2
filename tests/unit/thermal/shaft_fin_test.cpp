// Shaft beside a bearing as a fin.
//
// STEADY. Section A, perimeter p, far end insulated: conductance sqrt(h p k A) tanh(m L), m = sqrt(h p/(k A)).
// IN TIME. Near a step of its root's temperature a long fin without convection takes k A (T/sqrt(pi D t)) per time, that is 2 k A T sqrt(t/(pi D)) until t, D = k/(rho c).
#include "thermal/circuit/shaft_fin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrate/integrator.h"
#include "machine/heat/heated_model.h"
#include "thermal/circuit/thermal_network.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
constexpr double k = 46., rho_c = 7800. * 470., d = 70e-3, h = 50., ambient = 293.15;

FinBar bar(double length, double diameter) { return {length, 0.25 * pi * diameter * diameter, pi * diameter}; }
FinPiece piece(double length) { return {{bar(length, d)}}; }

std::vector<FinNode> fin(double length, double convection) {
  std::vector<FinPiece> pieces;
  for (const double l : fin_lengths(length, 0.15 * d)) pieces.push_back(piece(l));
  return fin_nodes("right", pieces, 0., convection, k, rho_c);
}

/// Conductance of the chain from its root to ambient.
double steady_conductance(const std::vector<FinNode>& nodes) {
  double G = 0.;
  for (std::size_t i = nodes.size(); i-- > 0;) G = 1. / (nodes[i].resistance + 1. / (1. / nodes[i].to_ambient + G));
  return G;
}

TEST(ShaftFin, ConductsWhatTheClosedFormSays) {
  for (const double L : {0.01, 0.1, 0.4}) {
    const double A = 0.25 * pi * d * d, p = pi * d, m = std::sqrt(h * p / (k * A));
    EXPECT_NEAR(steady_conductance(fin(L, h)) / (std::sqrt(h * p * k * A) * std::tanh(m * L)), 1., 1e-12) << L;
  }
  double sum = 0.;
  for (const auto& node : fin(0.4, h)) sum += node.capacity;
  EXPECT_NEAR(sum, rho_c * 0.25 * pi * d * d * 0.4, 1e-9) << "J/K, whole";
}

TEST(ShaftFin, ConductsOverStepsOfDiameterAsItsBarsDo) {
  // A neck, a collar and a long rest, in one piece and one by one: the same steady heat, by bars that are put in front of each other.
  const std::vector<FinBar> bars = {bar(0.02, 30e-3), bar(0.015, 110e-3), bar(0.25, 70e-3)};
  double G = 0.;  // of what lies behind
  for (std::size_t i = bars.size(); i-- > 0;) {
    const double s = std::sqrt(h * bars[i].perimeter * k * bars[i].section);
    const double tangent = std::tanh(bars[i].length * std::sqrt(h * bars[i].perimeter / (k * bars[i].section)));
    G = (G + s * tangent) / (1. + G * tangent / s);  // Carslaw & Jaeger: a bar with a load at its end
  }
  const auto one_by_one = fin_nodes("right", {{{bars[0]}}, {{bars[1]}}, {{bars[2]}}}, 0., h, k, rho_c);
  const auto together = fin_nodes("right", {{bars}}, 0., h, k, rho_c);
  ASSERT_EQ(together.size(), 1u);
  EXPECT_NEAR(steady_conductance(one_by_one) / G, 1., 1e-12);
  EXPECT_NEAR(steady_conductance(together) / G, 1., 1e-12);
  double volume = 0.;
  for (const auto& one : bars) volume += one.section * one.length;
  EXPECT_NEAR(together[0].capacity, rho_c * volume, 1e-9) << "J/K";
  // Under a mean section instead, the neck would hardly count.
  const auto mean = fin_nodes("right", {{{{0.285, volume / 0.285, pi * d}}}}, 0., h, k, rho_c);
  EXPECT_GT(steady_conductance(mean) / G, 1.2);
}

TEST(ShaftFin, TakesHeatInTimeLikeAHalfSpace) {
  // A root of so large a capacity that it stays at 1 K over ambient.
  ThermalNetworkData net;
  net.ambient = ambient;
  net.nodes = {{"root", 1e12, ""}};
  const auto nodes = fin(0.6, 1e-9);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    net.nodes.push_back({nodes[i].name, nodes[i].capacity, ""});
    net.resistors.push_back({nodes[i].is_first ? "root" : nodes[i - 1].name, nodes[i].name, nodes[i].resistance});
  }
  net.places = {{"root", "root", "root", "root"}};
  const ThermalNetwork model(net);
  HeatedModel system(model, 1, 0);
  for (const double t : {10., 30., 300.}) {
    std::vector<double> y(system.layout().size());
    system.initial_state(y);
    y[0] += 1.;
    const double before = model.stored_energy(std::span(y).first(y.size() - 1));
    const auto integrator = make_stiff_integrator(system, 1e-9, 0., y, t);
    while (integrator->time() < t) integrator->advance();
    double stored = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i) stored += nodes[i].capacity * (integrator->state()[i + 1] - ambient);
    const double D = k / rho_c, exact = 2. * k * 0.25 * pi * d * d * std::sqrt(t / (pi * D));
    printf("%5.0f s: fin took %.2f J, half space %.2f J\n", t, stored, exact);
    EXPECT_GT(before, 0.);
    // The first piece is 10.5 mm long, which heat crosses in 9 s; the few pieces then follow to some per cent.
    EXPECT_NEAR(stored / exact, 1., t < 20. ? 0.12 : 0.08);
    EXPECT_LT(stored, exact);
  }
}

}  // namespace
}  // namespace rotordrop
