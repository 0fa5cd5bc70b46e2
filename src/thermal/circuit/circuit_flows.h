#pragma once
// What flows in a circuit besides what is linear: links whose conductance follows a law, and rolling balls. Of one drop or of eight in lanes.
#include <cstddef>
#include <span>
#include <vector>

#include "laws/heat/heat_flow.h"
#include "thermal/heating/rolling_exchange.h"

namespace rotordrop {

/// How a resistor's flow depends on more than the difference of temperatures.
enum class ResistorLaw {
  constant,            ///< q = (T_a - T_b) / R
  housing_convection,  ///< q = h(T_a - T_b) area (T_a - T_b), h by eq. (16) of Neisi 2019
  contact              ///< q = (T_a - T_b) / R while rotor and ring of `place` touch, else / R_apart
};

/// One term of heat into a node, or of a massless node's temperature.
template <class Real>
struct CircuitTerm {
  std::size_t node;
  Real factor;
};

/// Between two nodes with capacity, or one and the surroundings (b = number of those).
template <class Real>
struct LawLink {
  std::size_t a, b;
  ResistorLaw law;
  std::size_t place;
  Real resistance, R_apart, area;
  /// From a to b [W].
  [[nodiscard]] Real flow(const Real& difference, std::span<const HeatInputOf<Real>> heat) const {
    if (law == ResistorLaw::housing_convection) return housing_convection(difference) * area * difference;
    return difference / select(heat[place].is_in_contact, resistance, R_apart);
  }
};

/// Rolling balls of a place, by what its contacts' temperatures follow from. A watt at a contact spreads by the same numbers.
template <class Real>
struct RollingBalls {
  std::size_t place, balls;
  Real factor;
  Real inner_of_ambient, outer_of_ambient;
  std::vector<CircuitTerm<Real>> inner_of, outer_of;  // temperatures with capacity [K/K]
  Real inner_inner, inner_outer, outer_outer;         // rises by heat into the contacts [K/W]

  [[nodiscard]] ContactHeatOf<Real> heat(std::span<const Real> T, const Real& ambient,
                                         const HeatInputOf<Real>& input) const {
    Real inner = inner_of_ambient * ambient + inner_inner * input.inner + inner_outer * input.outer;
    Real outer = outer_of_ambient * ambient + inner_outer * input.inner + outer_outer * input.outer;
    for (const auto& term : inner_of) inner += term.factor * T[term.node];
    for (const auto& term : outer_of) outer += term.factor * T[term.node];
    const BallConductionOf<Real> G{factor * input.balls.inner_to_ball, factor * input.balls.outer_to_ball,
                                   factor * input.balls.inner_to_outer};
    return contact_heat(G, inner, outer, T[balls], inner_inner, inner_outer, outer_outer);
  }
};

/// Adds to the rates of the nodes with capacity what links by law and rolling balls do.
/// @param T, inverse_capacity, dydt  of those nodes
/// @param lost  heat lost by what is linear [W]; @returns all that is lost
template <class Real>
Real add_flows(std::span<const LawLink<Real>> links, std::span<const RollingBalls<Real>> rolling,
               std::span<const Real> T, const Real& ambient, std::span<const HeatInputOf<Real>> heat,
               std::span<const Real> inverse_capacity, std::span<Real> dydt, Real lost) {
  const std::size_t surroundings = inverse_capacity.size();
  const auto give = [&](std::size_t node, const Real& watts) { dydt[node] += watts * inverse_capacity[node]; };
  for (const auto& link : links) {
    const Real q = link.flow(T[link.a] - (link.b == surroundings ? ambient : T[link.b]), heat);
    give(link.a, -q);
    if (link.b == surroundings)
      lost += q;
    else
      give(link.b, q);
  }
  for (const auto& r : rolling) {
    const ContactHeatOf<Real> q = r.heat(T, ambient, heat[r.place]);
    for (const auto& term : r.inner_of) give(term.node, term.factor * q.inner);
    for (const auto& term : r.outer_of) give(term.node, term.factor * q.outer);
    lost += r.inner_of_ambient * q.inner + r.outer_of_ambient * q.outer;
    give(r.balls, -q.from_balls());
  }
  return lost;
}

}  // namespace rotordrop
