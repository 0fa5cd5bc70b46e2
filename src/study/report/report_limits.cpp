#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bearing/touchdown_parameters.h"
#include "study/report/report.h"

// Limits that figures show: those that the case implies, and those of its [limits].
namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

class Figures {
 public:
  explicit Figures(Json& charts) : charts_(charts) {}
  [[nodiscard]] Json* find(const std::string& id) {
    const auto found = std::find_if(charts_.begin(), charts_.end(), [&](const Json& c) { return c["id"] == id; });
    return found == charts_.end() ? nullptr : &*found;
  }
  /// @param value  in the unit of the figure's axis
  void add(const std::string& id, const std::string& name, double value, std::size_t colour = black) {
    Json* chart = find(id);
    if (!chart || !std::isfinite(value)) return;
    Json limit = {{"name", name}, {"value", value}, {"colour", colour}};
    if (!chart->contains("limits")) (*chart)["limits"] = Json::array();
    auto& list = (*chart)["limits"];
    if (std::find(list.begin(), list.end(), limit) == list.end()) list.push_back(std::move(limit));
  }

  static constexpr std::size_t black = 7;

 private:
  Json& charts_;
};

/// Figure of a result that [limits] may bound; results that are no value of a series have none.
struct Place {
  const char* result;  ///< after the name of bearing or probe
  const char* figure;  ///< its id; + stands for the name
  double scale;
};
constexpr Place of_bearings[] = {{"peak_contact_force", "contact-force", 1e-3},
                                 {"mean_contact_force_end", "contact-force", 1e-3},
                                 {"axial.force.largest", "axial-force", 1e-3},
                                 {"axial.force.smallest", "axial-force", 1e-3},
                                 {"axial.shoulder_force.largest", "axial-force", 1e-3},
                                 {"axial.shoulder_force.smallest", "axial-force", 1e-3},
                                 {"axial.rotor_position.largest", "axial-position", 1e6},
                                 {"axial.rotor_position.smallest", "axial-position", 1e6},
                                 {"largest_ball_force", "ball-loads", 1.},
                                 {"largest_contact_pressure", "pressures", 1e-9},
                                 {"peak_friction_heat_rate", "rub-heat", 1e-3},
                                 {"inner_heat_rate_max", "inner-heat", 1.},
                                 {"outer_heat_rate_max", "inner-heat", 1.},
                                 {"friction_heat", "heat-given", 1.},
                                 {"inner_heat", "heat-given", 1.},
                                 {"outer_heat", "heat-given", 1.},
                                 {"load_torque_peak", "torques", 1.},
                                 {"temperature_rise_end.inner_ring", "temperature-+", 1.},
                                 {"temperature_rise_end.outer_ring", "temperature-+", 1.},
                                 {"temperature_rise_end.ball", "temperature-+", 1.},
                                 {"temperature_rise_end.shaft", "temperature-+", 1.}};
constexpr Place of_probes[] = {{"smallest_clearance", "probe-clearance", 1e6},
                               {"peak_contact_force", "probe-force", 1e-3}};

template <std::size_t n>
void add_own(Figures& figures, const Json& limit, const std::string& name, const std::string& prefix,
             const Place (&places)[n], std::size_t colour) {
  const std::string key = limit.at("key").get<std::string>();
  if (!limit.at("limit").is_number()) return;
  for (const Place& place : places) {
    if (key != prefix + name + "." + place.result) continue;
    std::string figure = place.figure;
    if (const auto at = figure.find('+'); at != std::string::npos) figure.replace(at, 1, name);
    figures.add(figure,
                fmt::format("{}: {} {}", name, place.result, limit.at("kind") == "max" ? "at most" : "at least"),
                limit.at("limit").get<double>() * place.scale, colour);
  }
}

void add_of_bearing(Figures& figures, const RecordedDrop& drop, const std::string& name, const TouchdownParameters& b,
                    std::size_t colour) {
  const auto& p = drop.parameters();
  const double gap = 1e6 * air_gap(b, p.contact);
  const std::string ring = "/bearings/" + name + "/ring_position";
  for (const std::size_t axis : {0u, 1u}) {
    const double centre = drop.has(ring) ? 1e6 * drop.series(ring, axis).values.front() : 0.;
    for (const double side : {-1., 1.})
      figures.add(axis == 0 ? "displacement-y" : "displacement-z", name + ": air gap", centre + side * gap, colour);
  }
  figures.add("clearance", "closed", 0.);
  if (b.C0 > 0.)
    for (const double side : {-1., 1.}) figures.add("bearing-force", name + ": C0", side * 1e-3 * b.C0, colour);
  figures.add("pressures", "ISO 76", 1e-9 * static_pressure_limit);
  if (const auto* material = find_material(p, b.ring); material && material->temperature_limit)
    for (const char* figure : {"temperature-", "surfaces-"})
      figures.add(figure + name, fmt::format("temperature_limit of {}", b.ring),
                  *material->temperature_limit - p.run.ambient);
}

void add_celsius(Json& charts, double ambient) {
  for (Json& chart : charts) {
    const std::string id = chart["id"];
    if (id.starts_with("temperature-") || id.starts_with("surfaces-"))
      chart["second"] = {{"unit", "°C"}, {"label", "temperature"}, {"offset", ambient - 273.15}};
  }
}

}  // namespace

void add_limits(const RecordedDrop& drop, const Json& summary, Json& charts) {
  Figures figures(charts);
  const Json limits = summary.is_null() ? Json::array() : summary.value("limits", Json::array());
  const auto& bearings = drop.parameters().bearings;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const std::string& name = bearings[i].name;
    if (const auto* touchdown = bearings[i].touchdown(); touchdown && drop.has("/bearings/" + name + "/contact_force"))
      add_of_bearing(figures, drop, name, *touchdown, i);
    const Json::json_pointer travel("/bearings/" + name + "/support/travel_limit");
    if (!summary.is_null() && summary.contains(travel) && summary.at(travel).is_number())
      for (const double side : {-1., 1.})
        figures.add("ring-position", name + ": travel_limit", side * 1e6 * summary.at(travel).get<double>(), i);
    for (const Json& limit : limits) add_own(figures, limit, name, "bearings.", of_bearings, i);
  }
  const auto& probes = drop.parameters().rotor.probes;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto& [name, probe] = probes[i];
    figures.add("probe-clearance", "touches", 0.);
    for (const std::size_t axis : {0u, 1u})
      for (const double side : {-1., 1.})
        figures.add("probe-position", name + (axis == 0 ? ": clearance, y" : ": clearance, z"),
                    1e6 * (probe.centre[axis] + side * probe.clearance), i);
    for (const Json& limit : limits) add_own(figures, limit, name, "probes.", of_probes, i);
  }
  for (const Json& limit : limits)
    if (limit.at("key") == "energy.dissipated" && limit.at("limit").is_number())
      figures.add("energy", "energy.dissipated", limit.at("limit").get<double>());
  add_celsius(charts, drop.parameters().run.ambient);
}

}  // namespace rotordrop
