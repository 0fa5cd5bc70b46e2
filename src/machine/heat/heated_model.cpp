#include "machine/heat/heated_model.h"

#include <utility>

namespace rotordrop {

HeatedModel::HeatedModel(const ThermalModel& model, std::size_t n_places, std::size_t place,
                         std::vector<double> weights)
    : model_(model), place_(place), weights_(std::move(weights)), state_(weights_.size()), heats_(n_places) {
  start_.resize(weights_.size());
  if (!start_.empty()) model.initial_state(start_);
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

std::span<const double> HeatedModel::model_state(std::span<const double> y) const {
  if (weights_.empty()) return y.first(y.size() - 1);
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] = start_[k] + (y[k] - start_[k]) / weights_[k];
  return state_;
}

void HeatedModel::rhs(double t, std::span<const double> y, std::span<double> dydt) const {
  dydt.back() = model_.rates(model_state(y), heats_at(t), dydt.first(dydt.size() - 1));
  for (std::size_t k = 0; k < weights_.size(); ++k) dydt[k] *= weights_[k];
}

}  // namespace rotordrop
