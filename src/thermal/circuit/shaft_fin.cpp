#include "thermal/circuit/shaft_fin.h"

#include <cmath>

namespace rotordrop {

namespace {

/// A bar as two-port: T_1 = (1 + a) T_2 + b q_2, q_1 = c T_2 + (1 + d) q_2, with rises T and heat q from end 1 to end 2.
struct TwoPort {
  double a = 0, b = 0, c = 0, d = 0;

  static TwoPort of(const FinBar& bar, double h, double conductivity) {
    const double s = std::sqrt(h * bar.perimeter * conductivity * bar.section),
                 ml = bar.length * std::sqrt(h * bar.perimeter / (conductivity * bar.section));
    const double half = std::sinh(0.5 * ml),
                 over_one = 2. * half * half;  // cosh - 1 without what rounding leaves of it
    return {over_one, std::sinh(ml) / s, s * std::sinh(ml), over_one};
  }
  /// This one, and behind it another.
  [[nodiscard]] TwoPort followed_by(const TwoPort& o) const {
    return {a + o.a + a * o.a + b * o.c, (1. + a) * o.b + b * (1. + o.d), c * (1. + o.a) + (1. + d) * o.c,
            d + o.d + d * o.d + c * o.b};
  }
};

}  // namespace

std::vector<FinNode> fin_nodes(const std::string& side, const std::vector<FinPiece>& pieces, double before, double h,
                               double conductivity, double volumetric_capacity) {
  std::vector<FinNode> nodes;
  double arm_before = before;
  for (const auto& piece : pieces) {
    TwoPort chain;
    double volume = 0.;
    for (const FinBar& bar : piece.bars) {
      chain = chain.followed_by(TwoPort::of(bar, h, conductivity));
      volume += bar.section * bar.length;
    }
    nodes.push_back({"shaft_" + side + "_" + std::to_string(nodes.size() + 1), volumetric_capacity * volume,
                     arm_before + chain.a / chain.c, 1. / chain.c, nodes.empty()});
    arm_before = chain.d / chain.c;
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
