#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "thermal/circuit/bearing_circuit.h"
#include "thermal/fe_parameters.h"
#include "thermal/thermal_kinds.h"

namespace rotordrop {

enum class HeatShare { constant, jaeger };

/// Length of the rubbing spot in the replay of the rub: Hertz's by the instant's force, or rub_band_length.
enum class RubBand { hertz, fixed };
/// Share of the heat in the replay of the rub: so that both surfaces have one temperature, or that of the thermal models.
enum class LocalShare { one_temperature, as_heated };

/// Where growth comes from.
enum class GrowthSource {
  formula,  ///< closed forms of mean temperatures, at the contact points of balls and races
  paper,    ///< the same at the rings' shoulders and without the axial part (Neisi 2019, eqs. 25 to 27)
  elastic   ///< elasticity on the finite elements' mesh
};

/// Whether rings and rotor grow by their speed.
enum class GrowthBySpeed {
  none,
  closed_form  ///< thin discs; rings by elasticity where thermal.expansion = "elastic" drives
};

/// How balls conduct at their contacts: as the circuit's R5 says, or by their loads and speed.
enum class BallConductionModel { fixed, rolling };
/// Where on a ball its contacts run: always the same circle, or all over its surface.
enum class BallTrack { repeating, wandering };
/// Whether the circuit's rings are heated at the balls' strips or over their whole raceways.
enum class RacewaySpreading { strip, none };

/// Whether the shaft goes on beside the bearing or ends with its lump.
enum class ShaftModel { fin, lump };

/// A node that a user adds to the circuit.
struct ExtraNode {
  std::string name;
  double capacity = 0;
};
/// A resistor that a user adds between two nodes.
struct ExtraResistor {
  std::vector<std::string> between;
  double resistance = 0;
};

/// Names of registered thermal models, each once, in the order of thermal_kinds().
/// @param name  of the key, for messages: "thermal.models"; @param may_be_none  whether an empty list is allowed
std::vector<std::string> read_thermal_models(const Node& node, const std::string& name, bool may_be_none,
                                             Faults& faults);
/// What a key with them accepts: a list of all that are registered.
std::string list_of_thermal_models();

/// Words of thermal.driver besides the models' names: the first model that runs, none, the record of an earlier run.
inline constexpr const char *automatic_driver = "automatic", *no_driver = "none", *recorded_driver = "recorded";
/// All words of thermal.driver.
std::vector<std::string> driver_words();
/// Whether results of a drop have a group, or a bearing's summary a key, of that name besides those of thermal models.
bool is_group_of_results(const std::string& name);

/// [thermal]: the lumped circuit of every touchdown bearing, and what a user adds to it.
struct ThermalParameters {
  std::vector<std::string> models = {thermal_kinds().front()->name};
  std::string driver = automatic_driver;           ///< as given: see driver_of()
  std::map<std::string, MakeThermalModel> makers;  ///< of models whose table [thermal.NAME] is given
  std::optional<std::string> recorded;             ///< results.h5 of an earlier run
  bool growth = true;
  HeatShare heat_share = HeatShare::constant;
  double share_to_ring = 0;
  double rub_band_length = 0, rub_contact_time = 0;
  RubBand rub_band = RubBand::hertz;
  LocalShare local_share = LocalShare::one_temperature;
  double h_shaft = 0, h_ball = 0, fit_resistance = 0, contact_half_width = 0;
  BallConductionModel contact_conduction = BallConductionModel::rolling;
  double oil_film = 0, oil_conductivity = 0;
  BallTrack ball_track = BallTrack::repeating;
  RacewaySpreading spreading = RacewaySpreading::strip;
  ShaftModel shaft = ShaftModel::fin;
  BearingCircuitData::Link shaft_ring_link = BearingCircuitData::Link::permanent;
  double gas_conductivity = 0;
  bool plane_strain_growth = false;
  GrowthSource expansion = GrowthSource::formula;
  GrowthBySpeed growth_by_speed = GrowthBySpeed::closed_form;
  FeParameters fe;
  std::vector<ExtraNode> nodes;
  std::vector<ExtraResistor> resistors;

  [[nodiscard]] bool runs(const std::string& model) const;
  [[nodiscard]] bool runs_circuit() const;   ///< one that has the case's own nodes and resistors
  [[nodiscard]] bool runs_sections() const;  ///< one that meshes the bearings' sections
};
Section<ThermalParameters> thermal_section();

/// The model whose growth is fed back; no_driver without thermal.growth; recorded_driver.
std::string driver_of(const ThermalParameters& parameters);
/// Models that run, in the order of thermal_kinds().
std::vector<const ThermalKind*> chosen_kinds(const ThermalParameters& parameters);
/// The model that runs and meshes sections, or nullptr.
const ThermalKind* section_kind(const ThermalParameters& parameters);
/// What makes a model, with its keys as given or by default; missing keys become faults.
MakeThermalModel maker_of(const ThermalParameters& parameters, const ThermalKind& kind, Faults& faults);

/// The user's nodes and resistors; names that do not exist become faults.
void add_extra_parts(const ThermalParameters& parameters, const Node& thermal_table, ThermalNetworkData& network,
                     Faults& faults);

}  // namespace rotordrop
