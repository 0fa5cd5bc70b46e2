#pragma once
#include <optional>

#include "laws/bearing_growth.h"
#include "model/heat_conduction.h"
#include "thermal/circuit/bearing_circuit.h"

namespace rotordrop {

/// Ports of a bearing's section, in the order of its problem.
enum BearingPort : std::size_t {
  bore_port,           ///< the inner ring's bore: the rub heat's share
  shaft_port,          ///< the rest of it
  inner_raceway_port,  ///< strips of the contact ellipses
  outer_raceway_port,
  housing_port,  ///< the housing's outside: eq. (16) is applied there by whoever advances the problem, with the mean rise
  ball_port,
  n_bearing_ports  ///< the nodes of the shaft beside the bearing follow, which nothing heats from outside
};

struct SectionSettings {
  bool shaft_is_meshed = false;  ///< with its steps, if it has any; otherwise a lump with fins, as in the circuit
  HeatNumerics numerics;
  bool rows_apart = false;    ///< ports for each row's strips, if the mesh has them
  bool housing_film = false;  ///< eq. (16) on the housing's outside, with the local rise: the problem is not linear
  std::optional<double> shaft_contact = {};  ///< [K/W] between a meshed shaft and the bore; R2 without
};

/// The section of a touchdown bearing with the circuit's data: inner ring, outer ring and housing as bodies, balls (and shaft) as nodes.
///   ambient -R1- shaft -R2- bore,  strips -R5- balls -R5- strips,  balls -R6- ambient,  fit between ring and housing.
/// The shaft beside the bearing is a chain of nodes, or if it is meshed its steps, joined face on face, with convection on their outsides.
/// R3, R4, R7 and R8 are what the section itself conducts. A link that acts only in contact and balls that conduct as they roll are left out: see
/// ReducedSections and WindowedSections.
/// @param mesh     with bodies inner_ring, outer_ring, housing (and shaft); empty: plain rectangles of the rings' diameters
/// @param ambient  [K]
HeatConductionProblem bearing_heat_problem(const BearingCircuitData& bearing, const SectionMesh& mesh, double ambient,
                                           const SectionSettings& settings);

/// Ports of the strips of one row, in a problem whose rows are heated apart; they lie within those of the raceways.
struct RacewayRowPorts {
  std::size_t inner = 0, outer = 0;
};
/// Of all rows, in the order of their positions; none if they are not heated apart.
std::vector<RacewayRowPorts> raceway_row_ports(const HeatConductionProblem& problem);

/// Growth of the surfaces per rise of volume means: of the inner ring, of outer ring and housing together, of the outer ring.
GrowthPerRise section_growth(const BearingCircuitData& bearing);

}  // namespace rotordrop
