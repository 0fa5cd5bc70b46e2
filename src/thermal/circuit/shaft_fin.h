#pragma once
#include <string>
#include <vector>

namespace rotordrop {

/// A uniform bar that gives heat to ambient along its length.
struct FinBar {
  double length = 0;     ///< [m]
  double section = 0;    ///< A [m^2]
  double perimeter = 0;  ///< p [m]
};

/// A piece of shaft beside the bearing: bars one after the other.
struct FinPiece {
  std::vector<FinBar> bars;
};

/// A node of a fin: a piece with its capacity in the middle.
struct FinNode {
  std::string name;       ///< "shaft_left_1", counted from the bearing; left: towards -x
  double capacity = 0;    ///< [J/K]
  double resistance = 0;  ///< to the node before it; of the first to the shaft under the bearing [K/W]
  double to_ambient = 0;  ///< [K/W]
  bool is_first = false;  ///< of its side
};

/// The nodes of one side. Each piece is a T of two arms and a shunt, which is exact in steady heat: of a uniform bar arms tanh(m l/2)/s and shunt
/// 1/(s sinh(m l)), s = sqrt(h p k A), m = sqrt(h p/(k A)), so that without heat through its far end the fin conducts s tanh(m L) if all is alike, whatever the
/// number of pieces; of several bars that of their chain of two-ports. The capacity of a piece sits at the shunt. In time it follows heat that takes longer
/// than l^2/(k/rho c) to cross its first piece. How heat spreads at steps of diameter is left out.
/// Source: Carslaw & Jaeger (1959), section 4.2 (bar with radiation from its surface).
/// @param side         "left" or "right"
/// @param pieces       from the bearing outwards, and so their bars
/// @param before       from the mean of the shaft under the bearing to its face [K/W]
/// @param h            convection [W/(m^2 K)]; @param volumetric_capacity rho c [J/(m^3 K)]
std::vector<FinNode> fin_nodes(const std::string& side, const std::vector<FinPiece>& pieces, double before, double h,
                               double conductivity, double volumetric_capacity);

/// Lengths of the pieces of a fin of this length: the first a given one, each further about 2.2 times as long, the last what is left.
std::vector<double> fin_lengths(double length, double first);

}  // namespace rotordrop
