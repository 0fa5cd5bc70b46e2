#pragma once
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "laws/bearing_growth.h"
#include "model/circuit_factors.h"
#include "model/heat_conduction.h"
#include "thermal/circuit/shaft_fin.h"
#include "thermal/circuit/thermal_network.h"
#include "thermal/section/shaft_steps.h"

namespace rotordrop {

struct ThermalMaterial {
  double conductivity = 0;   ///< k at ambient [W/(m K)]
  double heat_capacity = 0;  ///< c at ambient [J/(kg K)]
  double density = 0;        ///< rho [kg/m^3]
  double expansion = 0;      ///< alpha [1/K]
  double poisson_ratio = 0;
  /// Over temperature, for meshed bodies; the numbers above otherwise.
  std::optional<PropertyTable> conductivity_table = {}, heat_capacity_table = {};

  [[nodiscard]] double volumetric_capacity() const { return density * heat_capacity; }  ///< [J/(m3 K)]
};

/// What the circuit of one touchdown bearing is made from (docs/theory/model.md; Neisi 2019, section 3.4, fig. 6, table 1).
struct BearingCircuitData {
  std::string name;                               ///< of the bearing
  ThermalMaterial ring, ball, shaft;              ///< ring: also of the housing
  double width = 0;                               ///< W, all rows [m]
  double journal_radius = 0;                      ///< rotor's contact surface [m]
  double ring_mass = 0;                           ///< inner ring(s) [kg]
  double inner_bore = 0, inner_outside = 0;       ///< inner ring's diameters [m]
  double outer_bore = 0, outer_outside = 0;       ///< outer ring's [m]
  double housing_bore = 0, housing_outside = 0;   ///< [m]
  double housing_length = 0;                      ///< L_h, all rows [m]
  double shaft_length = 0;                        ///< of the lump of shaft [m]
  double shaft_bore_radius = 0;                   ///< of a hollow shaft [m]
  int n_balls = 0;                                ///< of all rows
  double ball_diameter = 0;                       ///< [m]
  double h_shaft = 0, h_ball = 0;                 ///< convection [W/(m^2 K)]
  double fit_resistance = 0;                      ///< outer ring to housing [K/W]
  double contact_half_width = 0;                  ///< a of the constriction [m]
  RaceSurfaces races;                             ///< where the rings' growth counts
  bool balls_roll = false;                        ///< contacts conduct by HeatInput::balls instead of R5
  std::optional<BallConduction> ball_conduction;  ///< constant, instead of R5
  /// Strips on the raceways, for spreading; none: heat enters the whole raceway evenly.
  struct Strips {
    std::vector<double> inner, outer;                 ///< middles of both races' strips, from the rings' end at -x [m]
    double inner_thickness = 0, outer_thickness = 0;  ///< of the walls under them [m]
    double inner_radius = 0, outer_radius = 0;        ///< of the strips [m]
    double half_width = 0;                            ///< [m]
  };
  std::optional<Strips> strips;
  bool plane_strain_growth = false;  ///< growth times (1 + nu)
  /// What the outer raceway grows with in the circuit. Finite elements know the means only.
  enum class OuterGrowth {
    profile,  ///< linear from the ring's node at the raceway to the housing's at its outside (Neisi 2019, eq. 26)
    joined,   ///< mean of ring and housing over their volume: a ring in its fit
    ring      ///< a ring that a soft support carries: the housing does not hold it
  } outer_growth = OuterGrowth::joined;
  enum class Link { permanent, in_contact } shaft_ring_link = Link::permanent;
  double gap_resistance = 0;  ///< of Link::in_contact, when apart [K/W]
  std::vector<FinNode> fins;  ///< shaft beside the bearing, both sides; none: the shaft ends with its lump
  /// Shaft beside the bearing for the finite elements that mesh it, both sides, from the bearing outwards. The circuit has its fins.
  std::vector<ShaftStep> shaft_steps;
  CircuitFactors factors;                      ///< calibration
  [[nodiscard]] double shaft_section() const;  ///< of the lump of shaft across the axis [m^2]
};

/// The circuit's resistances [K/W], the constant ones; R5 and R8 in their parts.
struct CircuitResistances {
  double R1 = 0;  ///< shaft to ambient
  double R2 = 0;  ///< shaft's centre, or the bore of a hollow one, to its surface
  double
      R3 = 0,
      R4 = 0;  ///< inner ring: journal to the middle of its wall, and on to its outside; R4 under strips: half the wall
  double R5_inside = 0;                            ///< a race to the balls' middle: inside the balls
  double R5_constriction = 0;                      ///< and at their contacts
  double R4_spreading = 0;                         ///< and from the strips that the balls roll on
  double R6 = 0;                                   ///< balls to ambient
  double R7 = 0;                                   ///< outer ring: its inside to the middle of its wall
  double R7_spreading = 0;                         ///< from the strips
  double R8_ring = 0, R8_fit = 0, R8_housing = 0;  ///< on to its outside; fit; to the middle of the housing's wall
};
CircuitResistances circuit_resistances(const BearingCircuitData& bearing);

GrowthDimensions growth_dimensions(const BearingCircuitData& bearing);

/// Adds a bearing's nodes, resistors, port and growth to a network; the bearing becomes its next place.
///   ambient -R1- s -R2- x -R3- i -R4- ci -R5- b -R5- co -R7- o -R8- h -R9- ambient,   b -R6- ambient
/// R4 and R7 with their spreading. Balls that roll have instead of R5 what HeatInput::balls says, between ci, b and co.
/// x is eliminated here: the rub heat enters s and i by the share, and R2 + R3 join them.
void add_bearing_circuit(const BearingCircuitData& bearing, ThermalNetworkData& network);

}  // namespace rotordrop
