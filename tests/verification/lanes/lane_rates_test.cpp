// Right-hand sides in lanes against those of one drop: the formulas are the same, so they must agree to rounding, and a lane's must not depend on its
// place or its neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../machine/test_machines.h"
#include "base/aligned_numbers.h"
#include "machine/lanes/machine_lanes.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
constexpr std::size_t width = LaneSystem::width;

struct Columns {
  std::vector<double> rates, step, details;
  bool operator==(const Columns&) const = default;
};

/// Of a ball: its groove centres lie some 10 mm apart, known to 2e-18 m, and its load Q = K delta^(3/2) has the stiffness 1.5 K^(2/3) Q^(1/3) with K of 1e10 N/m^(3/2).
double roundoff_of_load(double load) { return 1e-14 + 1.5 * std::cbrt(1e20 * load) * 2e-18; }

/// Rounding of sums of some sixty balls and of powers good to two units in the last place, over the largest value of the same kind.
/// @param roundoff  of a value itself
void expect_close(
    const std::vector<double>& lanes, const std::vector<double>& one, const char* what,
    double (*roundoff)(double) = [](double) { return 1e-14; }) {
  ASSERT_EQ(lanes.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double neighbour =
        std::max(i > 0 ? std::fabs(one[i - 1]) : 0., i + 1 < one.size() ? std::fabs(one[i + 1]) : 0.);
    EXPECT_NEAR(lanes[i], one[i], 1e-11 * std::max(std::fabs(one[i]), neighbour) + roundoff(std::fabs(one[i])))
        << what << " " << i;
  }
}

/// Details of a kind: loads on outer races, or all others.
std::vector<double> details_of(const Machine& machine, const std::vector<double>& details, bool on_outer_race) {
  std::vector<double> some;
  std::size_t at = 0;
  for (const Observable& o : machine.detail_observables()) {
    const auto first = details.begin() + static_cast<std::ptrdiff_t>(at);
    if (o.name.ends_with("/outer_ball_loads") == on_outer_race)
      some.insert(some.end(), first, first + static_cast<std::ptrdiff_t>(o.size));
    at += o.size;
  }
  return some;
}

/// Drops side by side at states of their own.
class Lanes {
 public:
  explicit Lanes(std::vector<const Machine*> machines)
      : machines_(std::move(machines)), system_(make_lanes(machines_)) {}
  /// @param states  of each machine
  std::vector<Columns> evaluate(const std::vector<std::vector<double>>& states) {
    const Machine& form = *machines_.front();
    const std::size_t n = form.layout().size();
    std::vector<double> t(width, 0.01), step(form.n_step() * width), details(form.n_details() * width);
    AlignedNumbers y(n * width), dydt(n * width), again(n * width);
    for (std::size_t l = 0; l < width; ++l)
      for (std::size_t i = 0; i < n; ++i) y[i * width + l] = states[l < states.size() ? l : 0][i];
    system_->observe(t, y, dydt, step, details);
    system_->rates(t, y, again);
    for (std::size_t i = 0; i < dydt.size(); ++i)
      if (std::isfinite(dydt[i])) {
        EXPECT_NEAR(dydt[i], again[i], 1e-11 * std::fabs(dydt[i]) + 1e-12) << "observed and not";
      }
    std::vector<Columns> all(machines_.size());
    for (std::size_t l = 0; l < all.size(); ++l) {
      const auto column = [l](std::span<const double> from) {
        std::vector<double> to;
        for (std::size_t i = l; i < from.size(); i += width) to.push_back(from[i]);
        return to;
      };
      all[l] = {column(dydt), column(step), column(details)};
    }
    return all;
  }

 private:
  std::vector<const Machine*> machines_;
  std::unique_ptr<LaneSystem> system_;
};

Columns alone(const Machine& machine, const std::vector<double>& y) {
  Evaluation found;
  found.wants_step = found.wants_details = true;
  machine.evaluate(0.01, y, found);
  return {found.rates, found.step, found.details};
}

/// Machines alike: each has its own friction, gap, stiffness, damping, unbalance and materials, and its number for every # of what they have in common.
std::vector<Example> machines(const std::vector<std::string>& common, std::size_t n = width) {
  std::vector<Example> list;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = static_cast<double>(k);
    auto set = common;
    for (auto& setting : set) std::replace(setting.begin(), setting.end(), '#', static_cast<char>('0' + k));
    set.push_back("contact.friction_coefficient=" + std::to_string(0.05 + 0.02 * x));
    set.push_back("contact.air_gap=" + std::to_string(2.2e-4 + 1e-5 * x));
    set.push_back("bearings.TB1.contact_stiffness=" + std::to_string(1e9 + 1e8 * x));
    set.push_back("bearings.TB2.support.C_y=" + std::to_string(2e3 + 500. * x));
    set.push_back("bearings.TB2.preload=" + std::to_string(200. + 40. * x));
    set.push_back("rotor.mass_proportional_alpha=" + std::to_string(5. * x));
    set.push_back("rotor.unbalance[0].me=" + std::to_string(1e-6 * (1. + x)));
    set.push_back("thermal.share_to_ring=" + std::to_string(0.5 + 0.05 * x));
    set.push_back("materials.steel.k=" + std::to_string(40. + 5. * x));
    list.push_back(reference_machine(set));
  }
  return list;
}

