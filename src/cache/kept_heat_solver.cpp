#include "cache/kept_heat_solver.h"

#include <fmt/format.h>

#include <utility>

#include "cache/kept_values.h"
#include "io/sha256.h"

namespace rotordrop {
namespace {

class KeptHeatSolver final : public HeatConductionSolver {
 public:
  KeptHeatSolver(const std::filesystem::path& folder, const std::string& content, HeatConductionProblem problem,
                 HeatSolverMaker make)
      : values_(folder, content), problem_(std::move(problem)), make_(std::move(make)) {}

  // Kept. What a problem is at its start does not change while the real solver advances.
  [[nodiscard]] double body_capacity(std::size_t body) const override {
    return values_.get<double>(fmt::format("body capacity {}", body), [&] { return real().body_capacity(body); });
  }
  [[nodiscard]] double port_area(std::size_t port) const override {
    return values_.get<double>(fmt::format("port area {}", port), [&] { return real().port_area(port); });
  }
  [[nodiscard]] HeatStatistics statistics() const override {
    if (real_) return real_->statistics();
    HeatStatistics start;
    const auto [unknowns, cells, values] = sizes();
    start.unknowns = unknowns;
    start.cells = cells;
    return start;
  }
  [[nodiscard]] const SectionMesh& section_mesh() const override {
    if (!problem_.mesh.empty()) return problem_.mesh;
    if (mesh_.empty()) mesh_ = values_.get<SectionMesh>("mesh", [&] { return real().section_mesh(); });
    return mesh_;
  }
  [[nodiscard]] std::vector<double> field() const override {
    if (real_) return real_->field();
    return std::vector<double>(std::get<2>(sizes()), problem_.initial_temperature);  // plain problems start evenly
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

  // Of the real solver.
  [[nodiscard]] double time() const override { return real_ ? real_->time() : 0.; }
  void advance_to(double time) override { real().advance_to(time); }
  [[nodiscard]] double temperature(std::size_t body, double x, double r) const override {
    return real().temperature(body, x, r);
  }
  [[nodiscard]] double mean_temperature(const HeatBoundary& boundary) const override {
    return real().mean_temperature(boundary);
  }
  [[nodiscard]] SurfaceRange surface(const std::vector<HeatBoundary>& boundaries) const override {
    return real().surface(boundaries);
  }
  [[nodiscard]] double body_mean(std::size_t body) const override { return real().body_mean(body); }
  [[nodiscard]] double port_temperature(std::size_t port) const override { return real().port_temperature(port); }
  [[nodiscard]] HeatEnergy energy() const override { return real().energy(); }
  void set_port_heat(std::span<const double> watts, std::span<const double> rates) override {
    real().set_port_heat(watts, rates);
  }
  void advance_window(double step) override { real().advance_window(step); }
  void set_field(std::span<const double> temperatures, double time, double input, double lost) override {
    real().set_field(temperatures, time, input, lost);
  }
  void lift(std::span<const double> state, std::span<const double> watts, double time) override {
    reduced().lift(state, watts, time);
  }
  void write_vtu(const std::string& file) const override { real().write_vtu(file); }
  [[nodiscard]] bool on_any_rank(bool own) const override { return real_ ? real_->on_any_rank(own) : own; }
  [[nodiscard]] double difference(const std::function<double(std::size_t body, double x, double r)>& f) const override {
    return real().difference(f);
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

  mutable KeptValues values_;
  HeatConductionProblem problem_;
  HeatSolverMaker make_;
  mutable std::unique_ptr<HeatConductionSolver> real_;
  mutable SectionMesh mesh_;
  std::optional<ReductionSettings> reduction_;
  std::string reduction_name_;
  mutable bool has_reduced_ = false;
};

}  // namespace

std::unique_ptr<HeatConductionSolver> kept_heat_solver(const std::filesystem::path& folder, const std::string& module,
                                                       const HeatConductionProblem& problem,
                                                       const HeatSolverMaker& make) {
  const auto digest = folder.empty() ? std::nullopt : plain::digest_of(problem);
  if (!digest) return make(problem);
  return std::make_unique<KeptHeatSolver>(folder, sha256_of(module + "\nheat\n" + *digest), problem, make);
}

}  // namespace rotordrop
