// Finite elements in a drop: three ways to couple them, one result; and the same heat as the lumped circuit's.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "../machine/test_machines.h"
#include "analysis/drop_loop.h"
#include "drops.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

TEST(Couplings, BothModelsReceiveTheSameJoules) {
  // What a model stores and loses in a second is what it receives. At ambient, where nothing is lost by any of them.
  auto drop = settling_drop({"thermal.models=[\"lumped\", \"fe\"]", "thermal.fe.coupling=monolithic",
                             "thermal.fe.section=plain", "thermal.fe.degree=1", "thermal.fe.refinement=0.25"});
  const Machine& machine = *drop->machine;
  ASSERT_EQ(machine.n_thermal_models(), 2u);
  std::mt19937 random(7);
  for (const bool in_contact : {true, false}) {
    auto y = random_state(machine, random, in_contact);
    std::vector<double> cold(y.size());
    machine.initial_state(cold);
    for (const char* block : {"temperature", "fe temperature"}) {
      const auto& b = machine.layout().block(block);
      std::copy_n(cold.begin() + static_cast<std::ptrdiff_t>(b.offset), b.size,
                  y.begin() + static_cast<std::ptrdiff_t>(b.offset));
    }
    std::vector<double> rates(y.size());
    machine.rhs(0., y, rates);
    double given = 0.;
    for (const char* name : {"TB1 ledger/rub heat", "TB1 ledger/inner heat", "TB1 ledger/outer heat",
                             "TB2 ledger/rub heat", "TB2 ledger/inner heat", "TB2 ledger/outer heat"})
      given += rates[entry(machine, name)];
    // Stored energy is linear in the temperatures: rates put on top of ambient give it per second.
    auto warmer = y;
    for (const char* block : {"temperature", "fe temperature"}) {
      const auto& b = machine.layout().block(block);
      for (std::size_t i = b.offset; i < b.offset + b.size; ++i) warmer[i] += rates[i];
    }
    const auto before = machine.energy_balance(0., y), after = machine.energy_balance(0., warmer);
    ASSERT_GT(given, 1.) << "W";
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(after.heat[k].stored - before.heat[k].stored, given, 1e-12 * given) << machine.thermal_name(k);
  }
}

TEST(Couplings, AllThreeGiveTheSameGrowth) {
  // The first impact heats the bore before a window knows: what the link to the shaft carries then is wrong for one window. Over 0.18 um of
  // growth at 20 ms that shows more than over the 1.3 um of a whole drop; windows are short here.
  const auto monolithic = run(small_mesh({"thermal.fe.coupling=monolithic"}), "monolithic");
  const auto reduced = run(small_mesh({"thermal.fe.coupling=reduced"}), "reduced");
  const auto windowed =
      run(small_mesh({"thermal.fe.coupling=windowed", "thermal.fe.longest_window=0.25 ms"}), "windowed");
  EXPECT_LT(difference(monolithic, reduced), 1e-3);
  EXPECT_LT(difference(monolithic, windowed), 1e-3);
  ASSERT_TRUE(windowed.result.windows);
  EXPECT_GE(windowed.result.windows->windows, 80) << "of 0.25 ms at most";
  EXPECT_LT(windowed.result.windows->largest_error, 1e-3 * windowed.result.windows->largest_growth);
}

