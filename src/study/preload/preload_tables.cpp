#include "study/preload/preload_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/version.h"
#include "integrate/equilibrium.h"

namespace rotordrop {

std::vector<Channel> running_channels(const std::string& prefix, std::size_t size,
                                      const std::vector<std::string>& columns) {
  return {{prefix + "preload", "N", "smaller axial force of opposed rows", size, columns},
          {prefix + "largest_ball_load", "N", "load of the most loaded ball", size, columns},
          {prefix + "largest_pressure", "Pa", "largest pressure of balls and races", size, columns},
          {prefix + "static_safety", "1", "(4.2 GPa / largest pressure)^3", size, columns},
          {prefix + "axial_stiffness", "N/m", "stiffness of the inner ring along x", size, columns},
          {prefix + "radial_stiffness_y", "N/m", "of the inner ring along y", size, columns},
          {prefix + "radial_stiffness_z", "N/m", "of the inner ring along z", size, columns},
          {prefix + "radial_clearance", "m",
           "radial clearance left in the mounted position; negative: balls are compressed", size, columns}};
}

std::vector<double> running_values(const RunningState& s) {
  const double safety = std::isfinite(s.static_safety) ? s.static_safety : std::numeric_limits<double>::quiet_NaN();
  return {s.preload,         s.largest_ball_load,  s.largest_pressure,   safety,
          s.axial_stiffness, s.radial_stiffness_y, s.radial_stiffness_z, s.radial_clearance};
}

void write_tables(const std::filesystem::path& file, const Case& c, const std::vector<PreloadTable>& tables,
                  bool overwrite) {
  std::vector<SeriesGroup> groups;
  std::size_t longest = 1;
  for (const auto& table : tables) {
    groups.push_back(table.group);
    longest = std::max(longest, table.axis.size());
  }
  RecorderOptions options;
  options.overwrite = overwrite;
  options.rows_per_chunk = std::min<std::size_t>(longest, 1024);
  const RecordHeader header{
      {{"program", program_name()}, {"git_revision", git_revision()}, {"content", "thermal preload"}, {"case", c.name}},
      {{"/parameters", c.resolved.text}}};
  Recorder recorder(file, header, groups, options);
  for (std::size_t g = 0; g < tables.size(); ++g)
    for (std::size_t i = 0; i < tables[g].axis.size(); ++i) recorder.append(g, tables[g].axis[i], tables[g].rows[i]);
  recorder.close();
}

FindRest rest_finder(const std::string& bearing, Look look) {
  return [bearing, look = std::move(look)](EquilibriumSystem& system, std::span<double> x) {
    if (look) look();
    const auto result = find_equilibrium(system, x);
    if (!result.found)
      throw SolverError(
          std::isfinite(result.residual)
              ? fmt::format("no equilibrium of {} was found: {:.2g} of the forces are left.", bearing, result.residual)
              : fmt::format("no equilibrium of {} was found: its forces are no numbers.", bearing));
  };
}

}  // namespace rotordrop
