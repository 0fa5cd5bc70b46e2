#include "study/preload/preload_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/preload/build_preload.h"
#include "base/rotation.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

struct Axis {
  std::string name, unit, long_name;
  std::vector<double> values;
  double shown = 1;  ///< factor to the unit in which columns are named
  std::string shown_unit = {};
};

/// Smallest and largest of some values.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] Json json() const { return low <= high ? Json{{"smallest", low}, {"largest", high}} : Json(nullptr); }
};

/// @param state  of the bearing at a point of the two axes
template <class StateAt>
Json make_map(const std::string& name, const std::string& bearing, const TouchdownRunning& running, const Axis& rows,
              const Axis& columns, StateAt state, std::vector<PreloadTable>& tables) {
  const std::string prefix = fmt::format("/{}/maps/{}/", bearing, name);
  std::vector<std::string> names;
  for (const double v : columns.values)
    names.push_back(fmt::format("{:.6g} {}", v * columns.shown, columns.shown_unit));
  PreloadTable map, other;
  map.group = {prefix + rows.name, running_channels(prefix, columns.values.size(), names), rows.unit, rows.long_name};
  map.axis = rows.values;
  other.group = {prefix + columns.name, {}, columns.unit, columns.long_name};
  other.axis = columns.values;
  other.rows.resize(columns.values.size());
  int n_failed = 0;
  Extent preload, ball_load, pressure;
  Json corners = Json::array();
  for (const double row : rows.values) {
    std::vector<std::vector<double>> values;  // [n_columns][n_quantities]
    for (const double column : columns.values) {
      const bool is_corner = (row == rows.values.front() || row == rows.values.back()) &&
                             (column == columns.values.front() || column == columns.values.back());
      try {
        const RunningState s = running.in(state(row, column));
        values.push_back(running_values(s));
        preload.add(s.preload);
        ball_load.add(s.largest_ball_load);
        pressure.add(s.largest_pressure);
        if (is_corner)
          corners.push_back({{rows.name, row},
                             {columns.name, column},
                             {"preload", s.preload},
                             {"largest_ball_load", s.largest_ball_load},
                             {"largest_pressure", s.largest_pressure},
                             {"axial_stiffness", s.axial_stiffness}});
      } catch (const SolverError&) {
        ++n_failed;
        values.emplace_back(map.group.channels.size(), std::numeric_limits<double>::quiet_NaN());
      }
    }
    std::vector<double> line;
    for (std::size_t quantity = 0; quantity < map.group.channels.size(); ++quantity)
      for (const auto& point : values) line.push_back(point[quantity]);
    map.rows.push_back(std::move(line));
  }
  tables.push_back(std::move(map));
  tables.push_back(std::move(other));
  return {{rows.name, rows.values},
          {columns.name, columns.values},
          {"preload", preload.json()},
          {"largest_ball_load", ball_load.json()},
          {"largest_pressure", pressure.json()},
          {"corners", corners},
          {"without_equilibrium", n_failed}};
}

}  // namespace

Json make_preload_maps(const Case& c, const std::string& bearing, std::vector<PreloadTable>& tables, const Look& look) {
  const auto& p = c.parameters;
  const auto& axes = p.preload.map;
  const auto& b = touchdown_of(p, bearing);
  const double full = preload_speed(p);
  const auto running = build_running_bearing(p, bearing, 0., rest_finder(bearing, look));
  const Force load = preload_load(p.preload);
  Axis speed{"speed", "rad/s", "of the inner ring", axes.speed, to_rpm, "rpm"};
  if (speed.values.empty()) speed.values = full > 0. ? std::vector<double>{0., 0.5 * full, full} : std::vector{0.};
  const auto cold = [&](double at_speed) { return BearingState{cold_growth(p, b, at_speed), at_speed, load}; };

  Json maps = Json::object();
  if (!axes.growth.empty())
    maps["growth"] = make_map(
        "growth", bearing, *running,
        {"growth", "m", "growth of the inner raceway minus that of the outer one", axes.growth}, speed,
        [&](double growth, double at_speed) {
          auto state = cold(at_speed);
          state.growth.inner_race += growth;
          return state;
        },
        tables);
  if (!axes.interference.empty()) {
    const double closure = housing_closure(b);
    maps["interference"] = make_map(
        "interference", bearing, *running,
        {"interference", "m", "radial interference between outer ring and housing, above the mounted value",
         axes.interference},
        speed,
        [&](double interference, double at_speed) {
          auto state = cold(at_speed);
          state.growth.outer_race -= closure * interference;
          return state;
        },
        tables);
    maps["interference"]["closure_per_interference"] = closure;
  }
  if (!axes.inner_rise.empty() && !axes.outer_rise.empty()) {
    const auto ring = even_growth(p, b);
    maps["rise"] = make_map(
        "rise", bearing, *running,
        {"inner_rise", "K", "temperature rise of the inner ring above ambient", axes.inner_rise},
        {"outer_rise", "K", "of the outer ring over ambient", axes.outer_rise, 1., "K"},
        [&](double inner, double outer) {
          auto state = cold(full);
          state.growth.inner_race += ring.inner_race * inner;
          state.growth.inner_width += ring.inner_width * inner;
          state.growth.outer_race += ring.outer_race * outer;
          state.growth.outer_width += ring.outer_width * outer;
          state.growth.ball += ring.ball * 0.5 * (inner + outer);  // balls between the rings
          return state;
        },
        tables);
    maps["rise"]["speed"] = full;
  }
  return maps;
}

}  // namespace rotordrop
