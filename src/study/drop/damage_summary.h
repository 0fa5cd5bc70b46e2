#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "analysis/watch/ball_fatigue.h"
#include "bearing/touchdown_parameters.h"

// What one drop does to a touchdown bearing, and how many such drops it may take: static safety, contact fatigue, wear.
namespace rotordrop {

struct BearingSummary;

/// `damage` of a bearing in summary.json. @param bearing  with its pressures and wear @param fatigue  none: not assessed
[[nodiscard]] nlohmann::ordered_json damage_json(const BearingSummary& bearing,
                                                 const std::optional<FatigueShare>& fatigue,
                                                 const TouchdownParameters& parameters);
/// Whether a `damage` says anything: not if the rotor did not touch the bearing, or the run ends in its first contact.
[[nodiscard]] bool is_assessed(const nlohmann::ordered_json& damage);
/// Whether contact ellipses reached over a raceway's edge: then the static safety is lower than a `damage` says.
[[nodiscard]] bool is_pressure_void(const nlohmann::ordered_json& damage);
/// Lines for the screen.
[[nodiscard]] std::string damage_text(const nlohmann::ordered_json& damage, std::size_t indent);

}  // namespace rotordrop
