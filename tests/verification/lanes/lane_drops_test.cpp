// Drops side by side: to the end of the first bounces each of them is the drop that runs alone, and what becomes of it does not depend on its lane.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../machine/test_machines.h"
#include "analysis/drop_lanes.h"
#include "analysis/memory_series.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

/// A case, its machine, and a drop of it.
struct OneDrop {
  Example example;
  Drop drop;
  explicit OneDrop(const std::vector<std::string>& settings)
      : example(reference_machine(settings, "neisi2019-settling.toml")),
        drop(*example, example.settings.parameters, example.settings.parameters.integration,
             example.settings.parameters.output) {}
};

const std::string usual_method = "tsitouras";

std::vector<std::string> settings(std::size_t k, const std::string& end = "25 ms",
                                  const std::string& method = usual_method) {
  return {"run.end_time=" + end, "integration.method=" + method, "integration.tolerance=1e-6",
          "contact.friction_coefficient=" + std::to_string(0.06 + 0.02 * static_cast<double>(k)),
          "bearings.TB1.support.C_y=" + std::to_string(2000. + 700. * static_cast<double>(k))};
}

std::vector<std::unique_ptr<OneDrop>> runs(std::span<const std::size_t> which, const std::string& end = "25 ms",
                                           const std::string& method = usual_method) {
  std::vector<std::unique_ptr<OneDrop>> list;
  for (const std::size_t k : which) list.push_back(std::make_unique<OneDrop>(settings(k, end, method)));
  return list;
}

std::vector<std::exception_ptr> run_together(const std::vector<std::unique_ptr<OneDrop>>& list) {
  std::vector<Drop*> drops;
  for (const auto& run : list) drops.push_back(&run->drop);
  return run_in_lanes(drops);
}

/// What a drop is compared by.
std::vector<double> scalars_of(const Drop& drop) {
  std::vector<double> values;
  for (std::size_t bearing = 0; bearing < 2; ++bearing) {
    const BearingScalars& of = drop.scalars().of(bearing);
    values.insert(values.end(), {of.first_contact_time, of.contact_force.value, of.ball_force.value,
                                 of.friction_heat_rate.value, of.ring_speed_end, of.contact_pressure.value});
  }
  return values;
}

class DropsInLanesBy : public ::testing::TestWithParam<const char*> {};

// Rounding decides about steps in flight, where the error is nothing but rounding, and grows from bounce to bounce. So the measure is what rounding does to
// a drop alone: that of the last digits of its speed, which acts from the start on, and of its friction coefficient. It need not be normal: the largest
// friction heat of the first drop lies at one of two values 1e-4 apart, and a quarter to a half of its neighbours at the other. One in 1000 such
// quarters is missed by 24 neighbours; a wrong term is off by far more.
TEST_P(DropsInLanesBy, AreTheDropsThatRunAlone) {
  const std::vector<std::size_t> which = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto together = runs(which, "25 ms", GetParam());
  for (const auto& failure : run_together(together)) EXPECT_FALSE(failure);
  for (std::size_t k = 0; k < which.size(); ++k) {
    std::vector<std::vector<double>> alone;
    for (int ulps = 0; ulps <= 24; ++ulps) {
      double friction = 0.06 + 0.02 * static_cast<double>(k), speed = 15200.;
      for (int i = 0; i < ulps; ++i) {
        friction = std::nextafter(friction, 1.);
        speed = std::nextafter(speed, 1e9);
      }
      auto set = settings(k, "25 ms", GetParam());
      set.push_back(fmt::format("contact.friction_coefficient={:.17g}", friction));
      set.push_back(fmt::format("run.initial_speed={:.17g} rpm", speed));
      OneDrop run(set);
      run.drop.run();
      alone.push_back(scalars_of(run.drop));
      if (ulps > 0) continue;
      const DropResult a = together[k]->drop.result(), b = run.drop.result();
      EXPECT_TRUE(a.completed);
      EXPECT_EQ(a.end_time, 0.025);
      // Rounding decides about steps in flight, as above.
      EXPECT_NEAR(static_cast<double>(a.statistics.steps), static_cast<double>(b.statistics.steps),
                  0.05 * static_cast<double>(b.statistics.steps));
      const auto balance = together[k]->example->energy_balance(a.end_time, a.state);
      EXPECT_LT(std::fabs(balance.residual), 1e-4);
    }
    const auto lane = scalars_of(together[k]->drop);
    for (std::size_t i = 0; i < lane.size(); ++i) {
      double spread = 0.;
      for (const auto& one : alone) spread = std::max(spread, std::fabs(one[i] - alone[0][i]));
      EXPECT_NEAR(lane[i], alone[0][i], 10. * spread + 1e-9 * std::fabs(alone[0][i]))
          << "drop " << k << ", value " << i;
      EXPECT_LT(spread, 1e-2 * std::fabs(alone[0][i])) << "this drop's spread shows nothing";
    }
  }
}

