// The loop and its observers: what they see, and that what they pack is all that decides about what follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "../../verification/machine/test_machines.h"
#include "analysis/drop.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

class Rows final : public RowSink {
 public:
  void row(double time, std::span<const double> values) override {
    numbers.push_back(time);
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  std::vector<double> numbers;
};

Drop drop_of(const Example& e) {
  const auto& p = e.settings.parameters;
  return {*e, p, p.integration, p.output};
}

/// Looks at every step, and evaluates by itself what the loop says it has found.
class Witness final : public Observer {
 public:
  explicit Witness(const Machine& machine) : machine_(machine), state_(machine.layout().size()) {
    fresh_.wants_step = fresh_.wants_details = true;
  }
  [[nodiscard]] bool wants_details() const override { return true; }
  void step(const Step& step) override {
    if (n_steps++ == 0) {
      EXPECT_EQ(step.time, 0.);
      EXPECT_EQ(step.start, 0.);
    } else {
      EXPECT_GT(step.time, step.start);
      EXPECT_EQ(step.start, last_time_) << "no gap";
      EXPECT_TRUE(std::equal(step.before.begin(), step.before.end(), last_.begin())) << "no gap";
      step.interpolate(step.time, state_);
      for (std::size_t i = 0; i < state_.size(); ++i) {
        const double size = std::fabs(step.after[i]) + machine_.layout().entries()[i].scale;
        EXPECT_NEAR(state_[i], step.after[i], 1e-10 * size) << "roundoff of the interpolant at its end";
      }
    }
    EXPECT_FALSE(is_over) << "nothing follows the last step";
    is_over = step.is_last;
    last_time_ = step.time;
    last_.assign(step.after.begin(), step.after.end());
    if (!step.is_observed) {
      longest_unseen = std::max(longest_unseen, step.time - last_seen_);
      return;
    }
    if (step.time > 2e-3 && !step.is_last) shortest_look = std::min(shortest_look, step.time - last_seen_);
    last_seen_ = step.time;
    machine_.evaluate(step.time, step.after, fresh_);
    if (step.found->time != step.time || step.found->step != fresh_.step || step.found->details != fresh_.details)
      ++n_wrong;
  }
  std::size_t n_steps = 0, n_wrong = 0;
  double longest_unseen = 0, shortest_look = 1;  // [s]; the second once the first steps are forgotten
  bool is_over = false;

