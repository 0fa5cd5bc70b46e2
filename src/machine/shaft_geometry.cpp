#include "machine/shaft_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "machine/bearing_data.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

constexpr double shortest_step = 0.5e-3;  // [m]

/// The shaft between two places, cut where its diameters change. Of elements over the same span (a sleeve on a shaft) the outermost surface gives off heat.
FinPiece piece_between(const RotorGeometry& g, double from, double to) {
  FinPiece piece;
  std::vector<double> cuts = {from, to};
  for (const double x : g.node_x)
    if (x > from && x < to) cuts.push_back(x);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    if (cuts[i + 1] - cuts[i] < 1e-9) continue;  // places that differ by rounding
    double section = 0., outside = 0.;
    for (const auto& e : g.elements) {
      if (middle < g.position(e.n1) || middle > g.position(e.n2)) continue;
      section += 0.25 * pi * (e.od * e.od - e.id * e.id);
      outside = std::max(outside, e.od);
    }
    auto& bars = piece.bars;
    if (!bars.empty() && bars.back().section == section && bars.back().perimeter == pi * outside)
      bars.back().length += cuts[i + 1] - cuts[i];
    else
      bars.push_back({cuts[i + 1] - cuts[i], section, pi * outside});
  }
  return piece;
}

/// Places on the rotor between which a bearing has the shaft to itself [m].
struct Span {
  double first = 0, last = 0;
};
std::optional<Span> span_of(const MachineParameters& p, const TouchdownParameters& b) {
  const RotorGeometry& g = p.rotor.geometry;
  if (g.node_x.empty() || b.node < 1 || b.node > g.n_nodes()) return {};  // a fault of its own
  const double at = g.position(b.node);
  Span span{g.node_x.front(), g.node_x.back()};
  std::vector<int> others = p.single.neighbours;
  for (const auto& entry : p.bearings)
    if (entry.touchdown()) others.push_back(entry.node());
  for (const int node : others) {
    if (node < 1 || node > g.n_nodes() || node == b.node) continue;
    const double middle = 0.5 * (at + g.position(node));
    (middle < at ? span.first : span.last) = middle < at ? std::max(span.first, middle) : std::min(span.last, middle);
  }
  return span;
}

/// From where on less than 0.1 % of a uniform fin's heat is missing [m].
double longest_fin(double conductivity, double diameter, double h) {
  return 4. / std::sqrt(4. * h / (conductivity * diameter));
}

/// Radii of the shaft at a place; both 0 where there is none.
std::pair<double, double> radii_at(const RotorGeometry& g, double x) {
  double inside = std::numeric_limits<double>::infinity(), outside = 0.;
  for (const auto& e : g.elements) {
    if (x < g.position(e.n1) || x > g.position(e.n2)) continue;
    inside = std::min(inside, 0.5 * e.id);
    outside = std::max(outside, 0.5 * e.od);
  }
  return outside > 0. ? std::pair(inside, outside) : std::pair(0., 0.);
}

/// Steps of one side from the bearing's face outwards, with lengths instead of places.
struct Piece {
  double length, inside, outside;
};
std::vector<Piece> pieces_of(const RotorGeometry& g, double face, double direction, double length) {
  std::vector<double> cuts = {0.};
  std::vector<double> nodes;
  for (const double x : g.node_x) nodes.push_back(direction * (x - face));
  std::sort(nodes.begin(), nodes.end());
  for (const double at : nodes)
    if (at > cuts.back() + shortest_step && at < length - shortest_step) cuts.push_back(at);
  cuts.push_back(length);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const auto [inside, outside] = radii_at(g, face + direction * 0.5 * (cuts[i] + cuts[i + 1]));
    if (outside <= 0.) break;
    if (!pieces.empty() && pieces.back().inside == inside && pieces.back().outside == outside)
      pieces.back().length += cuts[i + 1] - cuts[i];
    else
      pieces.push_back({cuts[i + 1] - cuts[i], inside, outside});
  }
  return pieces;
}

}  // namespace

double shaft_bore_radius(const MachineParameters& p, const TouchdownParameters& b) {
  const RotorGeometry& g = p.rotor.geometry;
  if (g.node_x.empty() || b.node < 1 || b.node > g.n_nodes()) return 0.;  // a fault of its own
  constexpr double thinnest = 0.05;                                       // wall over radius
  const double journal = bore_radius(b, p.contact) - air_gap(b, p.contact);
  return std::min(radii_at(g, g.position(b.node)).first, (1. - thinnest) * journal);
}

std::vector<FinNode> shaft_fins(const MachineParameters& p, const TouchdownParameters& b,
                                const BearingCircuitData& circuit) {
  const auto span = span_of(p, b);
  if (!span) return {};
  const RotorGeometry& g = p.rotor.geometry;
  const double at = g.position(b.node), half = 0.5 * circuit.shaft_length;
  const double k = circuit.shaft.conductivity, d = 2. * circuit.journal_radius;
  const double longest = longest_fin(k, d, circuit.h_shaft);
  // Heat enters evenly along the lump and leaves it at both faces.
  const double before = half / (3. * k * circuit.shaft_section());
  std::vector<FinNode> fins;
  for (const auto& [side, length] :
       {std::pair("left", at - half - span->first), std::pair("right", span->last - at - half)}) {
    if (length <= 0.) continue;
    std::vector<FinPiece> pieces;
    double from = 0.;
    for (const double l : fin_lengths(std::min(length, longest), std::min(0.15 * d, length))) {
      const double low = side == std::string("left") ? at - half - from - l : at + half + from;
      pieces.push_back(piece_between(g, low, low + l));
      if (side == std::string("left")) std::ranges::reverse(pieces.back().bars);
      from += l;
    }
    const auto has_gap = [](const FinPiece& piece) {
      return std::ranges::any_of(piece.bars, [](const FinBar& bar) { return bar.section <= 0.; });
    };
    if (std::ranges::any_of(pieces, has_gap)) continue;
    const double rho_c = circuit.shaft.volumetric_capacity();
    for (auto& node : fin_nodes(side, pieces, before, circuit.h_shaft, k, rho_c)) fins.push_back(std::move(node));
  }
  return fins;
}

std::vector<ShaftStep> shaft_steps(const MachineParameters& p, const TouchdownParameters& b) {
  const auto span = span_of(p, b);
  if (!span) return {};
  const RotorGeometry& g = p.rotor.geometry;
  const double at = g.position(b.node), half = 0.5 * b.shaft_lump_length.value_or(b.width);
  const double journal = 2. * (bore_radius(b, p.contact) - air_gap(b, p.contact));
  const auto& material = shaft_material(p, b);
  const double k = material.k_table ? PropertyTable(*material.k_table).value(p.run.ambient) : material.k;
  const double reach = p.thermal.fe.shaft_reach.value_or(longest_fin(k, journal, p.thermal.h_shaft));
  std::vector<ShaftStep> steps;
  for (const bool is_left : {true, false}) {
    const double length = std::min(reach, is_left ? at - half - span->first : span->last - at - half);
    if (length < shortest_step) continue;
    const double direction = is_left ? -1. : 1.;
    double from = half;
    int number = 0;
    for (const auto& piece : pieces_of(g, at + direction * half, direction, length)) {
      const double to = from + piece.length;
      ++number;
      steps.push_back({fmt::format("shaft_{}_{}", is_left ? "left" : "right", number), is_left ? -to : from,
                       is_left ? -from : to, piece.inside, piece.outside, is_left, number == 1});
      from = to;
    }
  }
  return steps;
}

}  // namespace rotordrop
