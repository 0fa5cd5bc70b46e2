#include "analysis/watch/support_watch.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rotordrop {

SupportWatch::SupportWatch(const Machine& machine) {
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string path = machine.support(i).results_path();
    const auto& step = machine.step_observables();
    const auto position = column_of(step, path + "/support_position"),
               energy = column_of(step, path + "/support_energy");
    if (!position) continue;
    Columns c;
    c.name = machine.support(i).name();
    c.support = i;
    c.position = *position;
    c.energy = energy.value_or(0);
    c.has_energy = energy.has_value();
    columns_.push_back(std::move(c));
  }
  for (const auto& c : columns_) {
    SupportScalars s;
    s.support = c.support;
    s.has_energy = c.has_energy;
    scalars_.push_back(s);
  }
}

void SupportWatch::follow(double t, std::span<const double> step) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const double y = step[columns_[i].position], z = step[columns_[i].position + 1];
    auto& s = scalars_[i];
    s.travel.follow(true, t, std::sqrt(y * y + z * z));
    if (columns_[i].has_energy) s.stored = std::fmax(s.stored, step[columns_[i].energy]);
  }
}

void SupportWatch::pack(PackedValues& to) const {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    auto& values = to["supports/" + columns_[i].name] = {scalars_[i].stored};
    FollowedPeak travel = scalars_[i].travel;
    for (const double* number : travel.numbers()) values.push_back(*number);
  }
}

void SupportWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const auto& values = from.at("supports/" + columns_[i].name);
    const auto numbers = scalars_[i].travel.numbers();
    if (values.size() != 1 + numbers.size()) throw std::invalid_argument("a support of another kind");
    scalars_[i].stored = values[0];
    for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = values[1 + k];
  }
}

const SupportScalars* SupportWatch::of(const std::string& bearing) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == bearing) return &scalars_[i];
  return nullptr;
}

}  // namespace rotordrop
