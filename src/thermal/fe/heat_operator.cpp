#include "thermal/fe/heat_operator.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/errors.h"
#include "thermal/fe/ring_quadrature.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
double loss(const HeatConvection& law, double T) {
  const double rise = T - law.ambient;
  if (law.exponent == 0.) return law.coefficient * rise;
  return rise > 0. ? law.coefficient * std::pow(rise, 1. + law.exponent) : 0.;
}
double loss_slope(const HeatConvection& law, double T) {
  const double rise = T - law.ambient;
  if (law.exponent == 0.) return law.coefficient;
  return rise > 0. ? law.coefficient * (1. + law.exponent) * std::pow(rise, law.exponent) : 0.;
}
bool is_curved(const HeatBody& body) { return !body.conductivity.is_constant() || !body.heat_capacity.is_constant(); }

using Values = std::vector<double>;
double interpolated(const dealii::Vector<double>& T, const std::vector<unsigned int>& dofs,
                    const std::vector<double>& shape) {
  double sum = 0.;
  for (std::size_t i = 0; i < dofs.size(); ++i) sum += T(dofs[i]) * shape[i];
  return sum;
}
}  // namespace

HeatOperator::HeatOperator(const HeatConductionProblem& problem)
    : problem_(problem),
      mesh_(problem.mesh.empty() ? mesh_of_rectangles(problem) : problem.mesh,
            static_cast<unsigned int>(problem.numerics.degree)),
      fe_(mesh_.element()),
      mapping_(mesh_.mapping()),
      cell_quadrature_(fe_.degree + 1),
      face_quadrature_(fe_.degree + 1),
      cells_(mesh_.cells()),
      n_field_(mesh_.dofs().n_dofs()) {
  find_covered_edges();
  for (auto* v : {&capacity_weights_, &ambient_load_, &loss_weights_, &scratch_}) v->reinit(size());
  make_ports();
  find_held_unknowns();
  make_pattern();
  prepare_curved_cells();
  capacity_.reinit(pattern_);
  conductance_.reinit(pattern_);
  assemble_bodies();
  assemble_interfaces();
  assemble_boundaries();
  assemble_nodes_and_links();
}

void HeatOperator::find_covered_edges() {
  for (const auto& interface : problem_.interfaces)
    for (const auto& [first, second] : mesh_.pairs_of(interface.first, interface.second))
      for (const auto edge : {first.edge, second.edge}) {
        is_covered_.resize(std::max(is_covered_.size(), edge + 1));
        is_covered_[edge] = true;
      }
}

std::vector<HeatOperator::Face> HeatOperator::free_faces_of(const HeatBoundary& boundary) const {
  auto faces = mesh_.faces_of(boundary);
  std::erase_if(faces, [&](const Face& face) { return face.edge < is_covered_.size() && is_covered_[face.edge]; });
  return faces;
}

// Integral of v over faces [m2]. On curved ones scaled to the exact area: a watt given is a watt received.
HeatOperator::Vector HeatOperator::integral_over(const std::vector<Face>& faces) const {
  Vector out(size());
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Indices dofs(fe_.dofs_per_cell);
  double discrete = 0., exact = 0.;
  for (const auto& face : faces) {
    fe.reinit(face.cell, face.number);
    face.cell->get_dof_indices(dofs);
    exact += mesh_.area(face);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      discrete += weight(fe, q);
      for (unsigned int i = 0; i < fe_.dofs_per_cell; ++i)
        if (fe_.has_support_on_face(i, face.number)) out(dofs[i]) += weight(fe, q) * fe.shape_value(i, q);
    }
  }
  if (mesh_.is_curved() && discrete > 0.) out *= exact / discrete;
  return out;
}

void HeatOperator::make_ports() {
  for (const auto& port : problem_.ports) {
    Port made{port.name, Vector(size()), 0., 0., 0.};
    if (port.node) {
      made.weights(index_of_node(*port.node)) = 1.;
    } else {
      std::vector<Face> faces;
      for (const auto& boundary : port.boundaries)
        for (const auto& face : free_faces_of(boundary)) faces.push_back(face);
      if (faces.empty()) throw SolverError("the heat port \"" + port.name + "\" has no free face of the mesh.");
      for (const auto& face : faces) made.area += mesh_.area(face);
      made.weights = integral_over(faces);
      made.weights /= made.area;
    }
    ports_.push_back(std::move(made));
  }
}

