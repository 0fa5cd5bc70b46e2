#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "thermal/fe/heat_integrands.h"
#include "thermal/fe/heat_operator.h"
#include "thermal/fe/ring_quadrature.h"

// What can be asked of temperatures once they are known: energies, means and places of the field, scales.
namespace rotordrop {

namespace {

using std::numbers::pi;
using Values = std::vector<double>;

}  // namespace

// --------------------------------------------------------------------------------------------------------------------- energy

std::string HeatOperator::part_of(unsigned int dof) const {
  if (dof >= n_field_) return "node \"" + problem_.nodes[dof - n_field_].name + "\"";
  return "body \"" + problem_.bodies[body_of_[dof]].name + "\"";
}

std::string HeatOperator::strongest_cooling(unsigned int dof, double t) const {
  static constexpr const char* sides[] = {"left", "right", "inner", "outer", "raceway", "strip"};
  double strongest = 0.;
  bool is_near = false;
  std::string words = "Check the initial temperature and the sources.";
  const auto look_at = [&](double power, bool is_here, const std::string& what, const char* advice) {
    if (!(power < 0.) || (is_near && !is_here) || (is_near == is_here && power >= strongest)) return;
    strongest = power;
    is_near = is_here;
    words = fmt::format("{} takes {:.4g} W out; {}", what, -power, advice);
  };
  for (const auto& load : loads_) {
    const auto name = [&](const HeatBoundary& b) {
      return problem_.bodies[b.body].name + "." + sides[static_cast<std::size_t>(b.side)];
    };
    look_at(load.held * load.area, load.unit(dof) != 0.,
            load.flux->second ? "The flux between " + name(load.flux->boundary) + " and " + name(*load.flux->second)
                              : "The flux on boundary " + name(load.flux->boundary),
            "no boundary can give off so much for so long: check its negative values.");
  }
  for (const auto& port : ports_)
    look_at(watts(port, t), port.weights(dof) != 0., "Port " + port.name,
            "no surface can give off so much for so long: check its negative heat.");
  return words;
}

double HeatOperator::input_power(double t) const {
  double power = 0.;
  for (const auto& port : ports_) power += watts(port, t);
  for (const auto& load : loads_) {
    power += load.held * load.area;
    if (!load.flux->function) continue;
    dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
    for (const auto& face : load.faces) {
      fe.reinit(face.cell, face.number);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
        power += load.flux->function(fe.quadrature_point(q)[0], fe.quadrature_point(q)[1], t) * weight(fe, q);
    }
  }
  return power;
}

double HeatOperator::lost_power(const Vector& T) const {
  double power = 0.;
  for (const auto* faces : {&linear_faces_, &power_faces_})
    for (const auto& face : *faces)
      for (std::size_t q = 0; q < face.weights.size(); ++q)
        power += loss(*face.law, interpolated(T, face.dofs, (*face.shape)[q])) * face.weights[q];
  for (const auto& link : problem_.links)
    if (!link.to) power += (port_temperature(T, link.from) - problem_.initial_temperature) / link.resistance;
  return power;
}

double HeatOperator::stored_energy(const Vector& T, const Vector& T_0) const {
  double energy = 0.;
  for (unsigned int i = 0; i < size(); ++i) energy += capacity_weights_(i) * (T(i) - T_0(i));
  for (const auto& cell : curved_cells_)
    for (std::size_t q = 0; q < cell.weights.size(); ++q) {
      const double before = interpolated(T_0, cell.dofs, shape_[q]), now = interpolated(T, cell.dofs, shape_[q]);
      energy += cell.body->density * cell.body->heat_capacity.integral(before, now) * cell.weights[q];
    }
  return energy;
}

// --------------------------------------------------------------------------------------------------------------------- probes

double HeatOperator::temperature(const Vector& T, std::size_t body, double x, double r) const {
  const auto place = mesh_.locate(body, x, r);
  Indices dofs(fe_.dofs_per_cell);
  place.cell->get_dof_indices(dofs);
  double value = 0.;
  for (unsigned int k = 0; k < dofs.size(); ++k) value += T(dofs[k]) * fe_.shape_value(k, place.on_unit_cell);
  return value;
}

double HeatOperator::mean_temperature(const Vector& T, const HeatBoundary& boundary) const {
  return surface(T, {boundary}).mean;
}

SurfaceRange HeatOperator::surface(const Vector& T, const std::vector<HeatBoundary>& boundaries) const {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Values now(fe.n_quadrature_points);
  Indices dofs(fe_.dofs_per_cell);
  SurfaceRange range{0., std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double sum = 0., area = 0.;
  for (const auto& boundary : boundaries)
    for (const auto& face : mesh_.faces_of(boundary)) {
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
        double value = 0.;
        for (const auto i : face_dofs_[face.number]) value += T(dofs[i]) * fe.shape_value(i, q);
        sum += (value - problem_.initial_temperature) * weight(fe, q);
        area += weight(fe, q);
      }
      for (const auto i : face_dofs_[face.number]) {
        range.lowest = std::min(range.lowest, T(dofs[i]));
        range.highest = std::max(range.highest, T(dofs[i]));
      }
    }
  range.mean = problem_.initial_temperature + sum / area;
  return range;
}

double HeatOperator::body_mean(const Vector& T, std::size_t body) const {
  const auto& weights = bodies_[body].weights;
  double rise = 0.;
  for (unsigned int i = 0; i < n_field_; ++i) rise += weights(i) * (T(i) - problem_.initial_temperature);
  return problem_.initial_temperature + rise;
}

double HeatOperator::port_temperature(const Vector& T, std::size_t port) const {
  const auto& weights = ports_[port].weights;
  double rise = 0.;
  for (unsigned int i = 0; i < size(); ++i)
    if (weights(i) != 0.) rise += weights(i) * (T(i) - problem_.initial_temperature);
  return problem_.initial_temperature + rise;
}

double HeatOperator::difference(const Vector& T, const std::function<double(std::size_t, double, double)>& f) const {
  dealii::FEValues<2> fe(mapping_, fe_, dealii::QGauss<2>(fe_.degree + 3), cell_flags);
  Values now(fe.n_quadrature_points);
  double sum = 0.;
  for (const auto& cell : cells_) {
    fe.reinit(cell);
    fe.get_function_values(T, now);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      const auto& p = fe.quadrature_point(q);
      const double e = now[q] - f(cell->material_id(), p[0], p[1]);
      sum += e * e * weight(fe, q);
    }
  }
  return std::sqrt(sum);
}

