#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "thermal/heating/heat_history.h"
#include "thermal/heating/heat_parameters.h"
#include "thermal/thermal_parameters.h"

/// [heat] of a drop's case: the thermal models of one of its touchdown bearings without dynamics, under heat that is given (`rotordrop heat`).
namespace rotordrop {

/// Where a source's heat goes. `all`: every heat that a drop recorded.
enum class SourcePort { rub, rub_into_ring, rub_into_shaft, inner, outer, all };

/// One of three: times and values, pulse, recorded.
struct HeatSourceParameters {
  SourcePort port = SourcePort::rub;
  std::vector<double> times, values;
  std::optional<std::string> interpolation;  ///< "steps" or "linear"
  std::optional<HeatPulseParameters> pulse;
  std::optional<std::string> recorded, bearing;  ///< a results.h5, and whose heat in it
  std::optional<double> share, interval;
};

/// A temperature: of a node of the circuit or a mean of the finite elements (`node`), or of the section at a point or a boundary.
struct BearingProbeParameters {
  std::string name;
  std::optional<std::string> model, node, boundary, body;
  std::optional<double> x, r;
};

struct PrescribedHeatParameters {
  std::optional<std::string> bearing;
  std::optional<ThermalModelChoice> models;
  std::vector<double> output_times;
  std::optional<double> end_time;
  double time_tolerance = 0;
  std::optional<double> ball_load, ring_speed, ball_conductance;  ///< [N], [rad/s], [W/K]
  std::vector<HeatSourceParameters> sources;
  std::vector<BearingProbeParameters> probes;
};
Section<PrescribedHeatParameters> prescribed_heat_section();

/// Heat that the sources of a case give to a bearing.
/// @param heat     the table [heat], for places
/// @param thermal  of the case: how rub heat is shared where a source does not say it
/// @param bearing  name of it
BearingHeatHistory make_heat_history(const PrescribedHeatParameters& parameters, const Node& heat,
                                     const ThermalParameters& thermal, const std::string& bearing,
                                     const ReadRecordedHeat& read_recorded, Faults& faults);

}  // namespace rotordrop
