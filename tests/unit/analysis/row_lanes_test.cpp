// Rows of a drop, several at a time: each is what an evaluation of its state alone gives, whatever stands beside it, and none is lost or late for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../../verification/machine/test_machines.h"
#include "../thermal/two_lumps.h"
#include "analysis/drop.h"
#include "analysis/row_lanes.h"
#include "base/errors.h"
#include "integrate/integrator.h"
#include "machine/lanes/machine_lanes.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

/// The reference case to the end of its first contacts. @param settings  further ones
Example reference(std::vector<std::string> settings = {}) {
  settings.emplace_back("run.end_time=12 ms");
  return {read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", settings), nullptr};
}
Example machine_of(Example e, bool with_follower = false) {
  Machine::Parts parts = machine_parts(e.settings.parameters, e.settings.tree);
  if (with_follower) {
    std::vector<ReducedSection> sections;
    for (const char* name : {"TB1", "TB2"}) {
      sections.push_back(two_lumps(100. * 21.));
      sections.back().name = name;
    }
    parts.thermal.push_back(
        {"second", "/second/", std::make_unique<ReducedSections>(std::move(sections), 293.15), false, true});
  }
  e.machine = std::make_unique<Machine>(std::move(parts));
  return e;
}

struct Instant {
  double t;
  std::vector<double> y;
};
/// Before, in and after contacts.
std::vector<Instant> instants(const Machine& m, const IntegrationParameters& parameters) {
  std::vector<Instant> list;
  std::vector<double> y(m.layout().size());
  m.initial_state(y);
  const MachineSystem system(m);
  const auto integrator =
      make_integrator(system, parameters, 0., std::span(y).first(m.integrated_layout().size()), 12e-3);
  for (int k = 1; k <= 11; ++k) {
    while (integrator->time() < 1.05e-3 * k) integrator->advance();
    const auto behind = std::copy(integrator->state().begin(), integrator->state().end(), y.begin());
    // Whatever follows has temperatures of its own.
    for (auto T = behind; T != y.end(); ++T) *T = 293.15 + k + 0.5 * static_cast<double>(T - behind);
    list.push_back({integrator->time(), y});
  }
  return list;
}

/// Step and state observables of every instant, in lanes. @param at_once  how many are added before they are evaluated
std::vector<std::vector<double>> in_lanes(const Machine& m, const std::vector<Instant>& list, std::size_t at_once) {
  std::vector<std::vector<double>> rows;
  RowLanes lanes(m);
  const auto evaluate = [&] {
    const RowTile found = lanes.evaluate();
    for (std::size_t i = 0; i < found.n_rows(); ++i) {
      EXPECT_EQ(found.times[i], list[rows.size()].t);
      found.copy_row(i, rows.emplace_back(found.row_size));
    }
    EXPECT_EQ(lanes.n_added(), 0U);
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    lanes.add(list[k].t, list[k].y);
    if ((k + 1) % at_once == 0) evaluate();
  }
  evaluate();
  return rows;
}

/// Of each value of a row: roundoff of sums in another order, and of balances, which are differences of some 1e6 J.
std::vector<double> roundoff(const Machine& m) {
  std::vector<double> list;
  for (const auto* observables : {&m.step_observables(), &m.state_observables()})
    for (const auto& o : *observables) list.insert(list.end(), o.size, o.unit == "J" ? 1e-8 : 1e-15);
  return list;
}

class RowLanesOf : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(RowLanesOf, FindWhatAnEvaluationOfAStateAloneFinds) {
  for (const bool with_follower : {false, true}) {
    const Example e = machine_of(reference(GetParam()), with_follower);
    ASSERT_TRUE(evaluates_in_lanes(*e));
    const auto list = instants(*e, e.settings.parameters.integration);
    const auto found = in_lanes(*e, list, LaneSystem::width);
    ASSERT_EQ(found.size(), list.size());
    Evaluation alone;
    alone.wants_step = true;
    std::vector<double> row(found.front().size()), largest(row.size(), 0.);
    for (const auto& r : found)
      for (std::size_t i = 0; i < r.size(); ++i) largest[i] = std::max(largest[i], std::fabs(r[i]));
    EXPECT_GT(*std::max_element(largest.begin(), largest.end()), 1000.) << "N: there is a contact among them";
    const auto allowed = roundoff(*e);
    for (std::size_t k = 0; k < list.size(); ++k) {
      e->evaluate(list[k].t, list[k].y, alone);
      std::copy(alone.step.begin(), alone.step.end(), row.begin());
      e->observe_state(list[k].y, alone, std::span(row).subspan(e->n_step()));
      for (std::size_t i = 0; i < row.size(); ++i)
        EXPECT_NEAR(found[k][i], row[i], 1e-11 * largest[i] + allowed[i]) << "value " << i << ", instant " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, RowLanesOf,
    ::testing::Values(
        std::vector<std::string>{},
        std::vector<std::string>{"thermal.contact_conduction=rolling", "bearings.load_law=equivalent"},
        std::vector<std::string>{"bearings.TB2.waviness=[{surface=\"inner\",order=14,amplitude=\"0.2 um\"},"
                                 "{surface=\"outer\",order=15,amplitude=\"0.1 um\",phase=1}]"},
        std::vector<std::string>{"bearings.TB1.support={type=\"ribbon\",mass=\"3 kg\",ribbon={stiffness=\"4e7 N/m\","
                                 "slip_force=\"2 kN\",stick_stiffness=\"3e8 N/m\"}}"},
        std::vector<std::string>{"rotor.windage={law=\"geometry\",factor=1}",
                                 "rotor.probes.seal={node=10,clearance=\"0.3 mm\"}"},
        std::vector<std::string>{"rotor.model=rigid"}, std::vector<std::string>{"bearings.ball_model=inertial"}));

TEST(RowLanes, DoNotDependOnTheRowsBeside) {
  for (const bool with_follower : {false, true}) {
    const Example e = machine_of(reference(), with_follower);
    const auto list = instants(*e, e.settings.parameters.integration);
    const auto eight = in_lanes(*e, list, 8);
    for (const std::size_t at_once : {1, 3}) EXPECT_EQ(in_lanes(*e, list, at_once), eight) << at_once;
  }
}

TEST(RowLanes, AreForMachinesThatRunInLanes) {
  EXPECT_FALSE(evaluates_in_lanes(*machine_of(reference({"contact.friction_law=sticking"}))));
  EXPECT_FALSE(evaluates_in_lanes(*machine_of(reference({"bearings.ring_motion=free"}))));
}

struct Kept final : RowSink {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;
  void row(double t, std::span<const double> values) override {
    times.push_back(t);
    rows.emplace_back(values.begin(), values.end());
  }
};

/// Takes rows side by side where they come so.
struct KeptByTiles final : RowSink {
  Kept kept;
  std::size_t n_tiles = 0;
  void row(double t, std::span<const double> values) override { kept.row(t, values); }
  [[nodiscard]] bool takes_tiles() const override { return true; }
  void rows(const RowTile& tile) override {
    ++n_tiles;
    std::vector<double> one(tile.row_size);
    for (std::size_t i = 0; i < tile.n_rows(); ++i) {
      tile.copy_row(i, one);
      kept.row(tile.times[i], one);
    }
  }
};
/// Refuses its n-th row.
struct Refuses final : RowSink {
  int n = 0;
  explicit Refuses(int rows) : n(rows) {}
  void row(double, std::span<const double>) override {
    if (--n == 0) throw SolverError("no more");
  }
};

TEST(SeriesRows, SideBySideAreThoseOneByOne) {
  const Example e = machine_of(reference());
  const auto& p = e.settings.parameters;
  Drop drop(*e, p, p.integration, p.output);
  Kept rows;
  KeptByTiles tiles;
  drop.rows().add(rows);
  drop.rows().add(tiles);
  drop.run();
  EXPECT_GT(tiles.n_tiles, rows.times.size() / 10) << "nearly all come eight at a time";
  EXPECT_EQ(tiles.kept.times, rows.times);
  EXPECT_EQ(tiles.kept.rows, rows.rows);
}

TEST(SeriesRows, BeforeTheOneThatIsRefusedAreKept) {
  const Example e = machine_of(reference());
  const auto& p = e.settings.parameters;
  for (const int n : {1, 2, 21, 24, 26}) {  // at either end of a tile and within
    Drop drop(*e, p, p.integration, p.output);
    Refuses refuses(n);
    KeptByTiles tiles;
    drop.rows().add(tiles);
    drop.rows().add(refuses);
    EXPECT_THROW(drop.run(), SolverError);
    // A row that comes alone is told to all in their order.
    EXPECT_EQ(tiles.kept.times.size(), n == 1 ? 1U : static_cast<std::size_t>(n - 1)) << n;
  }
}

TEST(SeriesRows, OfAnInterruptedDropAreTheFirstOfTheWholeOne) {
  const Example e = machine_of(reference());
  const auto& p = e.settings.parameters;
  Kept whole, part;
  Drop a(*e, p, p.integration, p.output), b(*e, p, p.integration, p.output);
  a.rows().add(whole);
  b.rows().add(part);
  a.run();
  int n_steps = 0;
  b.run([&] { return ++n_steps == 311; });
  ASSERT_GT(part.times.size(), 20U);
  ASSERT_LT(part.times.size(), whole.times.size());
  EXPECT_TRUE(std::is_sorted(whole.times.begin(), whole.times.end()));
  // None that was due is left: the next one lies behind the last step.
  EXPECT_GE(whole.times[part.times.size()], b.result().end_time);
  for (std::size_t k = 0; k < part.times.size(); ++k) {
    EXPECT_EQ(part.times[k], whole.times[k]);
    EXPECT_EQ(part.rows[k], whole.rows[k]) << k;
  }
}

}  // namespace
}  // namespace rotordrop
