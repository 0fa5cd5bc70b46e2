// Rings of a touchdown bearing that bend: contact of the rotor at a point of a bent bore, and the motion of the shapes.
//
// AT A POINT on the line of centres, delta = |e| - gap - u_r(theta_e): the force on rotor, ring and shapes is the gradient of the energy over e and the
// coefficients, so it has the part -N u_r'/|e| along t besides N along n. Friction does no work on the shapes: its part of a shape's force is at most mu / n of
// the normal one.
#include <cmath>
#include <string>

#include "bearing/touchdown_touch.h"

namespace rotordrop {

std::span<const double> TouchdownBearing::inner_shape(std::span<const double> y) const {
  return y.subspan(shapes_at(), data_.bending->n_inner());
}
std::span<const double> TouchdownBearing::inner_shape_rate(std::span<const double> y) const {
  return y.subspan(shapes_at() + n_shapes(), data_.bending->n_inner());
}

TouchdownBearing::BendAtPoint TouchdownBearing::bend_at_point(std::span<const double> y, double n_y, double n_z) const {
  const auto shape = inner_shape(y), rate = inner_shape_rate(y);
  double cosine = n_y * n_y - n_z * n_z, sine = 2. * n_y * n_z;
  BendAtPoint bend;
  for (std::size_t k = 0; k + 1 < shape.size(); k += 2) {
    const double n = 2. + 0.5 * static_cast<double>(k);
    bend.u += shape[k] * cosine + shape[k + 1] * sine;
    bend.rate += rate[k] * cosine + rate[k + 1] * sine;
    bend.slope += n * (shape[k + 1] * cosine - shape[k] * sine);
    const double next = cosine * n_y - sine * n_z;
    sine = sine * n_y + cosine * n_z;
    cosine = next;
  }
  return bend;
}

void TouchdownBearing::press_at_point(const Contact& c, double share, std::span<double> forces) const {
  if (c.normal == 0.) return;
  const double N = share * c.normal;
  double cosine = c.n_y * c.n_y - c.n_z * c.n_z, sine = 2. * c.n_y * c.n_z;
  for (std::size_t k = 0; k + 1 < forces.size(); k += 2) {
    forces[k] += N * cosine;
    forces[k + 1] += N * sine;
    const double next = cosine * c.n_y - sine * c.n_z;
    sine = sine * c.n_y + cosine * c.n_z;
    cosine = next;
  }
}

void TouchdownBearing::fill_ball_shapes(std::span<const double> y, ShapeForces& s) const {
  const std::size_t n = data_.bending->n_inner(), m = data_.bending->n_outer();
  const auto shape = y.subspan(shapes_at(), n + m), rate = y.subspan(shapes_at() + n + m, n + m);
  for (std::size_t k = 0; k < n; ++k) {
    s.shape[k] = shape[k] - (k < m ? shape[n + k] : 0.);
    s.shape_rate[k] = rate[k] - (k < m ? rate[n + k] : 0.);
    s.by_rotor[k] = s.by_balls[k] = 0.;
  }
}

void TouchdownBearing::lend_shapes(ShapeForces& s, BallRowInput& in) const {
  const std::size_t n = data_.bending->n_inner();
  in.shape = {s.shape.data(), n};
  in.shape_rate = {s.shape_rate.data(), n};
  in.shape_force = {s.by_balls.data(), n};
}

std::vector<TouchdownBearing::ShapeMotion> TouchdownBearing::shape_motions() const {
  std::vector<ShapeMotion> motions;
  for (const auto* ring : {&data_.bending->inner, &data_.bending->outer})
    for (const auto& h : *ring) {
      const double mass = data_.bending->dynamic_mass(h);
      motions.insert(motions.end(), 2,
                     {h.stiffness, mass, 1. / mass, 2. * data_.bending->damping_ratio * std::sqrt(h.stiffness * mass)});
    }
  return motions;
}

std::vector<double> TouchdownBearing::stiffness_of_both_rings() const {
  std::vector<double> both;
  if (!data_.bending) return both;
  const std::size_t n = data_.bending->n_inner(), m = data_.bending->n_outer();
  for (std::size_t k = 0; k < n; ++k) {
    const double inner = shape_motions_[k].stiffness;
    both.push_back(k < m ? 1. / (1. / inner + 1. / shape_motions_[n + k].stiffness) : inner);
  }
  return both;
}

void TouchdownBearing::bend_at_rest(std::span<const double> both, std::span<const double> widening,
                                    std::span<double> y) const {
  const std::size_t n = both.size(), m = data_.bending ? data_.bending->n_outer() : 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double force = both[k] * widening[k];
    y[shapes_at() + k] = force / shape_motions_[k].stiffness;
    if (k < m) y[shapes_at() + n + k] = -force / shape_motions_[n + k].stiffness;
  }
}

double TouchdownBearing::bend(std::span<const double> y, ShapeForces& f, std::span<double> dydt) const {
  const std::size_t at = shapes_at(), n = data_.bending->n_inner(), all = shape_motions_.size();
  double loss = 0.;
  for (std::size_t k = 0; k < all; ++k) {
    const ShapeMotion& m = shape_motions_[k];
    const double force = k < n ? f.by_rotor[k] + f.by_balls[k] : -f.by_balls[k - n];
    const double rate = y[at + all + k], damper = m.damping * rate;
    dydt[at + k] = rate;
    dydt[at + all + k] = (force - m.stiffness * y[at + k] - damper) * m.inverse_mass;
    loss += damper * rate;
  }
  return loss;
}

double TouchdownBearing::bending_energy(std::span<const double> y) const {
  const std::size_t at = shapes_at(), all = shape_motions_.size();
  double U = 0.;
  for (std::size_t k = 0; k < all; ++k) {
    const double a = y[at + k], rate = y[at + all + k];
    U += 0.5 * (shape_motions_[k].stiffness * a * a + shape_motions_[k].mass * rate * rate);
  }
  return U;
}

std::vector<StateEntry> TouchdownBearing::shape_entries() const {
  std::vector<StateEntry> entries;
  for (const bool is_rate : {false, true})
    for (const bool is_inner : {true, false})
      for (const auto& h : is_inner ? data_.bending->inner : data_.bending->outer)
        for (const char* part : {"cosine", "sine"})
          entries.push_back({std::string(is_inner ? "inner" : "outer") + " ring bending " + (is_rate ? "rate " : "") +
                                 std::to_string(h.n) + " " + part,
                             is_rate ? "m/s" : "m", is_rate ? 1. : 1e-4});
  return entries;
}

std::vector<Observable> TouchdownBearing::shape_observables() const {
  std::vector<Observable> list;
  for (const bool is_inner : {true, false}) {
    const auto& ring = is_inner ? data_.bending->inner : data_.bending->outer;
    if (ring.empty()) continue;
    Observable shape{is_inner ? "inner_ring_shape" : "outer_ring_shape",
                     "m",
                     "bending: coefficients of cos and sin of n times the azimuth in the radial displacement",
                     0,
                     {}};
    for (const auto& h : ring)
      for (const char* part : {"cos ", "sin "}) shape.columns.push_back(part + std::to_string(h.n));
    shape.size = shape.columns.size();
    list.push_back(std::move(shape));
  }
  return list;
}

}  // namespace rotordrop
