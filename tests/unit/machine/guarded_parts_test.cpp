#include "machine/others/guarded_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <new>
#include <stdexcept>

#include "base/errors.h"

namespace rotordrop {
namespace {

using Fault = std::function<void()>;

/// A support whose evaluation throws.
struct Throwing final : Support {
  Throwing(std::string called, Fault fault) : name_(std::move(called)), fault_(std::move(fault)) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<Observable> observables() const override { return {}; }
  [[nodiscard]] std::vector<double> instants() const override { return {1e-3, 2e-3}; }
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput&, std::span<const double>, std::span<double>, std::span<double>,
                SupportOutput& out) const override {
    fault_();
    out.heat.rub = rub;
  }
  [[nodiscard]] double energy(const SupportInput&, std::span<const double>) const override { return stored; }
  double rub = 0., stored = 3.;

 private:
  std::string name_;
  Fault fault_;
};

struct Faulty {
  Fault at_reading = [] {}, at_making = [] {}, at_run = [] {};
  double rub = 0., stored = 3.;
};

std::unique_ptr<Support> made(const Faulty& faulty) {
  SupportKind kind;
  kind.type = "faulty";
  kind.read = [faulty](const Node&, const ReadContext&, Faults&) {
    faulty.at_reading();
    return OtherSupport{1, [faulty](const std::string& name) {
                          faulty.at_making();
                          auto part = std::make_unique<Throwing>(name, faulty.at_run);
                          part->rub = faulty.rub;
                          part->stored = faulty.stored;
                          return part;
                        }};
  };
  Faults faults;
  return guarded(std::move(kind), "parts.so").read(Node::table(), {}, faults).make("X");
}

std::string told_by(const std::function<void()>& call) {
  try {
    call();
  } catch (const PartError& error) {
    return error.what();
  }
  return "";
}

void evaluate(const Support& support) {
  SupportOutput out;
  support.evaluate({}, {}, {}, {}, out);
}

const Fault runtime_fault = [] { throw std::runtime_error("no bush"); }, number = [] { throw 5; },
            input = [] { throw InputError({}, "wrong key"); }, memory = [] { throw std::bad_alloc(); };

TEST(GuardedParts, WhatAPartThrowsNamesThePartAndItsModule) {
  const auto running = made({.at_run = runtime_fault});
  EXPECT_TRUE(told_by([&] {
                evaluate(*running);
              }).starts_with("bearings.X (type \"faulty\" of parts.so) failed in evaluate(): no bush\n"));
  EXPECT_EQ(running->energy({}, {}), 3.);
  EXPECT_TRUE(told_by([] {
                made({.at_making = runtime_fault});
              }).starts_with("bearings.X (type \"faulty\" of parts.so) failed in its constructor: no bush\n"));
  EXPECT_NE(told_by([] { made({.at_reading = runtime_fault}); }).find("reading its keys: no bush"), std::string::npos);
}

TEST(GuardedParts, WhatIsNoExceptionIsToldToo) {
  for (const Faulty& faulty : {Faulty{.at_reading = number}, Faulty{.at_making = number}, Faulty{.at_run = number}})
    EXPECT_NE(told_by([&] { evaluate(*made(faulty)); }).find("it threw what is no std::exception"), std::string::npos);
}

TEST(GuardedParts, FaultsOfTheInputAndLackOfMemoryStayWhatTheyAre) {
  EXPECT_THROW(made({.at_reading = input}), InputError);
  EXPECT_THROW(made({.at_making = input}), InputError);
  EXPECT_NE(told_by([] { evaluate(*made({.at_run = input})); }), "") << "too late for that";
  EXPECT_THROW(evaluate(*made({.at_run = memory})), std::bad_alloc);
}

TEST(GuardedParts, HeatThatNobodyTakesIsTold) {
  EXPECT_NE(told_by([] { evaluate(*made({.rub = 5.})); }).find("no thermal model takes"), std::string::npos);
  EXPECT_EQ(told_by([] { evaluate(*made({})); }), "");
}

TEST(GuardedParts, InstantsAreThoseOfThePart) { EXPECT_EQ(made({})->instants(), (std::vector{1e-3, 2e-3})); }

TEST(GuardedParts, AnEnergyThatIsNoNumberIsTold) {
  const auto unknown = made({.stored = std::nan("")});
  EXPECT_NE(told_by([&] { static_cast<void>(unknown->energy({}, {})); }).find("failed in energy()"), std::string::npos);
}

TEST(GuardedParts, MessagesInOtherLettersAreReplaced) {
  const Fault latin = [] {
    throw std::runtime_error(
        "B\xfc"
        "chse");
  };
  EXPECT_NE(told_by([&] { evaluate(*made({.at_run = latin})); }).find("its message is no UTF-8"), std::string::npos);
}

TEST(GuardedParts, ThermalModelsAreGuardedWithAndWithoutKeys) {
  ThermalKind kind{.name = "wall"};
  kind.make = [](const ThermalGeometry&) -> std::unique_ptr<ThermalModel> { throw 5; };
  EXPECT_TRUE(told_by([&] {
                guarded(kind, "parts.so").make({});
              }).starts_with("thermal model \"wall\" (of parts.so) failed in its constructor: it threw"));
  kind.make = {};
  kind.read = [](const Node&, const ReadContext&, Faults&) -> MakeThermalModel {
    return [](const ThermalGeometry&) -> std::unique_ptr<ThermalModel> { throw std::runtime_error("no wall"); };
  };
  Faults faults;
  EXPECT_NE(told_by([&] { guarded(kind, "parts.so").read(Node::table(), {}, faults)({}); }).find("no wall"),
            std::string::npos);
}

}  // namespace
}  // namespace rotordrop
