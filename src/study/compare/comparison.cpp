#include "study/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "analysis/facts/thermal_report.h"
#include "base/errors.h"
#include "base/version.h"
#include "study/compare/model_pair.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

Json lumping_json(const std::vector<LumpedBody>& bodies, const Impact& impact, const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const auto& body : bodies) {
    Json& entry = j[body.name];
    entry = {{"length", body.length},
             {"diffusivity", body.diffusivity},
             {"biot", body.biot},
             {"evening_time", body.evening_time()},
             {"at", Json::array()}};
    const auto add = [&](const std::string& name, double time) {
      if (time > 0.)
        entry["at"].push_back({{"instant", name},
                               {"time_since_contact", time},
                               {"fourier", body.fourier(time)},
                               {"depth", body.depth(time)}});
    };
    if (!std::isfinite(impact.start)) continue;
    for (const auto& [name, t] : instants) add(name, t - impact.start);
    add("first impact's end", impact.end - impact.start);
  }
  return j;
}

/// Last time of a bearing's series.
double end_of(const RecordedDrop& drop, const std::string& bearing) {
  return drop.series("/bearings/" + bearing + "/orbit").times.back();
}

/// Of one run until a time.
Json forces_json(const RecordedDrop& drop, const std::string& bearing, const Impact& impact, double until) {
  const TimeSeries force = drop.series("/bearings/" + bearing + "/contact_force");
  const auto peak = largest_of(force, force.times.front(), until);
  const TimeSeries impulse = drop.series("/ledger/" + bearing + "/contact_impulse");
  const TimeSeries heat = drop.series("/ledger/" + bearing + "/rub_heat");
  const bool has_impact = std::isfinite(impact.start);
  return {
      {"peak_contact_force", peak ? Json(peak->value) : Json(nullptr)},
      {"peak_contact_force_time", peak ? Json(peak->time) : Json(nullptr)},
      {"first_impact_peak", has_impact ? Json(impact.peak) : Json(nullptr)},
      {"first_impact_impulse", has_impact ? Json(impulse.at(impact.end) - impulse.at(impact.start)) : Json(nullptr)},
      {"impulse", impulse.at(until)},
      {"rub_heat", heat.at(until)}};
}

/// The run that a model is taken from: this one if it has the model.
const RecordedDrop* run_of(const ThermalKind& kind, const RecordedDrop& drop, const RecordedDrop* against) {
  return drop.has(kind) ? &drop : against && against->has(kind) ? against : nullptr;
}

/// The models that are compared, from whichever run has them: the first one with each of the others.
std::vector<ModelOfRun> models_of(const RecordedDrop& drop, const RecordedDrop* against) {
  std::vector<ModelOfRun> models;
  for (const ThermalKind* kind : thermal_kinds())
    if (const RecordedDrop* from = run_of(*kind, drop, against)) models.push_back({from, kind});
  return models;
}

ModelOfRun model_that(bool ThermalKind::*property, const std::vector<ModelOfRun>& models) {
  const auto found = std::find_if(models.begin(), models.end(), [&](const ModelOfRun& m) { return m.kind->*property; });
  return found == models.end() ? ModelOfRun{} : *found;
}

Tolerance temperature_tolerance(const ComparisonOptions& options, double ambient) {
  const auto& t = options.temperature;
  return t.is_part ? Tolerance{options.floor, t.value, ambient} : Tolerance{t.value, 0., ambient};
}

Json compare_bearing(const std::string& name, const TouchdownParameters& p, const RecordedDrop& drop,
                     const RecordedDrop* against, const std::vector<ModelOfRun>& models,
                     const ComparisonOptions& options, std::vector<BoreTemperatures>& bores) {
  const Impact impact = first_impact(drop, name);
  double end = end_of(drop, name);
  if (against) end = std::min(end, end_of(*against, name));
  const auto instants = instants_of(impact, end, options.instants);

  const RubbedBore rubbed = rubbed_bore(name, p, drop, options.band_length);
  auto history = std::async([&rubbed] { return bore_history(rubbed.rub, rubbed.surfaces); });

  Json j;
  j["first_contact_time"] = json_number(impact.start);
  j["first_contact_end"] = json_number(impact.end);
  const auto pair = [&](std::size_t second) {
    return pair_json({{*models[0].drop, *models[0].kind},
                      {*models[second].drop, *models[second].kind},
                      name,
                      p,
                      impact,
                      instants,
                      temperature_tolerance(options, drop.parameters().run.ambient),
                      Tolerance{options.growth}});
  };
  if (models.size() > 1) j.update(pair(1));
  for (std::size_t k = 2; k < models.size(); ++k) j["further"][models[k].kind->name] = pair(k);

  BoreReport bore = report_bore(name, p, drop, rubbed, history.get(), model_that(&ThermalKind::is_circuit, models),
                                model_that(&ThermalKind::meshes_sections, models), impact, instants);
  j["bore"] = std::move(bore.report);
  bores.push_back(std::move(bore.temperatures));
  j["lumping"] = lumping_json(lumped_bodies(drop.parameters(), name, p), impact, instants);
  j["forces"] = forces_json(drop, name, impact, end_of(drop, name));
  return j;
}

