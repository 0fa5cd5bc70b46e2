#include "thermal/fe/heat_operator.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "thermal/fe/heat_integrands.h"
#include "thermal/fe/ring_quadrature.h"

namespace rotordrop {

HeatOperator::HeatOperator(const HeatConductionProblem& problem)
    : problem_(problem),
      mesh_(problem.mesh.empty() ? mesh_of_rectangles(problem) : problem.mesh,
            static_cast<unsigned int>(problem.numerics.degree)),
      fe_(mesh_.element()),
      mapping_(mesh_.mapping()),
      cell_quadrature_(fe_.degree + 1),
      face_quadrature_(fe_.degree + 1),
      cells_(mesh_.cells()),
      n_field_(mesh_.dofs().n_dofs()),
      sources_(problem_, {}, {}) {
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
  capacity_rows_ = NonzeroRows(capacity_);
  conductance_rows_ = NonzeroRows(conductance_);
  sources_ = make_sources();
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
    Port made{port.name, Vector(size()), 0., {}};
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
    made.mean = mean_by(made.weights);
    ports_.push_back(std::move(made));
  }
}

HeatSources HeatOperator::make_sources() const {
  std::vector<double> flux_areas, port_areas;
  for (const auto& load : loads_) flux_areas.push_back(load.area);
  for (const auto& port : ports_) port_areas.push_back(port.area);
  return {problem_, std::move(flux_areas), std::move(port_areas)};
}

void HeatOperator::find_held_unknowns() {
  std::vector<bool> is_taken(size());
  Indices dofs(fe_.dofs_per_cell);
  for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
    if (!problem_.bodies[b].held_at) continue;
    HeldUnknowns held{{}, *problem_.bodies[b].held_at};
    for (const auto& cell : cells_) {
      if (cell->material_id() != b) continue;
      cell->get_dof_indices(dofs);
      for (const auto i : dofs) {
        if (is_taken[i]) continue;
        is_taken[i] = true;
        held.unknowns.push_back(static_cast<unsigned int>(i));
      }
    }
    held_.push_back(std::move(held));
  }
  for (const auto& fixed : problem_.fixed) {
    HeldUnknowns held{{}, fixed.temperature};
    for (const auto& face : free_faces_of(fixed.boundary)) {
      face.cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < fe_.dofs_per_cell; ++i) {
        if (!fe_.has_support_on_face(i, face.number) || is_taken[dofs[i]]) continue;
        is_taken[dofs[i]] = true;
        held.unknowns.push_back(static_cast<unsigned int>(dofs[i]));
      }
    }
    held_.push_back(std::move(held));
  }
}

void HeatOperator::prepare_curved_cells() {
  const unsigned int n = fe_.dofs_per_cell;
  CellShapes shapes{n, {}, {}, {}};
  for (unsigned int q = 0; q < cell_quadrature_.size(); ++q)
    for (unsigned int i = 0; i < n; ++i) {
      const auto& p = cell_quadrature_.point(q);
      shapes.value.push_back(fe_.shape_value(i, p));
      shapes.x.push_back(fe_.shape_grad(i, p)[0]);
      shapes.r.push_back(fe_.shape_grad(i, p)[1]);
    }
  curved_ = CurvedCells(std::move(shapes));
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
    const std::vector<unsigned int> unknowns(dofs.begin(), dofs.end());
    std::vector<double> weights;
    std::vector<std::array<double, 3>> metrics;
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      weights.push_back(weight(fe, q));
      const auto& inverse = fe.inverse_jacobian(q);  // rows: directions of the unit cell
      metrics.push_back({inverse[0] * inverse[0], inverse[0] * inverse[1], inverse[1] * inverse[1]});
    }
    curved_.add(body_of(cell), {unknowns, weights, metrics});
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

void HeatOperator::enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const {
  scratch_ = T;
  scratch_ -= T_before;
  capacity_rows_.multiply(scratch_, out);
  curved_.add_enthalpy(T.begin(), T_before.begin(), out.begin());
}

