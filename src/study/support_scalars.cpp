#include "study/support_scalars.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "study/json_number.h"

namespace rotordrop {

using Json = nlohmann::ordered_json;

SupportWatch::SupportWatch(const Machine& machine) {
  const auto column_of = [&](const std::string& name) -> std::optional<std::size_t> {
    std::size_t at = 0;
    for (const auto& o : machine.step_observables()) {
      if (o.name == name) return at;
      at += o.size;
    }
    return std::nullopt;
  };
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string path = machine.support(i).results_path();
    const auto position = column_of(path + "/support_position"), energy = column_of(path + "/support_energy");
    if (!position) continue;
    Columns c;
    c.name = machine.support(i).name();
    c.support = i;
    c.position = *position;
    c.energy = energy.value_or(0);
    c.has_energy = energy.has_value();
    columns_.push_back(std::move(c));
  }
  scalars_.resize(columns_.size());
}

void SupportWatch::follow(double t, std::span<const double> step) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const double travel = std::hypot(step[columns_[i].position], step[columns_[i].position + 1]);
    auto& s = scalars_[i];
    if (travel > s.travel) {
      s.travel = travel;
      s.time = t;
    }
    if (columns_[i].has_energy) s.stored = std::fmax(s.stored, step[columns_[i].energy]);
  }
}

Json SupportWatch::summary(const Machine& machine, const MachineParameters& p, const std::string& bearing,
                           std::span<const double> y) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name != bearing) continue;
    for (const auto& entry : p.bearings) {
      const auto* b = entry.touchdown();
      if (!b || entry.name != bearing) continue;
      Json j;
      j["type"] = b->support.type;
      j["largest_travel"] = scalars_[i].travel;
      j["largest_travel_time"] = json_number(scalars_[i].time);
      j["travel_limit"] = json_number(b->support.travel_limit.value_or(std::numeric_limits<double>::quiet_NaN()));
      j["loss"] = machine.ledger(columns_[i].support, "support damping", y);
      if (columns_[i].has_energy) j["largest_stored_energy"] = scalars_[i].stored;
      if (b->support.stop) j["meets_stop"] = scalars_[i].travel > b->support.stop->gap;
      return j;
    }
  }
  return nullptr;
}

void SupportWatch::pack(std::vector<double>& to) const {
  for (const auto& s : scalars_) to.insert(to.end(), {s.travel, s.time, s.stored});
}

void SupportWatch::unpack(std::span<const double> values) {
  if (values.size() != packed_size()) throw std::invalid_argument("supports of another machine");
  for (std::size_t i = 0; i < scalars_.size(); ++i) scalars_[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

std::string support_text(const std::string& name, const Json& s) {
  if (s.is_null()) return {};
  const std::string indent(name.size() + 2, ' '), type = s["type"].get<std::string>();
  const double travel = s["largest_travel"].get<double>();
  std::string text;
  if (type != "linear" || s.contains("largest_stored_energy"))
    text += fmt::format("{}support ({}) moves by up to {:.4g} um and dissipates {:.4g} J\n", indent, type, travel * 1e6,
                        s["loss"].get<double>());
  if (s.contains("meets_stop") && s["meets_stop"].get<bool>())
    text += fmt::format("{}the outer ring meets its stop\n", indent);
  if (s["travel_limit"].is_number() && travel > s["travel_limit"].get<double>())
    text += fmt::format("{}warning: the outer ring moves by {:.4g} um, beyond its travel limit of {:.4g} um\n", indent,
                        travel * 1e6, s["travel_limit"].get<double>() * 1e6);
  return text;
}

}  // namespace rotordrop
