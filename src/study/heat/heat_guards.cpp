#include "study/heat/heat_guards.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/watch/heated_parts.h"
#include "thermal/thermal_parameters.h"

namespace rotordrop {

HeatGuards::HeatGuards(const BearingHeatCase& c) : bearing_(c.bearing) {
  const MachineParameters& p = c.drop.parameters;
  const TouchdownParameters& bearing = touchdown_of(p, c.bearing);
  const auto mark_of = [kinds = chosen_kinds(p.thermal)](const std::string& model) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto* one) { return one->name == model; });
    return kind == kinds.end() ? model : (*kind)->mark;
  };
  for (std::size_t m = 0; m < c.models.size(); ++m) {
    const auto& names = c.models[m].heated->names();
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string part = names[i];
      std::replace(part.begin(), part.end(), '_', ' ');
      const MaterialParameters* material = material_of_part(p, bearing, part);
      if (!material || !material->temperature_limit) continue;
      guards_.push_back({m, i, fmt::format("{} ({})", part, mark_of(c.models[m].name)), *material->temperature_limit});
    }
  }
}

void HeatGuards::look(std::size_t model, double time, std::span<const double> temperatures) {
  for (Guard& guard : guards_)
    if (guard.model == model) guard.seen.follow(time, temperatures[guard.name], guard.limit);
}

std::vector<RunWarning> HeatGuards::found() const {
  std::vector<RunWarning> list;
  for (const Guard& guard : guards_)
    if (guard.seen.count > 0.)
      list.push_back(guard.seen.as_warning(find_warning_kind("temperature"), bearing_, guard.part, guard.limit));
  return list;
}

}  // namespace rotordrop
