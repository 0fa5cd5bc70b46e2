#include "conduction/heat_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rotordrop {

HeatSources::HeatSources(const HeatConductionProblem& problem, std::vector<double> flux_areas,
                         std::vector<double> port_areas)
    : problem_(&problem),
      flux_areas_(std::move(flux_areas)),
      port_areas_(std::move(port_areas)),
      fluxes_(problem.fluxes.size()),
      ports_(problem.ports.size()) {}

void HeatSources::hold_fluxes_of(double time) {
  for (std::size_t f = 0; f < fluxes_.size(); ++f) {
    const auto &times = problem_->fluxes[f].times, &values = problem_->fluxes[f].values;
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    fluxes_[f] = next == times.begin() ? 0. : values[static_cast<std::size_t>(next - times.begin()) - 1];
  }
}

void HeatSources::hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time) {
  for (std::size_t p = 0; p < watts.size(); ++p) ports_[p] = {watts[p], rates.empty() ? 0. : rates[p]};
  held_since_ = time;
}

bool HeatSources::is_steady() const {
  return std::all_of(ports_.begin(), ports_.end(), [](const Port& port) { return port.rate == 0.; });
}

double HeatSources::power(double t) const {
  double power = 0.;
  for (std::size_t p = 0; p < ports_.size(); ++p) power += watts(p, t);
  for (std::size_t f = 0; f < fluxes_.size(); ++f) power += fluxes_[f] * flux_areas_[f];
  return power;
}

double HeatSources::expected_rise(double duration) const {
  const auto half_space = [&](const HeatBoundary& boundary, double flux) {
    const auto& body = problem_->bodies[boundary.body];
    const double k = body.conductivity.value(problem_->initial_temperature);
    const double rho_c = body.density * body.heat_capacity.value(problem_->initial_temperature);
    const auto side = boundary.side;
    const double thickness =
        side == HeatSide::left || side == HeatSide::right ? body.x[1] - body.x[0] : body.r[1] - body.r[0];
    // Until 0.1 thickness^2/diffusivity the body is thick.
    const double t = std::min(duration, 0.1 * thickness * thickness * rho_c / k);
    return 2. * std::fabs(flux) * std::sqrt(t / (std::numbers::pi * k * rho_c));
  };
  double rise = 0.;
  for (std::size_t f = 0; f < fluxes_.size(); ++f) {
    const auto& flux = problem_->fluxes[f];
    double here = half_space(flux.boundary, fluxes_[f]);
    if (flux.second && here > 0.) {
      const double beyond = half_space(*flux.second, fluxes_[f]);
      here *= beyond / (here + beyond);  // without contact resistance
    }
    rise = std::max(rise, here);
  }
  for (std::size_t p = 0; p < ports_.size(); ++p) {
    const auto& port = problem_->ports[p];
    const double largest = std::max(std::fabs(ports_[p].held), std::fabs(ports_[p].held + ports_[p].rate * duration));
    if (!port.node) {
      rise = std::max(rise, half_space(port.boundaries.front(), largest / port_areas_[p]));
      continue;
    }
    // Until its links carry the heat on.
    const double capacity = problem_->nodes[*port.node].capacity;
    double t = duration;
    for (const auto& link : problem_->links)
      if (link.from == p || link.to == p) t = std::min(t, link.resistance * capacity);
    rise = std::max(rise, largest * t / capacity);
  }
  return rise;
}

std::string HeatSources::strongest_cooling(double t, const std::function<bool(std::size_t)>& flux_is_here,
                                           const std::function<bool(std::size_t)>& port_is_here) const {
  static constexpr const char* sides[] = {"left", "right", "inner", "outer", "raceway", "strip"};
  double strongest = 0.;
  bool is_near = false;
  std::string words = "Check the initial temperature and the sources.";
  const auto look_at = [&](double power, bool is_here, const std::string& what, const char* advice) {
    if (!(power < 0.) || (is_near && !is_here) || (is_near == is_here && power >= strongest)) return;
    strongest = power;
    is_near = is_here;
    words = fmt::format("{} takes {:.4g} W out; {}", what, -power, advice);
  };
  for (std::size_t f = 0; f < fluxes_.size(); ++f) {
    const auto name = [&](const HeatBoundary& b) {
      return problem_->bodies[b.body].name + "." + sides[static_cast<std::size_t>(b.side)];
    };
    const auto& flux = problem_->fluxes[f];
    look_at(fluxes_[f] * flux_areas_[f], flux_is_here(f),
            flux.second ? "The flux between " + name(flux.boundary) + " and " + name(*flux.second)
                        : "The flux on boundary " + name(flux.boundary),
            "no boundary can give off so much for so long: check its negative values.");
  }
  for (std::size_t p = 0; p < ports_.size(); ++p)
    look_at(watts(p, t), port_is_here(p), "Port " + problem_->ports[p].name,
            "no surface can give off so much for so long: check its negative heat.");
  return words;
}

}  // namespace rotordrop