TEST(DropsInLanes, DoNotDependOnLaneOrNeighbours) {
  const auto eight = runs(std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7}), two = runs(std::vector<std::size_t>{5, 2}),
             one = runs(std::vector<std::size_t>{5});
  for (const auto* list : {&eight, &two, &one})
    for (const auto& failure : run_together(*list)) EXPECT_FALSE(failure);
  const auto state = [](const std::unique_ptr<OneDrop>& run) { return run->drop.result().state; };
  EXPECT_EQ(state(eight[5]), state(two[0]));
  EXPECT_EQ(state(eight[5]), state(one[0]));
  EXPECT_EQ(state(eight[2]), state(two[1]));
  EXPECT_EQ(eight[5]->drop.scalars().of(1).contact_force.value, one[0]->drop.scalars().of(1).contact_force.value);
}

/// Drops of one kind after those of another, which wait until the first are over.
class KindAfterKind final : public LaneFeed {
 public:
  explicit KindAfterKind(std::vector<std::vector<Drop*>> kinds) : kinds_(std::move(kinds)) {}
  Drop* next() override {
    if (n_running_ == 0 && !kinds_.empty() && kinds_.front().empty()) kinds_.erase(kinds_.begin());
    if (kinds_.empty() || kinds_.front().empty()) return nullptr;
    Drop* const drop = kinds_.front().back();
    kinds_.front().pop_back();
    ++n_running_;
    return drop;
  }
  void over(Drop&, const std::exception_ptr& failure) override {
    --n_running_;
    EXPECT_FALSE(failure);
  }

 private:
  std::vector<std::vector<Drop*>> kinds_;
  int n_running_ = 0;
};

// Numbers of modes, of thermal nodes and of the method's stages differ.
TEST(DropsInLanes, OfAnotherKindBeginWhereTheLastOfAKindIsOver) {
  std::vector<std::vector<std::string>> kinds(4, settings(1, "9 ms"));
  kinds[1].push_back("rotor.cut_off_frequency=900 Hz");
  kinds[2].push_back("integration.method=bogacki-shampine");
  kinds[3].push_back("rotor.cut_off_frequency=7 kHz");
  std::vector<std::unique_ptr<OneDrop>> by_turns, alone;
  std::vector<std::vector<Drop*>> drops;
  for (const auto& kind : kinds) {
    by_turns.push_back(std::make_unique<OneDrop>(kind));
    drops.push_back({&by_turns.back()->drop});
    alone.push_back(std::make_unique<OneDrop>(kind));
    Drop* const one = &alone.back()->drop;
    ASSERT_FALSE(run_in_lanes(std::span(&one, 1)).front());
  }
  KindAfterKind feed(drops);
  EXPECT_EQ(run_in_lanes(feed), kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    EXPECT_TRUE(by_turns[k]->drop.result().completed) << k;
    EXPECT_EQ(by_turns[k]->drop.result().state, alone[k]->drop.result().state) << k;
  }
  EXPECT_NE(alone[0]->drop.result().state.size(), alone[1]->drop.result().state.size());
  EXPECT_NE(alone[0]->drop.result().state.size(), alone[3]->drop.result().state.size());
}

// In flight Ip w' = T: a torque that rises from 0 to 1/width and falls back within the width leaves Ip w' = 1/2, in each lane at its own time.
TEST(DropsInLanes, MeetThePointsOfTheirTorques) {
  constexpr double Ip = 0.3899981437441726, initial_speed = 15200. * std::numbers::pi / 30.;  // kg m^2, rad/s
  for (const char* method : {"tsitouras", "two-step-runge-kutta", "bogacki-shampine"}) {
    std::vector<std::unique_ptr<OneDrop>> list;
    for (int k = 0; k < 5; ++k) {
      auto set = settings(static_cast<std::size_t>(k), "5 ms", method);
      const double begin = 1.03e-3 + 0.21e-3 * k, width = 1e-5 * (k + 1);
      set.push_back(fmt::format("rotor.torque=[[0, 0], [{}, 0], [{}, {}], [{}, 0]]", begin, begin + width / 2.,
                                1. / width, begin + width));
      list.push_back(std::make_unique<OneDrop>(set));
    }
    for (const auto& failure : run_together(list)) EXPECT_FALSE(failure);
    for (const auto& run : list) {
      const double gained = run->example->spin(run->drop.result().state).speed - initial_speed;
      EXPECT_NEAR(Ip * gained, 0.5, 1e-9) << "N m s, by " << method;
    }
  }
}

