#include "thermal/fe/elastic_operator.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.h"
#include "thermal/fe/ring_quadrature.h"

namespace rotordrop {
namespace {

struct Lame {
  double lambda, mu, beta;
  explicit Lame(const ElasticBody& b)
      : lambda(b.E * b.nu / ((1. + b.nu) * (1. - 2. * b.nu))),
        mu(0.5 * b.E / (1. + b.nu)),
        beta(b.E / (1. - 2. * b.nu)) {}
};

/// Strains of a unit displacement of one node along x or r: xx, rr, hoop, twice the shear xr.
std::array<double, 4> strain(unsigned int part, double value, const dealii::Tensor<1, 2>& gradient, double r) {
  if (part == 0) return {gradient[0], 0., 0., gradient[1]};
  return {0., gradient[1], value / r, gradient[0]};
}

SectionMesh section_of(const ElasticProblem& problem) {
  if (!problem.mesh.empty()) return problem.mesh;
  HeatConductionProblem rectangles;
  for (const auto& b : problem.bodies) rectangles.bodies.push_back({b.name, b.x, b.r, 0., {}, {}});
  rectangles.numerics = problem.numerics;
  return mesh_of_rectangles(rectangles);
}

}  // namespace

ElasticOperator::ElasticOperator(const ElasticProblem& problem)
    : problem_(problem),
      mesh_(section_of(problem), static_cast<unsigned int>(problem.numerics.degree)),
      fe_(mesh_.element()),
      mapping_(mesh_.mapping()),
      n_nodes_(static_cast<unsigned int>(mesh_.dofs().n_dofs())),
      cell_quadrature_(fe_.degree + 2),
      face_quadrature_(fe_.degree + 2) {
  for (auto* v : {&external_, &centrifugal_}) v->reinit(size());
  volume_.reinit(n_nodes_);
  find_nodes();
  make_patterns();
  stiffness_.reinit(pattern_);
  thermal_.reinit(thermal_pattern_);
  assemble_bodies();
  assemble_tractions();
}

void ElasticOperator::find_nodes() {
  nodes_.resize(n_nodes_);
  dealii::DoFTools::map_dofs_to_support_points(mapping_, mesh_.dofs(), nodes_);
  body_of_node_.resize(n_nodes_);
  Indices dofs(fe_.dofs_per_cell);
  for (const auto& cell : mesh_.cells()) {
    cell->get_dof_indices(dofs);
    for (const auto i : dofs) body_of_node_[i] = cell->material_id();
  }
}

void ElasticOperator::make_patterns() {
  dealii::DynamicSparsityPattern square(size()), wide(size(), n_nodes_);
  Indices dofs(fe_.dofs_per_cell);
  for (const auto& cell : mesh_.cells()) {
    cell->get_dof_indices(dofs);
    for (const auto i : dofs)
      for (const auto j : dofs)
        for (unsigned int c = 0; c < 2; ++c) {
          wide.add(2 * i + c, j);
          for (unsigned int d = 0; d < 2; ++d) square.add(2 * i + c, 2 * j + d);
        }
  }
  pattern_.copy_from(square);
  thermal_pattern_.copy_from(wide);
}

void ElasticOperator::assemble_bodies() {
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  const unsigned int n = fe_.dofs_per_cell;
  dealii::FullMatrix<double> stiffness(2 * n, 2 * n), thermal(2 * n, n);
  Indices nodes(n), unknowns(2 * n);
  for (const auto& cell : mesh_.cells()) {
    const auto& body = problem_.bodies[cell->material_id()];
    const Lame m(body);
    const bool is_constant = body.expansion.is_constant();
    has_tables_ = has_tables_ || !is_constant;
    const double alpha = is_constant ? body.expansion.value(0.) : 0.;
    fe.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int c = 0; c < 2; ++c) unknowns[2 * i + c] = 2 * nodes[i] + c;
    stiffness = 0.;
    thermal = 0.;
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      const double w = weight(fe, q), r = fe.quadrature_point(q)[1], x = fe.quadrature_point(q)[0];
      const AxialRadial force =
          problem_.body_force ? problem_.body_force(cell->material_id(), x, r) : AxialRadial{0., 0.};
      for (unsigned int i = 0; i < n; ++i) {
        const double value = fe.shape_value(i, q);
        volume_(nodes[i]) += w * value;
        centrifugal_(2 * nodes[i] + 1) += w * body.density * body.spin * body.spin * r * value;
        for (unsigned int c = 0; c < 2; ++c) {
          const auto e = strain(c, value, fe.shape_grad(i, q), r);
          const double divergence = e[0] + e[1] + e[2];
          external_(2 * nodes[i] + c) += w * force[c] * value;
          const std::array<double, 4> s = {m.lambda * divergence + 2. * m.mu * e[0],
                                           m.lambda * divergence + 2. * m.mu * e[1],
                                           m.lambda * divergence + 2. * m.mu * e[2], m.mu * e[3]};
          for (unsigned int j = 0; j < n; ++j) {
            thermal(2 * i + c, j) += w * m.beta * alpha * divergence * fe.shape_value(j, q);
            for (unsigned int d = 0; d < 2; ++d) {
              const auto o = strain(d, fe.shape_value(j, q), fe.shape_grad(j, q), r);
              stiffness(2 * i + c, 2 * j + d) += w * (s[0] * o[0] + s[1] * o[1] + s[2] * o[2] + s[3] * o[3]);
            }
          }
        }
      }
    }
    stiffness_.add(unknowns, stiffness);
    thermal_.add(unknowns, nodes, thermal);
  }
}

