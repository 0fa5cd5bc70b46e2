#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/facts/rotor_report.h"
#include "case/case.h"

namespace rotordrop {

/// Natural modes of a case's rotor at constant spin speeds: with its linear supports and magnets, or free-free.
struct ModesReport {
  std::vector<double> speeds;  ///< [rad/s]
  std::vector<WhirlModes> modes;
  bool is_free_free = true;
  std::string held_by;                 ///< "linear supports", "magnets" or both; empty if free-free
  std::vector<std::string> left_out;   ///< supports of kinds added by others
  std::vector<double> node_positions;  ///< [m]
};
ModesReport find_modes(const Case& rotor_case, const std::vector<double>& speeds);

/// What holds a levitated rotor by its stiffness: "linear supports", "magnets", "linear supports and magnets"; empty if nothing does.
[[nodiscard]] std::string supports_with_stiffness(const CaseParameters& parameters);

/// A sentence and a line's end about motions that diverge. @param rate  of the fastest [1/s]
[[nodiscard]] std::string diverging_text(int n_diverging, double rate);

/// supports, left_out[] (if there are such), speeds[].{speed, rigid_body_modes, overdamped_modes, diverging_modes, divergence_rate, modes[].{frequency, natural_frequency, damping_ratio, whirl}}; rad/s and Hz.
nlohmann::ordered_json to_json(const ModesReport& report, std::size_t n_modes);
/// A table of the first n_modes of each speed.
std::string to_table(const ModesReport& report, std::size_t n_modes);
/// Mode shapes: /node_positions, /speeds, and per speed /speed_K/{frequency, damping_ratio, shape_y_real, ...}.
void write_mode_shapes(const ModesReport& report, std::size_t n_modes, const std::filesystem::path& file);

/// "0 rpm, 15200 rpm" to rad/s. @throws InputError
std::vector<double> parse_speeds(const std::string& text);

}  // namespace rotordrop
