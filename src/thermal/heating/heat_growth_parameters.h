#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "model/thermo_elasticity.h"

/// The keys of displacements in a case of heat conduction alone (`rotordrop heat`).
namespace rotordrop {

/// [elastic]
struct HeatElasticParameters {
  std::optional<double> strain_free_temperature;  ///< [K]
};
/// Two sides that press on each other.
struct HeatFitParameters {
  std::string name;
  std::vector<std::string> between;
  double interference = 0;  ///< by radius or along the axis [m]
  FitKind kind = FitKind::frictionless;
};
enum class HoldDirection { axial, radial, both };
struct HeatHoldParameters {
  std::string boundary;
  HoldDirection direction = HoldDirection::both;
};
/// Where a quantity is reported: at a point, or as the mean of a boundary.
struct HeatPlaceParameters {
  std::string name;
  std::optional<double> x, r;
  std::optional<std::string> body, boundary;
};
using DisplacementParameters = HeatPlaceParameters;
Section<HeatElasticParameters> heat_elastic_section();
Section<HeatFitParameters> heat_fit_section();
Section<HeatHoldParameters> heat_hold_section();
Section<DisplacementParameters> displacement_section();
/// @param name, sentence  name and description of its table in parameter files
Section<HeatPlaceParameters> heat_place_section(const std::string& name, const std::string& sentence);

/// Reads `between`: two names of boundaries.
/// @param table  name of the table in messages
std::vector<std::string> read_two_boundaries(const Node& node, const std::string& table, Faults& faults);

}  // namespace rotordrop
