#include "study/drop/support_summary.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "study/json_number.h"

namespace rotordrop {

using Json = nlohmann::ordered_json;

Json support_summary(const SupportWatch& watch, const Machine& machine, const MachineParameters& p,
                     const std::string& bearing, std::span<const double> y) {
  const SupportScalars* const s = watch.of(bearing);
  if (!s) return nullptr;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b || entry.name != bearing) continue;
    Json j;
    j["type"] = b->support.type;
    j["largest_travel"] = s->travel;
    j["largest_travel_time"] = json_number(s->time);
    j["travel_limit"] = json_number(b->support.travel_limit.value_or(std::numeric_limits<double>::quiet_NaN()));
    j["loss"] = machine.ledger(s->support, "support damping", y);
    if (s->has_energy) j["largest_stored_energy"] = s->stored;
    if (b->support.stop) j["meets_stop"] = s->travel > b->support.stop->gap;
    return j;
  }
  return nullptr;
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
  return text;
}

}  // namespace rotordrop
