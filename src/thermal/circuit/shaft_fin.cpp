#include "thermal/circuit/shaft_fin.h"

#include <cmath>

namespace rotordrop {

std::vector<FinNode> fin_nodes(const std::string& side, const std::vector<FinPiece>& pieces, double before, double h,
                               double conductivity, double volumetric_capacity) {
  std::vector<FinNode> nodes;
  double arm_before = before;
  for (const auto& piece : pieces) {
    const double s = std::sqrt(h * piece.perimeter * conductivity * piece.section),
                 ml = piece.length * std::sqrt(h * piece.perimeter / (conductivity * piece.section));
    const double arm = std::tanh(0.5 * ml) / s;
    nodes.push_back({"shaft_" + side + "_" + std::to_string(nodes.size() + 1),
                     volumetric_capacity * piece.section * piece.length, arm_before + arm, 1. / (s * std::sinh(ml)),
                     nodes.empty()});
    arm_before = arm;
  }
  return nodes;
}

std::vector<double> fin_lengths(double length, double first) {
  constexpr double growth = 2.2;
  std::vector<double> lengths;
  double piece = first, left = length;
  while (left > 0.) {
    // No crumb at the end.
    if (left < 1.5 * piece) piece = left;
    lengths.push_back(piece);
    left -= piece;
    if (left < 1e-9 * length) break;
    piece *= growth;
  }
  return lengths;
}

}  // namespace rotordrop