TEST(Couplings, WindowsShowTheBoreWithinAnImpact) {
  // Lines between windows' ends against the modes' record every 50 us. A window that begins before the impact ends within some 0.1 ms of it.
  const auto windowed = run(small_mesh({"thermal.fe.coupling=windowed"}), "bore-windowed");
  const auto reduced = run(small_mesh({}), "bore-reduced");
  double different = 0., highest = 0.;
  std::size_t at = 1;
  for (std::size_t i = 0; i < reduced.bore.size(); ++i) {
    const double t = reduced.bore_times[i];
    if (t < windowed.bore_times[0]) continue;
    while (at + 1 < windowed.bore.size() && windowed.bore_times[at] < t) ++at;
    const double t0 = windowed.bore_times[at - 1], t1 = windowed.bore_times[at];
    const double share = std::min(1., (t - t0) / (t1 - t0));
    const double line = (1. - share) * windowed.bore[at - 1] + share * windowed.bore[at];
    different = std::max(different, std::fabs(line - reduced.bore[i]));
    highest = std::max(highest, reduced.bore[i] - reduced.bore[0]);
  }
  EXPECT_GT(highest, 1.) << "K";
  EXPECT_LT(different, 0.06 * highest) << "K: of " << highest << " K";
  std::printf("bore in windows: %.2g K off of %.3g K; %ld windows\n", different, highest,
              windowed.result.windows->windows);
}

/// From every millisecond on, inner raceways grow at another rate: as windows of finite elements have it, much faster.
class TurnsGrowth final : public Observer {
 public:
  explicit TurnsGrowth(GrowthHistory& growth) : growth_(growth) {}
  void step(const Step& step) override {
    if (!step.is_observed || step.time < next_) return;
    next_ += 1e-3;
    ++n_turns;
    std::vector<Expansion> now(2);
    growth_.at(step.time, now);
    growth_.cut(step.time);
    growth_.append(step.time, now);
    for (Expansion& e : now) e.inner_race += (n_turns % 2 == 1 ? speed : -speed);
    growth_.append(step.time + 1., now);
  }
  static constexpr double speed = 1e-3;  // [m/s]
  int n_turns = 0;

 private:
  GrowthHistory& growth_;
  double next_ = 10e-3;
};

// With the rates before each turn taken for the first stage after it, the balance would be off by 4.6e-6 to 9.6e-6 J.
TEST(Couplings, GrowthThatTurnsDoesItsWorkAtOnce) {
  for (const char* method :
       {"tsitouras", "sofroniou-spaletta", "bogacki-shampine", "two-step-runge-kutta", "runge-kutta-4"}) {
    const auto drop =
        settling_drop(small_mesh({"thermal.fe.coupling=windowed", std::string("integration.method=") + method,
                                  "integration.tolerance=1e-8", "integration.step=5 us"}));
    const auto& p = drop->settings.parameters;
    GrowthHistory growth(2);
    growth.append(0., std::vector<Expansion>(2));
    DropLoop loop(*drop->machine, p.integration, p.run, &growth);
    TurnsGrowth turns(growth);
    loop.add(turns);
    loop.run();
    EXPECT_EQ(turns.n_turns, 10);
    const auto e = drop->machine->energy_balance(loop.time(), loop.state(), &growth);
    EXPECT_GT(std::fabs(e.growth_work), 1e-3) << "J: it does some";
    // Classical Runge-Kutta has 3e-7 J without turns, too; two-step-runge-kutta keeps the rate at the start of the step before.
    EXPECT_NEAR(e.residual, 0., 1e-6) << "J, " << method;
  }
}

TEST(Couplings, WindowsAccountForTheirHeat) {
  const auto windowed = run(small_mesh({"thermal.fe.coupling=windowed"}), "energy");
  double given = 0.;
  auto drop = settling_drop(small_mesh({"thermal.fe.coupling=windowed"}));
  for (std::size_t place = 0; place < 2; ++place) {
    const auto e = drop->machine->heat_given(place, windowed.result.state);
    given += e.rub + e.inner + e.outer;
  }
  const auto& energy = windowed.result.windows_energy;
  EXPECT_NEAR(energy.input, given, 1e-10 * given) << "J: the ledgers' joules, whatever the windows";
  EXPECT_NEAR(energy.residual(), 0., 1e-9 * given);
}

TEST(Couplings, TheErrorOfWindowsFollowsTheirTolerance) {
  const auto coarse = run(small_mesh({"thermal.fe.coupling=windowed", "thermal.fe.window_tolerance=5 nm"}), "coarse");
  const auto fine = run(small_mesh({"thermal.fe.coupling=windowed", "thermal.fe.window_tolerance=0.01 nm"}), "fine");
  EXPECT_GT(fine.result.windows->windows, coarse.result.windows->windows);
  EXPECT_LT(fine.result.windows->largest_error, coarse.result.windows->largest_error);
}

