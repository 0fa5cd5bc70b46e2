#include "study/preload/preload_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "analysis/preload/build_preload.h"
#include "machine/speed_growth.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Of a column: what it is at the start and the end, and its largest value.
Json course(const PreloadTable& table, std::size_t column, bool smallest = false) {
  const auto less = [&](const auto& a, const auto& b) { return a[column] < b[column]; };
  const auto found = smallest ? std::min_element(table.rows.begin(), table.rows.end(), less)
                              : std::max_element(table.rows.begin(), table.rows.end(), less);
  return {{"start", table.rows.front()[column]},
          {smallest ? "smallest" : "largest", (*found)[column]},
          {"time", table.axis[static_cast<std::size_t>(found - table.rows.begin())]},
          {"end", table.rows.back()[column]}};
}

}  // namespace

Json make_preload_history(const Case& c, const std::string& bearing, const RecordedDrop& drop,
                          std::vector<PreloadTable>& tables, const Look& look) {
  constexpr std::size_t most_instants = 3000;
  const auto& p = c.parameters;
  const std::string from = fmt::format("/bearings/{}/", bearing);
  if (!drop.has(from + "expansion") || !drop.has(from + "ring_speed"))
    throw InputError({drop.directory().string(), 0, 0},
                     fmt::format("the drop recorded no growth for a touchdown bearing \"{}\"", bearing),
                     "Choose a recorded bearing with --bearing.");
  std::array<TimeSeries, growth_surfaces.size()> growth;
  for (std::size_t k = 0; k < growth.size(); ++k) growth[k] = drop.growth(from + "expansion", k);
  const auto speed = drop.series(from + "ring_speed");
  const auto force_y = drop.series(from + "bearing_force", 0), force_z = drop.series(from + "bearing_force", 1);

  // Of rings that are locked along the axis what their rows leave there is no load.
  std::vector<TimeSeries> axial;
  const auto& b = touchdown_of(p, bearing);
  if (drop.has(from + "axial_position"))
    for (int row = 0; row < touchdown_of(drop.parameters(), bearing).rows; ++row)
      axial.push_back(drop.series(from + "row_axial_force", static_cast<std::size_t>(row)));

  // A drop that grew by its speeds recorded that too.
  if (drop.driver() == "recorded" && preload_grows_by_speed(p))
    throw InputError(
        position_of(c.tree, "preload"),
        "the drop used growth recorded by an earlier run, and does not say whether that includes centrifugal growth.",
        "Give that earlier run with --results, or set preload.growth_by_speed = \"none\".");
  const bool has_growth_by_speed = drop_grows_by_speed(drop.parameters());
  MachineParameters cold_parameters = p;
  if (has_growth_by_speed) cold_parameters.preload.growth_by_speed = PreloadGrowthBySpeed::none;

  const auto running = build_running_bearing(p, bearing, 0., rest_finder(bearing, look));
  const std::string to = fmt::format("/{}/history/", bearing);
  PreloadTable table;
  table.group = {to + "time", running_channels(to)};
  table.group.channels.push_back({to + "ring_speed", "rad/s", "spin speed of the inner ring", 1, {}});
  table.group.channels.push_back({to + "growth",
                                  "m",
                                  "growth of the inner raceway minus that of the outer one, from heat, speed and fits",
                                  1,
                                  {}});
  const bool under_load = p.preload.history_under_load;
  // Of a drop that is being written, some series may be longer than others.
  std::size_t n = std::min({speed.values.size(), force_y.values.size(), force_z.values.size()});
  n = std::min(n, growth.front().values.size());
  for (const auto& series : axial) n = std::min(n, series.values.size());
  const std::size_t every = under_load ? 1 : (n + most_instants - 1) / most_instants;
  for (std::size_t i = 0; i < n; i = i + every < n || i + 1 == n ? i + every : n - 1) {
    BearingState state;
    state.speed = speed.values[i];
    std::array<double, growth_surfaces.size()> recorded{};
    for (std::size_t k = 0; k < growth.size(); ++k) recorded[k] = growth[k].values[i];
    state.growth = combined(1., expansion_of(recorded), 1., cold_growth(cold_parameters, b, state.speed));
    // The balls' force on the ring is what a ring at rest answers with.
    if (under_load) {
      state.load = {0., -force_y.values[i], -force_z.values[i], 0., 0., 0.};
      for (const auto& row : axial) state.load.x -= row.values[i];
    }
    auto row = running_values(running->in(state));
    row.push_back(state.speed);
    row.push_back(state.growth.inner_race - state.growth.outer_race);
    table.axis.push_back(speed.times[i]);
    table.rows.push_back(std::move(row));
  }
  Json j = {{"results_of", drop.case_name()},
            {"instants", table.axis.size()},
            {"of_recorded", n},
            {"under_load", under_load},
            {"growth_by_speed", has_growth_by_speed         ? "recorded"
                                : preload_grows_by_speed(p) ? "thin-disc"
                                                            : "none"},
            {"preload", course(table, 0)},
            {"largest_ball_load", course(table, 1)},
            {"largest_pressure", course(table, 2)},
            {"radial_clearance", course(table, 7, true)},
            {"growth", course(table, 9)}};
  tables.push_back(std::move(table));
  return j;
}

}  // namespace rotordrop