 private:
  const Machine& machine_;
  Evaluation fresh_;
  std::vector<double> state_, last_;
  double last_time_ = 0, last_seen_ = 0;
};

const char* const methods[] = {
    "tsitouras", "bogacki-shampine", "sofroniou-spaletta", "two-step-runge-kutta", "dormand-prince", "runge-kutta-4",
    "adams"};

TEST(DropLoop, ShowsEveryStepWithWhatWasFoundAtItsEnd) {
  for (const std::string method : methods) {
    const auto machine = reference_machine({"integration.method=" + method, "run.end_time=10 ms"});
    Drop drop = drop_of(machine);
    Witness witness(*machine);
    drop.loop().add(witness);
    drop.run();
    EXPECT_TRUE(witness.is_over);
    EXPECT_EQ(witness.n_wrong, 0u) << method;
    EXPECT_EQ(witness.n_steps, static_cast<std::size_t>(drop.loop().statistics().steps) + 1) << method;
    EXPECT_LT(witness.longest_unseen, 10e-6) << method;
    if (method != "adams" && method != "bogacki-shampine") {  // steps of the latter stay short with this tolerance
      EXPECT_EQ(witness.longest_unseen, 0.) << method << ": looking costs nothing";
    }
    EXPECT_EQ(drop.loop().time(), 10e-3);
  }
}

TEST(DropLoop, LooksAsOftenAsPeaksNeedWhereStepsStayShort) {
  for (const std::string method : {"two-step-runge-kutta", "runge-kutta-4"}) {
    const auto machine = reference_machine({"integration.method=" + method, "integration.step=2 us",
                                            "run.end_time=10 ms", "output.interval=1 s", "output.detail_interval=1 s"});
    Drop drop = drop_of(machine);
    Witness witness(*machine);
    drop.loop().add(witness);
    drop.run();
    EXPECT_EQ(witness.n_wrong, 0u) << method;
    EXPECT_GE(witness.n_steps, 5000u) << method;
    EXPECT_GE(witness.shortest_look, 9.9e-6) << method;
    EXPECT_LT(witness.longest_unseen, 10e-6) << method;
  }
}

TEST(DropLoop, LooksMoreOftenAtRingsThatMoveFasterOnAStiffContact) {
  const double K = 1.6e10, mass = 0.21;  // [N/m^(10/9)], [kg]
  const auto penetration = [K](double force) { return std::pow(force / K, 0.9); };
  const double stiffness = 200. / (penetration(1e4 + 100.) - penetration(1e4 - 100.)),
               period = 2. * std::numbers::pi * std::sqrt(mass / stiffness);
  const auto machine =
      reference_machine({"integration.method=runge-kutta-4", "integration.step=0.5 us", "run.end_time=8 ms",
                         "output.interval=1 s", "output.detail_interval=1 s", "bearings.TB2.contact_stiffness=1.6e10"});
  Drop drop = drop_of(machine);
  Witness witness(*machine);
  drop.loop().add(witness);
  drop.run();
  EXPECT_LT(period, 50e-6) << "s";
  EXPECT_GE(witness.shortest_look, period / 12. - 1e-9) << "s, steps of 0.5 us";
  EXPECT_LT(witness.longest_unseen, period / 12.) << "s";
}

/// Counts how often it is evaluated.
class Counted final : public Support {
 public:
  Counted(std::unique_ptr<Support> inner, long& n) : inner_(std::move(inner)), n_(n) {}
  [[nodiscard]] const std::string& name() const override { return inner_->name(); }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return inner_->state_entries(); }
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override { return inner_->ledger_entries(); }
  [[nodiscard]] std::vector<Observable> observables() const override { return inner_->observables(); }
  [[nodiscard]] std::vector<Observable> detailed_observables() const override { return inner_->detailed_observables(); }
  void initial_state(std::span<double> y) const override { inner_->initial_state(y); }
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override {
    ++n_;
    inner_->evaluate(input, y, dydt, ledger_rates, out);
  }
  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override {
    return inner_->energy(input, y);
  }

 private:
  std::unique_ptr<Support> inner_;
  long& n_;
};

TEST(DropLoop, EvaluatesEndsOfStepsNoMoreThanTheMethodDoes) {
  // Besides the method's right-hand sides: the look at the start, and the details of the first and the last row if somebody reads them. Rows themselves
  // take what is there.
  for (const auto& [method, reads_details] : {std::pair<std::string, bool>{"tsitouras", false},
                                              {"tsitouras", true},
                                              {"bogacki-shampine", true},
                                              {"sofroniou-spaletta", true},
                                              {"two-step-runge-kutta", true}}) {
    const auto e = reference_machine(
        {"integration.method=" + method, "run.end_time=10 ms", "output.interval=1 s", "output.detail_interval=1 s"});
    const auto& p = e.settings.parameters;
    long n = 0;
    Machine::Parts parts = machine_parts(p, e.settings.tree);
    parts.supports[0] = std::make_unique<Counted>(std::move(parts.supports[0]), n);
    const Machine machine(std::move(parts));
    n = 0;
    Drop drop(machine, p, p.integration, p.output);
    Rows details;
    if (reads_details) drop.detail_rows().add(details);
    drop.run();
    EXPECT_GT(drop.loop().statistics().steps, 100);
    EXPECT_EQ(n, drop.loop().statistics().rhs_evaluations + (reads_details ? 3 : 1)) << method;
  }
}

