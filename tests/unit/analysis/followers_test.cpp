// Thermal models behind a drop: its motion is that without them, to the bit, and they agree with what integrates them along.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../../verification/machine/test_machines.h"
#include "../thermal/two_lumps.h"
#include "analysis/drop.h"
#include "machine/heat/followers.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

enum class Second { none, integrated, follows };

/// Two lumps a bearing that settle within 0.2 ms, some steps; inner ring and rest are linked while rotor and ring touch.
std::unique_ptr<ThermalModel> fast_sections(double ambient) {
  std::vector<ReducedSection> sections;
  for (const char* name : {"TB1", "TB2"}) {
    auto section = two_lumps(5000. * 21.);
    section.name = name;
    section.heat.loss = {50., 0.};  // [W/K]
    section.heat.rate[0] = 0.5;
    section.contact_link = {.touching = 0.01, .apart = 10.};
    sections.push_back(std::move(section));
  }
  return std::make_unique<ReducedSections>(std::move(sections), ambient);
}

/// The reference case with its circuit, which drives, and a second model. @param longest_step  of one that follows [s]
Example machine_with(Second second, std::vector<std::string> overrides = {}, double longest_step = 0.) {
  overrides.emplace_back("run.end_time=24 ms");
  Example e{read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", overrides), nullptr};
  Machine::Parts parts = machine_parts(e.settings.parameters, e.settings.tree);
  if (second != Second::none)
    parts.thermal.push_back({"second", "/second/", fast_sections(e.settings.parameters.run.ambient), false,
                             second == Second::follows, longest_step});
  e.machine = std::make_unique<Machine>(std::move(parts));
  return e;
}

Drop drop_of(const Example& e) {
  const auto& p = e.settings.parameters;
  return {*e, p, p.integration, p.output};
}

/// The largest absolute value of a scalar in the rows, and its last.
class Watch final : public RowSink {
 public:
  Watch(const Machine& machine, const std::string& path) : at_(machine.n_step()) {
    for (const auto& o : machine.state_observables()) {
      if (o.name == path) return;
      at_ += o.size;
    }
    throw std::out_of_range(path);
  }
  void row(double, std::span<const double> values) override {
    last = values[at_];
    largest = std::max(largest, std::fabs(last));
    ++n_rows;
  }
  double largest = 0, last = 0;
  int n_rows = 0;

 private:
  std::size_t at_;
};

TEST(Followers, LeaveTheMotionAsItIsWithoutThem) {
  for (const std::string method : {"tsitouras", "dormand-prince", "runge-kutta-4", "adams"}) {
    const auto without = machine_with(Second::none, {"integration.method=" + method});
    const auto with = machine_with(Second::follows, {"integration.method=" + method}, 50e-6);
    Drop a = drop_of(without), b = drop_of(with);
    a.run();
    b.run();
    const auto y_a = a.result().state, y_b = b.result().state;
    ASSERT_EQ(with->integrated_layout().size(), y_a.size());
    ASSERT_EQ(y_b.size(), y_a.size() + 1 + 4) << "heat lost, and two modes a bearing";
    EXPECT_TRUE(std::equal(y_a.begin(), y_a.end(), y_b.begin())) << method;
    EXPECT_EQ(a.result().statistics.steps, b.result().statistics.steps) << method;
  }
}

TEST(Followers, AgreeWithTheStateVector) {
  // Even power within a step: an error of second order. What the link carries, of first order, is little beside what is conducted.
  double last = 0.;
  for (const std::string step : {"8 us", "4 us", "2 us"}) {
    const std::vector<std::string> settings = {"integration.method=runge-kutta-4", "integration.step=" + step};
    const auto integrated = machine_with(Second::integrated, settings),
               follows = machine_with(Second::follows, settings);
    Drop a = drop_of(integrated), b = drop_of(follows);
    Watch ring_a(*integrated, "/second/TB1/inner_ring"), ring_b(*follows, "/second/TB1/inner_ring");
    a.rows().add(ring_a);
    b.rows().add(ring_b);
    a.run();
    b.run();
    const double rise = ring_a.last - 293.15, error = std::fabs(ring_b.last - ring_a.last);
    EXPECT_GT(rise, 0.5) << "K";
    EXPECT_LT(error, 1e-6 * rise) << "K, " << step;
    if (last > 0.) {
      EXPECT_GT(last / error, 3.) << step;
    }
    last = error;
  }
}

TEST(Followers, GatherStepsOfTheMotion) {
  // Steps of 2 us, gathered to 8, 16 and 32 us: an error of second order in that length, whatever the rows ask for in between.
  const std::vector<std::string> settings = {"integration.method=runge-kutta-4", "integration.step=2 us"};
  const auto integrated = machine_with(Second::integrated, settings);
  Drop reference = drop_of(integrated);
  Watch ring(*integrated, "/second/TB1/inner_ring");
  reference.rows().add(ring);
  reference.run();
  double last = 0.;
  for (const double longest_step : {32e-6, 16e-6, 8e-6}) {
    const auto follows = machine_with(Second::follows, settings, longest_step);
    Drop with_rows = drop_of(follows), without = drop_of(follows);
    Watch watched(*follows, "/second/TB1/inner_ring");
    with_rows.rows().add(watched);
    with_rows.run();
    without.run();
    EXPECT_EQ(with_rows.result().state, without.result().state) << "rows look, and change nothing";
    const double error = std::fabs(watched.last - ring.last);
    EXPECT_LT(error, 1e-5 * (ring.last - 293.15)) << "K, " << longest_step;
    if (last > 0.) {
      EXPECT_GT(last / error, 3.) << longest_step;
    }
    last = error;
  }
}

TEST(Followers, StepNoLongerThanTheyMay) {
  const auto machine = machine_with(Second::follows, {}, 50e-6);
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  Evaluation found;
  machine->evaluate(0., y, found);
  Followers followers(*machine);
  followers.begin(0., y, found);
  followers.follow(0., 20e-6, y, found);
  EXPECT_EQ(followers.time(), 0.) << "another 20 us fit";
  followers.follow(20e-6, 40e-6, y, found);
  EXPECT_EQ(followers.time(), 40e-6) << "and here they do not";
  followers.follow(40e-6, 100e-6, y, found);
  EXPECT_EQ(followers.time(), 100e-6) << "a step of the motion is the least";
}

TEST(Followers, FindEveryJouleInEveryRow) {
  for (const std::string method : {"tsitouras", "adams"}) {
    const auto machine =
        machine_with(Second::follows, {"integration.method=" + method, "output.longest_interval=50 us"}, 50e-6);
    Drop drop = drop_of(machine);
    Watch residual(*machine, "/energy/second_heat_residual"), lost(*machine, "/energy/second_heat_lost"),
        ledger(*machine, "/ledger/second_heat_lost"), stored(*machine, "/energy/second_heat_stored");
    for (Watch* watch : {&residual, &lost, &ledger, &stored}) drop.rows().add(*watch);
    drop.run();
    EXPECT_GT(residual.n_rows, 480) << "most of them within a step";
    EXPECT_GT(stored.last, 50.) << "J";
    EXPECT_GT(lost.last, 0.1) << "J";
    EXPECT_EQ(lost.last, ledger.last);
    EXPECT_LT(residual.largest, 1e-8) << "J: roundoff of 200 J/K at 293 K, over a thousand steps";
  }
}

TEST(Followers, GoOnFromPackedValuesToTheSameBits) {
  const std::vector<std::string> settings = {"integration.method=runge-kutta-4", "integration.step=10 us"};
  const auto machine = machine_with(Second::follows, settings, 50e-6);
  Drop whole = drop_of(machine), first = drop_of(machine), second = drop_of(machine);
  whole.run();
  first.run([&] { return first.loop().time() >= 12.02e-3; });  // amid a step of theirs
  PackedValues packed;
  first.loop().pack(packed);
  second.loop().unpack(first.loop().time(), first.loop().state(), packed);
  second.run();
  EXPECT_EQ(second.result().state, whole.result().state);
}

/// Packs a drop while it shows some of its steps.
class PackingWhileShown final : public Observer {
 public:
  PackingWhileShown(Drop& drop, const Machine& machine) : drop_(drop), state_(machine.layout().size()) {}
  struct Packed {
    double time;
    std::vector<double> state;
    PackedValues values;
  };
  std::vector<Packed> packed;
  void step(const Step& step) override {
    if (step.time < 12e-3 || packed.size() == 12) return;
    step.interpolate(step.time, state_);
    packed.push_back({step.time, state_, {}});
    drop_.loop().pack(packed.back().values);
  }

 private:
  Drop& drop_;
  std::vector<double> state_;
};

TEST(Followers, GoOnFromStepsThatWereShown) {
  const auto machine = machine_with(
      Second::follows, {"integration.method=runge-kutta-4", "integration.step=10 us", "run.end_time=13 ms"}, 50e-6);
  Drop whole = drop_of(machine);
  PackingWhileShown packing(whole, *machine);
  whole.loop().add(packing);
  whole.run();
  ASSERT_EQ(packing.packed.size(), 12U) << "more than two steps of theirs";
  for (const auto& packed : packing.packed) {
    Drop second = drop_of(machine);
    second.loop().unpack(packed.time, packed.state, packed.values);
    second.run();
    EXPECT_EQ(second.result().state, whole.result().state) << packed.time;
  }
}

TEST(Followers, StayWhereTheyAreInAStepOfNoLength) {
  const auto machine = machine_with(Second::follows);
  std::vector<double> before(machine->layout().size());
  machine->initial_state(before);
  before.back() = 300.;
  auto y = before;
  y.back() = 0.;
  Evaluation found;
  machine->evaluate(0., before, found);
  Followers followers(*machine);
  followers.begin(0., before, found);
  followers.fill(0., y);
  EXPECT_EQ(y, before);
}

TEST(Followers, AreNoModelsThatOthersDependOn) {
  const auto refused = [](auto&& change) {
    const Case c = read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", {});
    Machine::Parts parts = machine_parts(c.parameters, c.tree);
    parts.thermal.push_back({"second", "/second/", fast_sections(c.parameters.run.ambient), false, true});
    change(parts);
    EXPECT_THROW(Machine(std::move(parts)), std::invalid_argument);
  };
  refused([](Machine::Parts& parts) { parts.driver = 1; });
  refused([](Machine::Parts& parts) { parts.friction_temperatures = {1, {0, 2}}; });
  refused([](Machine::Parts& parts) { parts.thermal[0].follows = true; });
}

}  // namespace
}  // namespace rotordrop