void ElasticOperator::assemble_tractions() {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags | dealii::update_normal_vectors);
  Indices nodes(fe_.dofs_per_cell);
  for (const auto& load : problem_.tractions)
    for (const auto& face : mesh_.faces_of(load.boundary)) {
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(nodes);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
        const auto& p = fe.quadrature_point(q);
        AxialRadial t = load.traction ? load.traction(load.boundary.body, p[0], p[1]) : AxialRadial{0., 0.};
        for (unsigned int c = 0; c < 2; ++c) {
          t[c] -= load.pressure * fe.normal_vector(q)[c];
          for (unsigned int i = 0; i < fe_.dofs_per_cell; ++i)
            external_(2 * nodes[i] + c) += weight(fe, q) * t[c] * fe.shape_value(i, q);
        }
      }
    }
}

// ---------------------------------------------------------------------------------------------------------------- temperature

double ElasticOperator::thermal_strain(const ElasticBody& body, double T) const {
  return body.expansion.integral(problem_.reference_temperature, T);
}

ElasticOperator::Vector ElasticOperator::thermal_load(std::span<const double> T) const {
  Vector out(size()), rise(n_nodes_);
  for (unsigned int i = 0; i < n_nodes_; ++i) rise(i) = T[i] - problem_.reference_temperature;
  thermal_.vmult(out, rise);
  if (!has_tables_) return out;
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  Indices nodes(fe_.dofs_per_cell);
  for (const auto& cell : mesh_.cells()) {
    const auto& body = problem_.bodies[cell->material_id()];
    if (body.expansion.is_constant()) continue;
    fe.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      double here = 0.;
      for (unsigned int i = 0; i < nodes.size(); ++i) here += T[nodes[i]] * fe.shape_value(i, q);
      const double stress = Lame(body).beta * thermal_strain(body, here) * weight(fe, q);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c) {
          const auto e = strain(c, fe.shape_value(i, q), fe.shape_grad(i, q), fe.quadrature_point(q)[1]);
          out(2 * nodes[i] + c) += stress * (e[0] + e[1] + e[2]);
        }
    }
  }
  return out;
}

std::vector<double> ElasticOperator::transposed_thermal_load(const Vector& w) const {
  if (has_tables_)
    throw SolverError("growth is not a linear function of temperature: an expansion coefficient depends on it.");
  Vector out(n_nodes_);
  thermal_.Tvmult(out, w);
  return {out.begin(), out.end()};
}

// ----------------------------------------------------------------------------------------------------------------- functionals

ElasticOperator::Vector ElasticOperator::integral_over(const std::vector<Face>& faces, Measure measure) const {
  Vector out(n_nodes_);
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Indices nodes(fe_.dofs_per_cell);
  for (const auto& face : faces) {
    fe.reinit(face.cell, face.number);
    face.cell->get_dof_indices(nodes);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      const double part = measure == Measure::area ? weight(fe, q) : fe.JxW(q);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (fe_.has_support_on_face(i, face.number)) out(nodes[i]) += part * fe.shape_value(i, q);
    }
  }
  return out;
}

ElasticOperator::Vector ElasticOperator::mean_weights(const std::vector<HeatBoundary>& boundaries) const {
  std::vector<Face> faces;
  for (const auto& boundary : boundaries)
    for (const auto& face : mesh_.faces_of(boundary)) faces.push_back(face);
  if (faces.empty()) throw SolverError("a mean displacement is wanted over a side that the mesh does not have.");
  const auto sum = [](const Vector& weights) { return std::accumulate(weights.begin(), weights.end(), 0.); };
  Vector out = integral_over(faces);
  if (sum(out) == 0.) out = integral_over(faces, Measure::length);  // the axis of a solid body has no area
  out /= sum(out);
  return out;
}

