#include "cache/kept_heat_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cache/kept_values.h"
#include "conduction/assembled_equations.h"
#include "conduction/heat_stepper.h"
#include "io/sha256.h"

namespace rotordrop {
namespace {

class KeptHeatSolver final : public HeatConductionSolver {
 public:
  KeptHeatSolver(const std::filesystem::path& folder, const std::string& content, HeatConductionProblem problem,
                 HeatSolverMaker make)
      : values_(folder, content), problem_(std::move(problem)), make_(std::move(make)) {}

  // Kept. What a problem is at its start does not change while it is stepped.
  [[nodiscard]] double body_capacity(std::size_t body) const override {
    return values_.get<double>(fmt::format("body capacity {}", body), [&] { return real().body_capacity(body); });
  }
  [[nodiscard]] double port_area(std::size_t port) const override {
    return values_.get<double>(fmt::format("port area {}", port), [&] { return real().port_area(port); });
  }
  [[nodiscard]] HeatStatistics statistics() const override {
    if (real_ && !own_) return real_->statistics();
    HeatStatistics s = own_ ? own_->stepper.statistics() : HeatStatistics{};
    const auto [unknowns, cells, values] = sizes();
    s.unknowns = unknowns;
    s.cells = cells;
    return s;
  }
  [[nodiscard]] const SectionMesh& section_mesh() const override {
    if (!problem_.mesh.empty()) return problem_.mesh;
    if (mesh_.empty()) mesh_ = values_.get<SectionMesh>("mesh", [&] { return real().section_mesh(); });
    return mesh_;
  }
  ReducedHeat reduce(const ReductionSettings& settings) override {
    reduction_ = settings;
    reduction_name_ = plain::digest_of(settings);
    bool is_fresh = false;
    ReducedHeat reduced = values_.get<ReducedHeat>("reduced " + reduction_name_, [&] {
      is_fresh = true;
      return real().reduce(settings);
    });
    has_reduced_ = is_fresh;
    return reduced;
  }
  [[nodiscard]] std::vector<double> project(std::span<const double> weights) const override {
    return values_.get<std::vector<double>>("projected " + reduction_name_ + plain::digest_of(weights),
                                            [&] { return reduced().project(weights); });
  }

  // Of the matrices, or of the real solver where there are none.
  [[nodiscard]] double time() const override {
    if (own_) return own_->stepper.time();
    return real_ ? real_->time() : 0.;
  }
  void advance_to(double time) override {
    on_stepper([&](auto& stepper) { stepper.advance_to(time); });
  }
  void ask_between_steps(std::function<void()> ask) override {
    on_stepper([&](auto& stepper) { stepper.ask_between_steps(ask); });
  }
  void advance_window(double step) override {
    on_stepper([&](auto& stepper) { stepper.advance_window(step); });
  }
  void set_port_heat(std::span<const double> watts, std::span<const double> rates) override {
    on_stepper([&](auto& stepper) { stepper.set_port_heat(watts, rates); });
  }
  void set_field(std::span<const double> temperatures, double time, double input, double lost) override {
    on_stepper([&](auto& stepper) { stepper.set_field(temperatures, time, input, lost); });
  }
  [[nodiscard]] std::vector<double> field() const override {
    if (own_) return {own_->stepper.field().begin(), own_->stepper.field().end()};
    if (real_ || is_held()) return real().field();
    return std::vector<double>(std::get<2>(sizes()), problem_.initial_temperature);  // plain problems start evenly
  }
  [[nodiscard]] HeatEnergy energy() const override { return own() ? own_->stepper.energy() : real().energy(); }
  [[nodiscard]] double temperature(std::size_t body, double x, double r) const override {
    return own() ? value(kept_mean_at(body, x, r)) : real().temperature(body, x, r);
  }
  [[nodiscard]] double mean_temperature(const HeatBoundary& boundary) const override {
    return own() ? value(kept_mean_over({boundary})) : real().mean_temperature(boundary);
  }
  [[nodiscard]] SurfaceRange surface(const std::vector<HeatBoundary>& boundaries) const override {
    if (!own()) return real().surface(boundaries);
    const HeatMean& mean = kept_mean_over(boundaries);
    return {value(mean), mean.lowest(own_->stepper.field()), mean.highest(own_->stepper.field())};
  }
  [[nodiscard]] double body_mean(std::size_t body) const override {
    return own() ? value(own_->assembled.bodies[body]) : real().body_mean(body);
  }
  [[nodiscard]] double port_temperature(std::size_t port) const override {
    return own() ? value(own_->assembled.ports[port]) : real().port_temperature(port);
  }
  [[nodiscard]] HeatMean mean_at(std::size_t body, double x, double r) const override {
    return kept_mean_at(body, x, r);
  }
  [[nodiscard]] HeatMean mean_over(const std::vector<HeatBoundary>& boundaries) const override {
    return kept_mean_over(boundaries);
  }
  [[nodiscard]] std::optional<AssembledHeat> assembled() const override {
    return values_.get<std::optional<AssembledHeat>>("assembled", [&] { return real().assembled(); });
  }

