// Solvers with a memory: the same answers, and the real solver only when something new is asked.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "cache/kept_elastic_solver.h"
#include "cache/kept_heat_solver.h"
#include "cache/kept_mesh.h"
#include "cache/kept_values.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

class Folder : public ::testing::Test {
 protected:
  Folder() : folder_(fs::path(testing::TempDir()) / ("rotordrop_cache_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Folder() override { fs::remove_all(folder_); }
  [[nodiscard]] std::vector<fs::path> files() const {
    std::vector<fs::path> list;
    for (const auto& entry : fs::directory_iterator(folder_)) list.push_back(entry.path());
    return list;
  }
  fs::path folder_;
};

/// Answers with numbers that name the question; counts how often it is made and reduces.
struct Calls {
  int made = 0, reduced = 0, lifted = 0;
  std::optional<AssembledHeat> matrices = {};
  std::vector<double> written = {};  ///< the field that write_vtu() saw
};
class FakeHeat final : public HeatConductionSolver {
 public:
  FakeHeat(const HeatConductionProblem& problem, Calls& calls) : calls_(calls), field_(7, problem.initial_temperature) {
    ++calls_.made;
  }
  [[nodiscard]] double time() const override { return time_; }
  void advance_to(double time) override { time_ = time; }
  void ask_between_steps(std::function<void()>) override {}
  [[nodiscard]] double temperature(std::size_t, double x, double) const override { return x; }
  [[nodiscard]] double mean_temperature(const HeatBoundary&) const override { return 1.; }
  [[nodiscard]] SurfaceRange surface(const std::vector<HeatBoundary>&) const override { return {}; }
  [[nodiscard]] double body_mean(std::size_t) const override { return field_[0]; }
  [[nodiscard]] double body_capacity(std::size_t body) const override { return 100. + static_cast<double>(body); }
  [[nodiscard]] double port_temperature(std::size_t) const override { return 2.; }
  [[nodiscard]] double port_area(std::size_t port) const override { return 0.1 + static_cast<double>(port); }
  [[nodiscard]] HeatEnergy energy() const override { return {}; }
  [[nodiscard]] HeatStatistics statistics() const override {
    HeatStatistics s;
    s.unknowns = 5;
    s.cells = 3;
    return s;
  }
  void set_port_heat(std::span<const double>, std::span<const double>) override {}
  void advance_window(double) override { field_[0] += 1.; }
  [[nodiscard]] std::vector<double> field() const override { return field_; }
  void set_field(std::span<const double> T, double, double, double) override { field_.assign(T.begin(), T.end()); }
  ReducedHeat reduce(const ReductionSettings& settings) override {
    ++calls_.reduced;
    scale_ = settings.longest_time;
    ReducedHeat heat;
    heat.rate = {1., 1. / 3., scale_};
    heat.capacity = 7.;
    heat.ports.push_back({"bore", {1., 2., 3.}, 4., 5., {6.}, 7., {8.}, 9.});
    heat.worst_response = "bore";
    return heat;
  }
  void lift(std::span<const double>, std::span<const double>, double) override {
    if (scale_ == 0.) throw std::logic_error("lifted without a reduction");
    ++calls_.lifted;
    field_ = {301., 302.};
  }
  [[nodiscard]] std::vector<double> project(std::span<const double> weights) const override {
    if (scale_ == 0.) throw std::logic_error("projected without a reduction");
    return {scale_ * std::accumulate(weights.begin(), weights.end(), 0.)};
  }
  [[nodiscard]] const SectionMesh& section_mesh() const override { return mesh_; }
  void write_vtu(const std::string&) const override { calls_.written = field_; }
  [[nodiscard]] bool on_any_rank(bool own) const override { return own; }
  [[nodiscard]] double difference(const std::function<double(std::size_t, double, double)>&) const override {
    return 0.;
  }
  [[nodiscard]] HeatMean mean_at(std::size_t, double, double) const override { return {{0, 1}, {0.25, 0.75}}; }
  [[nodiscard]] HeatMean mean_over(const std::vector<HeatBoundary>&) const override { return {{0, 1}, {0.5, 0.5}}; }
  [[nodiscard]] std::optional<AssembledHeat> assembled() const override { return calls_.matrices; }

 private:
  Calls& calls_;
  std::vector<double> field_;
  SectionMesh mesh_{{{0., 1.}, {1., 1.}}, {{{0, 1, 1, 0}, 0}}, {}, {{1., 2., 3.}}, {"ring"}};
  double time_ = 0., scale_ = 0.;
};

HeatConductionProblem problem() {
  HeatConductionProblem p;
  p.bodies.push_back({"ring", {0., 0.01}, {0.02, 0.03}, 7800., PropertyTable(46.), PropertyTable(460.), {}});
  p.ports.push_back({"bore", {{0, HeatSide::inner}}, {}, 0.});
  return p;
}

using KeptHeat = Folder;

TEST_F(KeptHeat, TheSecondTimeNothingIsComputedAndEveryBitIsTheSame) {
  std::vector<std::string> answers;
  Calls calls;
  for (int round = 0; round < 3; ++round) {
    const auto solver = kept_heat_solver(folder_, "room 1", problem(), [&](const HeatConductionProblem& p) {
      return std::make_unique<FakeHeat>(p, calls);
    });
    plain::Writer seen;
    seen.add(solver->body_capacity(0));
    seen.add(solver->port_area(0));
    seen.add(solver->statistics().unknowns);
    seen.add(solver->statistics().cells);
    seen.add(solver->field());
    seen.add(solver->section_mesh());
    seen.add(solver->reduce({}));
    seen.add(solver->project(std::vector<double>{0.1, 0.2}));
    answers.push_back(seen.bytes());
    EXPECT_EQ(calls.made, 1) << round;
    EXPECT_EQ(calls.reduced, 1) << round;
    EXPECT_EQ(answers.back(), answers.front());
  }
}

TEST_F(KeptHeat, AnythingElseMakesTheRealSolverWithItsReduction) {
  Calls calls;
  const auto make = [&](const HeatConductionProblem& p) { return std::make_unique<FakeHeat>(p, calls); };
  static_cast<void>(kept_heat_solver(folder_, "room", problem(), make)->reduce({}));
  ASSERT_EQ(calls.made, 1);
  const auto solver = kept_heat_solver(folder_, "room", problem(), make);
  static_cast<void>(solver->reduce({}));
  EXPECT_EQ(calls.reduced, 1);
  solver->lift({}, {}, 0.);  // throws unless the real one has reduced
  EXPECT_EQ(calls.made, 2);
  EXPECT_EQ(calls.reduced, 2);
  const double lifted = solver->field()[0];
  solver->advance_window(1.);
  EXPECT_EQ(solver->field()[0], lifted + 1.) << "the field of a solver that advanced is its own";
  // Weights that were not projected before.
  const auto other = kept_heat_solver(folder_, "room", problem(), make);
  static_cast<void>(other->reduce({}));
  EXPECT_EQ(other->project(std::vector<double>{1., 2.})[0], 3. * ReductionSettings{}.longest_time);
}

TEST_F(KeptHeat, AnyChangeOfTheProblemTheSettingsOrTheRoomIsAnotherContent) {
  Calls calls;
  const auto made_by = [&](const std::string& module, const HeatConductionProblem& p, const ReductionSettings& s) {
    calls = {};
    static_cast<void>(kept_heat_solver(folder_, module, p, [&](const HeatConductionProblem& q) {
                        return std::make_unique<FakeHeat>(q, calls);
                      })->reduce(s));
    return calls.made;
  };
  ASSERT_EQ(made_by("room", problem(), {}), 1);
  ASSERT_EQ(made_by("room", problem(), {}), 0);
  EXPECT_EQ(made_by("another room", problem(), {}), 1);
  ReductionSettings settings;
  settings.response_tolerance *= 1. + 1e-15;
  EXPECT_EQ(made_by("room", problem(), settings), 1);
  auto changed = problem();
  changed.bodies[0].conductivity = PropertyTable(46. * (1. + 1e-15));
  EXPECT_EQ(made_by("room", changed, {}), 1);
  changed = problem();
  changed.ports[0].boundaries[0].row = 1;
  EXPECT_EQ(made_by("room", changed, {}), 1);
  changed = problem();
  changed.mesh.vertices = {{1., 2.}};
  EXPECT_EQ(made_by("room", changed, {}), 1);
  changed = problem();
  changed.bodies[0].held_at = 300.;
  EXPECT_EQ(made_by("room", changed, {}), 1);
  // A function has no content that could be compared: never kept.
  changed = problem();
  changed.volume_source = [](std::size_t, double, double, double) { return 1.; };
  EXPECT_EQ(made_by("room", changed, {}), 1);
  EXPECT_EQ(made_by("room", changed, {}), 1);
}

TEST_F(KeptHeat, ADamagedFileIsComputedAnew) {
  Calls calls;
  const auto reduce = [&] {
    calls = {};
    return plain::bytes_of(kept_heat_solver(folder_, "room", problem(), [&](const HeatConductionProblem& p) {
                             return std::make_unique<FakeHeat>(p, calls);
                           })->reduce({}));
  };
  const auto good = reduce();
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files().front();
  const auto size = fs::file_size(file);
  for (const std::uintmax_t at : {std::uintmax_t{0}, std::uintmax_t{20}, size / 2, size - 1}) {
    {
      std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
      out.seekg(static_cast<std::streamoff>(at));
      const char old = static_cast<char>(out.get());
      out.seekp(static_cast<std::streamoff>(at));
      out.put(static_cast<char>(old ^ 0x10));
    }
    EXPECT_EQ(reduce(), good) << at;
    EXPECT_EQ(calls.made, 1) << at;
    EXPECT_EQ(reduce(), good) << "mended";
    EXPECT_EQ(calls.made, 0) << at;
  }
  fs::resize_file(file, size / 3);
  EXPECT_EQ(reduce(), good);
  EXPECT_EQ(calls.made, 1);
}

TEST_F(KeptHeat, WithoutAFolderNothingIsKept) {
  for (int round = 0; round < 2; ++round) {
    Calls calls;
    const auto solver = kept_heat_solver(
        {}, "room", problem(), [&](const HeatConductionProblem& p) { return std::make_unique<FakeHeat>(p, calls); });
    EXPECT_EQ(solver->body_capacity(0), 100.);
    EXPECT_EQ(calls.made, 1);
  }
  EXPECT_TRUE(files().empty());
}

/// Two lumps of 2 J/K with 0.5 W/K to the surroundings each; the flux's area is that of the first, the port's node the second.
AssembledHeat two_lumps() {
  AssembledHeat a;
  a.row_start = {0, 1, 2};
  a.column = {0, 1};
  a.capacity = a.capacity_weights = {2., 2.};
  a.conductance = a.loss_weights = {0.5, 0.5};
  a.ambient_load = {0., 0.};
  a.flux_loads = {{3., 0.}};
  a.flux_areas = {3.};
  a.ports = {{{1}, {1.}}};
  a.port_areas = {1.};
  a.bodies = {{{0, 1}, {0.5, 0.5}}};
  a.body_of = {0, 0};
  a.shortest_time = 1e-3;
  return a;
}

TEST_F(KeptHeat, MatricesAreSteppedWithoutTheRealSolverForAnyFluxAndTolerance) {
  Calls calls;
  calls.matrices = two_lumps();
  const auto make = [&](const HeatConductionProblem& p) { return std::make_unique<FakeHeat>(p, calls); };
  for (const double q : {10., 20., 10.}) {
    auto p = problem();
    p.fluxes.push_back({{0, HeatSide::inner}, {0.}, {q}});
    p.numerics.tolerance = 1e-9 * q;
    const auto solver = kept_heat_solver(folder_, "room", p, make);
    solver->advance_to(4.);
    const double rise = q * 3. / 0.5 * (1. - std::exp(-1.));  // of the first lump
    EXPECT_EQ(solver->time(), 4.);
    // A step may err by 1e-9 q of the rise, 1.5e-6 K at most; those of 4 s together leave 2e-7.
    EXPECT_NEAR(solver->temperature(0, 1., 2.), 293.15 + 0.25 * rise, 1e-6);
    EXPECT_NEAR(solver->surface({{0, HeatSide::inner}}).mean, 293.15 + 0.5 * rise, 1e-6);
    EXPECT_NEAR(solver->surface({{0, HeatSide::inner}}).highest, 293.15 + rise, 1e-6);
    EXPECT_NEAR(solver->surface({{0, HeatSide::inner}}).lowest, 293.15, 1e-9);
    EXPECT_NEAR(solver->mean_temperature({0, HeatSide::inner}), 293.15 + 0.5 * rise, 1e-6);
    EXPECT_NEAR(solver->body_mean(0), 293.15 + 0.5 * rise, 1e-6);
    EXPECT_NEAR(solver->port_temperature(0), 293.15, 1e-9);
    EXPECT_NEAR(solver->energy().input, 12. * q, 1e-9);
    EXPECT_NEAR(solver->energy().residual(), 0., 1e-9);
    EXPECT_EQ(solver->statistics().unknowns, 5U) << "as the real one said";
    EXPECT_GT(solver->statistics().steps, 10);
    EXPECT_EQ(calls.made, 1);
  }
  // The surroundings count: they are in the matrices.
  auto warmer = problem();
  warmer.fluxes.push_back({{0, HeatSide::inner}, {0.}, {10.}});
  warmer.initial_temperature += 1.;
  kept_heat_solver(folder_, "room", warmer, make)->advance_to(1.);
  EXPECT_EQ(calls.made, 2);
}

TEST_F(KeptHeat, AFieldThatIsHeldSomewhereIsTheRealSolvers) {
  Calls calls;
  const auto make = [&](const HeatConductionProblem& p) { return std::make_unique<FakeHeat>(p, calls); };
  auto p = problem();
  p.fixed.push_back({{0, HeatSide::inner}, 350.});
  for (int round = 1; round <= 2; ++round) {
    EXPECT_EQ(kept_heat_solver(folder_, "room", p, make)->field().size(), 7U);
    EXPECT_EQ(calls.made, round);
  }
}

TEST_F(KeptHeat, TheRealSolverGetsTheFieldThatWasSteppedWithoutIt) {
  Calls calls;
  calls.matrices = two_lumps();
  const auto make = [&](const HeatConductionProblem& p) { return std::make_unique<FakeHeat>(p, calls); };
  auto p = problem();
  p.fluxes.push_back({{0, HeatSide::inner}, {0.}, {10.}});
  const auto solver = kept_heat_solver(folder_, "room", p, make);
  const double watts[] = {6.};
  solver->set_port_heat(watts);
  for (int i = 0; i < 8; ++i) solver->advance_window(0.5);
  EXPECT_NEAR(solver->port_temperature(0), 293.15 + 12. * (1. - std::exp(-1.)), 0.01) << "eight windows";
  solver->write_vtu("none");
  EXPECT_EQ(calls.written, solver->field());
  // A field that the real solver lifts goes on here.
  static_cast<void>(solver->reduce({}));
  solver->lift({}, {}, 7.);
  EXPECT_EQ(solver->field(), (std::vector<double>{301., 302.}));
  EXPECT_EQ(solver->temperature(0, 1., 2.), 293.15 + (0.25 * (301. - 293.15) + 0.75 * (302. - 293.15)));
  // Likewise one that was lifted before anything was stepped.
  const auto other = kept_heat_solver(folder_, "room", p, make);
  static_cast<void>(other->reduce({}));
  other->lift({}, {}, 7.);
  EXPECT_EQ(other->field(), (std::vector<double>{301., 302.}));
  EXPECT_NEAR(other->body_mean(0), 301.5, 1e-9);
  EXPECT_NEAR(other->energy().stored, 2. * (301. + 302. - 2. * 293.15), 1e-9);
}

class FakeElastic final : public ElasticSolver {
 public:
  explicit FakeElastic(int& made) { ++made; }
  [[nodiscard]] std::size_t n_nodes() const override { return 4; }
  [[nodiscard]] std::vector<double> interpolate(
      const std::function<double(std::size_t, double, double)>&) const override {
    return {};
  }
  void solve(std::span<const double>, double speed) override { speed_ = speed; }
  [[nodiscard]] bool fits_changed() const override { return false; }
  [[nodiscard]] AxialRadial displacement(std::size_t, double, double) const override { return {}; }
  [[nodiscard]] AxialRadial mean_displacement(const std::vector<HeatBoundary>&) const override { return {}; }
  [[nodiscard]] double output(std::size_t) const override { return speed_; }
  [[nodiscard]] FitState fit(std::size_t) const override { return {}; }
  [[nodiscard]] Stress stress(std::size_t, double, double) const override { return {}; }
  [[nodiscard]] SurfaceRange hoop_stress(const HeatBoundary&) const override { return {}; }
  [[nodiscard]] ElasticInfluence influence(std::size_t k) const override { return {speed_, 1., {1. + double(k)}}; }
  [[nodiscard]] ElasticInfluence pressure_influence(std::size_t) const override { return {speed_, 2., {3.}}; }
  [[nodiscard]] std::vector<ElasticInfluence> node_pressure_influences(std::size_t) const override {
    return {{speed_, 4., {5.}}, {speed_, 6., {7.}}};
  }
  [[nodiscard]] FitOpenings openings(std::size_t) const override { return {{{8. + speed_}}, {{9.}}, {{10.}}, {11.}}; }
  [[nodiscard]] std::vector<double> node_shares(std::size_t) const override { return {0.25 + speed_, 0.75}; }
  [[nodiscard]] double difference(const ElasticFunction&) const override { return 0.; }

 private:
  double speed_ = 0.;
};

using KeptElastic = Folder;

TEST_F(KeptElastic, InfluencesComeFromTheCacheUntilASolveHasMovedTheFits) {
  ElasticProblem problem;
  problem.fits.push_back({"seat", {0, HeatSide::outer}, {1, HeatSide::inner}, 1e-6, FitKind::frictionless});
  int made = 0;
  std::vector<std::string> answers;
  for (int round = 0; round < 2; ++round) {
    const auto solver = kept_elastic_solver(folder_, "room", problem,
                                            [&](const ElasticProblem&) { return std::make_unique<FakeElastic>(made); });
    plain::Writer seen;
    seen.add(solver->n_nodes());
    for (std::size_t k = 0; k < 2; ++k) seen.add(solver->influence(k));
    seen.add(solver->pressure_influence(0));
    seen.add(solver->node_pressure_influences(0));
    seen.add(solver->openings(0));
    seen.add(solver->node_shares(0));
    answers.push_back(seen.bytes());
    EXPECT_EQ(made, 1) << round;
    if (round == 0) continue;
    solver->solve({}, 9.);
    EXPECT_EQ(made, 2);
    EXPECT_EQ(solver->influence(0).at_rest, 9.);
    EXPECT_EQ(solver->pressure_influence(0).at_rest, 9.);
    EXPECT_EQ(solver->node_pressure_influences(0)[0].at_rest, 9.);
    EXPECT_EQ(solver->openings(0).force[0][0], 17.);
    EXPECT_EQ(solver->node_shares(0)[0], 9.25);
  }
  EXPECT_EQ(answers[0], answers[1]);
  problem.fits[0].interference = 2e-6;
  const auto other = kept_elastic_solver(folder_, "room", problem,
                                         [&](const ElasticProblem&) { return std::make_unique<FakeElastic>(made); });
  static_cast<void>(other->influence(0));
  EXPECT_EQ(made, 3) << "another fit is another content";
}

using KeptMesh = Folder;

TEST_F(KeptMesh, IsThatOfItsPlan) {
  SectionPlan plan;
  plan.points = {{0., 1.}, {1., 1.}};
  plan.curves.push_back({0, 1, 4, 1.5, -1, HeatBoundary{0, HeatSide::strip, 1}});
  int made = 0;
  const auto mesh = [&](const SectionPlan& p) {
    return kept_mesh(folder_, "mesher", p, [&](const SectionPlan& q) {
      ++made;
      SectionMesh m;
      for (const auto& point : q.points) m.vertices.push_back({point.x, point.r});
      m.cells.resize(static_cast<std::size_t>(q.curves[0].cells));
      m.edges.push_back({{0, 1}, *q.curves[0].boundary, 2});
      m.bodies = {"ring"};
      return m;
    });
  };
  EXPECT_EQ(plain::bytes_of(mesh(plan)), plain::bytes_of(mesh(plan)));
  EXPECT_EQ(made, 1);
  plan.curves[0].ratio = 1.6;
  EXPECT_EQ(mesh(plan).edges.at(0).boundary, (HeatBoundary{0, HeatSide::strip, 1}));
  EXPECT_EQ(made, 2);
}

using Cache = Folder;

TEST_F(Cache, LosesTheLongestUnusedFilesFirst) {
  const auto now = fs::file_time_type::clock::now();
  for (int k = 0; k < 5; ++k) {
    const fs::path file = folder_ / (std::to_string(k) + ".kept");
    std::ofstream(file) << std::string(1000, 'x');
    fs::last_write_time(file, now - std::chrono::hours(10 - k));
  }
  std::ofstream(folder_ / "of the user") << std::string(5000, 'x');
  shrink_cache(folder_, 2500);
  EXPECT_FALSE(fs::exists(folder_ / "2.kept"));
  EXPECT_TRUE(fs::exists(folder_ / "3.kept"));
  EXPECT_TRUE(fs::exists(folder_ / "4.kept"));
  EXPECT_TRUE(fs::exists(folder_ / "of the user"));
  // What is read counts as used.
  {
    KeptValues(folder_, "a").get<double>("x", [] { return 1.; });
  }
  {
    KeptValues(folder_, "b").get<double>("x", [] { return 2.; });
  }
  fs::last_write_time(folder_ / "a.kept", now - std::chrono::hours(2));
  fs::last_write_time(folder_ / "b.kept", now - std::chrono::hours(1));
  EXPECT_EQ(KeptValues(folder_, "a").get<double>("x", [] { return 3.; }), 1.);
  shrink_cache(folder_, fs::file_size(folder_ / "a.kept"));
  EXPECT_TRUE(fs::exists(folder_ / "a.kept"));
  EXPECT_FALSE(fs::exists(folder_ / "b.kept"));
}

TEST_F(Cache, IsWhereTheUserSays) {
  ::setenv("ROTORDROP_CACHE", (folder_ / "own").c_str(), 1);
  EXPECT_EQ(cache_folder(), folder_ / "own");
  EXPECT_TRUE(fs::is_directory(folder_ / "own"));
  ::setenv("ROTORDROP_CACHE", "off", 1);
  EXPECT_EQ(cache_folder(), fs::path());
  std::ofstream(folder_ / "a file") << "x";
  ::setenv("ROTORDROP_CACHE", (folder_ / "a file" / "below").c_str(), 1);
  EXPECT_EQ(cache_folder(), fs::path());
  ::unsetenv("ROTORDROP_CACHE");
  ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  EXPECT_EQ(cache_folder(), folder_ / "rotordrop");
}

}  // namespace
}  // namespace rotordrop
