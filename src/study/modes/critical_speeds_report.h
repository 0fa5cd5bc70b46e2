#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/facts/rotor_report.h"
#include "case/case.h"

namespace rotordrop {

/// What `rotordrop critical-speeds` is asked, as given on the command line; empty: default.
struct CriticalSpeedQuestion {
  std::string up_to;      ///< default: twice the case's initial speed
  std::string stiffness;  ///< of isotropic springs at all stations
  std::string map;        ///< "1e6 N/m, 1e9 N/m": range of stiffness for the map
};
/// @throws InputError
[[nodiscard]] CriticalSpeedOptions critical_speed_options(const Case& rotor_case,
                                                          const CriticalSpeedQuestion& question);

/// {case, units, supports, stations, range, operating_speed, spin ("negative", if it is), critical_speeds[].{speed, frequency, whirl, damping_ratio,
/// separation}, overdamped_modes, diverging_modes, divergence_rate, rigid_body_modes, map[].{stiffness, speeds}}.
[[nodiscard]] nlohmann::ordered_json critical_speeds_json(const Case& rotor_case, const CriticalSpeedReport& report,
                                                          const CriticalSpeedOptions& options);
/// A table for the screen.
[[nodiscard]] std::string critical_speeds_text(const Case& rotor_case, const nlohmann::ordered_json& report);
/// Campbell diagram, and the critical-speed map if there is one, as one SVG picture.
[[nodiscard]] std::string campbell_picture(const CriticalSpeedReport& report, double up_to, double operating_speed);

}  // namespace rotordrop
