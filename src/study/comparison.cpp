#include "study/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"
#include "machine/thermal_report.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ThermalModelKind;

constexpr const char* nodes[] = {"shaft", "inner_ring", "ball", "outer_ring", "housing"};
/// Surfaces of the finite elements, and the node that stands for each.
struct SurfacePair {
  const char *surface, *node;
};
constexpr SurfacePair surface_pairs[] = {{"bore", "inner_ring"},
                                         {"inner_raceway", "inner_contact"},
                                         {"outer_raceway", "outer_contact"},
                                         {"housing_surface", "housing"}};

/// How the two sides of a difference are called.
struct Names {
  const char *first, *second;
};

/// Times up to which the worst difference is reported [s]: the same in every run that lasts so long.
constexpr double time_scales[] = {1e-3, 3e-3, 10e-3, 30e-3, 0.1, 0.3, 1., 3., 10., 30., 100., 300., 1000.};

Json by_time_json(const Difference& d) {
  Json j = Json::array();
  const auto add = [&](double until) {
    const auto worst = d.worst_until(until);
    j.push_back({{"until", until}, {"difference", worst.difference}, {"time", worst.time}, {"usage", worst.usage}});
  };
  const double begin = d.series.times.front(), end = d.series.times.back();
  for (const double until : time_scales)
    if (until >= begin && until <= end) add(until);
  if (j.empty() || j.back()["until"].get<double>() < end) add(end);
  return j;
}

Json difference_json(const TimeSeries& first, const TimeSeries& second, const Tolerance& tolerance, const Names& names,
                     const std::vector<Instant>& instants) {
  const Difference d = difference_of(first, second, tolerance);
  Json j = {{"tolerance", tolerance.floor},
            {"tolerance_part", tolerance.part},
            {"largest_difference", d.largest},
            {"largest_difference_time", d.largest_time},
            {"beyond_from", json_number(d.beyond)},
            {"within_from", json_number(d.within)},
            {"time_beyond", d.time_beyond},
            {"end", d.series.times.back()},
            {"by_time", by_time_json(d)},
            {"at", Json::array()}};
  for (const auto& [name, t] : instants)
    j["at"].push_back({{"instant", name},
                       {"time", t},
                       {names.first, first.at(t)},
                       {names.second, second.at(t)},
                       {"difference", second.at(t) - first.at(t)}});
  return j;
}

/// One thermal model of one run.
struct Side {
  const RecordedDrop& drop;
  Kind kind;
};

double largest_rise(const Side& side, const std::string& bearing) {
  double rise = 0.;
  for (const char* node : nodes) {
    const TimeSeries T = side.drop.series(side.drop.node_path(side.kind, bearing, node));
    for (const double value : T.values) rise = std::max(rise, std::fabs(value - side.drop.parameters().run.ambient));
  }
  return rise;
}

Json temperatures_json(const Side& a, const Side& b, const std::string& bearing, const Tolerance& tolerance, const Names& names,
                       const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const char* node : nodes)
    j[node] = difference_json(a.drop.series(a.drop.node_path(a.kind, bearing, node)),
                              b.drop.series(b.drop.node_path(b.kind, bearing, node)), tolerance, names, instants);
  return j;
}

Json surfaces_json(const RecordedDrop& lumped, const RecordedDrop& fe, const std::string& bearing, const Tolerance& tolerance,
                   const std::vector<Instant>& instants) {
  Json j = Json::object();
  const char* columns[] = {"mean", "lowest", "highest"};
  for (const auto& [surface, node] : surface_pairs) {
    const TimeSeries T = lumped.series(lumped.node_path(Kind::lumped, bearing, node));
    j[surface]["node"] = node;
    for (std::size_t c = 0; c < 3; ++c)
      j[surface][columns[c]] =
          difference_json(T, fe.series(fe.surface_path(bearing, surface), c), tolerance, {"lumped", "fe"}, instants);
  }
  return j;
}

Json growth_json(const Side& a, const Side& b, const std::string& bearing, const Tolerance& tolerance, const Names& names,
                 const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (std::size_t c = 0; c < growth_surface_keys.size(); ++c)
    j[growth_surface_keys[c]] =
        difference_json(a.drop.series(a.drop.growth_path(a.kind, bearing), c),
                        b.drop.series(b.drop.growth_path(b.kind, bearing), c), tolerance, names, instants);
  return j;
}

/// constant + sum of factors times growths, by one model.
TimeSeries of_growth(const Side& side, const std::string& bearing, double constant,
                     const std::array<double, 5>& factors) {
  TimeSeries sum;
  for (std::size_t c = 0; c < factors.size(); ++c) {
    const TimeSeries u = side.drop.series(side.drop.growth_path(side.kind, bearing), c);
    if (sum.empty()) sum = {u.times, std::vector<double>(u.times.size(), constant)};
    for (std::size_t i = 0; i < u.values.size(); ++i) sum.values[i] += factors[c] * u.values[i];
  }
  return sum;
}

