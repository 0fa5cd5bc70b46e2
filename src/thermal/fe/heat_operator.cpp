#include "thermal/fe/heat_operator.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;
constexpr unsigned int side_number(HeatSide side) {
  // deal.II's numbers of a quadrilateral's faces, with x and r as its two directions.
  switch (side) {
    case HeatSide::left:
      return 0;
    case HeatSide::right:
      return 1;
    case HeatSide::inner:
      return 2;
    case HeatSide::outer:
      return 3;
    case HeatSide::raceway:
    case HeatSide::strip:
      break;  // rectangles have none
  }
  return 0;
}
// The line of the section on which a boundary lies: direction across (0 x, 1 r) and coordinate.
std::pair<unsigned int, double> line_of(const HeatBody& body, HeatSide side) {
  switch (side) {
    case HeatSide::left:
      return {0, body.x[0]};
    case HeatSide::right:
      return {0, body.x[1]};
    case HeatSide::inner:
      return {1, body.r[0]};
    case HeatSide::outer:
      return {1, body.r[1]};
    case HeatSide::raceway:
    case HeatSide::strip:
      break;  // rectangles have none
  }
  return {0, 0.};
}
std::array<double, 2> extent_along(const HeatBody& body, HeatSide side) {
  return side == HeatSide::left || side == HeatSide::right ? body.r : body.x;
}

// Area of the part of a boundary between two coordinates along it.
double area_between(const HeatBody& body, HeatSide side, double a, double b) {
  const auto [across, at] = line_of(body, side);
  return across == 0 ? pi * (b * b - a * a) : 2. * pi * at * (b - a);
}

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
using Indices = std::vector<dealii::types::global_dof_index>;
const auto cell_flags =
    dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values;
const auto face_flags = dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values;
double interpolated(const dealii::Vector<double>& T, const std::vector<unsigned int>& dofs,
                    const std::vector<double>& shape) {
  double sum = 0.;
  for (std::size_t i = 0; i < dofs.size(); ++i) sum += T(dofs[i]) * shape[i];
  return sum;
}
// 2 pi r times the quadrature's weight.
double weight(const dealii::FEValuesBase<2>& fe, unsigned int q) {
  return 2. * pi * fe.quadrature_point(q)[1] * fe.JxW(q);
}

}  // namespace

HeatOperator::HeatOperator(const HeatConductionProblem& problem)
    : problem_(problem),
      grid_(make_grid(problem)),
      fe_(static_cast<unsigned int>(problem.numerics.degree)),
      cell_quadrature_(fe_.degree + 1),
      face_quadrature_(fe_.degree + 1),
      dofs_(triangulation_) {
  make_triangulation();
  dofs_.distribute_dofs(fe_);
  find_cells();
  make_pattern();
  prepare_curved_cells();
  capacity_.reinit(pattern_);
  conductance_.reinit(pattern_);
  for (auto* v : {&capacity_weights_, &ambient_load_, &scratch_}) v->reinit(size());
  assemble_bodies();
  assemble_interfaces();
  assemble_boundaries();
}

// ---------------------------------------------------------------------------------------------------------------------- mesh

void HeatOperator::make_triangulation() {
  std::vector<dealii::Point<2>> vertices;
  std::vector<dealii::CellData<2>> cells;
  const auto inside = [](const std::vector<double>& lines, const std::array<double, 2>& extent) {
    std::vector<std::size_t> found;  // lines of the body, the last one included
    const double slack = 1e-9 * (lines.back() - lines.front());
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i] >= extent[0] - slack && lines[i] <= extent[1] + slack) found.push_back(i);
    return found;
  };
  for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
    const auto& body = problem_.bodies[b];
    const auto x = inside(grid_.x, body.x), r = inside(grid_.r, body.r);
    layout_.push_back({x, r, cells.size()});
    const auto first = static_cast<unsigned int>(vertices.size());
    const auto n_x = static_cast<unsigned int>(x.size()), n_r = static_cast<unsigned int>(r.size());
    for (const auto j : r)
      for (const auto i : x) vertices.emplace_back(grid_.x[i], grid_.r[j]);
    for (unsigned int j = 0; j + 1 < n_r; ++j)
      for (unsigned int i = 0; i + 1 < n_x; ++i) {
        dealii::CellData<2> cell;
        const unsigned int corner = first + j * n_x + i;
        cell.vertices = {corner, corner + 1, corner + n_x, corner + n_x + 1};
        cell.material_id = static_cast<dealii::types::material_id>(b);
        cells.push_back(cell);
      }
  }
  triangulation_.create_triangulation(vertices, cells, dealii::SubCellData());
}