/// One bearing in two runs: second - first is against - this.
Json compare_runs(const std::string& name, const RecordedDrop& drop, const RecordedDrop& against,
                  const ComparisonOptions& options) {
  const Names names{"this", "against"};
  const double ends[] = {end_of(drop, name), end_of(against, name)}, until = std::min(ends[0], ends[1]);
  const Impact impact = first_impact(drop, name, until);
  const auto instants = instants_of(impact, until, options.instants);
  Json j;
  j["until"] = until;
  j["ends"] = {{"this", ends[0]}, {"against", ends[1]}};
  j["forces"] = {{"this", forces_json(drop, name, impact, until)},
                 {"against", forces_json(against, name, first_impact(against, name, until), until)}};
  const std::string gap = "/bearings/" + name + "/clearance", expansion = "/bearings/" + name + "/expansion";
  j["air_gap"] = difference_json(drop.series(gap), against.series(gap), {options.growth}, names, instants);
  for (std::size_t c = 0; c < growth_surface_keys.size(); ++c)
    j["expansion"][growth_surface_keys[c]] =
        difference_json(drop.growth(expansion, c), against.growth(expansion, c), {options.growth}, names, instants);
  for (const ThermalKind* kind : thermal_kinds()) {
    if (!drop.has(*kind) || !against.has(*kind)) continue;
    const Tolerance tolerance = temperature_tolerance(options, drop.parameters().run.ambient);
    j["temperatures"][kind->name] =
        temperatures_json({drop, *kind}, {against, *kind}, name, tolerance, names, instants);
  }
  return j;
}

Json run_json(const RecordedDrop& drop) {
  return {{"directory", drop.directory().string()}, {"case", drop.case_name()}, {"driver", drop.driver()}};
}

void require_something_to_compare(const RecordedDrop& drop, const RecordedDrop* against) {
  const std::string where = drop.directory().string();
  if (drop.bearings().empty()) throw InputError({where, 0, 0}, "the results contain no touchdown bearing");
  const auto models = drop.models();
  if (against || models.size() > 1) return;
  const auto kinds = thermal_kinds();
  const auto* other = models.empty() || models.front() != kinds[0] ? kinds[0] : kinds[1];
  throw InputError({where, 0, 0},
                   models.empty() ? "the results hold no thermal model"
                                  : fmt::format("the results hold the {}, but no {} to compare with",
                                                models.front()->title, other->title),
                   fmt::format("Run the case with thermal.models = [\"{}\", \"{}\"], or name other results with "
                               "--against DIR.",
                               kinds[0]->name, kinds[1]->name));
}

}  // namespace

std::vector<std::string> series_of_comparison(const CaseParameters& p) {
  std::vector<std::string> paths = {"/growth/", "/windows/"};
  for (const ThermalKind* kind : chosen_kinds(p.thermal)) paths.push_back(kind->group);
  for (const auto& entry : p.bearings) paths.push_back("/bearings/" + entry.name + "/contact_force");
  return paths;
}

Comparison compare_models(const RecordedDrop& drop, const RecordedDrop* against, const ComparisonOptions& options) {
  require_something_to_compare(drop, against);
  const auto models = models_of(drop, against);
  Comparison c;
  Json& j = c.report;
  j["program"] = program_name();
  j["run"] = run_json(drop);
  if (against) j["against"] = run_json(*against);
  for (const ThermalKind* kind : thermal_kinds()) {
    const RecordedDrop* from = run_of(*kind, drop, against);
    j[kind->name + "_from"] = from ? Json(from->directory().string()) : Json(nullptr);
  }
  j["tolerances"] = {{"temperature", options.temperature.value},
                     {"temperature_unit", options.temperature.is_part ? "part of the rise at the time" : "K"},
                     {"temperature_floor", options.temperature.is_part ? Json(options.floor) : Json(nullptr)},
                     {"growth", options.growth}};
  j["bearings"] = Json::object();
  for (const auto& [name, parameters] : drop.bearings()) {
    if (against && !against->has("/bearings/" + name + "/contact_force")) continue;
    j["bearings"][name] = compare_bearing(name, parameters, drop, against, models, options, c.bores);
    if (against) j["bearings"][name]["runs"] = compare_runs(name, drop, *against, options);
  }
  if (j["bearings"].empty())
    throw InputError({against->directory().string(), 0, 0},
                     "no touchdown bearing there has the same name as one in " + drop.directory().string());
  j["in_short"] = short_verdict_of(j);
  j["verdict"] = verdict_of(j);
  return c;
}

}  // namespace rotordrop
