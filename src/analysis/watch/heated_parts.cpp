#include "analysis/watch/heated_parts.h"

#include <string_view>

namespace rotordrop {
namespace {

/// Parts of a bearing whose material must keep its dimensions and hardness.
bool is_of_bearing(const std::string& part) {
  for (const std::string_view name :
       {"inner ring", "outer ring", "ball", "bore", "inner raceway", "outer raceway", "inner contact", "outer contact"})
    if (part.starts_with(name)) return true;
  return false;
}

}  // namespace

const MaterialParameters* material_of_part(const MachineParameters& p, const TouchdownParameters& b,
                                           const std::string& part) {
  if (part == "shaft") return b.journal ? find_material(p, *b.journal) : nullptr;
  return is_of_bearing(part) ? find_material(p, part.starts_with("ball") ? b.ball : b.ring) : nullptr;
}

}  // namespace rotordrop
