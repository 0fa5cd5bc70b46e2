#include "machine/heat/followers.h"

#include <algorithm>

namespace rotordrop {
namespace {

/// Powers that give the same energy in a step.
void set_even_power(const PlaceEnergy& before, const PlaceEnergy& after, double step, HeatInput& heat) {
  heat.rub = (after.rub - before.rub) / step;
  heat.rub_into_ring = (after.rub_into_ring - before.rub_into_ring) / step;
  heat.inner = (after.inner - before.inner) / step;
  heat.outer = (after.outer - before.outer) / step;
  for (std::size_t row = 0; row < heat.rows.size(); ++row) {
    heat.rows[row].inner = (after.rows[row][0] - before.rows[row][0]) / step;
    heat.rows[row].outer = (after.rows[row][1] - before.rows[row][1]) / step;
  }
}

}  // namespace

Followers::Followers(const Machine& machine)
    : machine_(machine), state_(machine.layout().size()), heats_(machine.n_thermal_places()) {
  for (std::size_t k = 0; k < machine.n_thermal_models(); ++k) {
    if (!machine.thermal(k).follows) continue;
    const double longest = machine.thermal(k).longest_step;
    longest_step_ = models_.empty() ? longest : std::min(longest_step_, longest);
    models_.push_back(k);
  }
  machine.initial_state(state_);
}

void Followers::begin(double t, std::span<const double> y, const Evaluation& found) {
  if (empty()) return;
  time_ = t;
  std::copy(y.begin(), y.end(), state_.begin());
  heats_ = found.heats;
}

void Followers::follow(double start, double t, std::span<double> y, const Evaluation& found) {
  if (empty() || (t - time_) + (t - start) <= longest_step_) return;
  fill(t, y);
  begin(t, y, found);
}

void Followers::fill(double t, std::span<double> y) const {
  if (empty()) return;
  const double step = t - time_;
  if (!(step > 0.)) {
    const auto first = static_cast<std::ptrdiff_t>(machine_.integrated_layout().size());
    std::copy(state_.begin() + first, state_.end(), y.begin() + first);
    return;
  }
  for (std::size_t place = 0; place < heats_.size(); ++place)
    set_even_power(machine_.heat_given(place, state_), machine_.heat_given(place, y), step, heats_[place]);
  for (const std::size_t k : models_) {
    const double lost = machine_.thermal(k).model->advance(step, machine_.thermal_state(k, state_), heats_,
                                                           machine_.followed_state(k, y));
    const std::size_t ledger = machine_.heat_lost_ledger(k);
    y[ledger] = state_[ledger] + lost;
  }
}

}  // namespace rotordrop
