#include "cache/kept_elastic_solver.h"

#include <fmt/format.h>

#include <utility>

#include "cache/kept_values.h"
#include "io/sha256.h"

namespace rotordrop {
namespace {

class KeptElasticSolver final : public ElasticSolver {
 public:
  KeptElasticSolver(const std::filesystem::path& folder, const std::string& content, ElasticProblem problem,
                    ElasticSolverMaker make)
      : values_(folder, content), problem_(std::move(problem)), make_(std::move(make)) {}

  // Kept, as long as no solve() has moved the fits.
  [[nodiscard]] std::size_t n_nodes() const override {
    return values_.get<std::size_t>("nodes", [&] { return real().n_nodes(); });
  }
  [[nodiscard]] ElasticInfluence influence(std::size_t output) const override {
    if (is_solved_) return real().influence(output);
    return values_.get<ElasticInfluence>(fmt::format("influence {}", output), [&] { return real().influence(output); });
  }
  [[nodiscard]] ElasticInfluence pressure_influence(std::size_t fit) const override {
    if (is_solved_) return real().pressure_influence(fit);
    return values_.get<ElasticInfluence>(fmt::format("pressure {}", fit),
                                         [&] { return real().pressure_influence(fit); });
  }
  [[nodiscard]] std::vector<ElasticInfluence> node_pressure_influences(std::size_t fit) const override {
    if (is_solved_) return real().node_pressure_influences(fit);
    return values_.get<std::vector<ElasticInfluence>>(fmt::format("node pressures {}", fit),
                                                      [&] { return real().node_pressure_influences(fit); });
  }
  [[nodiscard]] FitOpenings openings(std::size_t fit) const override {
    if (is_solved_) return real().openings(fit);
    return values_.get<FitOpenings>(fmt::format("openings {}", fit), [&] { return real().openings(fit); });
  }
  [[nodiscard]] std::vector<double> node_shares(std::size_t fit) const override {
    if (is_solved_) return real().node_shares(fit);
    return values_.get<std::vector<double>>(fmt::format("node shares {}", fit),
                                            [&] { return real().node_shares(fit); });
  }

  // Of the real solver.
  [[nodiscard]] std::vector<double> interpolate(
      const std::function<double(std::size_t body, double x, double r)>& f) const override {
    return real().interpolate(f);
  }
  void solve(std::span<const double> temperatures, double speed) override {
    is_solved_ = true;
    real().solve(temperatures, speed);
  }
  [[nodiscard]] bool fits_changed() const override { return real().fits_changed(); }
  [[nodiscard]] AxialRadial displacement(std::size_t body, double x, double r) const override {
    return real().displacement(body, x, r);
  }
  [[nodiscard]] AxialRadial mean_displacement(const std::vector<HeatBoundary>& boundaries) const override {
    return real().mean_displacement(boundaries);
  }
  [[nodiscard]] double output(std::size_t output) const override { return real().output(output); }
  [[nodiscard]] FitState fit(std::size_t fit) const override { return real().fit(fit); }
  [[nodiscard]] Stress stress(std::size_t body, double x, double r) const override { return real().stress(body, x, r); }
  [[nodiscard]] SurfaceRange hoop_stress(const HeatBoundary& boundary) const override {
    return real().hoop_stress(boundary);
  }
  [[nodiscard]] double difference(const ElasticFunction& f) const override { return real().difference(f); }

 private:
  [[nodiscard]] ElasticSolver& real() const {
    if (!real_) real_ = make_(problem_);
    return *real_;
  }

  mutable KeptValues values_;
  ElasticProblem problem_;
  ElasticSolverMaker make_;
  mutable std::unique_ptr<ElasticSolver> real_;
  bool is_solved_ = false;
};

}  // namespace

std::unique_ptr<ElasticSolver> kept_elastic_solver(const std::filesystem::path& folder, const std::string& module,
                                                   const ElasticProblem& problem, const ElasticSolverMaker& make) {
  const auto digest = folder.empty() ? std::nullopt : plain::digest_of(problem);
  if (!digest) return make(problem);
  return std::make_unique<KeptElasticSolver>(folder, sha256_of(module + "\nelasticity\n" + *digest), problem, make);
}

}  // namespace rotordrop
