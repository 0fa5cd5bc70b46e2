// Warnings of a run: what is counted is laid beside what an observer of its own sees, or beside sequences counted by hand.
#include "analysis/watch/run_guards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "../../verification/machine/test_machines.h"
#include "analysis/drop.h"
#include "base/errors.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

TEST(Exceedance, CountsTimesAboveItsLimitAndKeepsTheWorst) {
  Exceedance e;
  // Above 1 at 1, 2 and 3 ms, and again at 6 ms: twice, for 2 ms between instants that are both above, worst 5 at 2 ms. The limit itself is not beyond.
  const double values[] = {0., 2., 5., 4., 1., 0.5, 3.};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(e.follow(1e-3 * i, values[i], 1.), values[i] > 1.) << i;
  EXPECT_EQ(e.count, 2.);
  EXPECT_EQ(e.worst, 5.);
  EXPECT_EQ(e.time, 2e-3);
  EXPECT_EQ(e.first_time, 1e-3);
  EXPECT_NEAR(e.duration, 2e-3, 1e-15);
  EXPECT_FALSE(e.follow(8e-3, std::nan(""), 1.)) << "what is not known is not beyond";
  EXPECT_EQ(e.count, 2.);
}

TEST(WarningKinds, HaveCodesOfTheirOwn) {
  std::set<std::string> codes;
  for (const auto& kind : warning_kinds) EXPECT_TRUE(codes.insert(kind.code).second) << kind.code;
  EXPECT_EQ(find_warning_kind("energy-residual")->unit, std::string("1"));
  EXPECT_EQ(find_warning_kind("energy"), nullptr);
}

Drop drop_of(const Example& e) {
  const auto& p = e.settings.parameters;
  return {*e, p, p.integration, p.output};
}

const RunWarning* warning_of(const std::vector<RunWarning>& list, const std::string& code, const std::string& place) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& w) { return w.kind->code == code && w.place == place; });
  return found == list.end() ? nullptr : &*found;
}

/// Looks at one column of the step observables by itself.
class Column final : public Observer {
 public:
  Column(const Machine& machine, const std::string& name) {
    for (const auto& o : machine.step_observables()) {
      if (o.name == name) return;
      column_ += o.size;
    }
    throw std::out_of_range(name);
  }
  void step(const Step& step) override {
    if (!step.is_observed) return;
    times.push_back(step.time);
    values.push_back(step.found->step[column_]);
  }
  std::vector<double> times, values;

 private:
  std::size_t column_ = 0;
};

TEST(RunGuards, FindDeepPenetrationAsAnObserverSeesIt) {
  // Bore and rotor as soft as rubber: the rotor dips deeper than half its gap of 250 um.
  const auto machine = reference_machine(
      {"bearings.TB1.contact_stiffness=5e6", "bearings.TB2.contact_stiffness=5e6", "run.end_time=30 ms"});
  Drop drop = drop_of(machine);
  Column penetration(*machine, "/bearings/TB1/penetration");
  drop.loop().add(penetration);
  drop.run();
  const auto warnings = drop.result().warnings;
  const RunWarning* found = warning_of(warnings, "penetration", "TB1");
  ASSERT_NE(found, nullptr);
  long times = 0;
  for (std::size_t i = 1; i < penetration.values.size(); ++i)
    if (penetration.values[i] > 125 * um && penetration.values[i - 1] <= 125 * um) ++times;
  const auto worst = std::max_element(penetration.values.begin(), penetration.values.end());
  EXPECT_GT(times, 0);
  EXPECT_EQ(found->count, times);
  EXPECT_EQ(found->worst, *worst);
  EXPECT_EQ(found->time, penetration.times[static_cast<std::size_t>(worst - penetration.values.begin())]);
  EXPECT_EQ(found->limit, 125 * um);
  EXPECT_LT(found->first_time, found->time);
}

