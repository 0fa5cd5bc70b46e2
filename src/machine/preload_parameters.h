#pragma once
#include <array>
#include <optional>
#include <vector>

#include "base/parameters/section.h"

namespace rotordrop {

/// Whether inner rings grow by their speed in `rotordrop preload`.
enum class PreloadGrowthBySpeed {
  as_drop,  ///< thermal.growth_by_speed
  none,
  thin_disc  ///< closed form of a spinning ring of rectangular section (laws/ring_growth.h)
};

/// Thermal model of a running bearing.
enum class PreloadModel {
  lumped,  ///< its circuit
  fe       ///< its section by finite elements, on few modes
};

/// [preload.map]: axes of the maps.
struct PreloadMapParameters {
  std::vector<double> growth;                  ///< of the inner raceway over the outer one [m]
  std::vector<double> interference;            ///< of outer ring and housing, more than as mounted, by radius [m]
  std::vector<double> inner_rise, outer_rise;  ///< over ambient [K]
  std::vector<double> speed;                   ///< [rad/s]; empty: standstill, half and full preload.speed
};

/// [preload]: one touchdown bearing by itself, running steadily.
struct PreloadParameters {
  PreloadModel model = PreloadModel::lumped;
  std::optional<double> speed;                ///< [rad/s]; run.initial_speed if not given
  std::array<double, 3> force{};              ///< on the inner ring, x, y, z [N]
  std::array<double, 2> moment{};             ///< about y, z [N m]
  double inner_growth = 0, outer_growth = 0;  ///< of the raceways besides heat and speed [m]
  double interference = 0;                    ///< of outer ring and housing, more than as mounted [m]
  PreloadGrowthBySpeed growth_by_speed = PreloadGrowthBySpeed::as_drop;  ///< in maps, histories and running alike
  bool history_under_load = false;                                       ///< histories with the recorded force
  bool critical_values = true;                                           ///< found, and operating points over speed
  double end_time = 0;                                                   ///< [s]
  double settled_rate = 0;                                               ///< [K/s]
  double temperature_limit = 0;                                          ///< [K]
  double pressure_limit = 0;                                             ///< [Pa]
  double tolerance = 0;                                                  ///< relative, of the integration in time
  PreloadMapParameters map;
};
Section<PreloadParameters> preload_section();

}  // namespace rotordrop
