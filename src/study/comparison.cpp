#include "study/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/errors.h"
#include "base/units.h"
#include "laws/hertz.h"
#include "machine/build_machine.h"
#include "study/lumping.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ThermalModelKind;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

constexpr const char* nodes[] = {"shaft", "inner_ring", "ball", "outer_ring", "housing"};
/// Surfaces of the finite elements, and the node that stands for each.
struct SurfacePair {
  const char *surface, *node;
};
constexpr SurfacePair surface_pairs[] = {{"bore", "inner_ring"},
                                         {"inner_raceway", "inner_contact"},
                                         {"outer_raceway", "outer_contact"},
                                         {"housing_surface", "housing"}};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

struct Instant {
  std::string name;
  double time = 0;
};

/// The first impact of a bearing; NaN if there was none.
struct Impact {
  double start = nothing, end = nothing, peak_time = nothing, peak = 0;
};

Impact first_impact(const RecordedDrop& drop, const std::string& bearing) {
  const TimeSeries penetration = drop.series("/bearings/" + bearing + "/penetration");
  Impact impact;
  const double begin = penetration.times.front();
  const auto start = penetration.values.front() > 0. ? begin : first_crossing(penetration, true, begin);
  if (!start) return impact;
  impact.start = *start;
  impact.end = first_crossing(penetration, false, *start).value_or(penetration.times.back());
  if (const auto peak = largest_of(drop.series("/bearings/" + bearing + "/contact_force"), impact.start, impact.end)) {
    impact.peak = peak->value;
    impact.peak_time = peak->time;
  }
  return impact;
}

std::vector<Instant> instants_of(const Impact& impact, double end, const std::vector<double>& more) {
  std::vector<Instant> list;
  if (std::isfinite(impact.peak_time)) list.push_back({"first impact's peak", impact.peak_time});
  for (const double t : more)
    if (t < end) list.push_back({fmt::format("{:.6g} ms", t * 1e3), t});
  list.push_back({"end", end});
  return list;
}

/// How the two sides of a difference are called.
struct Names {
  const char *first, *second;
};

