#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>

#include "thermal/fe/heat_integrands.h"
#include "thermal/fe/heat_operator.h"
#include "thermal/fe/ring_quadrature.h"

// The heat operator's matrices and loads: all that is linear.
namespace rotordrop {

namespace {

using Values = std::vector<double>;

}  // namespace

void HeatOperator::make_pattern() {
  dealii::DynamicSparsityPattern pattern(size());
  Indices a(fe_.dofs_per_cell), b(fe_.dofs_per_cell);
  for (const auto& cell : cells_) {
    cell->get_dof_indices(a);
    for (const auto i : a)
      for (const auto j : a) pattern.add(i, j);
  }
  for (const auto& interface : problem_.interfaces)
    for (const auto& [first, second] : mesh_.pairs_of(interface.first, interface.second)) {
      first.cell->get_dof_indices(a);
      second.cell->get_dof_indices(b);
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int j = 0; j < b.size(); ++j) {
          if (!fe_.has_support_on_face(i, first.number) || !fe_.has_support_on_face(j, second.number)) continue;
          pattern.add(a[i], b[j]);
          pattern.add(b[j], a[i]);
        }
    }
  for (std::size_t k = 0; k < problem_.nodes.size(); ++k) pattern.add(index_of_node(k), index_of_node(k));
  for (const auto& link : problem_.links) {
    const auto ends = ends_of(link);
    for (const auto& [i, at_i] : ends)
      for (const auto& [j, at_j] : ends) pattern.add(i, j);
  }
  pattern_.copy_from(pattern);
}

// Weights of the temperature difference that drives a link.
std::vector<std::pair<unsigned int, double>> HeatOperator::ends_of(const HeatLink& link) const {
  std::vector<std::pair<unsigned int, double>> ends;
  const auto add = [&](std::size_t port, double sign) {
    const auto& weights = ports_[port].weights;
    for (unsigned int i = 0; i < weights.size(); ++i)
      if (weights(i) != 0.) ends.emplace_back(i, sign * weights(i));
  };
  add(link.from, 1.);
  if (link.to) add(*link.to, -1.);
  return ends;
}

void HeatOperator::assemble_bodies() {
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  const unsigned int n = fe_.dofs_per_cell;
  dealii::FullMatrix<double> capacity(n, n), conductance(n, n);
  Indices dofs(n);
  for (std::size_t b = 0; b < problem_.bodies.size(); ++b) bodies_.push_back({Vector(size()), 0., {}});
  body_of_.assign(n_field_, 0);
  for (const auto& cell : cells_) {
    const auto& body = body_of(cell);
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    auto& mean = bodies_[cell->material_id()];
    for (const auto dof : dofs) body_of_[dof] = cell->material_id();
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
      for (unsigned int i = 0; i < n; ++i) mean.weights(dofs[i]) += weight(fe, q) * fe.shape_value(i, q);
    // What depends on temperature is not in the matrices.
    const double k = body.conductivity.is_constant() ? body.conductivity.value(0.) : 0.;
    const double rho_c = body.heat_capacity.is_constant() ? body.density * body.heat_capacity.value(0.) : 0.;
    capacity = 0.;
    conductance = 0.;
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      const double w = weight(fe, q);
      for (unsigned int i = 0; i < n; ++i) {
        for (unsigned int j = 0; j < n; ++j) {
          capacity(i, j) += rho_c * w * fe.shape_value(i, q) * fe.shape_value(j, q);
          conductance(i, j) += k * w * (fe.shape_grad(i, q) * fe.shape_grad(j, q));
        }
        capacity_weights_(dofs[i]) += rho_c * w * fe.shape_value(i, q);
      }
    }
    capacity_.add(dofs, capacity);
    conductance_.add(dofs, conductance);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& body = problem_.bodies[b];
    double volume = 0.;
    for (const double w : bodies_[b].weights) volume += w;
    bodies_[b].capacity = volume * body.density * body.heat_capacity.value(problem_.initial_temperature);
    bodies_[b].weights /= volume;
    bodies_[b].mean = mean_by(bodies_[b].weights);
  }
}

