#include "machine/preload_loop.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace rotordrop {

PreloadLoop::PreloadLoop(std::shared_ptr<const ThermalModel> thermal, std::unique_ptr<RunningBearing> bearing,
                         std::size_t n_places, std::size_t place, double ambient)
    : thermal_(std::move(thermal)),
      bearing_(std::move(bearing)),
      n_places_(n_places),
      place_(place),
      ambient_(ambient),
      entries_(thermal_->state_entries()),
      observables_(thermal_->observables()) {
  for (const auto& o : observables_)
    if (o.unit == "K" && o.size == 1) nodes_.push_back(o);
}

std::vector<double> PreloadLoop::cold() const {
  std::vector<double> T(size());
  thermal_->initial_state(T);
  return T;
}

Expansion PreloadLoop::growth(std::span<const double> T) const {
  std::vector<Expansion> all(n_places_);
  thermal_->growth(T, all);
  return all[place_];
}

std::vector<HeatInput> PreloadLoop::inputs(double heat) const {
  std::vector<HeatInput> all(n_places_);
  all[place_].inner = bearing_->inner_share() * heat;
  all[place_].outer = heat - all[place_].inner;
  all[place_].is_in_contact = true;
  return all;
}

double PreloadLoop::rates(std::span<const double> T, double heat, std::span<double> dydt) const {
  return thermal_->rates(T, inputs(heat), dydt);
}

std::vector<double> PreloadLoop::node_temperatures(std::span<const double> T, double heat) const {
  std::vector<double> all(observed_size(observables_)), nodes;
  thermal_->observe(T, inputs(heat), all);
  std::size_t at = 0;
  for (const auto& o : observables_) {
    if (o.unit == "K" && o.size == 1) nodes.push_back(all[at]);
    at += o.size;
  }
  return nodes;
}

double PreloadLoop::highest_temperature(std::span<const double> T, double heat) const {
  const auto nodes = node_temperatures(T, heat);
  return *std::max_element(nodes.begin(), nodes.end());
}

std::vector<double> PreloadLoop::jacobian(std::span<const double> T, double heat) const {
  constexpr double step = 1e-3;  // [K]; rates are straight lines but for convection's power of the rise
  const std::size_t n = size();
  std::vector<double> J(n * n), trial(T.begin(), T.end()), above(n), below(n);
  for (std::size_t k = 0; k < n; ++k) {
    trial[k] = T[k] + step;
    rates(trial, heat, above);
    trial[k] = T[k] - step;
    rates(trial, heat, below);
    trial[k] = T[k];
    for (std::size_t i = 0; i < n; ++i) J[i * n + k] = (above[i] - below[i]) / (2. * step);
  }
  return J;
}

std::vector<double> PreloadLoop::steady(double heat, std::span<const double> start) const {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(size());
  std::vector<double> T(start.begin(), start.end());
  Eigen::VectorXd F(n);
  for (int i = 0; i < 100; ++i) {
    rates(T, heat, {F.data(), size()});
    const auto J = jacobian(T, heat);
    const Eigen::VectorXd step = Eigen::Map<const Matrix>(J.data(), n, n).partialPivLu().solve(F);
    for (std::size_t k = 0; k < size(); ++k) T[k] -= step[static_cast<Eigen::Index>(k)];
    const double largest = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(largest)) break;
    if (largest < 1e-9 * (1. + std::fabs(T[0] - ambient_))) return T;
  }
  throw SolverError("no steady temperatures were found: has every part of the bearing a way to ambient?");
}

PreloadTransient::PreloadTransient(const PreloadLoop& loop) : loop_(loop) {
  layout_.add_block("temperature", loop.entries());
  layout_.add_block("heat",
                    {{"made", "J", 1e3, "friction heat of the bearing"}, {"lost", "J", 1e3, "heat given to ambient"}});
}

void PreloadTransient::initial_state(std::span<double> y) const {
  const auto T = loop_.cold();
  std::copy(T.begin(), T.end(), y.begin());
  y[loop_.size()] = y[loop_.size() + 1] = 0.;
}

void PreloadTransient::rhs(double, std::span<const double> y, std::span<double> dydt) const {
  const auto T = temperatures(y);
  double heat = NAN;
  try {
    heat = loop_.state(T).heat;
  } catch (const SolverError&) {
    // No rest of the bearing: a trial state far out. Rates that are no numbers ask for a shorter step.
  }
  dydt[loop_.size() + 1] = loop_.rates(T, heat, dydt.first(loop_.size()));
  dydt[loop_.size()] = heat;
}

}  // namespace rotordrop
