#include "machine/others/declared_parts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

/// A support of others that declares what a test gives it.
struct Declaring final : Support {
  std::string called = "X";
  std::vector<StateEntry> states, ledgers;
  std::vector<Observable> series, details;
  [[nodiscard]] const std::string& name() const override { return called; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return states; }
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override { return ledgers; }
  [[nodiscard]] std::vector<Observable> observables() const override { return series; }
  [[nodiscard]] std::vector<Observable> detailed_observables() const override { return details; }
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput&, std::span<const double>, std::span<double>, std::span<double>,
                SupportOutput&) const override {}
  [[nodiscard]] double energy(const SupportInput&, std::span<const double>) const override { return 0.; }
};

std::string fault_of(const Declaring& support) {
  Faults faults;
  check_declared(&support, "X", {}, faults);
  return faults.empty() ? "" : faults.begin()->message;
}

TEST(DeclaredParts, SoundOnesPass) {
  Declaring part;
  part.states = {{"stretch y", "m", 1e-4}, {"stretch z", "m", 1e-4}};
  part.ledgers = {{"bush damping", "J", 1., ""}};
  part.series = {{"orbit", "m", "", 2, {"y", "z"}}, {"bush/force", "N", "", 3}};
  EXPECT_EQ(fault_of(part), "");
}

TEST(DeclaredParts, ScalesOfStatesAreLargerThanZero) {
  for (const double scale : {0., -1., std::nan("")}) {
    Declaring part;
    part.states = {{"s", "m", scale}};
    EXPECT_NE(fault_of(part).find("bearings.X: the scale of state \"s\" must be larger than 0"), std::string::npos);
  }
}

TEST(DeclaredParts, NamesThatNoDatasetCanHaveAreRefused) {
  for (const char* name : {"", "../a", "a/../b", "a//b", "a.b", "time", "b/time", "a\nb"}) {
    Declaring series, ledger;
    series.series = {{name, "m", ""}};
    ledger.ledgers = {{name, "J", 1., ""}};
    EXPECT_NE(fault_of(series), "") << name;
    EXPECT_NE(fault_of(ledger), "") << name;
  }
  Declaring twice, within, kept;
  twice.series = within.series = {{"a", "m", ""}};
  twice.details = {{"a", "m", ""}};
  within.details = {{"a/b", "m", ""}};
  kept.ledgers = {{"rub_heat", "J", 1., ""}};
  EXPECT_EQ(fault_of(twice), "bearings.X: series \"a\" stands twice.");
  EXPECT_EQ(fault_of(within), "bearings.X: series \"a\" and \"a/b\" cannot both be datasets.");
  EXPECT_EQ(fault_of(kept), "bearings.X: ledger \"rub_heat\" stands twice.");
}

TEST(DeclaredParts, ColumnsAreAsManyAsNumbersAndDiffer) {
  const std::vector<std::string> one = {"y"}, equal = {"u", "u"}, none = {};
  for (const auto& [size, columns] : {std::pair{std::size_t{2}, one}, {2, equal}, {0, none}}) {
    Declaring part;
    part.series = {{"a", "m", "", size, columns}};
    EXPECT_NE(fault_of(part), "") << size;
  }
}

TEST(DeclaredParts, WhatHasBallForcesGivesAllThatATouchdownBearingGives) {
  Declaring part;
  part.series = {{"ball_force", "N", "", 1, {"row 1"}, Observed::ball_force}};
  EXPECT_NE(fault_of(part).find("orbit[2], penetration, clearance, contact_force"), std::string::npos);
}

TEST(DeclaredParts, NumbersOfASeriesFitIntoMemory) {
  Declaring part;
  part.series = {{"a", "m", "", std::size_t{1} << 60}};
  EXPECT_NE(fault_of(part).find("series \"a\" has 1152921504606846976 numbers, and at most"), std::string::npos);
}

TEST(DeclaredParts, TheNameIsThatOfTheTable) {
  Declaring part;
  part.called = "Y";
  EXPECT_NE(fault_of(part).find("its name() or results_path() is not that of its table"), std::string::npos);
}

TEST(DeclaredParts, TextsAreInUtf8) {
  Declaring name, words, column, unit;
  name.states = {{"s\xff", "m", 1.}};
  words.series = {{"a", "m", "\xff"}};
  column.series = {{"a", "m", "", 2, {"y", "\xff"}}};
  unit.ledgers = {{"l", "\xff", 1., ""}};
  for (const Declaring* part : {&name, &words, &column}) EXPECT_NE(fault_of(*part).find("UTF-8"), std::string::npos);
  EXPECT_NE(fault_of(unit), "");
}

TEST(DeclaredParts, UnitsAreKnown) {
  Declaring state, series, ledger;
  state.states = {{"s", "furlongx", 1.}};
  series.series = {{"a", "no_unit_at_all", ""}};
  ledger.ledgers = {{"l", "kg kg kgg", 1., ""}};
  for (const Declaring* part : {&state, &series, &ledger})
    EXPECT_NE(fault_of(*part).find("is not known"), std::string::npos) << fault_of(*part);
}

TEST(DeclaredParts, AKindThatMakesNothingIsTold) {
  Faults faults;
  check_declared(static_cast<const Support*>(nullptr), "X", {}, faults);
  EXPECT_EQ(faults.size(), 1u);
}

}  // namespace
}  // namespace rotordrop
