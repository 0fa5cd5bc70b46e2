#include "thermal/circuit/adiabatic_rises.h"

#include <algorithm>
#include <utility>

namespace rotordrop {
namespace {

constexpr std::size_t n_states = 3;  // inner ring, shaft, outer ring and housing

Expansion growth_of_rises(const GrowthPerRise& g, double inner, double shaft, double outer) {
  return {.shaft = g.shaft * shaft,
          .bore = g.bore * inner,
          .inner_race = g.inner_race * inner,
          .outer_race = g.outer_race * outer,
          .ball = 0.,
          .inner_width = g.inner_width * inner,
          .outer_width = g.outer_width * outer};
}

}  // namespace

Expansion AdiabaticSection::growth_by(double inner, double shaft, double outer) const {
  return growth_of_rises(growth, inner / inner_capacity, shaft / shaft_capacity, outer / outer_capacity);
}

AdiabaticRises::AdiabaticRises(std::vector<AdiabaticSection> sections, double ambient)
    : sections_(std::move(sections)), ambient_(ambient) {}

std::vector<StateEntry> AdiabaticRises::state_entries() const {
  std::vector<StateEntry> entries;
  for (const auto& s : sections_)
    for (const char* body : {"inner ring", "shaft", "outer ring and housing"})
      entries.push_back({s.name + "/" + body + " without conduction", "K", 1.});
  return entries;
}

void AdiabaticRises::initial_state(std::span<double> state) const { std::fill(state.begin(), state.end(), ambient_); }

void AdiabaticRises::growth(std::span<const double> y, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < sections_.size(); ++k)
    out[k] = growth_of_rises(sections_[k].growth, y[n_states * k] - ambient_, y[n_states * k + 1] - ambient_,
                             y[n_states * k + 2] - ambient_);
}

void AdiabaticRises::growth_rates(std::span<const double> rate, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < sections_.size(); ++k)
    out[k] = growth_of_rises(sections_[k].growth, rate[n_states * k], rate[n_states * k + 1], rate[n_states * k + 2]);
}

double AdiabaticRises::rates(std::span<const double>, std::span<const HeatInput> heat, std::span<double> dydt) const {
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const auto& s = sections_[k];
    dydt[n_states * k] = (heat[k].rub_into_ring + heat[k].inner) / s.inner_capacity;
    dydt[n_states * k + 1] = (heat[k].rub - heat[k].rub_into_ring) / s.shaft_capacity;
    dydt[n_states * k + 2] = heat[k].outer / s.outer_capacity;
  }
  return 0.;
}

double AdiabaticRises::stored_energy(std::span<const double> y) const {
  double stored = 0.;
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const auto& s = sections_[k];
    stored += s.inner_capacity * (y[n_states * k] - ambient_) + s.shaft_capacity * (y[n_states * k + 1] - ambient_) +
              s.outer_capacity * (y[n_states * k + 2] - ambient_);
  }
  return stored;
}

}  // namespace rotordrop