/// Air gap, and play of the balls in the middle of the load: what each model's growth would leave of them.
Json clearances_json(const Side& a, const Side& b, const std::string& bearing, const TouchdownParameters& p,
                     const Tolerance& tolerance, const Names& names, const std::vector<Instant>& instants) {
  const double gap = air_gap(p, a.drop.parameters().contact), lean = std::cos(p.contact_angle);
  const std::array<double, 5> in_gap = {-1., 1., 0., 0., 0.}, in_play = {0., 0., -lean, lean, -2.};
  return {{"air_gap", difference_json(of_growth(a, bearing, gap, in_gap), of_growth(b, bearing, gap, in_gap), tolerance,
                                      names, instants)},
          {"ball_play_change", difference_json(of_growth(a, bearing, 0., in_play), of_growth(b, bearing, 0., in_play),
                                               tolerance, names, instants)}};
}

/// Why the circuit's temperatures leave the tolerance when they do: what of the finite elements the circuit has no word for, at that time.
Json reasons_json(const RecordedDrop& lumped, const RecordedDrop& fe, const std::string& bearing,
                  const Json& temperatures, const std::vector<LumpedBody>& bodies, const Impact& impact) {
  const auto node = [&](Kind kind, const char* name, double t) {
    const auto& drop = kind == Kind::fe ? fe : lumped;
    return drop.series(drop.node_path(kind, bearing, name)).at(t);
  };
  const auto surface = [&](const char* name, double t) { return fe.series(fe.surface_path(bearing, name)).at(t); };
  Json j = Json::object();
  for (const auto& [name, d] : temperatures.items()) {
    if (d["beyond_from"].is_null()) continue;
    const double t = d["beyond_from"].get<double>();
    Json& reason = j[name];
    for (const auto& body : bodies)
      if (body.name == name) {
        reason["biot"] = body.biot;
        if (t > impact.start) reason["fourier"] = body.fourier(t - impact.start);
      }
    if (name == "shaft" || name == "inner_ring")
      reason["bore_over_ring"] = surface("bore", t) - node(Kind::fe, "inner_ring", t);
    if (name == "ball" || name == "inner_ring")
      reason["inner_contact_over_ring"] = {
          {"lumped", node(Kind::lumped, "inner_contact", t) - node(Kind::lumped, "inner_ring", t)},
          {"fe", surface("inner_raceway", t) - node(Kind::fe, "inner_ring", t)}};
    if (name == "ball" || name == "outer_ring")
      reason["outer_contact_over_ring"] = {
          {"lumped", node(Kind::lumped, "outer_contact", t) - node(Kind::lumped, "outer_ring", t)},
          {"fe", surface("outer_raceway", t) - node(Kind::fe, "outer_ring", t)}};
  }
  return j;
}

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

Json forces_json(const RecordedDrop& drop, const std::string& bearing, const Impact& impact) {
  const Extreme peak = largest_of(drop.series("/bearings/" + bearing + "/contact_force"));
  const TimeSeries impulse = drop.series("/ledger/" + bearing + "/contact_impulse");
  const TimeSeries heat = drop.series("/ledger/" + bearing + "/rub_heat");
  const bool has_impact = std::isfinite(impact.start);
  return {
      {"peak_contact_force", peak.value},
      {"peak_contact_force_time", peak.time},
      {"first_impact_peak", has_impact ? Json(impact.peak) : Json(nullptr)},
      {"first_impact_impulse", has_impact ? Json(impulse.at(impact.end) - impulse.at(impact.start)) : Json(nullptr)},
      {"impulse", impulse.values.back()},
      {"rub_heat", heat.values.back()}};
}

// --------------------------------------------------------------------------------------------------------------- bearing

/// What is compared: the two models, from whichever run has them; none if no pair can be made.
struct Models {
  const RecordedDrop *lumped = nullptr, *fe = nullptr;
};

Models models_of(const RecordedDrop& drop, const RecordedDrop* against) {
  Models m;
  const auto take = [&](Kind kind) {
    return drop.has(kind) ? &drop : against && against->has(kind) ? against : nullptr;
  };
  m.lumped = take(Kind::lumped);
  m.fe = take(Kind::fe);
  return m;
}

Tolerance temperature_tolerance(const ComparisonOptions& options, double ambient) {
  const auto& t = options.temperature;
  return t.is_part ? Tolerance{options.floor, t.value, ambient} : Tolerance{t.value, 0., ambient};
}

