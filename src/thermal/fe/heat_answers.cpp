#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "thermal/fe/heat_integrands.h"
#include "thermal/fe/heat_operator.h"
#include "thermal/fe/ring_quadrature.h"
#include "thermal/fe/solvers/sorted_rows.h"

// What can be asked of temperatures once they are known: energies, means and places of the field, scales.
namespace rotordrop {

namespace {

using Values = std::vector<double>;

}  // namespace

// --------------------------------------------------------------------------------------------------------------------- energy

std::string HeatOperator::part_of(std::size_t unknown) const {
  if (unknown >= n_field_) return "node \"" + problem_.nodes[unknown - n_field_].name + "\"";
  return "body \"" + problem_.bodies[body_of_[unknown]].name + "\"";
}

std::string HeatOperator::strongest_cooling(std::size_t unknown, double t) const {
  const auto i = static_cast<unsigned int>(unknown);
  return sources_.strongest_cooling(
      t, [&](std::size_t flux) { return loads_[flux].unit(i) != 0.; },
      [&](std::size_t port) { return ports_[port].weights(i) != 0.; });
}

double HeatOperator::input_power(double t) const {
  double power = sources_.power(t);
  for (const auto& load : loads_) {
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
    if (!link.to)
      power += mean_of_port(link.from).rise({T.begin(), T.end()}, problem_.initial_temperature) / link.resistance;
  return power;
}

double HeatOperator::stored_energy(const Vector& T, const Vector& T_0) const {
  double energy = 0.;
  for (unsigned int i = 0; i < size(); ++i) energy += capacity_weights_(i) * (T(i) - T_0(i));
  const std::size_t n = fe_.dofs_per_cell;
  curved_.for_each([&](const CurvedCells::View& cell) {
    for (std::size_t q = 0; cell.has_capacity && q < n; ++q) {
      double before = 0., now = 0.;
      for (std::size_t i = 0; i < n; ++i) {
        const double shape = curved_.shapes().value[q * n + i];
        before += T_0(cell.unknown(i)) * shape;
        now += T(cell.unknown(i)) * shape;
      }
      energy += cell.body.density * cell.body.heat_capacity.integral(before, now) * cell.weight(q);
    }
  });
  return energy;
}

// --------------------------------------------------------------------------------------------------------------------- probes

HeatMean HeatOperator::mean_at(std::size_t body, double x, double r) const {
  const auto place = mesh_.locate(body, x, r);
  Indices dofs(fe_.dofs_per_cell);
  place.cell->get_dof_indices(dofs);
  HeatMean mean;
  for (unsigned int k = 0; k < dofs.size(); ++k) {
    mean.unknowns.push_back(static_cast<unsigned int>(dofs[k]));
    mean.weights.push_back(fe_.shape_value(k, place.on_unit_cell));
  }
  return mean;
}

HeatMean HeatOperator::mean_over(const std::vector<HeatBoundary>& boundaries) const {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Indices dofs(fe_.dofs_per_cell);
  std::map<unsigned int, double> weights;
  double area = 0.;
  for (const auto& boundary : boundaries)
    for (const auto& face : mesh_.faces_of(boundary)) {
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
        area += weight(fe, q);
        for (const auto i : face_dofs_[face.number])
          weights[static_cast<unsigned int>(dofs[i])] += weight(fe, q) * fe.shape_value(i, q);
      }
    }
  HeatMean mean;
  for (const auto& [unknown, w] : weights) {
    mean.unknowns.push_back(unknown);
    mean.weights.push_back(w / area);
  }
  return mean;
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

// --------------------------------------------------------------------------------------------------------------------- plain data

std::optional<AssembledHeat> HeatOperator::assembled() const {
  if (!is_linear()) return std::nullopt;
  AssembledHeat heat;
  SortedRows capacity, conductance;
  capacity.analyse(capacity_);
  capacity.take_values(capacity_);
  conductance.analyse(conductance_);
  conductance.take_values(conductance_);
  heat.row_start.assign(capacity.row_start.begin(), capacity.row_start.end());
  heat.column.assign(capacity.column.begin(), capacity.column.end());
  heat.capacity = std::move(capacity.value);
  heat.conductance = std::move(conductance.value);
  const auto list = [](const Vector& v) { return Values(v.begin(), v.end()); };
  heat.capacity_weights = list(capacity_weights_);
  heat.loss_weights = list(loss_weights_);
  heat.ambient_load = list(ambient_load_);
  for (const auto& load : loads_) {
    heat.flux_loads.push_back(list(load.unit));
    heat.flux_areas.push_back(load.area);
  }
  for (const auto& port : ports_) {
    heat.ports.push_back(port.mean);
    heat.port_areas.push_back(port.area);
  }
  heat.held = held_;
  for (const auto& body : bodies_) heat.bodies.push_back(body.mean);
  heat.body_of.assign(body_of_.begin(), body_of_.end());
  heat.shortest_time = shortest_time();
  return heat;
}

}  // namespace rotordrop
