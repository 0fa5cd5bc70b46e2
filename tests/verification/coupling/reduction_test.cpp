// The sections of the reference case on their default modes, against the same meshes stepped in time (a method of order 4 under error control).
// Heat is constant in pieces, so that the modes' states are exact: z(t + h) = z exp(-r h) + in q (1 - exp(-r h))/r.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "drops.h"
#include "thermal/heating/bearing_heat.h"

namespace rotordrop::testing {
namespace {

using PortHeat = std::array<double, n_bearing_ports>;

class Modes {
 public:
  explicit Modes(const ReducedHeat& heat) : heat_(heat), z_(heat.n_modes()) {}
  void advance(double h, const PortHeat& watts) {
    for (std::size_t i = 0; i < z_.size(); ++i) {
      double q = 0.;
      for (std::size_t p = 0; p < watts.size(); ++p) q += heat_.ports[p].shape[i] / heat_.capacity * watts[p];
      const double r = heat_.rate[i], x = r * h;
      z_[i] = z_[i] * std::exp(-x) + q * (x < 1e-8 ? h * (1. - 0.5 * x) : -std::expm1(-x) / r);
    }
  }
  [[nodiscard]] double rise(const ReducedHeat::Output& output) const {
    double sum = 0.;
    for (std::size_t i = 0; i < z_.size(); ++i) sum += output.shape[i] * z_[i];
    return sum;
  }

 private:
  const ReducedHeat& heat_;
  std::vector<double> z_;
};

TEST(ReducedSection, MeansFollowTheMeshForMinutes) {
  auto drop = settling_drop({"thermal.models=[\"fe\"]"});
  // 0.3 s of rub and 110 W inside the bearing, which stay on.
  PortHeat rub{}, running{};
  running[inner_raceway_port] = 50.;
  running[outer_raceway_port] = 60.;
  rub = running;
  rub[bore_port] = 660.;
  rub[shaft_port] = 340.;
  for (auto& section : drop->elements.sections) {
    ASSERT_LE(section.reduced.response_error, 0.005);
    const double zero = section.problem.initial_temperature;
    Modes modes(section.reduced);
    auto& mesh = *section.solver;
    mesh.set_port_heat(rub);
    double at = 0.;
    for (const double t : {0.3, 10., 300.}) {
      mesh.advance_to(t);
      modes.advance(t - at, at == 0. ? rub : running);
      if (at == 0.) mesh.set_port_heat(running);
      at = t;
      double warmest = 0.;
      for (std::size_t b = 0; b < section.problem.bodies.size(); ++b)
        warmest = std::max(warmest, mesh.body_mean(b) - zero);
      for (std::size_t b = 0; b < section.problem.bodies.size(); ++b) {
        const double rise = mesh.body_mean(b) - zero;
        EXPECT_NEAR(modes.rise(section.reduced.bodies[b]), rise, 0.005 * (rise + 1e-3 * warmest))
            << "K, mean of " << section.problem.bodies[b].name << " of " << section.name << " at " << t << " s";
      }
      for (const auto port : {ball_port, shaft_port}) {
        const double rise = mesh.port_temperature(port) - zero;
        EXPECT_NEAR(modes.rise(section.reduced.nodes[*section.problem.ports[port].node]), rise,
                    0.005 * (rise + 1e-3 * warmest))
            << "K, " << section.problem.ports[port].name << " of " << section.name << " at " << t << " s";
      }
    }
  }
}

TEST(ReducedSection, IsRefusedIfTooFewModesAreAllowed) {
  try {
    settling_drop({"thermal.models=[\"fe\"]", "thermal.fe.modes=20"});
    FAIL() << "20 modes were taken";
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("the section of TB1 on "), std::string::npos) << words;
    EXPECT_NE(words.find("thermal.fe.response_tolerance = 0.005 allows 0.5 %"), std::string::npos) << words;
    EXPECT_NE(words.find("thermal.fe.modes = 20"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace rotordrop::testing
