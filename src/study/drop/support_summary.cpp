#include "study/drop/support_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/json_number.h"

namespace rotordrop {

using Json = nlohmann::ordered_json;

std::optional<SupportSummary> support_summary(const SupportWatch& watch, const Machine& machine,
                                              const MachineParameters& p, const std::string& bearing,
                                              std::span<const double> y) {
  const SupportScalars* const s = watch.of(bearing);
  if (!s) return {};
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b || entry.name != bearing) continue;
    SupportSummary summary;
    summary.type = b->support.type;
    summary.largest_travel = s->travel.value;
    summary.largest_travel_time = s->travel.time;
    summary.travel_limit = b->support.travel_limit;
    summary.loss = machine.ledger(s->support, "support damping", y);
    if (s->has_energy) summary.largest_stored_energy = s->stored;
    if (const auto stop = acting_stop(b->support)) summary.meets_stop = s->travel.value > stop->gap;
    return summary;
  }
  return {};
}

Json support_json(const std::optional<SupportSummary>& s) {
  if (!s) return nullptr;
  Json j;
  j["type"] = s->type;
  j["largest_travel"] = s->largest_travel;
  j["largest_travel_time"] = json_number(s->largest_travel_time);
  j["travel_limit"] = json_number(s->travel_limit);
  j["loss"] = s->loss;
  if (s->largest_stored_energy) j["largest_stored_energy"] = *s->largest_stored_energy;
  if (s->meets_stop) j["meets_stop"] = *s->meets_stop;
  return j;
}

std::string support_text(const std::string& name, const SupportSummary& s) {
  const std::string indent(name.size() + 2, ' ');
  std::string text;
  if (s.type != "linear" || s.largest_stored_energy)
    text += fmt::format("{}support ({}) moves by up to {:.4g} um and dissipates {:.4g} J\n", indent, s.type,
                        s.largest_travel * 1e6, s.loss);
  if (s.meets_stop.value_or(false)) text += fmt::format("{}the outer ring meets its stop\n", indent);
  return text;
}

}  // namespace rotordrop