void HeatOperator::find_held_unknowns() {
  std::vector<bool> is_taken(size());
  Indices dofs(fe_.dofs_per_cell);
  for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
    if (!problem_.bodies[b].held_at) continue;
    Held held{{}, *problem_.bodies[b].held_at};
    for (const auto& cell : cells_) {
      if (cell->material_id() != b) continue;
      cell->get_dof_indices(dofs);
      for (const auto i : dofs) {
        if (is_taken[i]) continue;
        is_taken[i] = true;
        held.dofs.push_back(static_cast<unsigned int>(i));
      }
    }
    held_.push_back(std::move(held));
  }
  for (const auto& fixed : problem_.fixed) {
    Held held{{}, fixed.temperature};
    for (const auto& face : free_faces_of(fixed.boundary)) {
      face.cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < fe_.dofs_per_cell; ++i) {
        if (!fe_.has_support_on_face(i, face.number) || is_taken[dofs[i]]) continue;
        is_taken[dofs[i]] = true;
        held.dofs.push_back(static_cast<unsigned int>(dofs[i]));
      }
    }
    held_.push_back(std::move(held));
  }
}

void HeatOperator::prepare_curved_cells() {
  const unsigned int n = fe_.dofs_per_cell;
  for (unsigned int q = 0; q < cell_quadrature_.size(); ++q) {
    const auto& p = cell_quadrature_.point(q);
    for (auto* table : {&shape_, &shape_x_, &shape_r_}) table->emplace_back(n);
    for (unsigned int i = 0; i < n; ++i) {
      shape_[q][i] = fe_.shape_value(i, p);
      shape_x_[q][i] = fe_.shape_grad(i, p)[0];
      shape_r_[q][i] = fe_.shape_grad(i, p)[1];
    }
  }
  for (unsigned int number = 0; number < 4; ++number) {
    for (unsigned int i = 0; i < n; ++i)
      if (fe_.has_support_on_face(i, number)) face_dofs_[number].push_back(i);
    for (unsigned int q = 0; q < face_quadrature_.size(); ++q) {
      const double s = face_quadrature_.point(q)[0], end = number % 2;
      const dealii::Point<2> p = number < 2 ? dealii::Point<2>(end, s) : dealii::Point<2>(s, end);
      face_shape_[number].emplace_back();
      for (const auto i : face_dofs_[number]) face_shape_[number].back().push_back(fe_.shape_value(i, p));
    }
  }
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags | dealii::update_inverse_jacobians);
  Indices dofs(n);
  for (const auto& cell : cells_) {
    if (!is_curved(body_of(cell))) continue;
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    CurvedCell prepared{&body_of(cell), {dofs.begin(), dofs.end()}, {}, {}};
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      prepared.weights.push_back(weight(fe, q));
      const auto& inverse = fe.inverse_jacobian(q);  // rows: directions of the unit cell
      prepared.metric.push_back({inverse[0] * inverse[0], inverse[0] * inverse[1], inverse[1] * inverse[1]});
    }
    curved_cells_.push_back(std::move(prepared));
  }
}

HeatOperator::FilmFace HeatOperator::film_face(const Face& face, const HeatConvection& law) const {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  fe.reinit(face.cell, face.number);
  Indices dofs(fe_.dofs_per_cell);
  face.cell->get_dof_indices(dofs);
  FilmFace prepared{&law, {}, {}, &face_shape_[face.number]};
  for (const auto i : face_dofs_[face.number]) prepared.dofs.push_back(static_cast<unsigned int>(dofs[i]));
  for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) prepared.weights.push_back(weight(fe, q));
  return prepared;
}

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

// ------------------------------------------------------------------------------------------------------------------ assembly