void HeatOperator::assemble_interfaces() {
  dealii::FEFaceValues<2> fe_1(mapping_, fe_, face_quadrature_, face_flags),
      fe_2(mapping_, fe_, face_quadrature_, face_flags);
  const unsigned int n = fe_.dofs_per_cell;
  Indices dofs(2 * n), part(n);
  for (const auto& interface : problem_.interfaces)
    for (const auto& [first, second] : mesh_.pairs_of(interface.first, interface.second)) {
      fe_1.reinit(first.cell, first.number);
      fe_2.reinit(second.cell, second.number);
      // Cells may number the points of their common side from either end.
      const bool runs_backwards = fe_1.quadrature_point(0).distance(fe_2.quadrature_point(0)) >
                                  1e-3 * first.cell->face(first.number)->measure();
      first.cell->get_dof_indices(part);
      std::copy(part.begin(), part.end(), dofs.begin());
      second.cell->get_dof_indices(part);
      std::copy(part.begin(), part.end(), dofs.begin() + n);
      Values jump(2 * n);
      for (unsigned int q = 0; q < fe_1.n_quadrature_points; ++q) {
        const double w = weight(fe_1, q) / interface.resistance;
        for (unsigned int i = 0; i < n; ++i) {
          jump[i] = fe_1.shape_value(i, q);
          jump[n + i] = -fe_2.shape_value(i, runs_backwards ? fe_2.n_quadrature_points - 1 - q : q);
        }
        for (unsigned int i = 0; i < 2 * n; ++i)
          for (unsigned int j = 0; j < 2 * n; ++j)
            if (jump[i] != 0. && jump[j] != 0.) {
              // Shape functions of inner nodes vanish on the face but for roundoff; the pattern has no place for them.
              const bool is_on_face = fe_.has_support_on_face(i % n, i < n ? first.number : second.number) &&
                                      fe_.has_support_on_face(j % n, j < n ? first.number : second.number);
              if (is_on_face) conductance_.add(dofs[i], dofs[j], w * jump[i] * jump[j]);
            }
      }
    }
}

void HeatOperator::assemble_boundaries() {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  const unsigned int n = fe_.dofs_per_cell;
  dealii::FullMatrix<double> film(n, n);
  Indices dofs(n);
  for (const auto& law : problem_.convections)
    for (const auto& face : free_faces_of(law.boundary)) {
      (law.exponent == 0. ? linear_faces_ : power_faces_).push_back(film_face(face, law));
      if (law.exponent != 0.) continue;
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(dofs);
      film = 0.;
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
        for (unsigned int i = 0; i < n; ++i) {
          const double part = law.coefficient * weight(fe, q) * fe.shape_value(i, q);
          for (unsigned int j = 0; j < n; ++j) film(i, j) += part * fe.shape_value(j, q);
          ambient_load_(dofs[i]) += part * (law.ambient - problem_.initial_temperature);
          loss_weights_(dofs[i]) += part;
        }
      conductance_.add(dofs, film);
    }
  for (const auto& flux : problem_.fluxes) loads_.push_back(flux_load(flux));
}

// Heat q that arises within the resistance R of an interface, R s of which lie on its second side: with the temperature T_0 of that place,
//   q_1 = (T_0 - T_1)/(R (1 - s)),  q_2 = (T_0 - T_2)/(R s),  q_1 + q_2 = q   give   q_1 = s q + (T_2 - T_1)/R,  q_2 = (1 - s) q + (T_1 - T_2)/R.
HeatOperator::FluxLoad HeatOperator::flux_load(const HeatFlux& flux) const {
  FluxLoad load{&flux, {}, {}, 0.};
  if (flux.second) {
    for (const auto& [first, second] : mesh_.pairs_of(flux.boundary, *flux.second)) {
      load.faces.push_back(first);
      load.second_faces.push_back(second);
    }
  } else {
    load.faces = free_faces_of(flux.boundary);
  }
  load.unit.reinit(size());
  on_sides(load, [&](const std::vector<Face>& faces, double part) { load.unit.add(part, integral_over(faces)); });
  for (const auto& face : load.faces) load.area += mesh_.area(face);
  return load;
}

void HeatOperator::assemble_nodes_and_links() {
  for (std::size_t k = 0; k < problem_.nodes.size(); ++k) {
    const auto i = index_of_node(k);
    capacity_.add(i, i, problem_.nodes[k].capacity);
    capacity_weights_(i) += problem_.nodes[k].capacity;
  }
  for (const auto& link : problem_.links) {
    const auto ends = ends_of(link);
    const double G = 1. / link.resistance;
    for (const auto& [i, at_i] : ends) {
      for (const auto& [j, at_j] : ends) conductance_.add(i, j, G * at_i * at_j);
      if (!link.to) loss_weights_(i) += G * at_i;
    }
  }
}

}  // namespace rotordrop