  // Of the real solver.
  void lift(std::span<const double> state, std::span<const double> watts, double time) override {
    reduced().lift(state, watts, time);
    is_lifted_ = true;
    if (own_) take_lifted_field();
  }
  void write_vtu(const std::string& file) const override { real_with_field().write_vtu(file); }
  [[nodiscard]] bool on_any_rank(bool own) const override { return real_ ? real_->on_any_rank(own) : own; }
  [[nodiscard]] double difference(const std::function<double(std::size_t body, double x, double r)>& f) const override {
    return real_with_field().difference(f);
  }

 private:
  using Sizes = std::array<std::size_t, 3>;  ///< unknowns, cells, numbers in a field
  [[nodiscard]] Sizes sizes() const {
    return values_.get<Sizes>("sizes", [&] {
      if (!real_) real_ = make_(problem_);
      const HeatStatistics s = real_->statistics();
      return Sizes{s.unknowns, s.cells, real_->field().size()};
    });
  }
  [[nodiscard]] HeatConductionSolver& real() const {
    if (!real_) {
      real_ = make_(problem_);
      static_cast<void>(sizes());  // once there is a solver to ask
    }
    return *real_;
  }
  /// The real solver with the last reduction, which it must have done itself.
  [[nodiscard]] HeatConductionSolver& reduced() const {
    if (!has_reduced_ && reduction_) static_cast<void>(real().reduce(*reduction_));
    has_reduced_ = true;
    return real();
  }

  /// Whether something is held at a temperature from the start on.
  [[nodiscard]] bool is_held() const {
    return !problem_.fixed.empty() || std::any_of(problem_.bodies.begin(), problem_.bodies.end(),
                                                  [](const HeatBody& body) { return body.held_at.has_value(); });
  }
  /// What is stepped here, without the real solver.
  struct Own {
    Own(const HeatConductionProblem& problem, AssembledHeat heat)
        : assembled(std::move(heat)), equations(problem, assembled), stepper(equations, problem) {}
    const AssembledHeat assembled;
    AssembledEquations equations;
    HeatStepper stepper;
  };
  /// Whether there are matrices to step by.
  [[nodiscard]] bool own() const {
    if (!is_own_known_) {
      is_own_known_ = true;
      if (auto heat = assembled()) own_ = std::make_unique<Own>(problem_, std::move(*heat));
      if (own_ && is_lifted_) take_lifted_field();
    }
    return own_ != nullptr;
  }
  void take_lifted_field() const {
    const HeatEnergy e = own_->stepper.energy();
    own_->stepper.set_field(real_->field(), real_->time(), e.input, e.lost);
  }
  void on_stepper(const auto& f) {
    if (own())
      f(own_->stepper);
    else
      f(real());
  }
  [[nodiscard]] double value(const HeatMean& mean) const {
    return mean.of(own_->stepper.field(), problem_.initial_temperature);
  }
  [[nodiscard]] const HeatMean& kept_mean_at(std::size_t body, double x, double r) const {
    return kept_mean(fmt::format("mean at {} {} {}", body, x, r), [&] { return real().mean_at(body, x, r); });
  }
  [[nodiscard]] const HeatMean& kept_mean_over(const std::vector<HeatBoundary>& boundaries) const {
    return kept_mean("mean over " + plain::bytes_of(boundaries), [&] { return real().mean_over(boundaries); });
  }
  [[nodiscard]] const HeatMean& kept_mean(const std::string& name, const auto& compute) const {
    auto found = means_.find(name);
    if (found == means_.end()) found = means_.emplace(name, values_.get<HeatMean>(name, compute)).first;
    return found->second;
  }
  [[nodiscard]] HeatConductionSolver& real_with_field() const {
    HeatConductionSolver& solver = real();
    if (!own_) return solver;
    const HeatEnergy e = own_->stepper.energy();
    solver.set_field(own_->stepper.field(), own_->stepper.time(), e.input, e.lost);
    return solver;
  }

  mutable KeptValues values_;
  HeatConductionProblem problem_;
  HeatSolverMaker make_;
  mutable std::unique_ptr<HeatConductionSolver> real_;
  mutable SectionMesh mesh_;
  std::optional<ReductionSettings> reduction_;
  std::string reduction_name_;
  mutable bool has_reduced_ = false;
  mutable std::unique_ptr<Own> own_;
  mutable bool is_own_known_ = false;
  bool is_lifted_ = false;
  mutable std::map<std::string, HeatMean> means_;
};

}  // namespace

std::unique_ptr<HeatConductionSolver> kept_heat_solver(const std::filesystem::path& folder, const std::string& module,
                                                       const HeatConductionProblem& problem,
                                                       const HeatSolverMaker& make) {
  const auto digest = plain::digest_of(problem);
  if (!digest) return make(problem);
  return std::make_unique<KeptHeatSolver>(folder, sha256_of(module + "\nheat\n" + *digest), problem, make);
}

}  // namespace rotordrop
