#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parameters/section.h"
#include "bearing/touchdown_parameters.h"
#include "machine/preload_parameters.h"
#include "machine/statics_parameters.h"
#include "machine/supports.h"
#include "rotor/rotor_parameters.h"
#include "thermal/thermal_parameters.h"

namespace rotordrop {

/// Condition that ends a run before its latest end.
enum class EndCondition {
  time,           ///< nothing
  standstill,     ///< the rotor's spin speed is below standstill_speed
  no_contact,     ///< after a contact, no rotor surface has touched an inner ring for flight_without_contact
  rings_at_speed  ///< the bores of all inner rings run within 1 % of the rotor's surface speed
};
inline constexpr double standstill_speed = 1.;         ///< [rad/s]
inline constexpr double flight_without_contact = 0.1;  ///< longer than any bounce in an air gap under gravity [s]

/// [run]: what happens, how long, in what surroundings.
struct RunParameters {
  EndCondition until = EndCondition::time;
  std::optional<double> until_time;         ///< [s]
  double end_time = 0;                      ///< [s]
  double initial_speed = 0;                 ///< of the rotor's spin [rad/s]
  std::array<double, 3> gravity{};          ///< along x, y, z [m/s^2]
  double ambient = 0;                       ///< [K]
  std::vector<std::string> parts;           ///< modules with parts of others, full paths; loaded when the case is read
  std::vector<std::string> fatal_warnings;  ///< codes of warning_kinds, or "all"
  bool second_opinion = false;
  [[nodiscard]] double latest_end() const { return until_time.value_or(end_time); }
  [[nodiscard]] bool is_fatal(std::string_view code) const;
};
Section<RunParameters> run_section();
/// Name of a condition in a case file: "standstill"; empty for `time`.
[[nodiscard]] std::string name_of(EndCondition condition);

/// [materials.NAME].
struct MaterialParameters {
  double E = 0, nu = 0;  ///< Young's modulus [Pa], Poisson's ratio
  double rho = 0;        ///< density [kg/m^3]
  double k = 0, c = 0;   ///< conductivity [W/(m K)], heat capacity [J/(kg K)]
  double alpha = 0;      ///< thermal expansion [1/K]
  std::optional<std::vector<std::array<double, 2>>> k_table, c_table;  ///< pairs of temperature [K] and value
  std::optional<double> temperature_limit;                             ///< a run that exceeds it warns [K]
};
Section<MaterialParameters> material_section();
/// Steel and Si3N4, where a case names no materials of its own.
Node default_materials();

/// What else counts for a bearing that is computed by itself.
struct SingleBearing {
  std::vector<int> neighbours;  ///< nodes of the other touchdown bearings, which share the shaft
  std::string heated;           ///< the bearing whose balls conduct as follows; others may be joined to it by resistors
  std::optional<BallConduction> ball_conduction;  ///< given: no loads and speeds decide it
};

/// Everything that makes the machine; integration and output are elsewhere.
struct MachineParameters {
  RunParameters run;
  RotorParameters rotor;
  ContactParameters contact;
  std::vector<SupportEntry> bearings;
  std::vector<std::pair<std::string, MaterialParameters>> materials;
  ThermalParameters thermal;
  StaticsParameters statics;
  PreloadParameters preload;
  SingleBearing single;
};

/// A section of a case as given; an empty table if there is none.
[[nodiscard]] const Node& table_of(const Node& case_node, const char* section);
/// nullptr if the case has no material of that name.
[[nodiscard]] const MaterialParameters* find_material(const MachineParameters& parameters, const std::string& name);
/// Of a case that was checked. @throws std::invalid_argument for an unknown name
[[nodiscard]] const MaterialParameters& material_of(const MachineParameters& parameters, const std::string& name);
[[nodiscard]] std::vector<std::string> touchdown_names(const MachineParameters& parameters);
/// @throws std::invalid_argument if no touchdown bearing has that name
[[nodiscard]] const TouchdownParameters& touchdown_of(const MachineParameters& parameters, const std::string& name);
/// The same without supports but this touchdown bearing.
[[nodiscard]] MachineParameters with_single_bearing(MachineParameters parameters, const std::string& name);

}  // namespace rotordrop