TEST(RunGuards, AreSilentInASoundRun) {
  const auto machine = reference_machine({"run.end_time=12 ms"});
  Drop drop = drop_of(machine);
  drop.run();
  for (const auto& warning : drop.result().warnings)
    EXPECT_EQ(warning.kind->code, std::string("ellipse-truncated")) << warning.place;
}

TEST(RunGuards, FindEnergyThatCoarseStepsLose) {
  // Far too loose a tolerance, and no bound on the step: the impacts cost some thousandths of the energy.
  const auto machine = reference_machine(
      {"integration.method=tsitouras", "integration.tolerance=1e-2", "integration.step=1 ms", "run.end_time=20 ms"});
  Drop drop = drop_of(machine);
  drop.run();
  const auto result = drop.result();
  const EnergyBalance e = machine->energy_balance(result.end_time, result.state);
  const double moved = e.dissipated + std::fabs(e.growth_work) + std::fabs(e.prescribed_work) +
                       std::fabs(e.unbalance_work) + std::fabs(e.drive_work);
  ASSERT_GT(std::fabs(e.residual), 1e-3 * moved) << "the case is to be a coarse one";
  const RunWarning* found = warning_of(result.warnings, "energy-residual", "");
  ASSERT_NE(found, nullptr);
  EXPECT_GE(found->worst, std::fabs(e.residual) / moved * (1. - 1e-12)) << "the last row is one of those looked at";
  EXPECT_EQ(found->limit, 1e-3);
}

TEST(RunGuards, FindPartsThatAreTooHotForTheirMaterial) {
  const auto machine = reference_machine({"materials.steel.temperature_limit=293.2 K", "run.end_time=12 ms"});
  Drop drop = drop_of(machine);
  drop.run();
  const auto result = drop.result();
  const RunWarning* found = warning_of(result.warnings, "temperature", "TB1");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->part, "inner ring (lumped)");
  EXPECT_NEAR(found->worst, result.state[entry(*machine, "temperature/TB1/inner_ring")], 1e-3) << "it only warms here";
  EXPECT_EQ(found->limit, 293.2);
}

TEST(RunGuards, EndARunAtAWarningThatIsDeclaredFatal) {
  const std::vector<std::string> soft = {"bearings.TB1.contact_stiffness=5e6", "bearings.TB2.contact_stiffness=5e6",
                                         "run.end_time=30 ms"};
  const auto calm = reference_machine(soft);
  Drop whole = drop_of(calm);
  whole.run();
  const auto warnings = whole.result().warnings;
  const double first = std::min(warning_of(warnings, "penetration", "TB1")->first_time,
                                warning_of(warnings, "penetration", "TB2")->first_time);
  auto fatal = soft;
  fatal.emplace_back("run.fatal_warnings=[\"penetration\"]");
  const auto machine = reference_machine(fatal);
  Drop drop = drop_of(machine);
  try {
    drop.run();
    FAIL() << "it is fatal";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("run.fatal_warnings: penetration of TB"), std::string::npos)
        << error.what();
  }
  EXPECT_LT(drop.loop().time(), first);
  EXPECT_GT(drop.loop().time(), first - 60e-6) << "the step before";
}

TEST(RunGuards, GoOnFromPackedValues) {
  const std::vector<std::string> settings = {"bearings.TB1.contact_stiffness=5e6", "integration.method=runge-kutta-4",
                                             "integration.step=10 us", "run.end_time=30 ms"};
  const auto machine = reference_machine(settings);
  Drop whole = drop_of(machine), first = drop_of(machine), second = drop_of(machine);
  whole.run();
  first.run([&] { return first.loop().time() >= 12e-3; });
  PackedValues packed;
  first.loop().pack(packed);
  second.loop().unpack(first.loop().time(), first.loop().state(), packed);
  second.run();
  const auto expected = whole.result().warnings, found = second.result().warnings;
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_FALSE(expected.empty());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_EQ(found[i].count, expected[i].count) << expected[i].kind->code;
    EXPECT_EQ(found[i].worst, expected[i].worst) << expected[i].kind->code;
  }
}

