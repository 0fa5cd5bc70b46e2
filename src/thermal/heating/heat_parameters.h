#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parameters/section.h"
#include "model/heat_conduction.h"
#include "model/thermo_elasticity.h"
#include "thermal/heating/heat_growth_parameters.h"
#include "thermal/heating/heat_history.h"

/// The keys of a case of heat conduction alone (`rotordrop heat`), and the problem that they state.
namespace rotordrop {

/// [run] of such a case.
struct HeatRunParameters {
  double ambient = 0;                                   ///< [K]
  std::optional<double> initial_temperature, end_time;  ///< [K], [s]
};

/// [materials.NAME] as conduction needs it.
struct HeatMaterialParameters {
  double rho = 0;
  std::optional<double> k, c;
  std::optional<std::vector<std::array<double, 2>>> k_table, c_table;  ///< pairs of temperature [K] and value
  std::optional<double> E, nu, alpha;                                  ///< for displacements
};

struct HeatRectangleParameters {
  std::string name, material;
  std::array<double, 2> x{}, r{};
  std::optional<double> temperature;  ///< [K]
};
struct HeatSectionParameters {
  std::vector<HeatRectangleParameters> rectangles;
};
struct HeatPulseParameters {
  double height = 0, width = 0, start = 0;
  std::optional<double> period;
  int count = 1;
};
/// @param unit  of their height
Section<HeatPulseParameters> pulse_section(const std::string& unit);
PulseTrain pulse_train(const HeatPulseParameters& pulse);

/// One of three: times and values, pulse, recorded.
struct HeatFluxParameters {
  std::optional<std::string> boundary;
  std::vector<std::string> between;         ///< instead of that, the two of an interface
  std::optional<double> resistance_beyond;  ///< of an interface
  std::vector<double> times, values;
  std::optional<HeatPulseParameters> pulse;
  std::optional<std::string> recorded, bearing, heat;  ///< a results.h5, and which heat in it
  std::optional<double> share, interval;
};
struct HeatFixedParameters {
  std::string boundary;
  double temperature = 0;  ///< [K]
};
struct HeatConvectionParameters {
  std::string boundary;
  double coefficient = 0, exponent = 0;
  std::optional<double> ambient;
};
struct HeatInterfaceParameters {
  std::vector<std::string> between;
  double resistance = 0;
};
using HeatProbeParameters = HeatPlaceParameters;
struct HeatNumericsParameters {
  int degree = 2, cells = 8;
  double grading = 0, end_grading = 0, growth = 0, time_tolerance = 0;
  HeatLinearSolver solver = HeatLinearSolver::direct;
};

struct HeatParameters {
  HeatRunParameters run;
  std::vector<std::pair<std::string, HeatMaterialParameters>> materials;
  HeatSectionParameters section;
  std::vector<HeatFluxParameters> fluxes;
  std::vector<HeatConvectionParameters> convections;
  std::vector<HeatFixedParameters> fixed;
  std::vector<HeatInterfaceParameters> interfaces;
  std::vector<HeatProbeParameters> probes;
  std::vector<double> output_times, field_times;
  std::optional<double> field_interval;
  HeatNumericsParameters fe;
  HeatElasticParameters elastic;
  std::vector<HeatFitParameters> fits;
  std::vector<HeatHoldParameters> holds;
  std::vector<DisplacementParameters> displacements;
};
Section<HeatParameters> heat_section(const Node& default_materials);

/// Where a temperature is wanted.
struct HeatProbe {
  std::string name;
  std::optional<HeatBoundary> boundary;  ///< mean over it; otherwise at the point
  std::size_t body = 0;
  double x = 0, r = 0;
};

/// Displacements under the temperatures of a study.
struct HeatElasticStudy {
  ElasticProblem problem;                ///< without its mesh, which is that of conduction
  std::vector<HeatProbe> displacements;  ///< mean over a boundary, or at a point
};

/// A problem with what is wanted of it.
struct HeatStudy {
  HeatConductionProblem problem;
  std::vector<HeatProbe> probes;
  std::vector<double> output_times;  ///< rising; [run] end_time is the last of them
  std::vector<double> field_times;   ///< rising
  double field_interval = 0;         ///< [s]; 0: none
  std::optional<HeatElasticStudy> elastic;
};

/// Which heat of an earlier drop.
struct RecordedHeatName {
  std::string file, bearing;
  std::string ledger;  ///< "rub_heat"
};
/// Reads it, or adds faults and returns nothing.
/// @param table  that names it by `recorded` and perhaps `bearing`, for places
/// @param name   of that table in messages: "flux#1"
using ReadRecordedHeat = std::function<std::optional<RecordedHeat>(const RecordedHeatName& heat, const Node& table,
                                                                   const std::string& name, Faults& faults)>;

/// Names become indices; what does not fit together becomes faults.
HeatStudy make_heat_study(const HeatParameters& parameters, const Node& tree, const ReadRecordedHeat& read_recorded,
                          Faults& faults);

}  // namespace rotordrop