Json difference_json(const TimeSeries& first, const TimeSeries& second, double tolerance, const Names& names,
                     const std::vector<Instant>& instants) {
  const Difference d = difference_of(first, second, tolerance);
  Json j = {{"tolerance", tolerance},
            {"largest_difference", d.largest},
            {"largest_difference_time", d.largest_time},
            {"beyond_from", number(d.beyond)},
            {"within_from", number(d.within)},
            {"time_beyond", d.time_beyond},
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

Json temperatures_json(const Side& a, const Side& b, const std::string& bearing, double tolerance, const Names& names,
                       const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const char* node : nodes)
    j[node] = difference_json(a.drop.series(a.drop.node_path(a.kind, bearing, node)),
                              b.drop.series(b.drop.node_path(b.kind, bearing, node)), tolerance, names, instants);
  return j;
}

Json surfaces_json(const RecordedDrop& lumped, const RecordedDrop& fe, const std::string& bearing, double tolerance,
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

Json growth_json(const Side& a, const Side& b, const std::string& bearing, double tolerance, const Names& names,
                 const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (std::size_t c = 0; c < std::size(growth_columns); ++c)
    j[growth_columns[c]] =
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
                     double tolerance, const Names& names, const std::vector<Instant>& instants) {
  const double gap = air_gap(p, a.drop.parameters().contact), lean = std::cos(p.contact_angle);
  const std::array<double, 5> in_gap = {-1., 1., 0., 0., 0.}, in_play = {0., 0., -lean, lean, -2.};
  return {{"air_gap", difference_json(of_growth(a, bearing, gap, in_gap), of_growth(b, bearing, gap, in_gap), tolerance,
                                      names, instants)},
          {"ball_play_change", difference_json(of_growth(a, bearing, 0., in_play), of_growth(b, bearing, 0., in_play),
                                               tolerance, names, instants)}};
}

Json lumping_json(const BearingCircuitData& circuit, const Impact& impact, const std::vector<Instant>& instants) {
  Json j = Json::object();
  for (const auto& body : lumped_bodies(circuit)) {
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

// ------------------------------------------------------------------------------------------------------------------ bore

RubRecord rub_record(const RecordedDrop& drop, const std::string& bearing) {
  const std::string at = "/bearings/" + bearing + "/", ledger = "/ledger/" + bearing + "/";
  const TimeSeries y = drop.series(at + "orbit", 0), z = drop.series(at + "orbit", 1);
  const TimeSeries ring_y = drop.series(at + "ring_position", 0), ring_z = drop.series(at + "ring_position", 1);
  const TimeSeries all = drop.series(ledger + "rub_heat");
  RubRecord r;
  r.times = y.times;
  r.joules_into_ring = drop.series(ledger + "rub_heat_into_ring").values;
  r.ring_angle = integral_of(drop.series(at + "ring_speed")).values;
  r.rotor_angle = drop.series("/rotor/spin_angle").values;
  for (std::size_t i = 0; i < r.times.size(); ++i) {
    r.contact_angle.push_back(std::atan2(z.values[i] - ring_z.values[i], y.values[i] - ring_y.values[i]));
    r.joules_into_rotor.push_back(all.values[i] - r.joules_into_ring[i]);
  }
  return r;
}

RubSurfaces rub_surfaces(const BearingCircuitData& c, double bore, double band_length) {
  const double capacity = c.ring.density * c.ring.heat_capacity;
  RubSurfaces s;
  s.bore = {bore, c.ring.conductivity, capacity, 0.5 * (c.inner_outside - c.inner_bore)};
  s.rotor_radius = c.journal_radius;
  s.rotor_conductivity = c.ring.conductivity;
  s.rotor_capacity = capacity;
  s.half_width = 0.5 * band_length;
  s.axial_width = c.width;
  return s;
}

BoreTemperatures bore_temperatures(const std::string& bearing, BoreHistory history, const TimeSeries* node,
                                   const TimeSeries* mean, double ambient) {
  BoreTemperatures b;
  b.bearing = bearing;
  const std::size_t n = history.times.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double t = history.times[i];
    // Over the half space's own mean: that part of the heat is in the finite elements already.
    const double bulk = mean ? mean->at(t) - history.mean_rise[i] : ambient;
    b.node.push_back(node ? node->at(t) : nothing);
    b.mean.push_back(bulk + history.mean_rise[i]);
    b.local.push_back(bulk + history.largest_rise[i]);
    b.flash.push_back(bulk + history.rise_at_contact[i]);
    b.rotor_flash.push_back(history.rotor_flash[i]);
  }
  b.history = std::move(history);
  return b;
}

/// The row whose time comes closest to t.
std::size_t row_at(const std::vector<double>& times, double t) {
  const auto after = std::lower_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - times.begin());
  return i < times.size() && times[i] - t < t - times[i - 1] ? i : i - 1;
}

Json largest_excess(const BoreTemperatures& b, const std::vector<double>& over) {
  Extreme most{-std::numeric_limits<double>::infinity(), nothing};
  for (std::size_t i = 0; i < b.local.size(); ++i)
    if (b.local[i] - over[i] > most.value) most = {b.local[i] - over[i], b.history.times[i]};
  return {{"value", number(most.value)}, {"time", number(most.time)}};
}

Json bore_json(const BoreTemperatures& b, const RubRecord& r, const RubSurfaces& s, double hertz_half_width,
               bool has_mean, const Impact& impact, const std::vector<Instant>& instants) {
  const auto& h = b.history;
  Json j = {{"mean_from", has_mean ? "finite elements" : "half space"},
            {"half_width", s.half_width},
            {"hertz_half_width", number(hertz_half_width)},
            {"axial_width", s.axial_width},
            {"wall_crossed_after", h.valid_until},
            {"track_widens_after", s.half_width * s.half_width * s.bore.capacity / s.bore.conductivity},
            {"largest_local_over_node", largest_excess(b, b.node)},
            {"largest_local_over_mean", largest_excess(b, b.mean)},
            {"at", Json::array()}};
  for (const auto& [name, t] : instants) {
    const std::size_t i = row_at(h.times, t);
    j["at"].push_back({{"instant", name},
                       {"time", h.times[i]},
                       {"lumped_node", number(b.node[i])},
                       {"mean", b.mean[i]},
                       {"local", b.local[i]},
                       {"flash", number(b.flash[i])},
                       {"rotor_flash_rise", number(b.rotor_flash[i])},
                       {"arc", h.arc[i] * s.bore.radius},
                       {"heated_arc", h.heated_arc[i] * s.bore.radius},
                       {"ring_turns", h.ring_turns[i]},
                       {"half_space_valid", !(h.times[i] > impact.start + h.valid_until)}});
  }
  if (!std::isfinite(impact.start)) return j;
  const TimeSeries heat{r.times, r.joules_into_ring}, angle{r.times, r.ring_angle};
  const double duration = impact.end - impact.start;
  // Contact ends between two rows; what was swept until the last one before.
  double arc = 0., local = 0., local_time = nothing;
  for (std::size_t i = 0; i < h.times.size() && h.times[i] <= impact.end; ++i) {
    arc = std::max(arc, h.arc[i]);
    if (h.largest_rise[i] > local) {
      local = h.largest_rise[i];
      local_time = h.times[i];
    }
  }
  const double joules = heat.at(impact.end) - heat.at(impact.start);
  j["first_impact"] = {{"duration", duration},
                       {"heat_into_ring", joules},
                       {"arc", arc * s.bore.radius},
                       {"ring_angle", angle.at(impact.end) - angle.at(impact.start)},
                       {"largest_local_rise", local},
                       {"largest_local_rise_time", number(local_time)},
                       {"steady_band_rise", steady_band_rise(s, joules, duration, arc)}};
  return j;
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

double tolerance_of(const TemperatureTolerance& t, double rise) { return t.is_part ? t.value * rise : t.value; }

Json compare_bearing(const std::string& name, const TouchdownParameters& p, const RecordedDrop& drop,
                     const RecordedDrop* against, const Models& models, const ComparisonOptions& options,
                     std::vector<BoreTemperatures>& bores) {
  const Impact impact = first_impact(drop, name);
  double end = drop.series("/bearings/" + name + "/orbit").times.back();
  if (against) end = std::min(end, against->series("/bearings/" + name + "/orbit").times.back());
  const auto instants = instants_of(impact, end, options.instants);
  const auto circuit = circuit_data(drop.parameters(), name, p);

  Json j;
  j["first_contact_time"] = number(impact.start);
  j["first_contact_end"] = number(impact.end);
  if (models.lumped && models.fe) {
    const Side lumped{*models.lumped, Kind::lumped}, fe{*models.fe, Kind::fe};
    const Names names{"lumped", "fe"};
    const double rise = std::max(largest_rise(lumped, name), largest_rise(fe, name)),
                 tolerance = tolerance_of(options.temperature, rise);
    j["largest_rise"] = rise;
    j["lumps_in_both"] = Json::array({"ball"});
    if (!models.fe->parameters().thermal.fe.shaft) j["lumps_in_both"].push_back("shaft");
    j["temperatures"] = temperatures_json(lumped, fe, name, tolerance, names, instants);
    j["surfaces"] = surfaces_json(*models.lumped, *models.fe, name, tolerance, instants);
    j["growth"] = growth_json(lumped, fe, name, options.growth, names, instants);
    j["clearances"] = clearances_json(lumped, fe, name, p, options.growth, names, instants);
  }

  std::optional<TimeSeries> node, mean;
  if (models.lumped) node = models.lumped->series(models.lumped->node_path(Kind::lumped, name, "inner_ring"));
  if (models.fe) mean = models.fe->series(models.fe->surface_path(name, "bore"), 0);
  const RubRecord rub = rub_record(drop, name);
  const double bore = bore_radius(p, drop.parameters().contact);
  const RubSurfaces surfaces =
      rub_surfaces(circuit, bore, options.band_length.value_or(drop.parameters().thermal.rub_band_length));
  double hertz = nothing;
  for (const auto& [material, m] : drop.parameters().materials)
    if (material == p.ring) {
      const double E = effective_modulus({m.E, m.nu}, {m.E, m.nu});
      hertz = line_contact_half_width(impact.peak / p.width,
                                      bore * circuit.journal_radius / (bore - circuit.journal_radius), E);
    }
  bores.push_back(bore_temperatures(name, bore_history(rub, surfaces), node ? &*node : nullptr, mean ? &*mean : nullptr,
                                    drop.parameters().run.ambient));
  j["bore"] = bore_json(bores.back(), rub, surfaces, hertz, mean.has_value(), impact, instants);
  j["lumping"] = lumping_json(circuit, impact, instants);
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
  j["air_gap"] = difference_json(drop.series(gap), against.series(gap), options.growth, names, instants);
  for (std::size_t c = 0; c < std::size(growth_columns); ++c)
    j["expansion"][growth_columns[c]] =
        difference_json(drop.series(expansion, c), against.series(expansion, c), options.growth, names, instants);
  for (const Kind kind : {Kind::lumped, Kind::fe}) {
    if (!drop.has(kind) || !against.has(kind)) continue;
    const Side a{drop, kind}, b{against, kind};
    const double tolerance = tolerance_of(options.temperature, std::max(largest_rise(a, name), largest_rise(b, name)));
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

double positive_si(const std::string& text, const char* unit, QuantityKind kind, const std::string& option,
                   const char* name) {
  const auto value = convert_to_si(text, unit, kind, name);
  if (!value) throw InputError({option, 0, 0}, value.error, value.advice);
  if (!(value.value > 0.)) throw InputError({option, 0, 0}, fmt::format("\"{}\" must be above zero", text));
  return value.value;
}

}  // namespace

TemperatureTolerance parse_temperature_tolerance(const std::string& text) {
  const auto percent = text.find('%');
  if (percent != std::string::npos) {
    std::string before = text.substr(0, percent);
    before.erase(before.find_last_not_of(' ') + 1);
    const auto value = bare_number(before);
    if (!value || !(*value > 0.) || !std::isfinite(*value) ||
        text.find_first_not_of(' ', percent + 1) != std::string::npos)
      throw InputError({"--tolerance", 0, 0}, fmt::format("\"{}\" is no percentage above zero", text),
                       "Write \"5 %\" of the largest rise, or \"0.5 K\".");
    return {*value / 100., true};
  }
  return {positive_si(text, "K", QuantityKind::temperature_difference, "--tolerance", "a tolerance"), false};
}

double parse_length(const std::string& text, const std::string& option) {
  return positive_si(text, "m", QuantityKind::plain, option, "it");
}

std::vector<double> parse_instants(const std::string& text) {
  std::vector<double> instants;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    instants.push_back(positive_si(text.substr(from, comma - from), "s", QuantityKind::plain, "--times", "a time"));
    from = comma + 1;
  }
  return instants;
}

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
                     {"temperature_unit", options.temperature.is_part ? "part of the largest rise" : "K"},
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
  j["verdict"] = verdict_of(j);
  return c;
}

}  // namespace rotordrop