// --------------------------------------------------------------------------------------------------------------------- scales

double HeatOperator::expected_rise(double duration) const {
  const auto half_space = [&](const HeatBoundary& boundary, double flux) {
    const auto& body = problem_.bodies[boundary.body];
    const double k = body.conductivity.value(problem_.initial_temperature);
    const double rho_c = body.density * body.heat_capacity.value(problem_.initial_temperature);
    const auto side = boundary.side;
    const double thickness =
        side == HeatSide::left || side == HeatSide::right ? body.x[1] - body.x[0] : body.r[1] - body.r[0];
    // Until 0.1 thickness^2/diffusivity the body is thick.
    const double t = std::min(duration, 0.1 * thickness * thickness * rho_c / k);
    return 2. * std::fabs(flux) * std::sqrt(t / (pi * k * rho_c));
  };
  double rise = 0.;
  for (const auto& load : loads_) {
    double here = half_space(load.flux->boundary, load.held);
    if (load.flux->second && here > 0.) {
      const double beyond = half_space(*load.flux->second, load.held);
      here *= beyond / (here + beyond);  // without contact resistance
    }
    rise = std::max(rise, here);
  }
  for (std::size_t p = 0; p < ports_.size(); ++p) {
    const auto& port = problem_.ports[p];
    const double largest = std::max(std::fabs(ports_[p].held), std::fabs(ports_[p].held + ports_[p].rate * duration));
    if (!port.node) {
      rise = std::max(rise, half_space(port.boundaries.front(), largest / ports_[p].area));
      continue;
    }
    // Until its links carry the heat on.
    const double capacity = problem_.nodes[*port.node].capacity;
    double t = duration;
    for (const auto& link : problem_.links)
      if (link.from == p || link.to == p) t = std::min(t, link.resistance * capacity);
    rise = std::max(rise, largest * t / capacity);
  }
  return rise;
}

double HeatOperator::shortest_time() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& cell : cells_) {
    const auto& body = body_of(cell);
    double side = std::numeric_limits<double>::infinity();
    for (const unsigned int f : cell->face_indices()) side = std::min(side, cell->face(f)->measure());
    const double h = side / static_cast<double>(fe_.degree);
    const double k = body.conductivity.value(problem_.initial_temperature);
    shortest = std::min(shortest, h * h * body.density * body.heat_capacity.value(problem_.initial_temperature) / k);
  }
  return shortest;
}

}  // namespace rotordrop
