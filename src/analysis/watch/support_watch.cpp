#include "analysis/watch/support_watch.h"

#include <cmath>
#include <optional>
#include <utility>

#include "analysis/watch/packed_numbers.h"

namespace rotordrop {

std::vector<double*> SupportScalars::numbers() {
  std::vector<double*> all = {&stored};
  for (double* number : travel.numbers()) all.push_back(number);
  return all;
}

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
    SupportScalars scalars = scalars_[i];
    to["supports/" + columns_[i].name] = packed_numbers(scalars.numbers());
  }
}

void SupportWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    unpack_numbers(from.at("supports/" + columns_[i].name), scalars_[i].numbers());
}

const SupportScalars* SupportWatch::of(const std::string& bearing) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == bearing) return &scalars_[i];
  return nullptr;
}

}  // namespace rotordrop
