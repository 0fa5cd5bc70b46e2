#include "thermal/heating/bearing_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "laws/heat/heat_flow.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

HeatBody body(const std::string& name, std::array<double, 2> x, std::array<double, 2> r, const ThermalMaterial& m) {
  return {name,
          x,
          r,
          m.density,
          m.conductivity_table.value_or(PropertyTable(m.conductivity)),
          m.heat_capacity_table.value_or(PropertyTable(m.heat_capacity))};
}
/// By diameters, about the middle of the bearing.
HeatBody body(const std::string& name, double length, double inside, double outside, const ThermalMaterial& m) {
  return body(name, {-0.5 * length, 0.5 * length}, {0.5 * inside, 0.5 * outside}, m);
}

constexpr double no_resistance = 1e-8;  // [m2 K/W]: half a micrometre of steel

/// Joins each step with what is nearer to the bearing, and cools its outside.
void add_shaft_steps(HeatConductionProblem& p, const BearingCircuitData& b, double ambient) {
  std::size_t before = body_index(p.bodies, "shaft");
  for (const auto& step : b.shaft_steps) {
    if (step.is_first) before = body_index(p.bodies, "shaft");
    const std::size_t k = body_index(p.bodies, step.name);
    const HeatBoundary near{k, step.is_left ? HeatSide::right : HeatSide::left},
        other{before, step.is_left ? HeatSide::left : HeatSide::right};
    p.interfaces.push_back({other, near, no_resistance});
    p.convections.push_back({{k, HeatSide::outer}, b.h_shaft, 0., ambient});
    before = k;
  }
}

/// Strips of all rows, or where the mesh has none the whole side.
std::vector<HeatBoundary> race(const SectionMesh& mesh, std::size_t body, HeatSide plain) {
  std::vector<HeatBoundary> found;
  for (const auto& edge : mesh.edges)
    if (edge.boundary.body == body && edge.boundary.side == HeatSide::strip &&
        std::find(found.begin(), found.end(), edge.boundary) == found.end())
      found.push_back(edge.boundary);
  if (found.empty()) found.push_back({body, plain});
  return found;
}

std::string row_port(const char* race, std::size_t row) { return fmt::format("{}_raceway_row_{}", race, row + 1); }

/// A port for the strip of every row on each raceway, if there are strips of several rows.
void add_row_ports(HeatConductionProblem& p) {
  const auto inner = p.ports[inner_raceway_port].boundaries, outer = p.ports[outer_raceway_port].boundaries;
  const auto is_of = [](const std::vector<HeatBoundary>& strips, std::size_t row) {
    return std::find_if(strips.begin(), strips.end(), [&](const HeatBoundary& b) {
      return b.side == HeatSide::strip && b.row == static_cast<int>(row);
    });
  };
  const std::size_t n = inner.size();
  if (n < 2 || outer.size() != n) return;
  for (std::size_t row = 0; row < n; ++row)
    if (is_of(inner, row) == inner.end() || is_of(outer, row) == outer.end()) return;
  for (std::size_t row = 0; row < n; ++row) {
    p.ports.push_back({row_port("inner", row), {*is_of(inner, row)}});
    p.ports.push_back({row_port("outer", row), {*is_of(outer, row)}});
  }
}

}  // namespace

std::vector<RacewayRowPorts> raceway_row_ports(const HeatConductionProblem& p) {
  std::vector<RacewayRowPorts> rows;
  const auto find = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(p.ports.begin(), p.ports.end(), [&](const HeatPort& port) { return port.name == name; }) -
        p.ports.begin());
  };
  for (std::size_t row = 0;; ++row) {
    const RacewayRowPorts ports{find(row_port("inner", row)), find(row_port("outer", row))};
    if (ports.inner == p.ports.size()) return rows;
    rows.push_back(ports);
  }
}

