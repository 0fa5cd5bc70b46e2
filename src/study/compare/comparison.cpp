#include "study/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/facts/thermal_report.h"
#include "analysis/preload/build_preload.h"
#include "base/errors.h"
#include "machine/speed_growth.h"
#include "study/json_number.h"
#include "study/preload/preload_tables.h"

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
  Json j = {{"tolerance", tolerance.floor},         {"tolerance_part", tolerance.part},
            {"largest_difference", d.largest},      {"largest_difference_time", d.largest_time},
            {"beyond_from", json_number(d.beyond)}, {"within_from", json_number(d.within)},
            {"time_beyond", d.time_beyond},         {"end", d.series.times.back()},
            {"by_time", by_time_json(d)},           {"at", Json::array()}};
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

Json temperatures_json(const Side& a, const Side& b, const std::string& bearing, const Tolerance& tolerance,
                       const Names& names, const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const char* node : nodes)
    j[node] = difference_json(a.drop.series(a.drop.node_path(a.kind, bearing, node)),
                              b.drop.series(b.drop.node_path(b.kind, bearing, node)), tolerance, names, instants);
  return j;
}

Json surfaces_json(const RecordedDrop& lumped, const RecordedDrop& fe, const std::string& bearing,
                   const Tolerance& tolerance, const std::vector<Instant>& instants) {
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

/// Whether the growth that stands for this side is by elasticity: the finite elements' if the drop recorded it, fed back or not.
bool is_elastic(const Side& side, const std::string& bearing) {
  return side.kind == Kind::fe && (side.drop.has(side.drop.node_path(Kind::fe, bearing, "elastic_growth")) ||
                                   side.drop.parameters().thermal.expansion == GrowthSource::elastic);
}

TimeSeries growth_series(const Side& side, const std::string& bearing, std::size_t surface) {
  const std::string judged = side.drop.node_path(side.kind, bearing, "elastic_growth");
  const bool has_judged = side.kind == Kind::fe && side.drop.has(judged);
  const std::string path = has_judged ? judged : side.drop.growth_path(side.kind, bearing);
  if (surface < side.drop.table(path).n_columns) return side.drop.series(path, surface);
  TimeSeries none = side.drop.series(path, 0);  // results of a version that did not know this surface
  std::fill(none.values.begin(), none.values.end(), 0.);
  return none;
}

Json growth_json(const Side& a, const Side& b, const std::string& bearing, const Tolerance& tolerance,
                 const Names& names, const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (std::size_t c = 0; c < growth_surface_keys.size(); ++c)
    j[growth_surface_keys[c]] =
        difference_json(growth_series(a, bearing, c), growth_series(b, bearing, c), tolerance, names, instants);
  return j;
}

/// constant + sum of factors times growths, by one model.
TimeSeries of_growth(const Side& side, const std::string& bearing, double constant,
                     const std::array<double, growth_surfaces.size()>& factors) {
  TimeSeries sum;
  for (std::size_t c = 0; c < factors.size(); ++c) {
    const TimeSeries u = growth_series(side, bearing, c);
    if (sum.empty()) sum = {u.times, std::vector<double>(u.times.size(), constant)};
    for (std::size_t i = 0; i < u.values.size(); ++i) sum.values[i] += factors[c] * u.values[i];
  }
  return sum;
}

using Factors = std::array<double, growth_surfaces.size()>;

/// How far a row's inner contact points move more than its outer ones, per growth of each surface.
struct RowFactors {
  Factors radial{}, axial{};
  Factors approach{};  ///< of the races along the contact's nominal normal, with both ends of the ball
};
std::vector<RowFactors> row_factors(const TouchdownParameters& p) {
  const double lean = std::cos(p.contact_angle), side = std::sin(p.contact_angle), half = 0.5 * p.ball_diameter * side;
  std::vector<RowFactors> rows;
  for (const auto& row : row_places(p)) {
    // The normal from the inner point to the outer one has the parts s sin phi and cos phi.
    const double s = row.direction, inner = (row.position - s * half) / p.width,
                 outer = (row.position + s * half) / p.width;
    const double share = row.difference_share;
    rows.push_back({{0., 0., 1., -1., 0., 0., 0., share},
                    {0., 0., 0., 0., 0., inner, -outer, 0.},
                    {0., 0., lean, -lean, 2., s * side * inner, -s * side * outer, share * lean}});
  }
  return rows;
}

/// Approach of the races to the balls in the mean over the rows.
Json ball_approach_json(const Side& a, const Side& b, const std::string& bearing, const TouchdownParameters& p,
                        const Tolerance& tolerance, const Names& names, const std::vector<Instant>& instants) {
  Factors mean{};
  const auto rows = row_factors(p);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < mean.size(); ++c) mean.at(c) += row.approach.at(c) / static_cast<double>(rows.size());
  return difference_json(of_growth(a, bearing, 0., mean), of_growth(b, bearing, 0., mean), tolerance, names, instants);
}

