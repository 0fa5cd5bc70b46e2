#include "analysis/preload/preload_loop.h"

#include <algorithm>
#include <array>
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

RunningState PreloadLoop::state(std::span<const double> T) const {
  if (!std::equal(T.begin(), T.end(), last_T_.begin(), last_T_.end())) {
    last_T_.clear();
    last_ = bearing_->at(growth(T));
    last_T_.assign(T.begin(), T.end());
  }
  return last_;
}

BallConduction PreloadLoop::balls(std::span<const double> T) const {
  return bearing_->balls_roll() ? state(T).balls : BallConduction{};
}

std::vector<HeatInput> PreloadLoop::inputs(double heat, const BallConduction& balls) const {
  std::vector<HeatInput> all(n_places_);
  all[place_].inner = bearing_->inner_share() * heat;
  all[place_].outer = heat - all[place_].inner;
  all[place_].is_in_contact = true;
  all[place_].balls = balls;
  return all;
}

double PreloadLoop::rates(std::span<const double> T, double heat, const BallConduction& balls,
                          std::span<double> dydt) const {
  return thermal_->rates(T, inputs(heat, balls), dydt);
}

std::vector<double> PreloadLoop::node_temperatures(std::span<const double> T, double heat) const {
  std::vector<double> all(observed_size(observables_)), nodes;
  thermal_->observe(T, inputs(heat, balls(T)), all);
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

std::vector<double> PreloadLoop::jacobian_of_held_balls(std::span<const double> T, double heat,
                                                        const BallConduction& held) const {
  constexpr double step = 1e-3;  // [K]; rates are straight lines but for convection's power of the rise
  const std::size_t n = size();
  std::vector<double> J(n * n), trial(T.begin(), T.end()), above(n), below(n);
  for (std::size_t k = 0; k < n; ++k) {
    trial[k] = T[k] + step;
    rates(trial, heat, held, above);
    trial[k] = T[k] - step;
    rates(trial, heat, held, below);
    trial[k] = T[k];
    for (std::size_t i = 0; i < n; ++i) J[i * n + k] = (above[i] - below[i]) / (2. * step);
  }
  return J;
}

std::vector<double> PreloadLoop::jacobian(std::span<const double> T, double heat, bool is_rough) const {
  auto J = jacobian_of_held_balls(T, heat, balls(T));
  if (!bearing_->balls_roll()) return J;
  constexpr double step = 2e-8;  // [m], as for gradients of heat (preload_criterion.cpp)
  const std::size_t n = size();
  const Expansion grown = growth(T);
  std::vector<Expansion> by_T(n), all(n_places_);
  std::vector<double> one(n);
  for (std::size_t k = 0; k < n; ++k) {
    one[k] = 1.;
    thermal_->growth_rates(one, all);
    by_T[k] = all[place_];
    one[k] = 0.;
  }
  constexpr std::array<double, 4> places = {-2., -1., 1., 2.}, fine = {1., -8., 8., -1.}, rough = {0., -6., 6., 0.};
  const auto& weights = is_rough ? rough : fine;
  std::vector<double> at(n), derivative(n);
  for (const auto surface : growth_surfaces) {
    if (std::all_of(by_T.begin(), by_T.end(), [&](const Expansion& e) { return e.*surface == 0.; })) continue;
    std::fill(derivative.begin(), derivative.end(), 0.);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (weights[i] == 0.) continue;
      Expansion moved = grown;
      moved.*surface += places[i] * step;
      rates(T, heat, bearing_->at(moved).balls, at);
      for (std::size_t k = 0; k < n; ++k) derivative[k] += weights[i] * at[k] / (12. * step);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) J[i * n + k] += derivative[i] * by_T[k].*surface;
  }
  return J;
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
  BallConduction balls;
  try {
    const RunningState state = loop_.state(T);
    heat = state.heat;
    balls = state.balls;
  } catch (const SolverError&) {
    // No rest of the bearing: a trial state far out. Rates that are no numbers ask for a shorter step.
  }
  dydt[loop_.size() + 1] = loop_.rates(T, heat, balls, dydt.first(loop_.size()));
  dydt[loop_.size()] = heat;
}

}  // namespace rotordrop