void HeatOperator::find_cells() {
  // A coarse mesh keeps the order in which its cells were given.
  for (const auto& cell : dofs_.active_cell_iterators()) {
    cells_.push_back(cell);
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
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  Indices dofs(n);
  for (const auto& cell : cells_) {
    if (!is_curved(body_of(cell))) continue;
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    CurvedCell prepared{&body_of(cell),
                        {dofs.begin(), dofs.end()},
                        {},
                        1. / cell->extent_in_direction(0),
                        1. / cell->extent_in_direction(1)};
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) prepared.weights.push_back(weight(fe, q));
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

bool HeatOperator::is_covered(const HeatBoundary& boundary, const dealii::Point<2>& centre) const {
  for (const auto& interface : problem_.interfaces)
    for (const auto* side : {&interface.first, &interface.second}) {
      if (!(*side == boundary)) continue;
      const auto& other = side == &interface.first ? interface.second : interface.first;
      const auto along = extent_along(problem_.bodies[other.body], other.side);
      const double at = boundary.side == HeatSide::left || boundary.side == HeatSide::right ? centre[1] : centre[0];
      if (at > along[0] && at < along[1]) return true;
    }
  return false;
}

std::vector<HeatOperator::Face> HeatOperator::faces_of(const HeatBoundary& boundary, bool free_part_only) const {
  std::vector<Face> faces;
  const unsigned int number = side_number(boundary.side);
  for (const auto& cell : cells_)
    if (cell->material_id() == boundary.body && cell->at_boundary(number) &&
        !(free_part_only && is_covered(boundary, cell->face(number)->center())))
      faces.push_back({cell, number});
  return faces;
}

double HeatOperator::free_area(const HeatBoundary& boundary) const {
  // Union of the covered stretches, cut out of the whole.
  const auto& body = problem_.bodies[boundary.body];
  const auto whole = extent_along(body, boundary.side);
  std::vector<std::array<double, 2>> covered;
  for (const auto& interface : problem_.interfaces)
    for (const auto* side : {&interface.first, &interface.second}) {
      if (!(*side == boundary)) continue;
      const auto& other = side == &interface.first ? interface.second : interface.first;
      const auto along = extent_along(problem_.bodies[other.body], other.side);
      covered.push_back({std::max(along[0], whole[0]), std::min(along[1], whole[1])});
    }
  std::sort(covered.begin(), covered.end());
  double area = area_between(body, boundary.side, whole[0], whole[1]), reached = whole[0];
  for (const auto& [a, b] : covered) {
    if (b <= reached) continue;
    area -= area_between(body, boundary.side, std::max(a, reached), b);
    reached = b;
  }
  return area;
}

std::vector<std::pair<HeatOperator::Face, HeatOperator::Face>> HeatOperator::pairs_of(
    const HeatInterface& interface) const {
  std::vector<std::pair<Face, Face>> pairs;
  const auto first = faces_of(interface.first, false), second = faces_of(interface.second, false);
  const unsigned int along = interface.first.side == HeatSide::inner || interface.first.side == HeatSide::outer ? 0 : 1;
  for (const auto& a : first)
    for (const auto& b : second) {
      const auto face_a = a.cell->face(a.number), face_b = b.cell->face(b.number);
      if (std::fabs(face_a->center()[along] - face_b->center()[along]) < 1e-3 * face_a->measure())
        pairs.emplace_back(a, b);
    }
  return pairs;
}

void HeatOperator::make_pattern() {
  dealii::DynamicSparsityPattern pattern(size());
  dealii::DoFTools::make_sparsity_pattern(dofs_, pattern);
  Indices a(fe_.dofs_per_cell), b(fe_.dofs_per_cell);
  for (const auto& interface : problem_.interfaces)
    for (const auto& [first, second] : pairs_of(interface)) {
      first.cell->get_dof_indices(a);
      second.cell->get_dof_indices(b);
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int j = 0; j < b.size(); ++j) {
          if (!fe_.has_support_on_face(i, first.number) || !fe_.has_support_on_face(j, second.number)) continue;
          pattern.add(a[i], b[j]);
          pattern.add(b[j], a[i]);
        }
    }
  pattern_.copy_from(pattern);
}

// ------------------------------------------------------------------------------------------------------------------ assembly

void HeatOperator::assemble_bodies() {
  dealii::FEValues<2> fe(mapping_, fe_, cell_quadrature_, cell_flags);
  const unsigned int n = fe_.dofs_per_cell;
  dealii::FullMatrix<double> capacity(n, n), conductance(n, n);
  Indices dofs(n);
  for (const auto& cell : cells_) {
    const auto& body = body_of(cell);
    if (is_curved(body)) continue;
    const double k = body.conductivity.value(0.), rho_c = body.density * body.heat_capacity.value(0.);
    fe.reinit(cell);
    capacity = 0.;
    conductance = 0.;
    cell->get_dof_indices(dofs);
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
}

void HeatOperator::assemble_interfaces() {
  dealii::FEFaceValues<2> fe_1(mapping_, fe_, face_quadrature_, face_flags),
      fe_2(mapping_, fe_, face_quadrature_, face_flags);
  const unsigned int n = fe_.dofs_per_cell;
  Indices dofs(2 * n), part(n);
  for (const auto& interface : problem_.interfaces)
    for (const auto& [first, second] : pairs_of(interface)) {
      fe_1.reinit(first.cell, first.number);
      fe_2.reinit(second.cell, second.number);
      first.cell->get_dof_indices(part);
      std::copy(part.begin(), part.end(), dofs.begin());
      second.cell->get_dof_indices(part);
      std::copy(part.begin(), part.end(), dofs.begin() + n);
      Values jump(2 * n);
      for (unsigned int q = 0; q < fe_1.n_quadrature_points; ++q) {
        const double w = weight(fe_1, q) / interface.resistance;
        for (unsigned int i = 0; i < n; ++i) {
          jump[i] = fe_1.shape_value(i, q);
          jump[n + i] = -fe_2.shape_value(i, q);
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
    for (const auto& face : faces_of(law.boundary, true)) {
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
        }
      conductance_.add(dofs, film);
    }
  for (const auto& flux : problem_.fluxes) {
    FluxLoad load{&flux, faces_of(flux.boundary, true), Vector(size()), free_area(flux.boundary), 0.};
    for (const auto& face : load.faces) {
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
        for (unsigned int i = 0; i < n; ++i) load.unit(dofs[i]) += weight(fe, q) * fe.shape_value(i, q);
    }
    loads_.push_back(std::move(load));
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

void HeatOperator::hold_fluxes_of(double time) {
  for (auto& load : loads_) {
    const auto& times = load.flux->times;
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    load.held = next == times.begin() ? 0. : load.flux->values[static_cast<std::size_t>(next - times.begin()) - 1];
  }
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

  for (const auto& cell : curved_cells_)
    for (std::size_t q = 0; q < cell.weights.size(); ++q) {
      const double k = cell.body->conductivity.value(interpolated(T, cell.dofs, shape_[q])) * cell.weights[q];
      const double k_T_x = k * interpolated(T, cell.dofs, shape_x_[q]) * cell.per_x * cell.per_x;
      const double k_T_r = k * interpolated(T, cell.dofs, shape_r_[q]) * cell.per_r * cell.per_r;
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
    for (const auto& face : load.faces) {
      fe.reinit(face.cell, face.number);
      face.cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
        const auto& p = fe.quadrature_point(q);
        const double heat = load.flux->function(p[0], p[1], t) * weight(fe, q);
        for (unsigned int i = 0; i < dofs.size(); ++i) out(dofs[i]) += heat * fe.shape_value(i, q);
      }
    }
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
        const double now = interpolated(T, cell.dofs, shape_[q]), w = cell.weights[q], xx = cell.per_x * cell.per_x,
                     rr = cell.per_r * cell.per_r;
        const double k = scaled_step * w * k_of.value(now), steeper = scaled_step * w * k_of.slope(now);
        const double flow_i = interpolated(T, cell.dofs, shape_x_[q]) * xx * shape_x_[q][i] +
                              interpolated(T, cell.dofs, shape_r_[q]) * rr * shape_r_[q][i];
        const double by_value =
            cell.body->density * cell.body->heat_capacity.value(now) * w * shape_[q][i] + steeper * flow_i;
        for (std::size_t j = 0; j < n; ++j)
          local[j] += by_value * shape_[q][j] +
                      k * (xx * shape_x_[q][i] * shape_x_[q][j] + rr * shape_r_[q][i] * shape_r_[q][j]);
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
}

// --------------------------------------------------------------------------------------------------------------------- energy

double HeatOperator::input_power(double t) const {
  double power = 0.;
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
  const auto& layout = layout_.at(body);
  // The cell between the lines, and the place in it from 0 to 1.
  const auto locate = [](const std::vector<double>& lines, const std::vector<std::size_t>& own, double at) {
    std::size_t i = 0;
    while (i + 2 < own.size() && lines[own[i + 1]] <= at) ++i;
    return std::pair{i, (at - lines[own[i]]) / (lines[own[i + 1]] - lines[own[i]])};
  };
  const auto [i, xi] = locate(grid_.x, layout.x, x);
  const auto [j, eta] = locate(grid_.r, layout.r, r);
  const auto& cell = cells_[layout.first_cell + j * (layout.x.size() - 1) + i];
  Indices dofs(fe_.dofs_per_cell);
  cell->get_dof_indices(dofs);
  double value = 0.;
  for (unsigned int k = 0; k < dofs.size(); ++k) value += T(dofs[k]) * fe_.shape_value(k, {xi, eta});
  return value;
}

double HeatOperator::mean_temperature(const Vector& T, const HeatBoundary& boundary) const {
  dealii::FEFaceValues<2> fe(mapping_, fe_, face_quadrature_, face_flags);
  Values now(fe.n_quadrature_points);
  double sum = 0., area = 0.;
  for (const auto& face : faces_of(boundary, false)) {
    fe.reinit(face.cell, face.number);
    fe.get_function_values(T, now);
    for (unsigned int q = 0; q < fe.n_quadrature_points; ++q) {
      sum += (now[q] - problem_.initial_temperature) * weight(fe, q);
      area += weight(fe, q);
    }
  }
  return problem_.initial_temperature + sum / area;
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
  double rise = 0.;
  for (const auto& load : loads_) {
    const auto& body = problem_.bodies[load.flux->boundary.body];
    const double k = body.conductivity.value(problem_.initial_temperature);
    const double rho_c = body.density * body.heat_capacity.value(problem_.initial_temperature);
    const auto across = line_of(body, load.flux->boundary.side).first;
    const double thickness = across == 0 ? body.x[1] - body.x[0] : body.r[1] - body.r[0];
    // Until 0.1 thickness^2/diffusivity the body is thick.
    const double t = std::min(duration, 0.1 * thickness * thickness * rho_c / k);
    rise = std::max(rise, 2. * std::fabs(load.held) * std::sqrt(t / (pi * k * rho_c)));
  }
  return rise;
}

double HeatOperator::shortest_time() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& cell : cells_) {
    const auto& body = body_of(cell);
    const double h =
        std::min(cell->extent_in_direction(0), cell->extent_in_direction(1)) / static_cast<double>(fe_.degree);
    const double k = body.conductivity.value(problem_.initial_temperature);
    shortest = std::min(shortest, h * h * body.density * body.heat_capacity.value(problem_.initial_temperature) / k);
  }
  return shortest;
}

}  // namespace rotordrop