/// Stops halfway, in the first bounces; with a fixed step the integrator has no memory of its own.
void expect_to_go_on_to_the_same_bits(const std::string& step) {
  const std::vector<std::string> settings = {"integration.method=runge-kutta-4", "integration.step=" + step,
                                             "run.end_time=24 ms", "output.longest_interval=1 ms"};
  const auto machine = reference_machine(settings);
  Rows unbroken, first_part, second_part;
  Drop whole = drop_of(machine);
  whole.rows().add(unbroken);
  whole.run();

  Drop first = drop_of(machine);
  first.rows().add(first_part);
  first.run([&] { return first.loop().time() >= 12e-3; });
  EXPECT_FALSE(first.result().completed);
  PackedValues packed;
  first.loop().pack(packed);
  EXPECT_TRUE(packed.contains("scalars/TB1/contact force")) << "by name";

  Drop second = drop_of(machine);
  second.rows().add(second_part);
  second.loop().unpack(first.loop().time(), first.loop().state(), packed);
  second.run();

  auto joined = first_part.numbers;
  joined.insert(joined.end(), second_part.numbers.begin(), second_part.numbers.end());
  EXPECT_EQ(joined, unbroken.numbers);
  PackedValues at_end, at_end_of_whole;
  second.loop().pack(at_end);
  whole.loop().pack(at_end_of_whole);
  for (auto* values : {&at_end, &at_end_of_whole})
    values->at("loop")[1] = 0.;  // right-hand sides: one more after a break
  for (const auto& [name, values] : at_end_of_whole) {
    ASSERT_EQ(values.size(), at_end.at(name).size()) << name;
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_TRUE(values[i] == at_end.at(name)[i] || (std::isnan(values[i]) && std::isnan(at_end.at(name)[i])))
          << name << " " << i;
  }
  EXPECT_EQ(second.result().state, whole.result().state);
}

TEST(DropLoop, GoesOnFromPackedValuesToTheSameBits) { expect_to_go_on_to_the_same_bits("10 us"); }
TEST(DropLoop, GoesOnToTheSameBitsWhereShortStepsAreLookedAtNowAndThen) { expect_to_go_on_to_the_same_bits("4 us"); }

/// Packs while a step is shown, as checkpoints are written.
struct PacksEachStep final : Observer {
  explicit PacksEachStep(const DropLoop& l) : loop(l) {}
  void step(const Step&) override {
    packed.clear();
    loop.pack(packed);
  }
  const DropLoop& loop;
  PackedValues packed;
};

TEST(DropLoop, PacksWhileAStepIsShownWhatItPacksAfterIt) {
  const auto machine = reference_machine({"integration.step=4 us", "run.end_time=2 ms"});
  Drop drop = drop_of(machine);
  PacksEachStep observer(drop.loop());
  drop.loop().add(observer);
  PackedValues after;
  int n = 0;
  drop.run([&] {
    after.clear();
    drop.loop().pack(after);
    EXPECT_EQ(observer.packed.at("loop"), after.at("loop"));
    EXPECT_EQ(observer.packed.at("end condition"), after.at("end condition"));
    return ++n == 100;
  });
  EXPECT_EQ(n, 100);
}

TEST(DropLoop, RefusesPackedValuesThatLackSomething) {
  const auto machine = reference_machine({"run.end_time=2 ms"});
  Drop drop = drop_of(machine);
  drop.run([] { return true; });
  PackedValues packed;
  drop.loop().pack(packed);
  for (const char* name : {"loop", "end condition", "rows", "detail rows", "impulse", "scalars/TB2/skid"}) {
    auto lacking = packed;
    ASSERT_EQ(lacking.erase(name), 1u) << name;
    Drop other = drop_of(machine);
    EXPECT_THROW(other.loop().unpack(drop.loop().time(), drop.loop().state(), lacking), std::logic_error) << name;
  }
}

TEST(DropLoop, RunsTwoDropsOfOneMachineInTwoThreadsToTheSameBits) {
  const auto machine = reference_machine({"run.end_time=20 ms"});
  Rows alone, rows[2];
  Drop drop = drop_of(machine);
  drop.rows().add(alone);
  drop.run();
  const auto work = [&](std::size_t i) {
    Drop own = drop_of(machine);
    own.rows().add(rows[i]);
    own.run();
  };
  std::thread first(work, 0), second(work, 1);
  first.join();
  second.join();
  EXPECT_EQ(rows[0].numbers, alone.numbers);
  EXPECT_EQ(rows[1].numbers, alone.numbers);
}

}  // namespace
}  // namespace rotordrop