TEST(Couplings, WithAMeshedShaftTheyAgreeToo) {
  const auto reduced = run(small_mesh({"thermal.fe.shaft=bearing"}), "shaft-reduced");
  const auto monolithic = run(small_mesh({"thermal.fe.shaft=bearing", "thermal.fe.coupling=monolithic"}), "shaft");
  EXPECT_LT(difference(monolithic, reduced), 1e-3);
}

TEST(Couplings, WithAShaftBeyondTheBearingTheyAgreeToo) {
  const auto reduced = run(small_mesh({"thermal.fe.shaft=beyond"}), "beyond-reduced");
  const auto windowed = run(small_mesh({"thermal.fe.shaft=beyond", "thermal.fe.coupling=windowed"}), "beyond-windowed");
  EXPECT_LT(difference(windowed, reduced), 5e-3) << "thermal.fe.response_tolerance";
}

TEST(GroovedSection, HasTheVolumeOfItsRings) {
  // Elements of degree 2 take arcs as parabolas: 5e-6 of the volume at most with sides of up to 15 degrees of arc.
  auto drop = settling_drop({"thermal.models=[\"fe\"]"});
  for (const auto& section : drop->elements.sections) {
    const auto* b = [&]() -> const TouchdownParameters* {
      for (const auto& entry : drop->settings.parameters.bearings)
        if (entry.name == section.name) return entry.touchdown();
      return nullptr;
    }();
    ASSERT_NE(b, nullptr);
    const SectionMesh& mesh = section.problem.mesh;
    // The same integral, 2 pi r dA, around each body's outline: Green's theorem, -pi r^2 dx, with arcs integrated as arcs.
    for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
      double volume = 0.;
      for (const auto& cell : mesh.cells) {
        if (cell.body != body) continue;
        for (std::size_t i = 0; i < 4; ++i) {
          const unsigned int from = cell.vertices[i], to = cell.vertices[(i + 1) % 4];
          const auto [x0, r0] = mesh.vertices[from];
          const auto [x1, r1] = mesh.vertices[to];
          volume -= M_PI * (x1 - x0) * (r0 * r0 + r0 * r1 + r1 * r1) / 3.;
          for (const auto& edge : mesh.edges) {
            const bool is_it = (edge.vertices[0] == from && edge.vertices[1] == to) ||
                               (edge.vertices[0] == to && edge.vertices[1] == from);
            if (!is_it || edge.arc < 0) continue;
            // From the chord to the arc: the segment between them, at its centroid.
            const auto& arc = mesh.arcs[static_cast<std::size_t>(edge.arc)];
            const double phi =
                std::remainder(std::atan2(r1 - arc.r, x1 - arc.x) - std::atan2(r0 - arc.r, x0 - arc.x), 2. * M_PI);
            const double area = 0.5 * arc.radius * arc.radius * (phi - std::sin(phi));  // positive: counterclockwise
            const double half = 0.5 * std::fabs(phi);
            const double from_centre =
                4. * arc.radius * std::pow(std::sin(half), 3) / (3. * (2. * half - std::sin(2. * half)));
            const double mx = 0.5 * (x0 + x1) - arc.x, mr = 0.5 * (r0 + r1) - arc.r, m = std::hypot(mx, mr);
            volume += 2. * M_PI * (arc.r + from_centre * mr / m) * area;
          }
        }
      }
      const auto& material = section.problem.bodies[body];
      const double capacity = volume * material.density * material.heat_capacity.value(293.15);
      EXPECT_NEAR(section.solver->body_capacity(body), capacity, 1e-5 * capacity)
          << section.name << ", " << mesh.bodies[body];
    }
  }
}

}  // namespace
}  // namespace rotordrop