Json compare_bearing(const std::string& name, const TouchdownParameters& p, const RecordedDrop& drop,
                     const RecordedDrop* against, const Models& models, const ComparisonOptions& options,
                     std::vector<BoreTemperatures>& bores) {
  const Impact impact = first_impact(drop, name);
  double end = drop.series("/bearings/" + name + "/orbit").times.back();
  if (against) end = std::min(end, against->series("/bearings/" + name + "/orbit").times.back());
  const auto instants = instants_of(impact, end, options.instants);

  Json j;
  j["first_contact_time"] = json_number(impact.start);
  j["first_contact_end"] = json_number(impact.end);
  if (models.lumped && models.fe) {
    const Side lumped{*models.lumped, Kind::lumped}, fe{*models.fe, Kind::fe};
    const Names names{"lumped", "fe"};
    const Tolerance tolerance = temperature_tolerance(options, drop.parameters().run.ambient);
    const Tolerance growth{options.growth};
    j["largest_rise"] = std::max(largest_rise(lumped, name), largest_rise(fe, name));
    j["lumps_in_both"] = Json::array({"ball"});
    if (!models.fe->parameters().thermal.fe.shaft) j["lumps_in_both"].push_back("shaft");
    j["temperatures"] = temperatures_json(lumped, fe, name, tolerance, names, instants);
    j["surfaces"] = surfaces_json(*models.lumped, *models.fe, name, tolerance, instants);
    j["growth"] = growth_json(lumped, fe, name, growth, names, instants);
    j["reasons"] = reasons_json(*models.lumped, *models.fe, name, j["temperatures"], lumped_bodies(drop.parameters(), name, p), impact);
    j["clearances"] = clearances_json(lumped, fe, name, p, growth, names, instants);
  }

  BoreReport bore = report_bore(name, p, drop, models.lumped, models.fe, options.band_length, impact, instants);
  j["bore"] = std::move(bore.report);
  bores.push_back(std::move(bore.temperatures));
  j["lumping"] = lumping_json(lumped_bodies(drop.parameters(), name, p), impact, instants);
  j["forces"] = forces_json(drop, name, impact);
  return j;
}

/// One bearing in two runs: second - first is against - this.
Json compare_runs(const std::string& name, const RecordedDrop& drop, const RecordedDrop& against,
                  const ComparisonOptions& options) {
  const Names names{"this", "against"};
  const double end = std::min(drop.series("/bearings/" + name + "/orbit").times.back(),
                              against.series("/bearings/" + name + "/orbit").times.back());
  const auto instants = instants_of(first_impact(drop, name), end, options.instants);
  Json j;
  j["forces"] = {{"this", forces_json(drop, name, first_impact(drop, name))},
                 {"against", forces_json(against, name, first_impact(against, name))}};
  const std::string gap = "/bearings/" + name + "/clearance", expansion = "/bearings/" + name + "/expansion";
  j["air_gap"] = difference_json(drop.series(gap), against.series(gap), {options.growth}, names, instants);
  for (std::size_t c = 0; c < growth_surface_keys.size(); ++c)
    j["expansion"][growth_surface_keys[c]] =
        difference_json(drop.series(expansion, c), against.series(expansion, c), {options.growth}, names, instants);
  for (const Kind kind : {Kind::lumped, Kind::fe}) {
    if (!drop.has(kind) || !against.has(kind)) continue;
    const Side a{drop, kind}, b{against, kind};
    const Tolerance tolerance = temperature_tolerance(options, drop.parameters().run.ambient);
    j["temperatures"][kind == Kind::lumped ? "lumped" : "fe"] =
        temperatures_json(a, b, name, tolerance, names, instants);
  }
  return j;
}

Json run_json(const RecordedDrop& drop) {
  return {{"directory", drop.directory().string()}, {"case", drop.case_name()}, {"driver", drop.driver()}};
}

void require_something_to_compare(const RecordedDrop& drop, const RecordedDrop* against) {
  const std::string where = drop.directory().string();
  if (drop.bearings().empty()) throw InputError({where, 0, 0}, "the results hold no touchdown bearing");
  if (against) return;
  const bool lumped = drop.has(Kind::lumped), fe = drop.has(Kind::fe);
  if (lumped && fe) return;
  throw InputError(
      {where, 0, 0},
      lumped ? "the results hold the lumped circuit, but no finite elements to compare it with"
      : fe   ? "the results hold finite elements, but no lumped circuit to compare with them"
             : "the results hold no thermal model",
      "Run the case with thermal.models = [\"lumped\", \"fe\"], or name other results with --against DIR.");
}

}  // namespace

Comparison compare_models(const RecordedDrop& drop, const RecordedDrop* against, const ComparisonOptions& options) {
  require_something_to_compare(drop, against);
  const Models models = models_of(drop, against);
  Comparison c;
  Json& j = c.report;
  j["run"] = run_json(drop);
  if (against) j["against"] = run_json(*against);
  j["lumped_from"] = models.lumped ? Json(models.lumped->directory().string()) : Json(nullptr);
  j["fe_from"] = models.fe ? Json(models.fe->directory().string()) : Json(nullptr);
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
                     "no touchdown bearing there has the name of one in " + drop.directory().string());
  j["in_short"] = short_verdict_of(j);
  j["verdict"] = verdict_of(j);
  return c;
}

}  // namespace rotordrop
