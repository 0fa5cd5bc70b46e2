#include "machine/shaft_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

/// Mean section and perimeter of the shaft between two places. Of elements over the same span (a sleeve on a shaft) the outermost surface gives off heat.
FinPiece piece_between(const RotorGeometry& g, double from, double to) {
  FinPiece piece{to - from, 0., 0.};
  std::vector<double> cuts = {from, to};
  for (const double x : g.node_x)
    if (x > from && x < to) cuts.push_back(x);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]), part = (cuts[i + 1] - cuts[i]) / piece.length;
    double section = 0., outside = 0.;
    for (const auto& e : g.elements) {
      if (middle < g.position(e.n1) || middle > g.position(e.n2)) continue;
      section += 0.25 * pi * (e.od * e.od - e.id * e.id);
      outside = std::max(outside, e.od);
    }
    piece.section += part * section;
    piece.perimeter += part * pi * outside;
  }
  return piece;
}

}  // namespace

std::vector<FinNode> shaft_fins(const MachineParameters& p, const TouchdownParameters& b,
                                const BearingCircuitData& circuit) {
  const RotorGeometry& g = p.rotor.geometry;
  if (g.node_x.empty() || b.node < 1 || b.node > g.n_nodes()) return {};  // a fault of its own
  const double at = g.position(b.node), half = 0.5 * circuit.shaft_length;
  double first = g.node_x.front(), last = g.node_x.back();
  for (const auto& entry : p.bearings) {
    const auto* other = entry.touchdown();
    if (!other || other->node < 1 || other->node > g.n_nodes() || other->node == b.node) continue;
    const double middle = 0.5 * (at + g.position(other->node));
    (middle < at ? first : last) = middle < at ? std::max(first, middle) : std::min(last, middle);
  }
  const double k = circuit.ring.conductivity, d = 2. * circuit.journal_radius;
  const double longest = 4. / std::sqrt(4. * circuit.h_shaft / (k * d));
  // Heat enters evenly along the lump and leaves it at both faces.
  const double before = half / (3. * k * 0.25 * pi * d * d);
  std::vector<FinNode> fins;
  for (const auto& [side, length] : {std::pair("left", at - half - first), std::pair("right", last - at - half)}) {
    if (length <= 0.) continue;
    std::vector<FinPiece> pieces;
    double from = 0.;
    for (const double l : fin_lengths(std::min(length, longest), std::min(0.15 * d, length))) {
      const double low = side == std::string("left") ? at - half - from - l : at + half + from;
      pieces.push_back(piece_between(g, low, low + l));
      from += l;
    }
    if (std::any_of(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.section <= 0.; })) continue;
    const double rho_c = circuit.ring.density * circuit.ring.heat_capacity;
    for (auto& node : fin_nodes(side, pieces, before, circuit.h_shaft, k, rho_c)) fins.push_back(std::move(node));
  }
  return fins;
}

}  // namespace rotordrop
