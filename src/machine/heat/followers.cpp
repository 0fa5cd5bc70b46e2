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

Followers::Followers(const Machine& machine) : machine_(machine), heats_(machine.n_thermal_places()) {
  for (std::size_t k = 0; k < machine.n_thermal_models(); ++k)
    if (machine.thermal(k).follows) models_.push_back(k);
}

void Followers::advance(double step, std::span<const double> before, std::span<double> y) {
  if (empty()) return;
  if (!(step > 0.)) {
    const auto first = static_cast<std::ptrdiff_t>(machine_.integrated_layout().size());
    std::copy(before.begin() + first, before.end(), y.begin() + first);
    return;
  }
  for (std::size_t place = 0; place < heats_.size(); ++place)
    set_even_power(machine_.heat_given(place, before), machine_.heat_given(place, y), step, heats_[place]);
  for (const std::size_t k : models_) {
    const double lost = machine_.thermal(k).model->advance(step, machine_.thermal_state(k, before), heats_,
                                                           machine_.followed_state(k, y));
    const std::size_t ledger = machine_.heat_lost_ledger(k);
    y[ledger] = before[ledger] + lost;
  }
}

}  // namespace rotordrop
