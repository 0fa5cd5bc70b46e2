#include "machine/others/declared_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rotordrop {
namespace {

using Numbers = std::vector<double>;

void check_heat_ports(const ThermalModel& model, const RefusePart& refuse) {
  auto ports = model.heat_ports();
  std::sort(ports.begin(), ports.end());
  if (const auto twice = std::adjacent_find(ports.begin(), ports.end()); twice != ports.end())
    refuse(fmt::format("heat_ports() gives \"{}\" twice.", *twice), "Heat would enter it twice: give each once.");
}

/// Growth of all surfaces, of temperatures or of their rates.
class Growth {
 public:
  Growth(const ThermalModel& model, std::size_t n_places) : model_(model), places_(n_places) {}
  [[nodiscard]] Numbers at(const Numbers& temperature) {
    clear();
    model_.growth(temperature, places_);
    return values();
  }
  [[nodiscard]] Numbers rate(const Numbers& rates) {
    clear();
    model_.growth_rates(rates, places_);
    return values();
  }

 private:
  void clear() { std::fill(places_.begin(), places_.end(), Expansion{}); }
  [[nodiscard]] Numbers values() const {
    Numbers all;
    for (const Expansion& one : places_)
      for (const double value : growth_values(one)) all.push_back(value);
    return all;
  }
  const ThermalModel& model_;
  std::vector<Expansion> places_;
};

double largest_of(const Numbers& values) {
  double largest = 0.;
  for (const double value : values) largest = std::fmax(largest, std::abs(value));
  return largest;
}

/// Rises of some tens of kelvin that differ from state to state, and from one pattern to the next.
Numbers rises(std::size_t n_states, std::size_t pattern) {
  Numbers all(n_states);
  for (std::size_t k = 0; k < n_states; ++k)
    all[k] = 20. + static_cast<double>((k * (2 * pattern + 3) + pattern) % 7) * 10.;
  return all;
}

/// What is linear grows from T to T + a as growth_rates() tells of a; a and b are unlike, so their sum is a third direction.
void check_growth(const ThermalModel& model, std::size_t n_places, const Numbers& initial, const RefusePart& refuse) {
  Growth growth(model, n_places);
  const Numbers start = growth.at(initial);
  const Numbers a = rises(initial.size(), 0), b = rises(initial.size(), 1);
  Numbers sum = a;
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += b[k];
  for (const Numbers& rise : {a, b, sum}) {
    Numbers moved = initial;
    for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += rise[k];
    const Numbers there = growth.at(moved), rate = growth.rate(rise);
    const double tolerance = 1e-8 * std::fmax(std::fmax(largest_of(there), largest_of(start)), largest_of(rate));
    for (std::size_t j = 0; j < there.size(); ++j)
      if (!(std::abs(there[j] - start[j] - rate[j]) <= tolerance)) {
        refuse(fmt::format("the growth of \"{}\" is not linear in the temperatures, or growth_rates() is not its "
                           "rate: it changes by {:.6g} m, and by {:.6g} m according to growth_rates().",
                           growth_surface_names[j % growth_surface_names.size()], there[j] - start[j], rate[j]),
               "growth() must be a sum of factors times temperatures and a constant, and growth_rates() the same sum "
               "without the constant.");
        return;
      }
  }
}

void check_stored_energy(const ThermalModel& model, const Numbers& initial, const RefusePart& refuse) {
  Numbers warmer = initial;
  for (double& T : warmer) T += 1.;
  const double stored = model.stored_energy(initial), per_kelvin = model.stored_energy(warmer) - stored;
  if (!(std::abs(stored) <= 1e-6 * std::abs(per_kelvin)))
    refuse(fmt::format("stored_energy() is {:.6g} J at the start.", stored),
           "It must be 0 there, or the balance of heat never closes: count from initial_state().");
}

}  // namespace

void check_ring_states(const ThermalModel& model, const ThermalKind& kind, std::size_t n_places,
                       const RefusePart& refuse) {
  const auto states = model.ring_states();
  const std::size_t n_states = model.state_entries().size();
  const char* advice =
      "They are the states that are the inner rings' mean temperatures, one for each touchdown bearing; the kind's "
      "has_ring_states says that there are such.";
  if (states.size() != (kind.has_ring_states ? n_places : 0))
    refuse(fmt::format("has_ring_states is {}, and ring_states() gives {} states for {} touchdown bearings.",
                       kind.has_ring_states, states.size(), n_places),
           advice);
  else if (std::any_of(states.begin(), states.end(), [&](std::size_t state) { return state >= n_states; }))
    refuse(fmt::format("ring_states() gives states beyond the {} that there are, counted from 0.", n_states), advice);
}

void check_heat(const ThermalModel& model, std::size_t n_places, const RefusePart& refuse) {
  Numbers initial(model.state_entries().size());
  model.initial_state(initial);
  check_heat_ports(model, refuse);
  check_growth(model, n_places, initial, refuse);
  check_stored_energy(model, initial, refuse);
}

}  // namespace rotordrop