/// A step by hand.
class GivenStep final : public Step {
 public:
  void interpolate(double, std::span<double>) const override {}
};

/// Puts observed steps by hand before guards: of the step observables nothing but one number is not zero.
class ObservedSteps {
 public:
  ObservedSteps(RunGuards& guards, const Machine& machine, const std::string& name) : guards_(guards) {
    found_.step.assign(observed_size(machine.step_observables()), 1.);  // clearances are open
    column_ = column_of(machine.step_observables(), name).value();
    step_.is_observed = true;
    step_.found = &found_;
  }
  void take(double value) {
    step_.start = step_.time;
    step_.time += 1e-3;
    found_.step[column_] = value;
    guards_.step(step_);
  }

 private:
  RunGuards& guards_;
  Evaluation found_;
  GivenStep step_;
  std::size_t column_ = 0;
};

TEST(RunGuards, FindAGapThatCloses) {
  const auto machine = reference_machine();
  const auto& p = machine.settings.parameters;
  RunGuards guards(*machine, p, p.integration);
  ObservedSteps steps(guards, *machine, "/bearings/TB2/clearance");
  for (const double gap : {2e-6, -1e-6, -3e-6, 0., 1e-6, -2e-6}) steps.take(gap);
  const auto warnings = guards.found(DropScalars(*machine));
  const RunWarning* found = warning_of(warnings, "gap-closed", "TB2");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->count, 2);
  EXPECT_EQ(found->worst, -3e-6);
  EXPECT_EQ(found->time, 3e-3);
  EXPECT_NEAR(found->duration, 1e-3, 1e-12);
}

// The checkpoint lies between a step that is beyond and one that is not.
TEST(RunGuards, SeeAValueComeBackAfterTheyWerePacked) {
  const auto machine = reference_machine();
  const auto& p = machine.settings.parameters;
  RunGuards whole(*machine, p, p.integration), first(*machine, p, p.integration), second(*machine, p, p.integration);
  ObservedSteps all(whole, *machine, "/bearings/TB1/clearance"), before(first, *machine, "/bearings/TB1/clearance"),
      after(second, *machine, "/bearings/TB1/clearance");
  for (const double gap : {1e-6, -1e-6}) {
    all.take(gap);
    before.take(gap);
    after.take(1e-6);  // its time goes on, too
  }
  PackedValues packed;
  first.pack(packed);
  second.unpack(packed);
  for (const double gap : {1e-6, -2e-6, -2e-6}) {
    all.take(gap);
    after.take(gap);
  }
  const DropScalars scalars(*machine);
  const auto expected = whole.found(scalars), found = second.found(scalars);
  const RunWarning *a = warning_of(expected, "gap-closed", "TB1"), *b = warning_of(found, "gap-closed", "TB1");
  ASSERT_NE(a, nullptr);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(a->count, 2);
  EXPECT_EQ(b->count, 2);
  EXPECT_EQ(b->duration, a->duration);
  EXPECT_EQ(b->worst, -2e-6);
}

TEST(RunGuards, FindStepsThatCollapse) {
  const auto machine = reference_machine({"integration.step=50 us"});
  const auto& p = machine.settings.parameters;
  RunGuards guards(*machine, p, p.integration);
  GivenStep step;
  const auto take = [&](int n, double length) {
    for (int i = 0; i < n; ++i) {
      step.start = step.time;
      step.time += length;
      guards.step(step);
    }
  };
  take(15, 1e-12);  // the start, when the method finds its step
  take(50, 20e-6);
  take(10, 5.1e-8);  // just above the limit, a thousandth of 50 us
  EXPECT_TRUE(guards.found(DropScalars(*machine)).empty());
  take(3, 2e-8);
  take(5, 20e-6);
  take(2, 1e-9);
  const auto found = guards.found(DropScalars(*machine));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind->code, std::string("step-collapse"));
  EXPECT_EQ(found[0].count, 2);
  EXPECT_NEAR(found[0].worst, 1e-9, 1e-15);
}

}  // namespace
}  // namespace rotordrop