HeatConductionProblem bearing_heat_problem(const BearingCircuitData& b, const SectionMesh& mesh, double ambient,
                                           const SectionSettings& settings) {
  HeatConductionProblem p;
  p.mesh = mesh;
  p.initial_temperature = ambient;
  p.numerics = settings.numerics;
  std::vector<HeatBody> bodies = {body("inner_ring", b.width, b.inner_bore, b.inner_outside, b.ring),
                                  body("outer_ring", b.width, b.outer_bore, b.outer_outside, b.ring),
                                  body("housing", b.housing_length, b.outer_outside, b.housing_outside, b.ring)};
  const bool has_steps = settings.shaft_is_meshed && !b.shaft_steps.empty();
  if (settings.shaft_is_meshed)
    bodies.push_back(body("shaft", b.shaft_length, 2. * b.shaft_bore_radius, 2. * b.journal_radius, b.shaft));
  if (has_steps)
    for (const auto& step : b.shaft_steps)
      bodies.push_back(body(step.name, {step.from, step.to}, {step.inside, step.outside}, b.shaft));
  if (mesh.empty()) {
    p.bodies = bodies;
  } else {
    for (const auto& name : mesh.bodies) {
      const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const HeatBody& x) { return x.name == name; });
      if (found == bodies.end()) throw std::invalid_argument("the section's mesh has a body named " + name);
      p.bodies.push_back(*found);
    }
  }
  const std::size_t inner = body_index(p.bodies, "inner_ring"), outer = body_index(p.bodies, "outer_ring"),
                    housing = body_index(p.bodies, "housing");

  const double ball_volume = pi / 6. * b.ball_diameter * b.ball_diameter * b.ball_diameter;
  p.nodes = {{"ball", b.n_balls * ball_volume * b.ball.volumetric_capacity()}};
  HeatPort shaft{"shaft", {}};
  if (settings.shaft_is_meshed) {
    shaft.boundaries = {{body_index(p.bodies, "shaft"), HeatSide::outer}};
  } else {
    p.nodes.push_back({"shaft", b.shaft_section() * b.shaft_length * b.shaft.volumetric_capacity()});
    shaft.node = 1;
  }
  p.ports = {{"bore", {{inner, HeatSide::inner}}},
             shaft,
             {"inner_raceway", race(p.mesh, inner, HeatSide::outer)},
             {"outer_raceway", race(p.mesh, outer, HeatSide::inner)},
             {"housing_surface", {{housing, HeatSide::outer}}},
             {"ball", {}, 0}};
  p.ports[housing_port].steady_for = 1.;  // its film follows the housing, which takes minutes to warm

  const CircuitResistances R = circuit_resistances(b);
  const double R5 = R.R5_inside + R.R5_constriction;
  p.links = {{shaft_port, {}, R.R1}, {ball_port, {}, R.R6}};
  if (const auto& G = b.ball_conduction) {
    p.links.push_back({inner_raceway_port, ball_port, 1. / G->inner_to_ball});
    p.links.push_back({outer_raceway_port, ball_port, 1. / G->outer_to_ball});
    if (G->inner_to_outer > 0.) p.links.push_back({inner_raceway_port, outer_raceway_port, 1. / G->inner_to_outer});
  } else if (!b.balls_roll) {
    p.links.insert(p.links.begin() + 1, {{inner_raceway_port, ball_port, R5}, {outer_raceway_port, ball_port, R5}});
  }
  if (b.shaft_ring_link == BearingCircuitData::Link::permanent)
    p.links.push_back({shaft_port, bore_port, settings.shaft_contact.value_or(R.R2)});

  for (const FinNode& fin : has_steps ? std::vector<FinNode>{} : b.fins) {
    const std::size_t port = p.ports.size(), before = fin.is_first ? std::size_t{shaft_port} : port - 1;
    p.nodes.push_back({fin.name, fin.capacity});
    p.ports.push_back({fin.name, {}, p.nodes.size() - 1, 1e-4});  // nothing heats them but the shaft
    p.links.push_back({before, port, fin.resistance});
    p.links.push_back({port, {}, fin.to_ambient});
  }

  if (settings.rows_apart) add_row_ports(p);

  if (settings.housing_film)
    p.convections = {{{housing, HeatSide::outer}, housing_convection(1.), 0.25, ambient}};  // h = 23 rise^0.25

  const double fit_area = pi * b.outer_outside * std::min(b.width, b.housing_length);
  p.interfaces = {
      {{outer, HeatSide::outer}, {housing, HeatSide::inner}, std::max(b.fit_resistance * fit_area, no_resistance)}};
  if (has_steps) add_shaft_steps(p, b, ambient);
  return p;
}

GrowthPerRise section_growth(const BearingCircuitData& b) {
  return growth_per_rise(growth_dimensions(b), b.plane_strain_growth ? 1. + b.ring.poisson_ratio : 1.);
}

}  // namespace rotordrop
