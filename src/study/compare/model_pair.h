#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bearing/touchdown_parameters.h"
#include "study/compare/difference_json.h"
#include "study/recorded_drop.h"
#include "study/rub/impact.h"

namespace rotordrop {

/// One thermal model of one run.
struct Side {
  const RecordedDrop& drop;
  const ThermalKind& kind;
};

/// Two models of one bearing, and by what they are judged.
struct ModelPair {
  Side first, second;
  std::string bearing;
  const TouchdownParameters& parameters;  ///< of the bearing
  const Impact& impact;
  const std::vector<Instant>& instants;
  Tolerance temperature, growth;
  [[nodiscard]] Names names() const { return {first.kind.name, second.kind.name}; }
};

/// Mean temperatures of the bodies that both models have.
nlohmann::ordered_json temperatures_json(const Side& a, const Side& b, const std::string& bearing,
                                         const Tolerance& tolerance, const Names& names,
                                         const std::vector<Instant>& instants);

/// All that is said of two models: temperatures, surfaces, growth, reasons, clearances, ball loads (docs/how-to/compare.md).
nlohmann::ordered_json pair_json(const ModelPair& pair);

// Of growth:

/// Whether the growth that stands for this side is by elasticity: that of meshed sections if the drop recorded it, fed back or not.
bool is_elastic(const Side& side, const std::string& bearing);
nlohmann::ordered_json growth_json(const ModelPair& pair);
/// Air gap, and play of the balls in the middle of the load: what each model's growth would leave of them.
nlohmann::ordered_json clearances_json(const ModelPair& pair);
/// Approach of the races to the balls in the mean over the rows.
nlohmann::ordered_json ball_approach_json(const ModelPair& pair);
/// Each row by itself, where elasticity knows it: the first model has one growth for all.
nlohmann::ordered_json row_growth_json(const ModelPair& pair);
/// Contact loads of opposed rows at rest under each model's growth, the ring without load, turning as it then does.
nlohmann::ordered_json effect_json(const ModelPair& pair);

}  // namespace rotordrop
