// Heat of a support that is no bearing, into a node of the lumped circuit.
#include <gtest/gtest.h>

#include <optional>

#include "../../verification/machine/test_machines.h"
#include "analysis/drop.h"
#include "base/errors.h"
#include "case/case_text.h"

namespace rotordrop {
namespace {

struct BrakeParameters {
  int node = 0;
  std::optional<std::string> heats;
  double gives = 0;  ///< [W]
};

/// Dissipates 50 W, whatever the rotor does; by default 20 W of that enter a node. By hand: a node of 100 J/K without resistors warms by 0.2 K/s.
class Brake final : public Support {
 public:
  Brake(std::string name, std::string heats, double gives)
      : name_(std::move(name)), heats_(std::move(heats)), gives_(gives) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<Observable> observables() const override { return {}; }
  [[nodiscard]] std::string heat_port() const override { return heats_; }
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput&, std::span<const double>, std::span<double>, std::span<double>,
                SupportOutput& out) const override {
    out.force_on_rotor = {};
    out.other_dissipation = 50.;
    out.heat_into_port = gives_;
  }
  [[nodiscard]] double energy(const SupportInput&, std::span<const double>) const override { return 0.; }

 private:
  std::string name_, heats_;
  double gives_;
};

void add_brake() {
  static const bool once = [] {
    Section<BrakeParameters> section("brake");
    section.integer("node", &BrakeParameters::node, {});
    section.text("heats", &BrakeParameters::heats, {});
    section.quantity("gives", &BrakeParameters::gives, {.unit = "W", .fallback = "20 W", .source = "test"});
    add_support_kind("brake", section, [](const std::string& name, const BrakeParameters& p) {
      return std::make_unique<Brake>(name, p.heats.value_or(""), p.gives);
    });
    return true;
  }();
  static_cast<void>(once);
}

testing::Example braked_machine(const std::string& heats, const std::string& more = "") {
  add_brake();
  const std::string key = heats.empty() ? "" : "heats = \"" + heats + "\"\n" + more;
  const std::string text =
      "base = \"neisi2019.toml\"\n[run]\nend_time = \"10 ms\"\n[bearings.BRAKE]\ntype = \"brake\"\nnode = 16\n" + key +
      "[[thermal.node]]\nname = \"bush\"\ncapacity = \"100 J/K\"\n";
  testing::Example e{read_case_text(text, std::string(ROTORDROP_SOURCE_DIR) + "/params"), nullptr};
  e.machine = build_machine(e.settings.parameters, e.settings.tree);
  return e;
}

TEST(HeatPort, WarmsANodeByItsPowerOverTheCapacity) {
  const auto machine = braked_machine("bush");
  std::vector<double> y(machine->layout().size()), rates(y.size());
  machine->initial_state(y);
  machine->rhs(0., y, rates);
  EXPECT_DOUBLE_EQ(rates[testing::entry(*machine, "temperature/bush")], 0.2) << "K/s: 20 W into 100 J/K";
  EXPECT_DOUBLE_EQ(rates[testing::entry(*machine, "BRAKE ledger/heat into port")], 20.) << "W";
  EXPECT_DOUBLE_EQ(rates[testing::entry(*machine, "BRAKE ledger/other dissipation")], 50.)
      << "W, what is given included";
  EXPECT_EQ(rates[testing::entry(*machine, "temperature/TB1/shaft")], 0.) << "K/s, nobody else is warmed";
}

TEST(HeatPort, CountsInTheBalanceOfTheModelThatItEnters) {
  const auto machine = braked_machine("bush");
  std::vector<double> y(machine->layout().size());
  machine->initial_state(y);
  y[testing::entry(*machine, "BRAKE ledger/heat into port")] = 30.;
  y[testing::entry(*machine, "temperature/bush")] += 0.3;
  const EnergyBalance balance = machine->energy_balance(0., y);
  EXPECT_DOUBLE_EQ(balance.heat[0].deposited, 30.) << "J";
  EXPECT_NEAR(balance.heat[0].residual, 0., 1e-11) << "J: 30 J given, 100 J/K times 0.3 K stored; roundoff of 293 K";
  EXPECT_EQ(machine->ledger(2, "heat into port", y), 30.);
}

TEST(HeatPort, IsNoLedgerWithoutAPlace) {
  const auto machine = braked_machine("");
  EXPECT_THROW(testing::entry(*machine, "BRAKE ledger/heat into port"), std::out_of_range);
}

/// What a run of 10 ms says of the brake's heat.
const RunWarning* warning_of(const std::string& gives, std::vector<RunWarning>& warnings) {
  const auto machine = braked_machine("bush", "gives = \"" + gives + "\"\n");
  const auto& p = machine.settings.parameters;
  Drop drop(*machine, p, p.integration, p.output);
  drop.run();
  warnings = drop.result().warnings;
  for (const RunWarning& warning : warnings)
    if (warning.kind->code == std::string("heat-port")) return &warning;
  return nullptr;
}

TEST(HeatPort, MoreThanIsDissipatedOrLessThanNothingIsWarnedOf) {
  std::vector<RunWarning> warnings;
  EXPECT_EQ(warning_of("20 W", warnings), nullptr);
  EXPECT_EQ(warning_of("50 W", warnings), nullptr) << "all of it";
  const RunWarning* more = warning_of("60 W", warnings);
  ASSERT_NE(more, nullptr);
  EXPECT_EQ(more->place, "BRAKE");
  EXPECT_NEAR(more->worst, 10. / 60., 1e-12) << "10 W of 60 W are from nowhere";
  const RunWarning* less = warning_of("-20 W", warnings);
  ASSERT_NE(less, nullptr);
  EXPECT_NEAR(less->worst, 20. / 50., 1e-12);
}

TEST(HeatPort, OfAnUnknownNodeIsExplained) {
  try {
    braked_machine("busch");
    FAIL() << "there is no such node";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("bearings.BRAKE heats \"busch\""), std::string::npos) << text;
    EXPECT_NE(text.find("Did you mean \"bush\"?"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rotordrop