/// Each row by itself, where elasticity knows it: the circuit has one growth for all.
Json row_growth_json(const Side& lumped, const Side& fe, const std::string& bearing, const TouchdownParameters& p,
                     const Tolerance& tolerance, const std::vector<Instant>& instants) {
  const std::string path = fe.drop.node_path(Kind::fe, bearing, "row_growth");
  Json j = Json::array();
  if (!fe.drop.has(path)) return j;
  const Names names{"lumped", "fe"};
  const auto rows = row_factors(p);
  const auto places = row_places(p);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const TimeSeries radial = fe.drop.series(path, 2 * row), axial = fe.drop.series(path, 2 * row + 1),
                     ball = growth_series(fe, bearing, 4);
    TimeSeries approach = radial;
    const double lean = std::cos(p.contact_angle), side = places[row].direction * std::sin(p.contact_angle);
    for (std::size_t i = 0; i < approach.values.size(); ++i)
      approach.values[i] = lean * radial.values[i] + side * axial.values[i] + 2. * ball.values.at(i);
    const auto difference = [&](const Factors& factors, const TimeSeries& found) {
      return difference_json(of_growth(lumped, bearing, 0., factors), found, tolerance, names, instants);
    };
    j.push_back({{"row", row + 1},
                 {"radial", difference(rows[row].radial, radial)},
                 {"axial", difference(rows[row].axial, axial)},
                 {"ball_approach", difference(rows[row].approach, approach)}});
  }
  return j;
}

/// Contact loads of opposed rows at rest under each model's growth, the ring without load, turning as it then does.
Json effect_json(const Side& a, const Side& b, const std::string& bearing, const TouchdownParameters& p,
                 const Names& names, const std::vector<Instant>& instants) {
  Json j = Json::array();
  if (p.rows < 2 || p.arrangement == RowArrangement::tandem) return j;
  const auto& parameters = a.drop.parameters();
  const auto running = build_running_bearing(parameters, bearing, 0., rest_finder(bearing));
  const TimeSeries speed = a.drop.series("/bearings/" + bearing + "/ring_speed");
  const bool grows = parameters.thermal.growth_by_speed != GrowthBySpeed::none;
  const Expansion by_speed = grows ? ring_growth_by_speed(parameters, p) : Expansion{};
  for (const auto& [name, t] : instants) {
    const double w = speed.at(t);
    Json entry = {{"instant", name}, {"time", t}, {"ring_speed", w}};
    for (const auto& [side, key] : {std::pair{&a, names.first}, std::pair{&b, names.second}}) {
      Expansion growth;
      for (std::size_t c = 0; c < growth_surfaces.size(); ++c)
        growth.*growth_surfaces[c] = growth_series(*side, bearing, c).at(t);
      try {
        const RunningState state = running->in({combined(1., growth, w * w, by_speed), w, {}});
        entry[key] = {{"preload", state.preload}, {"largest_ball_load", state.largest_ball_load}};
      } catch (const SolverError&) {
        entry[key] = {{"preload", nullptr}, {"largest_ball_load", nullptr}};  // no rest found
      }
    }
    j.push_back(std::move(entry));
  }
  return j;
}

/// Air gap, and play of the balls in the middle of the load: what each model's growth would leave of them.
Json clearances_json(const Side& a, const Side& b, const std::string& bearing, const TouchdownParameters& p,
                     const Tolerance& tolerance, const Names& names, const std::vector<Instant>& instants) {
  const double gap = air_gap(p, a.drop.parameters().contact), lean = std::cos(p.contact_angle);
  // Along the contact's normal: contact points lie at x_row -+ s (d/2) sin phi and move by x/W of their ring's growth.
  const double per_width = std::sin(p.contact_angle) / p.width,
               half = 0.5 * p.ball_diameter * std::sin(p.contact_angle);
  double apart = 0.;  // s x_row; 0 in the mean of rows that all lean one way
  const auto rows = row_places(p);
  for (const auto& row : rows) apart += row.direction * row.position / static_cast<double>(rows.size());
  const std::array<double, growth_surfaces.size()> in_gap = {-1., 1.};
  const std::array<double, growth_surfaces.size()> in_play = {
      0., 0., -lean, lean, -2., -per_width * (apart - half), per_width * (apart + half)};
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
    if (models.fe->parameters().thermal.fe.shaft == FeShaft::lump) j["lumps_in_both"].push_back("shaft");
    j["temperatures"] = temperatures_json(lumped, fe, name, tolerance, names, instants);
    j["surfaces"] = surfaces_json(*models.lumped, *models.fe, name, tolerance, instants);
    j["growth_by"] = is_elastic(fe, name) ? "elasticity" : "formula";
    j["growth"] = growth_json(lumped, fe, name, growth, names, instants);
    j["reasons"] = reasons_json(*models.lumped, *models.fe, name, j["temperatures"],
                                lumped_bodies(drop.parameters(), name, p), impact);
    j["clearances"] = clearances_json(lumped, fe, name, p, growth, names, instants);
    j["ball_approach"] = ball_approach_json(lumped, fe, name, p, growth, names, instants);
    j["row_growth"] = row_growth_json(lumped, fe, name, p, growth, instants);
    j["effect"] = effect_json(lumped, fe, name, p, names, instants);
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
  if (drop.bearings().empty()) throw InputError({where, 0, 0}, "the results contain no touchdown bearing");
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
                     "no touchdown bearing there has the same name as one in " + drop.directory().string());
  j["in_short"] = short_verdict_of(j);
  j["verdict"] = verdict_of(j);
  return c;
}

}  // namespace rotordrop
