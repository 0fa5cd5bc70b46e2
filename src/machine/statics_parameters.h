#pragma once
#include <array>
#include <vector>

#include "base/parameters/section.h"
#include "rotor/static_rotor.h"

namespace rotordrop {

enum class StaticsSubject {
  shaft,    ///< the rotor at rest on all its supports
  bearings  ///< every touchdown bearing by itself under the same load
};
enum class PreloadBy { rigid, spring };

/// [statics]: what rests, on what, under what.
struct StaticsParameters {
  StaticsSubject subject = StaticsSubject::shaft;
  std::array<double, 3> force{};                                         ///< on the inner ring, x, y, z [N]
  std::array<double, 2> moment{};                                        ///< on the inner ring, about y, z [N m]
  std::vector<RotorLoad> loads;                                          ///< on the rotor
  double speed = 0;                                                      ///< of the inner rings [rad/s]
  double inner_rise = 0, outer_rise = 0, ball_rise = 0, shaft_rise = 0;  ///< over ambient [K]
  double inner_growth = 0, outer_growth = 0;                             ///< of the raceways by fits [m]
  PreloadBy preload_by = PreloadBy::rigid;
  double preload_stiffness = 0;  ///< [N/m]
};
Section<StaticsParameters> statics_section();

}  // namespace rotordrop
