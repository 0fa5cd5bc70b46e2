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
    const double travel = std::sqrt(y * y + z * z);
    auto& s = scalars_[i];
    if (travel > s.travel) {
      s.travel = travel;
      s.time = t;
    }
    if (columns_[i].has_energy) s.stored = std::fmax(s.stored, step[columns_[i].energy]);
  }
}

void SupportWatch::pack(PackedValues& to) const {
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    to["supports/" + columns_[i].name] = {scalars_[i].travel, scalars_[i].time, scalars_[i].stored};
}

void SupportWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const auto& v = from.at("supports/" + columns_[i].name);
    if (v.size() != 3) throw std::invalid_argument("a support of another kind");
    scalars_[i].travel = v[0];
    scalars_[i].time = v[1];
    scalars_[i].stored = v[2];
  }
}

const SupportScalars* SupportWatch::of(const std::string& bearing) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == bearing) return &scalars_[i];
  return nullptr;
}

}  // namespace rotordrop
