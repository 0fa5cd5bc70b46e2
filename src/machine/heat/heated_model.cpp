#include "machine/heat/heated_model.h"

namespace rotordrop {

HeatedModel::HeatedModel(const ThermalModel& model, std::size_t n_places, std::size_t place)
    : model_(model), place_(place), heats_(n_places) {
  layout_.add_block("temperature", model.state_entries());
  layout_.add_block("energy", {{"heat lost", "J", 1., "heat lost to ambient"}});
}

void HeatedModel::hold(double time, const HeatInput& heat, const HeatInput& rate) {
  since_ = time;
  heat_ = heat;
  rate_ = rate;
}

const std::vector<HeatInput>& HeatedModel::heats_at(double t) const {
  HeatInput& now = heats_[place_];
  now = heat_;
  const double elapsed = t - since_;
  now.rub += elapsed * rate_.rub;
  now.rub_into_ring += elapsed * rate_.rub_into_ring;
  now.inner += elapsed * rate_.inner;
  now.outer += elapsed * rate_.outer;
  return heats_;
}

void HeatedModel::initial_state(std::span<double> y) const {
  model_.initial_state(y.first(y.size() - 1));
  y.back() = 0.;
}

void HeatedModel::rhs(double t, std::span<const double> y, std::span<double> dydt) const {
  dydt.back() = model_.rates(y.first(y.size() - 1), heats_at(t), dydt.first(dydt.size() - 1));
}

}  // namespace rotordrop