void HeatOperator::assemble_bodies() {
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  const unsigned int n = fe_.dofs_per_cell;
  dealii::FullMatrix<double> capacity(n, n), conductance(n, n);
  Indices dofs(n);
  for (std::size_t b = 0; b < problem_.bodies.size(); ++b) bodies_.push_back({Vector(size()), 0.});
  body_of_.assign(n_field_, 0);
  for (const auto& cell : cells_) {
    const auto& body = body_of(cell);
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    auto& mean = bodies_[cell->material_id()];
    for (const auto dof : dofs) body_of_[dof] = cell->material_id();
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
      for (unsigned int i = 0; i < n; ++i) mean.weights(dofs[i]) += weight(fe, q) * fe.shape_value(i, q);
    if (is_curved(body)) continue;
    const double k = body.conductivity.value(0.), rho_c = body.density * body.heat_capacity.value(0.);
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
  FluxLoad load{&flux, {}, {}, 0., 0.};
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

// ----------------------------------------------------------------------------------------------------------------- evaluation

void HeatOperator::initial_temperature(Vector& T) const {
  T.reinit(size());
  T = problem_.initial_temperature;
  if (!problem_.initial_field) return;
  Indices dofs(fe_.dofs_per_cell);
  for (const auto& cell : cells_) {
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      const auto p = mapping_.transform_unit_to_real_cell(cell, fe_.unit_support_point(i));
      T(dofs[i]) = problem_.initial_field(cell->material_id(), p[0], p[1]);
    }
  }
}

bool HeatOperator::is_symmetric() const {
  return std::all_of(problem_.bodies.begin(), problem_.bodies.end(),
                     [](const HeatBody& body) { return body.conductivity.is_constant(); });
}

void HeatOperator::clear_held(Vector& residual) const {
  for (const auto& held : held_)
    for (const auto i : held.dofs) residual(i) = 0.;
}

void HeatOperator::hold_fluxes_of(double time) {
  for (auto& load : loads_) {
    const auto& times = load.flux->times;
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    load.held = next == times.begin() ? 0. : load.flux->values[static_cast<std::size_t>(next - times.begin()) - 1];
  }
}

void HeatOperator::hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time) {
  for (std::size_t p = 0; p < watts.size(); ++p) {
    ports_[p].held = watts[p];
    ports_[p].rate = rates.empty() ? 0. : rates[p];
  }
  held_since_ = time;
}

void HeatOperator::enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const {
  scratch_ = T;
  scratch_ -= T_before;
  capacity_.vmult(out, scratch_);
  for (const auto& cell : curved_cells_)
    for (std::size_t q = 0; q < cell.weights.size(); ++q) {
      const double before = interpolated(T_before, cell.dofs, shape_[q]), now = interpolated(T, cell.dofs, shape_[q]);
      const double gained = cell.body->density * cell.body->heat_capacity.integral(before, now) * cell.weights[q];
      for (std::size_t i = 0; i < cell.dofs.size(); ++i) out(cell.dofs[i]) += gained * shape_[q][i];
    }
}

void HeatOperator::heat_flow(const Vector& T, double t, Vector& out) const {
  scratch_ = T;
  scratch_.add(-problem_.initial_temperature);
  conductance_.vmult(out, scratch_);
  out.sadd(-1., ambient_load_);
  for (const auto& load : loads_) out.add(load.held, load.unit);
  for (const auto& port : ports_)
    if (port.held != 0. || port.rate != 0.) out.add(watts(port, t), port.weights);

  for (const auto& cell : curved_cells_)
    for (std::size_t q = 0; q < cell.weights.size(); ++q) {
      const double k = cell.body->conductivity.value(interpolated(T, cell.dofs, shape_[q])) * cell.weights[q];
      const double T_x = interpolated(T, cell.dofs, shape_x_[q]), T_r = interpolated(T, cell.dofs, shape_r_[q]);
      const auto& [xx, xr, rr] = cell.metric[q];
      const double k_T_x = k * (xx * T_x + xr * T_r), k_T_r = k * (xr * T_x + rr * T_r);
      for (std::size_t i = 0; i < cell.dofs.size(); ++i)
        out(cell.dofs[i]) -= k_T_x * shape_x_[q][i] + k_T_r * shape_r_[q][i];
    }
  for (const auto& face : power_faces_)
    for (std::size_t q = 0; q < face.weights.size(); ++q) {
      const auto& shape = (*face.shape)[q];
      const double lost = loss(*face.law, interpolated(T, face.dofs, shape)) * face.weights[q];
      for (std::size_t i = 0; i < face.dofs.size(); ++i) out(face.dofs[i]) -= lost * shape[i];
    }
  add_functions(t, out);
}