std::vector<ElasticOperator::MassEntry> ElasticOperator::face_mass(const std::vector<Face>& faces) const {
  std::vector<MassEntry> entries;
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Indices nodes(fe_.dofs_per_cell);
  for (const auto& face : faces) {
    fe.reinit(face.cell, face.number);
    face.cell->get_dof_indices(nodes);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int j = 0; j < nodes.size(); ++j) {
        if (!fe_.has_support_on_face(i, face.number) || !fe_.has_support_on_face(j, face.number)) continue;
        double sum = 0.;
        for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
          sum += weight(fe, q) * fe.shape_value(i, q) * fe.shape_value(j, q);
        entries.push_back({static_cast<unsigned int>(nodes[i]), static_cast<unsigned int>(nodes[j]), sum});
      }
  }
  return entries;
}

std::vector<unsigned int> ElasticOperator::nodes_of(const Face& face) const {
  Indices nodes(fe_.dofs_per_cell);
  face.cell->get_dof_indices(nodes);
  std::vector<unsigned int> found;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (fe_.has_support_on_face(i, face.number)) found.push_back(static_cast<unsigned int>(nodes[i]));
  return found;
}

AxialRadial ElasticOperator::value(const Vector& u, std::size_t body, double x, double r) const {
  const auto place = mesh_.locate(body, x, r);
  Indices nodes(fe_.dofs_per_cell);
  place.cell->get_dof_indices(nodes);
  AxialRadial sum = {0., 0.};
  for (unsigned int i = 0; i < nodes.size(); ++i)
    for (unsigned int c = 0; c < 2; ++c) sum[c] += u(2 * nodes[i] + c) * fe_.shape_value(i, place.on_unit_cell);
  return sum;
}

ElasticSolver::Stress ElasticOperator::stress_at(const dealii::FEValuesBase<2>& fe, unsigned int q, const Cell& cell,
                                                 const Vector& u, std::span<const double> T) const {
  const auto& body = problem_.bodies[cell->material_id()];
  const Lame m(body);
  Indices nodes(fe_.dofs_per_cell);
  cell->get_dof_indices(nodes);
  std::array<double, 4> e{};
  double here = T.empty() ? problem_.reference_temperature : 0.;
  // On the axis u_r/r is u_r,r.
  const double r = fe.quadrature_point(q)[1];
  for (unsigned int i = 0; i < nodes.size(); ++i) {
    if (!T.empty()) here += T[nodes[i]] * fe.shape_value(i, q);
    for (unsigned int c = 0; c < 2; ++c) {
      const auto one = strain(c, fe.shape_value(i, q), fe.shape_grad(i, q), r > 0. ? r : 1.);
      for (std::size_t k = 0; k < 4; ++k) e[k] += one[k] * u(2 * nodes[i] + c);
    }
  }
  if (r == 0.) e[2] = e[1];
  const double common = m.lambda * (e[0] + e[1] + e[2]) - m.beta * thermal_strain(body, here);
  return {common + 2. * m.mu * e[0], common + 2. * m.mu * e[1], common + 2. * m.mu * e[2], m.mu * e[3]};
}

ElasticSolver::Stress ElasticOperator::stress(const Vector& u, std::span<const double> T, std::size_t body, double x,
                                              double r) const {
  const auto place = mesh_.locate(body, x, r);
  dealii::FEValues<2> fe(mapping_, fe_, dealii::Quadrature<2>(place.on_unit_cell), cell_flags);
  fe.reinit(place.cell);
  return stress_at(fe, 0, place.cell, u, T);
}

SurfaceRange ElasticOperator::hoop_stress(const Vector& u, std::span<const double> T, const HeatBoundary& side) const {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags | dealii::update_gradients);
  SurfaceRange range{0., std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double area = 0.;
  for (const auto& face : mesh_.faces_of(side)) {
    fe.reinit(face.cell, face.number);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      const double hoop = stress_at(fe, q, face.cell, u, T).hoop;
      range.mean += weight(fe, q) * hoop;
      area += weight(fe, q);
      range.lowest = std::min(range.lowest, hoop);
      range.highest = std::max(range.highest, hoop);
    }
  }
  range.mean /= area;
  return range;
}

double ElasticOperator::difference(const Vector& u, const ElasticFunction& f) const {
  dealii::FEValues<2> fe(mapping_, fe_, dealii::QGauss<2>(fe_.degree + 3), cell_flags);
  Indices nodes(fe_.dofs_per_cell);
  double sum = 0.;
  for (const auto& cell : mesh_.cells()) {
    fe.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      AxialRadial e = f(cell->material_id(), fe.quadrature_point(q)[0], fe.quadrature_point(q)[1]);
      for (unsigned int c = 0; c < 2; ++c) {
        for (unsigned int i = 0; i < nodes.size(); ++i) e[c] -= u(2 * nodes[i] + c) * fe.shape_value(i, q);
        sum += e[c] * e[c] * weight(fe, q);
      }
    }
  }
  return std::sqrt(sum);
}

}  // namespace rotordrop