TEST(DropsInLanes, EndEachAtItsOwnTime) {
  std::vector<std::unique_ptr<OneDrop>> list;
  for (const char* end : {"9 ms", "3 ms", "12 ms"}) list.push_back(std::make_unique<OneDrop>(settings(1, end)));
  run_together(list);
  EXPECT_EQ(list[0]->drop.result().end_time, 9e-3);
  EXPECT_EQ(list[1]->drop.result().end_time, 3e-3);
  EXPECT_EQ(list[2]->drop.result().end_time, 12e-3);
  const auto short_one = runs(std::vector<std::size_t>{1}, "9 ms");
  run_together(short_one);
  EXPECT_EQ(short_one[0]->drop.result().state, list[0]->drop.result().state);
}

// Rows are sparse while little changes, and then one lies before the change: all of them must hold the values of their own time. A drop alone with rows every 10 us
// shows these by straight lines, to 100 m/s2 (10 us)^2 / 8 = 1e-9 m.
TEST_P(DropsInLanesBy, HaveRowsOfTheirOwnTimes) {
  const std::vector<std::string> paths = {"/bearings/TB1/orbit", "/rotor/spin_angle", "/ledger/TB1/contact_impulse"};
  const auto is_kept = [&](const std::string& path) {
    return std::find(paths.begin(), paths.end(), path) != paths.end();
  };
  auto sparse = settings(2, "12 ms", GetParam()), dense = sparse;
  sparse.insert(sparse.end(), {"output.interval=0.1 ms", "output.longest_interval=3 ms", "output.change=0.05"});
  dense.push_back("output.interval=10 us");
  OneDrop lane(sparse), alone(dense);
  // All lanes run: where all have stepped, states change places instead of being copied.
  const auto neighbours = runs(std::vector<std::size_t>{0, 1, 3, 4, 5, 6, 7}, "12 ms", GetParam());
  MemorySeries rows(*lane.example, lane.drop, is_kept), all(*alone.example, alone.drop, is_kept);
  std::vector<Drop*> eight = {&lane.drop};
  for (const auto& neighbour : neighbours) eight.push_back(&neighbour->drop);
  for (const auto& failure : run_in_lanes(eight)) EXPECT_FALSE(failure);
  alone.drop.run();
  for (const auto& [path, tolerance] : {std::pair{paths[0], 1e-7}, {paths[1], 1e-5}, {paths[2], 1e-2}}) {
    const SeriesInMemory found = rows.series(path), fine = all.series(path);
    ASSERT_GT(found.times.size(), 20U);
    EXPECT_LT(found.times.size(), 110U) << "no row was left out";
    for (std::size_t k = 0; k < found.times.size(); ++k) {
      const auto after =
          std::upper_bound(fine.times.begin(), fine.times.end() - 1, found.times[k]) - fine.times.begin();
      const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after, 1));
      const double part = (found.times[k] - fine.times[i - 1]) / (fine.times[i] - fine.times[i - 1]);
      EXPECT_NEAR(found.values[k], fine.values[i - 1] + part * (fine.values[i] - fine.values[i - 1]), tolerance)
          << path << " at " << found.times[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OwnPairs, DropsInLanesBy,
                         ::testing::Values("tsitouras", "bogacki-shampine", "sofroniou-spaletta",
                                           "two-step-runge-kutta"));

TEST(DropsInLanes, AreOfTheMethodsThatTheReasonNames) {
  const auto reason = [](const std::string& method) {
    const auto e = reference_machine({"integration.method=" + method});
    return why_not_in_lanes(*e, e.settings.parameters.integration);
  };
  for (const char* method : {"tsitouras", "bogacki-shampine", "sofroniou-spaletta", "two-step-runge-kutta"})
    EXPECT_EQ(reason(method), "");
  for (const char* method : {"runge-kutta-4", "dormand-prince", "fehlberg-8", "adams"})
    EXPECT_EQ(reason(method),
              "integration.method is none of \"tsitouras\", \"bogacki-shampine\", \"sofroniou-spaletta\", "
              "\"two-step-runge-kutta\"");
}

TEST(DropsInLanes, AreNotThoseWhoseFastModesAreIntegratedByExponentials) {
  const auto reason = [](const std::vector<std::string>& settings) {
    const auto e = reference_machine(settings);
    return why_not_in_lanes(*e, e.settings.parameters.integration);
  };
  EXPECT_EQ(reason({"rotor.cut_off_frequency=19 kHz"}), "");
  EXPECT_NE(reason({"rotor.cut_off_frequency=30 kHz"}).find("integration.exponential_above"), std::string::npos);
  EXPECT_EQ(reason({"rotor.model=full", "integration.exponential_above=90 kHz"}), "");
}

/// Ends its drop by a failure.
class Trap final : public Observer {
 public:
  explicit Trap(double time) : time_(time) {}
  void step(const Step& step) override {
    if (step.time > time_) throw SolverError("the trap");
  }

 private:
  double time_;
};

/// Drops of unequal lengths, each made when a lane is free and gone when it is over.
class Queue final : public LaneFeed {
 public:
  static constexpr std::size_t n = 21, trapped = 4;
  [[nodiscard]] static std::vector<std::string> settings_of(std::size_t k) {
    return settings(k % 8, fmt::format("{} ms", 2 + (5 * k) % 11));
  }
  Drop* next() override {
    if (n_begun == n) return nullptr;
    if (hesitates && n_begun == 1 && !running_.empty()) return nullptr;
    running_.emplace_back(n_begun, std::make_unique<OneDrop>(settings_of(n_begun)));
    if (n_begun == trapped) running_.back().second->drop.loop().add(trap_);
    ++n_begun;
    most_running = std::max(most_running, running_.size());
    return &running_.back().second->drop;
  }
  void over(Drop& drop, const std::exception_ptr& failure) override {
    const auto found =
        std::find_if(running_.begin(), running_.end(), [&](const auto& one) { return &one.second->drop == &drop; });
    ASSERT_NE(found, running_.end());
    if (failure) failed.push_back(found->first);
    states.at(found->first) = drop.result().state;
    steps.at(found->first) = drop.result().statistics.steps;
    n_refilled += n_begun < n;
    running_.erase(found);
  }
  bool hesitates = false;  ///< nothing beside the first drop
  std::size_t n_begun = 0, most_running = 0, n_refilled = 0;
  std::vector<std::size_t> failed;
  std::array<std::vector<double>, n> states;
  std::array<long, n> steps{};

 private:
  Trap trap_{1e-3};
  std::vector<std::pair<std::size_t, std::unique_ptr<OneDrop>>> running_;
};

TEST(DropsInLanes, BeginWhereOthersAreOver) {
  Queue queue;
  EXPECT_EQ(run_in_lanes(queue), Queue::n);
  EXPECT_EQ(queue.most_running, 8U);
  EXPECT_EQ(queue.n_refilled, Queue::n - 8);
  EXPECT_EQ(queue.failed, std::vector{Queue::trapped});
  for (std::size_t k = 0; k < Queue::n; ++k) {
    if (k == Queue::trapped) continue;
    OneDrop alone(Queue::settings_of(k));
    const std::array<Drop*, 1> list = {&alone.drop};
    EXPECT_FALSE(run_in_lanes(list).front());
    EXPECT_EQ(alone.drop.result().state, queue.states[k]) << k;
    EXPECT_EQ(alone.drop.result().statistics.steps, queue.steps[k]) << k;
  }
}

TEST(DropsInLanes, TakeUpDropsThatComeLater) {
  Queue queue;
  queue.hesitates = true;
  EXPECT_EQ(run_in_lanes(queue), Queue::n);
  EXPECT_EQ(queue.most_running, 8U);
  EXPECT_EQ(queue.failed, std::vector{Queue::trapped});
}

TEST(DropsInLanes, AreAllOverWhenTheyAreStopped) {
  Queue queue;
  int asked = 0;
  EXPECT_EQ(run_in_lanes(queue, [&] { return ++asked > 5; }), 8U);
  EXPECT_TRUE(queue.failed.empty());
  for (std::size_t k = 0; k < 8; ++k) EXPECT_GT(queue.steps[k], 0) << k;
}

/// Refuses its n-th row.
class Refuses final : public RowSink {
 public:
  explicit Refuses(int n) : n_(n) {}
  void row(double, std::span<const double>) override {
    if (--n_ == 0) throw SolverError("no more");
  }

 private:
  int n_;
};

// Rows wait until there are eight of them; what waits when all are stopped is refused when its drop is over.
TEST(DropsInLanes, AreOverOneByOneWhereTheLastRowsAreRefused) {
  const auto list = runs(std::vector<std::size_t>{0, 1, 2}, "5 ms");
  Refuses second(2);
  list[1]->drop.rows().add(second);
  std::vector<Drop*> drops;
  for (const auto& run : list) drops.push_back(&run->drop);
  std::vector<std::exception_ptr> failures;
  ASSERT_NO_THROW(failures = run_in_lanes(drops, [&] { return drops[1]->loop().time() > 0.2e-3; }));
  EXPECT_FALSE(failures[0]);
  EXPECT_TRUE(failures[1]);
  EXPECT_FALSE(failures[2]);
  EXPECT_LT(drops[1]->loop().time(), 0.4e-3) << "eight rows would have been told before";
}

}  // namespace
}  // namespace rotordrop
