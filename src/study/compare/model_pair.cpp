#include "study/compare/model_pair.h"

#include <algorithm>
#include <cmath>

#include "analysis/facts/thermal_report.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* nodes[] = {"shaft", "inner_ring", "ball", "outer_ring", "housing"};
/// Surfaces of the finite elements, and the node that stands for each.
struct SurfacePair {
  const char *surface, *node;
};
constexpr SurfacePair surface_pairs[] = {{"bore", "inner_ring"},
                                         {"inner_raceway", "inner_contact"},
                                         {"outer_raceway", "outer_contact"},
                                         {"housing_surface", "housing"}};

bool has_node(const Side& side, const std::string& bearing, const char* node) {
  return side.drop.has(side.drop.node_path(side.kind, bearing, node));
}

TimeSeries node_series(const Side& side, const std::string& bearing, const char* node, std::size_t column = 0) {
  return side.drop.series(side.drop.node_path(side.kind, bearing, node), column);
}

double largest_rise(const Side& side, const std::string& bearing) {
  double rise = 0.;
  for (const char* node : nodes) {
    if (!has_node(side, bearing, node)) continue;
    for (const double value : node_series(side, bearing, node).values)
      rise = std::max(rise, std::fabs(value - side.drop.parameters().run.ambient));
  }
  return rise;
}

/// Surfaces of the second model beside the first one's nodes.
Json surfaces_json(const ModelPair& pair) {
  Json j = Json::object();
  const char* columns[] = {"mean", "lowest", "highest"};
  for (const auto& [surface, node] : surface_pairs) {
    if (!pair.second.kind.meshes_sections || !has_node(pair.first, pair.bearing, node)) continue;
    const TimeSeries T = node_series(pair.first, pair.bearing, node);
    j[surface]["node"] = node;
    for (std::size_t c = 0; c < 3; ++c)
      j[surface][columns[c]] = difference_json(T, node_series(pair.second, pair.bearing, surface, c), pair.temperature,
                                               pair.names(), pair.instants);
  }
  return j;
}

/// Bodies that are single lumps in both models, as far as is known.
Json lumps_in_both(const ModelPair& pair) {
  Json lumps = Json::array();
  if (!pair.second.kind.meshes_sections) return lumps;
  lumps.push_back("ball");
  if (pair.second.drop.parameters().thermal.fe.shaft == FeShaft::lump) lumps.push_back("shaft");
  return lumps;
}

/// Why the circuit's temperatures leave the tolerance when they do: what of the finite elements the circuit has no word for, at that time.
Json reasons_json(const ModelPair& pair, const Json& temperatures) {
  Json j = Json::object();
  if (!pair.first.kind.is_circuit || !pair.second.kind.meshes_sections) return j;
  const auto over_ring = [&](const Side& side, const char* node, double t) {
    return node_series(side, pair.bearing, node).at(t) - node_series(side, pair.bearing, "inner_ring").at(t);
  };
  const auto over_outer = [&](const Side& side, const char* node, double t) {
    return node_series(side, pair.bearing, node).at(t) - node_series(side, pair.bearing, "outer_ring").at(t);
  };
  const auto bodies = lumped_bodies(pair.first.drop.parameters(), pair.bearing, pair.parameters);
  const Names names = pair.names();
  for (const auto& [name, d] : temperatures.items()) {
    if (d["beyond_from"].is_null()) continue;
    const double t = d["beyond_from"].get<double>();
    Json& reason = j[name];
    for (const auto& body : bodies)
      if (body.name == name) {
        reason["biot"] = body.biot;
        if (t > pair.impact.start) reason["fourier"] = body.fourier(t - pair.impact.start);
      }
    if (name == "shaft" || name == "inner_ring") reason["bore_over_ring"] = over_ring(pair.second, "bore", t);
    if (name == "ball" || name == "inner_ring")
      reason["inner_contact_over_ring"] = {{names.first, over_ring(pair.first, "inner_contact", t)},
                                           {names.second, over_ring(pair.second, "inner_raceway", t)}};
    if (name == "ball" || name == "outer_ring")
      reason["outer_contact_over_ring"] = {{names.first, over_outer(pair.first, "outer_contact", t)},
                                           {names.second, over_outer(pair.second, "outer_raceway", t)}};
  }
  return j;
}

}  // namespace

Json temperatures_json(const Side& a, const Side& b, const std::string& bearing, const Tolerance& tolerance,
                       const Names& names, const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const char* node : nodes)
    if (has_node(a, bearing, node) && has_node(b, bearing, node))
      j[node] =
          difference_json(node_series(a, bearing, node), node_series(b, bearing, node), tolerance, names, instants);
  return j;
}

Json pair_json(const ModelPair& pair) {
  Json j;
  j["models"] = Json::array({pair.first.kind.name, pair.second.kind.name});
  j["largest_rise"] = std::max(largest_rise(pair.first, pair.bearing), largest_rise(pair.second, pair.bearing));
  j["lumps_in_both"] = lumps_in_both(pair);
  j["temperatures"] =
      temperatures_json(pair.first, pair.second, pair.bearing, pair.temperature, pair.names(), pair.instants);
  j["surfaces"] = surfaces_json(pair);
  j["growth_by"] = is_elastic(pair.second, pair.bearing) ? "elasticity"
                   : pair.second.kind.meshes_sections    ? "formula"
                                                         : "model";
  j["growth"] = growth_json(pair);
  j["reasons"] = reasons_json(pair, j["temperatures"]);
  j["clearances"] = clearances_json(pair);
  j["ball_approach"] = ball_approach_json(pair);
  j["row_growth"] = row_growth_json(pair);
  j["effect"] = effect_json(pair);
  return j;
}

}  // namespace rotordrop
