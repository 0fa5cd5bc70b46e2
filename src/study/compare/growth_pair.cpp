#include <array>
#include <cmath>
#include <tuple>

#include "analysis/preload/build_preload.h"
#include "base/errors.h"
#include "machine/speed_growth.h"
#include "study/compare/model_pair.h"
#include "study/preload/preload_tables.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

TimeSeries growth_series(const Side& side, const std::string& bearing, std::size_t surface) {
  const std::string judged = side.drop.node_path(side.kind, bearing, "elastic_growth");
  const bool has_judged = side.kind.meshes_sections && side.drop.has(judged);
  return side.drop.growth(has_judged ? judged : side.drop.growth_path(side.kind, bearing), surface);
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

/// Of a constant and factors of growths: second model minus first.
Json difference(const ModelPair& pair, double constant, const Factors& factors) {
  return difference_json(of_growth(pair.first, pair.bearing, constant, factors),
                         of_growth(pair.second, pair.bearing, constant, factors), pair.growth, pair.names(),
                         pair.instants);
}

}  // namespace

bool is_elastic(const Side& side, const std::string& bearing) {
  return side.kind.meshes_sections && (side.drop.has(side.drop.node_path(side.kind, bearing, "elastic_growth")) ||
                                       side.drop.parameters().thermal.expansion == GrowthSource::elastic);
}

Json growth_json(const ModelPair& pair) {
  Json j = Json::object();
  for (std::size_t c = 0; c < growth_surface_keys.size(); ++c)
    j[growth_surface_keys[c]] =
        difference_json(growth_series(pair.first, pair.bearing, c), growth_series(pair.second, pair.bearing, c),
                        pair.growth, pair.names(), pair.instants);
  return j;
}

Json ball_approach_json(const ModelPair& pair) {
  Factors mean{};
  const auto rows = row_factors(pair.parameters);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < mean.size(); ++c) mean.at(c) += row.approach.at(c) / static_cast<double>(rows.size());
  return difference(pair, 0., mean);
}

Json row_growth_json(const ModelPair& pair) {
  const auto& p = pair.parameters;
  const auto& [circuit, section] = std::tie(pair.first, pair.second);
  const std::string path = section.drop.node_path(section.kind, pair.bearing, "row_growth");
  Json j = Json::array();
  if (!section.kind.meshes_sections || !section.drop.has(path)) return j;
  const auto rows = row_factors(p);
  const auto places = row_places(p);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const TimeSeries radial = section.drop.series(path, 2 * row), axial = section.drop.series(path, 2 * row + 1),
                     ball = growth_series(section, pair.bearing, 4);
    TimeSeries approach = radial;
    const double lean = std::cos(p.contact_angle), side = places[row].direction * std::sin(p.contact_angle);
    for (std::size_t i = 0; i < approach.values.size(); ++i)
      approach.values[i] = lean * radial.values[i] + side * axial.values[i] + 2. * ball.values.at(i);
    const auto difference = [&, &circuit = circuit](const Factors& factors, const TimeSeries& found) {
      return difference_json(of_growth(circuit, pair.bearing, 0., factors), found, pair.growth, pair.names(),
                             pair.instants);
    };
    j.push_back({{"row", row + 1},
                 {"radial", difference(rows[row].radial, radial)},
                 {"axial", difference(rows[row].axial, axial)},
                 {"ball_approach", difference(rows[row].approach, approach)}});
  }
  return j;
}

Json effect_json(const ModelPair& pair) {
  const auto& [a, b] = std::tie(pair.first, pair.second);
  const auto& p = pair.parameters;
  const std::string& bearing = pair.bearing;
  const Names names = pair.names();
  Json j = Json::array();
  if (p.rows < 2 || p.arrangement == RowArrangement::tandem) return j;
  const auto& parameters = a.drop.parameters();
  const auto running = build_running_bearing(parameters, bearing, 0., rest_finder(bearing));
  const TimeSeries speed = a.drop.series("/bearings/" + bearing + "/ring_speed");
  const bool grows = parameters.thermal.growth_by_speed != GrowthBySpeed::none;
  const Expansion by_speed = grows ? ring_growth_by_speed(parameters, p) : Expansion{};
  for (const auto& [name, t] : pair.instants) {
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

Json clearances_json(const ModelPair& pair) {
  const auto& p = pair.parameters;
  const double gap = air_gap(p, pair.first.drop.parameters().contact), lean = std::cos(p.contact_angle);
  // Along the contact's normal: contact points lie at x_row -+ s (d/2) sin phi and move by x/W of their ring's growth.
  const double per_width = std::sin(p.contact_angle) / p.width,
               half = 0.5 * p.ball_diameter * std::sin(p.contact_angle);
  double apart = 0.;  // s x_row; 0 in the mean of rows that all lean one way
  const auto rows = row_places(p);
  for (const auto& row : rows) apart += row.direction * row.position / static_cast<double>(rows.size());
  const std::array<double, growth_surfaces.size()> in_gap = {-1., 1.};
  const std::array<double, growth_surfaces.size()> in_play = {
      0., 0., -lean, lean, -2., -per_width * (apart - half), per_width * (apart + half)};
  return {{"air_gap", difference(pair, gap, in_gap)}, {"ball_play_change", difference(pair, 0., in_play)}};
}

}  // namespace rotordrop