std::vector<const Machine*> pointers(const std::vector<Example>& list) {
  std::vector<const Machine*> of;
  for (const auto& e : list) of.push_back(e.machine.get());
  return of;
}

class LaneRates : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(LaneRates, AreThoseOfOneDrop) {
  const auto list = machines(GetParam());
  for (const auto& e : list) ASSERT_EQ(why_not_in_lanes(*e), "");
  Lanes lanes(pointers(list));
  std::mt19937 random(5);
  for (int turn = 0; turn < 20; ++turn) {
    std::vector<std::vector<double>> states;
    for (std::size_t l = 0; l < width; ++l) states.push_back(random_state(*list[l], random, (turn + l) % 3 != 0));
    const auto found = lanes.evaluate(states);
    for (std::size_t l = 0; l < width; ++l) {
      const Columns one = alone(*list[l], states[l]);
      expect_close(found[l].rates, one.rates, "rate");
      expect_close(found[l].step, one.step, "observed value");
      expect_close(details_of(*list[l], found[l].details, false), details_of(*list[l], one.details, false), "detail",
                   roundoff_of_load);
      const auto in_lanes = details_of(*list[l], found[l].details, true),
                 outer = details_of(*list[l], one.details, true);
      // Each ball's balance is found to 2e-5 before the last step (row/inertial_newton.h), which squares that.
      for (std::size_t i = 0; i < outer.size(); ++i) EXPECT_NEAR(in_lanes[i], outer[i], 4e-10 * outer[i]) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, LaneRates,
    ::testing::Values(
        std::vector<std::string>{},
        std::vector<std::string>{"bearings.load_law=equivalent", "thermal.contact_conduction=rolling"},
        std::vector<std::string>{"thermal.heat_share=jaeger", "thermal.growth_by_speed=closed-form",
                                 "thermal.expansion=formula"},
        std::vector<std::string>{"contact.static_friction_coefficient=0.3", "contact.stribeck_speed=0.5",
                                 "thermal.shaft_ring_link=in-contact"},
        std::vector<std::string>{"bearings.TB2.waviness=[{surface=\"inner\",order=14,amplitude=\"0.#2 um\"},"
                                 "{surface=\"outer\",order=15,amplitude=\"0.1 um\",phase=1.#}]"},
        std::vector<std::string>{"bearings.waviness=[{surface=\"bore\",order=3,amplitude=\"1.#5 um\",phase=0.#},"
                                 "{surface=\"bore\",order=1,amplitude=\"2 um\"}]"},
        std::vector<std::string>{"rotor.probes.seal={node=10,clearance=\"0.3 mm\"}"},
        std::vector<std::string>{"rotor.model=rigid", "bearings.internal_heat=ball-speed"},
        std::vector<std::string>{"bearings.ball_model=inertial"},
        std::vector<std::string>{"bearings.ball_model=inertial", "bearings.gyroscopic_split=equal",
                                 "thermal.contact_conduction=rolling",
                                 "bearings.TB2.waviness=[{surface=\"inner\",order=14,amplitude=\"0.#2 um\"},"
                                 "{surface=\"outer\",order=15,amplitude=\"0.1 um\",phase=1.#}]"}));

TEST(DropsInLanes, AskTheLawsOfTheirSupportsOneByOne) {
  std::vector<Example> list;
  for (int k = 0; k < 5; ++k)
    list.push_back(reference_machine({"bearings.TB1.support={type=\"ribbon\",mass=\"" + std::to_string(3 + k) +
                                          " kg\",ribbon={stiffness=\"4e7 N/m\",slip_force=\"2 kN\",stick_stiffness=\"" +
                                          std::to_string(3 + k) + "e8 N/m\"}}",
                                      "contact.friction_coefficient=" + std::to_string(0.1 + 0.02 * k)}));
  ASSERT_EQ(why_not_in_lanes(*list[0]), "");
  std::mt19937 random(3);
  Lanes lanes(pointers(list));
  for (int turn = 0; turn < 10; ++turn) {
    std::vector<std::vector<double>> states;
    for (const auto& e : list) {
      states.push_back(random_state(*e, random, turn % 2 == 0));
      const auto& block = e->layout().block("TB1");
      for (std::size_t i = TouchdownBearing::n_state; i < block.size; ++i)
        states.back()[block.offset + i] = 1e-6 * (turn - 4.);
    }
    const auto found = lanes.evaluate(states);
    for (std::size_t l = 0; l < list.size(); ++l) {
      const Columns one = alone(*list[l], states[l]);
      expect_close(found[l].rates, one.rates, "rate");
      expect_close(found[l].step, one.step, "observed value");
    }
  }
}

class LanesOfDrops : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(LanesOfDrops, DoNotSeeTheirNeighbours) {
  const auto list = machines(GetParam());
  const auto all = pointers(list);
  std::mt19937 random(7);
  std::vector<std::vector<double>> states;
  for (std::size_t l = 0; l < width; ++l) states.push_back(random_state(*list[l], random, l % 2 == 0));
  // One whose rings still stand: its balls have no forces of inertia.
  for (const char* name : {"TB1", "TB2"})
    states[5][list[5]->layout().block(name).offset + TouchdownBearing::ring_spin] = 0.;
  const auto together = Lanes(all).evaluate(states);
  for (const std::size_t l : {5, 6}) expect_close(together[l].rates, alone(*list[l], states[l]).rates, "rate");
  for (std::size_t l = 0; l < width; ++l) {
    EXPECT_EQ(Lanes({all[l]}).evaluate({states[l]})[0], together[l]) << "alone, from lane " << l;
    // As the last of three others.
    const std::size_t a = (l + 3) % width, b = (l + 5) % width;
    EXPECT_EQ(Lanes({all[a], all[b], all[l]}).evaluate({states[a], states[b], states[l]})[2], together[l]);
  }
  // A neighbour that is lost does not pull the others with it.
  states[2].assign(states[2].size(), std::nan(""));
  const auto beside_lost = Lanes(all).evaluate(states);
  for (std::size_t l = 0; l < width; ++l)
    if (l != 2) {
      EXPECT_EQ(beside_lost[l], together[l]);
    }
  EXPECT_FALSE(std::isfinite(beside_lost[2].rates[0]));
}

INSTANTIATE_TEST_SUITE_P(Cases, LanesOfDrops,
                         ::testing::Values(std::vector<std::string>{},
                                           std::vector<std::string>{"bearings.ball_model=inertial"}));

TEST(DropsInLanes, TellWhatDoesNotRunInThem) {
  EXPECT_EQ(why_not_in_lanes(*reference_machine()), "");
  const auto reason = [](const std::string& setting) { return why_not_in_lanes(*reference_machine({setting})); };
  EXPECT_EQ(reason("bearings.ball_model=inertial"), "");
  EXPECT_NE(reason("bearings.ring_motion=free").find("TB1"), std::string::npos);
  EXPECT_NE(reason("contact.friction_law=sticking"), "");
  EXPECT_FALSE(are_alike(*reference_machine(), *reference_machine({"bearings.TB2.balls_per_row=22"})));
  const auto with_waves = [](const std::string& waves) {
    return reference_machine({"bearings.TB1.waviness=[{amplitude=\"1 um\"," + waves + "}]"});
  };
  EXPECT_TRUE(are_alike(*with_waves("surface=\"bore\",order=3"), *with_waves("surface=\"bore\",order=3,phase=1")));
  EXPECT_FALSE(are_alike(*with_waves("surface=\"bore\",order=3"), *with_waves("surface=\"bore\",order=2")));
  EXPECT_FALSE(are_alike(*with_waves("surface=\"inner\",order=3"), *with_waves("surface=\"inner\",order=2")));
  EXPECT_FALSE(are_alike(*with_waves("surface=\"inner\",order=3"), *with_waves("surface=\"outer\",order=3")));
  EXPECT_FALSE(are_alike(*with_waves("surface=\"bore\",order=3"), *reference_machine()));
  EXPECT_FALSE(are_alike(*reference_machine(), *reference_machine({"rotor.cut_off_frequency=3 kHz"})));
  EXPECT_FALSE(are_alike(*reference_machine(), *reference_machine({"bearings.load_law=equivalent"})));
  EXPECT_FALSE(are_alike(*reference_machine(), *reference_machine({"thermal.heat_share=jaeger"})));
  EXPECT_FALSE(are_alike(*reference_machine(), *reference_machine({"bearings.ball_model=inertial"})));
  EXPECT_FALSE(are_alike(*reference_machine({"bearings.ball_model=inertial"}),
                         *reference_machine({"bearings.ball_model=inertial", "bearings.gyroscopic_split=equal"})));
}

}  // namespace
}  // namespace rotordrop