void HeatOperator::heat_flow(const Vector& T, double t, Vector& out) const {
  scratch_ = T;
  scratch_.add(-problem_.initial_temperature);
  conductance_rows_.multiply(scratch_, out);
  out.sadd(-1., ambient_load_);
  for (std::size_t f = 0; f < loads_.size(); ++f) out.add(sources_.flux(f), loads_[f].unit);
  for (std::size_t p = 0; p < ports_.size(); ++p)
    if (!sources_.is_silent(p)) out.add(sources_.watts(p, t), ports_[p].weights);

  curved_.subtract_conduction(T.begin(), out.begin());
  for (const auto& face : power_faces_)
    for (std::size_t q = 0; q < face.weights.size(); ++q) {
      const auto& shape = (*face.shape)[q];
      const double lost = loss(*face.law, interpolated(T, face.dofs, shape)) * face.weights[q];
      for (std::size_t i = 0; i < face.dofs.size(); ++i) out(face.dofs[i]) -= lost * shape[i];
    }
  add_functions(t, out);
}

bool HeatOperator::is_steady() const {
  return sources_.is_steady() && !problem_.volume_source &&
         std::none_of(problem_.fluxes.begin(), problem_.fluxes.end(),
                      [](const HeatFlux& flux) { return static_cast<bool>(flux.function); });
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

void HeatOperator::jacobian(const Vector& T, double scaled_step, HeatMatrix kind, Matrix& out) const {
  out.copy_from(capacity_);
  out.add(scaled_step, conductance_);
  const std::size_t n = fe_.dofs_per_cell;
  const CellShapes& shapes = curved_.shapes();
  std::vector<double> here(n), local(n);
  curved_.for_each([&](const CurvedCells::View& cell) {
    const auto& k_of = cell.body.conductivity;
    for (std::size_t i = 0; i < n; ++i) here[i] = T(cell.unknown(i));
    const auto at_point = [&](const double* shape) { return std::inner_product(here.begin(), here.end(), shape, 0.); };
    for (std::size_t i = 0; i < n; ++i) {
      std::fill(local.begin(), local.end(), 0.);
      for (std::size_t q = 0; q < n; ++q) {
        const double *shape = &shapes.value[q * n], *shape_x = &shapes.x[q * n], *shape_r = &shapes.r[q * n];
        const double now = at_point(shape), w = cell.weight(q);
        const auto [xx, xr, rr] = cell.metric(q);
        const double k = cell.has_conductivity ? scaled_step * w * k_of.value(now) : 0.;
        const double steeper =
            cell.has_conductivity && kind == HeatMatrix::exact ? scaled_step * w * k_of.slope(now) : 0.;
        const double rho_c = cell.has_capacity ? cell.body.density * cell.body.heat_capacity.value(now) : 0.;
        // Gradient of shape i raised by the metric.
        const double i_x = xx * shape_x[i] + xr * shape_r[i], i_r = xr * shape_x[i] + rr * shape_r[i];
        const double flow_i = at_point(shape_x) * i_x + at_point(shape_r) * i_r;
        const double by_value = rho_c * w * shape[i] + steeper * flow_i;
        for (std::size_t j = 0; j < n; ++j) local[j] += by_value * shape[j] + k * (i_x * shape_x[j] + i_r * shape_r[j]);
      }
      for (std::size_t j = 0; j < n; ++j) out.add(cell.unknown(i), cell.unknown(j), local[j]);
    }
  });
  for (const auto& face : power_faces_)
    for (std::size_t q = 0; q < face.weights.size(); ++q) {
      const auto& shape = (*face.shape)[q];
      const double film = scaled_step * loss_slope(*face.law, interpolated(T, face.dofs, shape)) * face.weights[q];
      for (std::size_t i = 0; i < face.dofs.size(); ++i)
        for (std::size_t j = 0; j < face.dofs.size(); ++j)
          out.add(face.dofs[i], face.dofs[j], film * shape[i] * shape[j]);
    }
  for (const auto& held : held_)
    for (const auto i : held.unknowns)
      for (auto entry = out.begin(i); entry != out.end(i); ++entry) {
        const auto j = entry->column();
        if (j == i) continue;
        entry->value() = 0.;
        out.set(j, i, 0.);
      }
}

}  // namespace rotordrop