void HeatOperator::add_functions(double t, Vector& out) const {
  Indices dofs(fe_.dofs_per_cell);
  if (problem_.volume_source) {
    dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
    for (const auto& cell : cells_) {
      fe.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
        const auto& p = fe.quadrature_point(q);
        const double source = problem_.volume_source(cell->material_id(), p[0], p[1], t) * weight(fe, q);
        for (unsigned int i = 0; i < dofs.size(); ++i) out(dofs[i]) += source * fe.shape_value(i, q);
      }
    }
  }
  for (const auto& load : loads_) {
    if (!load.flux->function) continue;
    dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
    on_sides(load, [&](const std::vector<Face>& faces, double part) {
      for (const auto& face : faces) {
        fe.reinit(face.cell, face.number);
        face.cell->get_dof_indices(dofs);
        for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
          const auto& p = fe.quadrature_point(q);
          const double heat = part * load.flux->function(p[0], p[1], t) * weight(fe, q);
          for (unsigned int i = 0; i < dofs.size(); ++i) out(dofs[i]) += heat * fe.shape_value(i, q);
        }
      }
    });
  }
}

void HeatOperator::jacobian(const Vector& T, double scaled_step, Matrix& out) const {
  out.copy_from(capacity_);
  out.add(scaled_step, conductance_);
  const std::size_t n = fe_.dofs_per_cell;
  std::vector<double> local(n);
  for (const auto& cell : curved_cells_) {
    const auto& k_of = cell.body->conductivity;
    for (std::size_t i = 0; i < n; ++i) {
      std::fill(local.begin(), local.end(), 0.);
      for (std::size_t q = 0; q < cell.weights.size(); ++q) {
        const double now = interpolated(T, cell.dofs, shape_[q]), w = cell.weights[q];
        const auto& [xx, xr, rr] = cell.metric[q];
        const double k = scaled_step * w * k_of.value(now), steeper = scaled_step * w * k_of.slope(now);
        // Gradient of shape i raised by the metric.
        const double i_x = xx * shape_x_[q][i] + xr * shape_r_[q][i], i_r = xr * shape_x_[q][i] + rr * shape_r_[q][i];
        const double flow_i =
            interpolated(T, cell.dofs, shape_x_[q]) * i_x + interpolated(T, cell.dofs, shape_r_[q]) * i_r;
        const double by_value =
            cell.body->density * cell.body->heat_capacity.value(now) * w * shape_[q][i] + steeper * flow_i;
        for (std::size_t j = 0; j < n; ++j)
          local[j] += by_value * shape_[q][j] + k * (i_x * shape_x_[q][j] + i_r * shape_r_[q][j]);
      }
      for (std::size_t j = 0; j < n; ++j) out.add(cell.dofs[i], cell.dofs[j], local[j]);
    }
  }
  for (const auto& face : power_faces_)
    for (std::size_t q = 0; q < face.weights.size(); ++q) {
      const auto& shape = (*face.shape)[q];
      const double film = scaled_step * loss_slope(*face.law, interpolated(T, face.dofs, shape)) * face.weights[q];
      for (std::size_t i = 0; i < face.dofs.size(); ++i)
        for (std::size_t j = 0; j < face.dofs.size(); ++j)
          out.add(face.dofs[i], face.dofs[j], film * shape[i] * shape[j]);
    }
  for (const auto& held : held_)
    for (const auto i : held.dofs)
      for (auto entry = out.begin(i); entry != out.end(i); ++entry) {
        const auto j = entry->column();
        if (j == i) continue;
        entry->value() = 0.;
        out.set(j, i, 0.);
      }
}

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
