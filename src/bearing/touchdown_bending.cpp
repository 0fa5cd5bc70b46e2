// Rings of a touchdown bearing that bend: how the rotor touches a bent bore, and the motion of the shapes.
//
// AT A POINT on the line of centres, delta = |e| - gap - u_r(theta_e): the force on rotor, ring and shapes is the gradient of the energy over e and the
// coefficients, so it has the part -N u_r'/|e| along t besides N along n. OVER AN ARC the energy is the sum of ArcContact's over points around the bore,
// delta_i = e . n_i - gap - u_r(theta_i), each with Hunt and Crossley's damping; friction acts along each point's tangent with one slip speed, the
// mean of the points' by their normal forces. Both conserve energy for any number of points. Friction does no work on the shapes: its part of a shape's force
// is at most mu / n of the normal one.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/wide_vectors.h"
#include "bearing/touchdown_touch.h"
#include "laws/vector_power.h"

namespace rotordrop {

// Twice around, so that every arc is one run of points.
struct TouchdownBearing::ArcTable {
  static constexpr std::size_t n = 2 * n_arc_points;
  using Row = std::array<double, n>;
  Row cosine, sine;
  std::vector<Row> shapes;                // as the coefficients
  std::vector<std::array<Row, 2>> waves;  // cos, sin of a bore wave's order times the azimuth
};

namespace {

using Row = std::array<double, 2 * n_arc_points>;
constexpr std::size_t lane = 8;

// Local overlaps and their rates, then forces. Arrays run over the points of the arc.
struct Arc {
  Arc() {}  // leaves everything unwritten: only the points of the arc are used
  alignas(64) std::array<double, n_arc_points> delta, rate, elastic, normal;
};

struct ArcSums {
  double y, z, normal, elastic, damping, deepest;
};

ROTORDROP_WIDE_VECTORS
void approach(double ey, double ez, double vy, double vz, double gap, const double* cosine, const double* sine,
              std::size_t n, double* delta, double* rate) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    delta[i] = ey * cosine[i] + ez * sine[i] - gap;
    rate[i] = vy * cosine[i] + vz * sine[i];
  }
}

ROTORDROP_WIDE_VECTORS
void subtract_shape(double a, double a_rate, double b, double b_rate, const double* cosine, const double* sine,
                    std::size_t n, double* delta, double* rate) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    delta[i] -= a * cosine[i] + b * sine[i];
    rate[i] -= a_rate * cosine[i] + b_rate * sine[i];
  }
}

struct ArcLaw {
  double exponent, f_0, f_1, f_2, f_3, damping;
};

ROTORDROP_WIDE_VECTORS
void press(const ArcLaw& law, const double* cosine, const double* sine, std::size_t n, Arc& arc, ArcSums& sums) {
  double y = 0, z = 0, normal = 0, elastic = 0, dissipated = 0, deepest = -1e300;
  const ArcLaw l = law;
  const double *delta = arc.delta.data(), *rate = arc.rate.data();
  double *el = arc.elastic.data(), *force = arc.normal.data();
#pragma omp simd reduction(+ : y, z, normal, elastic, dissipated) reduction(max : deepest)
  for (std::size_t i = 0; i < n; ++i) {
    // Written so that an overlap that is not a number goes on.
    const double d = !(delta[i] <= 0.) ? delta[i] : 0.;
    const double E =
        vector_power(d + 1e-300, l.exponent) * (l.f_0 + d * (l.f_1 + d * (l.f_2 + d * l.f_3))) * (d == 0. ? 0. : 1.);
    const double N = std::max(E * (1. + l.damping * rate[i]), 0.);
    y += N * cosine[i];
    z += N * sine[i];
    normal += N;
    elastic += E;
    dissipated += (N - E) * rate[i];
    deepest = std::max(deepest, delta[i]);
    el[i] = E;
    force[i] = N;
  }
  sums = {y, z, normal, elastic, dissipated, deepest};
}

ROTORDROP_WIDE_VECTORS
double product(const double* a, const double* b, std::size_t n) {
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// First point and number of points of the arc where surfaces can overlap.
struct Window {
  std::size_t first = 0, n = 0;
};

Window window(double ey, double ez, double distance, double gap, double bound) {
  // e cos(phi) - gap + bound > 0
  const double least = (gap - bound) / distance;
  if (!(least < 1.)) return {};
  const double step = 2. * std::numbers::pi / n_arc_points;
  const double half = least <= -1. ? std::numbers::pi : std::acos(least);
  double middle = std::atan2(ez, ey);
  if (middle < 0.) middle += 2. * std::numbers::pi;
  const double begin = std::floor((middle - half) / step);
  auto n = static_cast<std::size_t>(std::ceil(2. * half / step)) + 2;
  n = std::min((n + lane - 1) / lane * lane, n_arc_points);
  const double around = begin < 0. ? begin + static_cast<double>(n_arc_points) : begin;
  return {static_cast<std::size_t>(around) % n_arc_points, n};
}

double bound_of(std::span<const double> shape) {
  double sum = 0.;
  for (std::size_t k = 0; k + 1 < shape.size(); k += 2)
    sum += std::sqrt(shape[k] * shape[k] + shape[k + 1] * shape[k + 1]);
  return sum;
}

}  // namespace

std::shared_ptr<const TouchdownBearing::ArcTable> TouchdownBearing::make_arc_table() const {
  auto table = std::make_shared<ArcTable>();
  const auto fill = [](int order, Row& cosine, Row& sine) {
    for (std::size_t i = 0; i < cosine.size(); ++i) {
      const double theta = 2. * std::numbers::pi * static_cast<double>(i % n_arc_points) / n_arc_points;
      cosine[i] = std::cos(order * theta);
      sine[i] = std::sin(order * theta);
    }
  };
  fill(1, table->cosine, table->sine);
  table->shapes.resize(data_.bending->n_inner());
  for (std::size_t k = 0; k < data_.bending->inner.size(); ++k)
    fill(data_.bending->inner[k].n, table->shapes[2 * k], table->shapes[2 * k + 1]);
  table->waves.resize(data_.bore_waves.size());
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k)
    fill(data_.bore_waves[k].order, table->waves[k][0], table->waves[k][1]);
  return table;
}

std::span<const double> TouchdownBearing::inner_shape(std::span<const double> y) const {
  return y.subspan(shapes_at(), data_.bending->n_inner());
}
std::span<const double> TouchdownBearing::inner_shape_rate(std::span<const double> y) const {
  return y.subspan(shapes_at() + n_shapes(), data_.bending->n_inner());
}

void TouchdownBearing::bend_at_point(std::span<const double> y, Contact& c) const {
  const auto shape = inner_shape(y), rate = inner_shape_rate(y);
  double cosine = c.n_y * c.n_y - c.n_z * c.n_z, sine = 2. * c.n_y * c.n_z;
  double u = 0., u_rate = 0., slope = 0.;
  for (std::size_t k = 0; k + 1 < shape.size(); k += 2) {
    const double n = 2. + 0.5 * static_cast<double>(k);
    u += shape[k] * cosine + shape[k + 1] * sine;
    u_rate += rate[k] * cosine + rate[k + 1] * sine;
    slope += n * (shape[k + 1] * cosine - shape[k] * sine);
    const double next = cosine * c.n_y - sine * c.n_z;
    sine = sine * c.n_y + cosine * c.n_z;
    cosine = next;
  }
  c.penetration -= u;
  // d(delta)/dt with the line of centres turning through the shape.
  c.rate -= u_rate + slope * c.centres_turning;
  // The line of centres' direction has no meaning for concentric rings, which do not touch.
  c.bore_slope = c.distance > 0. ? slope / c.distance : 0.;
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

TouchdownBearing::Contact TouchdownBearing::contact_over_arc(const SupportInput& in, const Expansion& growth,
                                                             std::span<const double> y, const Bodies& at, double share,
                                                             std::span<double> forces) const {
  Contact c;
  const double distance = std::sqrt(at.y * at.y + at.z * at.z);
  c.distance = distance;
  c.n_y = distance > 0. ? at.y / distance : -1.;
  c.n_z = distance > 0. ? at.z / distance : 0.;
  c.rate = at.vy * c.n_y + at.vz * c.n_z;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.centres_turning = distance > 0. ? c.tangential_speed / distance : 0.;
  const double surfaces = in.rotor_spin.speed * data_.rotor_radius - y[ring_spin] * data_.bore_radius;
  c.slip_speed = surfaces + c.tangential_speed;
  const double gap = data_.air_gap + growth.bore - growth.shaft;
  const auto shape = inner_shape(y), rate = inner_shape_rate(y);
  double bound = bound_of(shape);
  for (const auto& w : data_.bore_waves) bound += std::fabs(w.amplitude);
  c.penetration = distance + bound - gap;  // a bound for rotors that are clear of the bore
  if (c.penetration <= 0.) {
    bend_at_point(y, c);
    c.penetration -= bound;
    return c;
  }
  if (!std::isfinite(c.penetration)) {  // found by the solver as a force that is not a number
    c.normal = c.elastic = c.penetration;
    return c;
  }
  const Window w = window(at.y, at.z, distance, gap, bound);
  const ArcTable& table = *arc_table_;
  const double *cosine = table.cosine.data() + w.first, *sine = table.sine.data() + w.first;
  Arc arc;
  approach(at.y, at.z, at.vy, at.vz, gap, cosine, sine, w.n, arc.delta.data(), arc.rate.data());
  for (std::size_t k = 0; k < shape.size(); k += 2)
    subtract_shape(shape[k], rate[k], shape[k + 1], rate[k + 1], table.shapes[k].data() + w.first,
                   table.shapes[k + 1].data() + w.first, w.n, arc.delta.data(), arc.rate.data());
  struct Turned {
    double c, s;
  };
  const auto turned = [&](const BoreWave& wave) {
    const double argument = wave.phase - wave.order * y[ring_angle];
    return Turned{wave.amplitude * std::cos(argument), wave.amplitude * std::sin(argument)};
  };
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
    const Turned p = turned(data_.bore_waves[k]);
    for (std::size_t i = 0; i < w.n; ++i)
      arc.delta[i] += table.waves[k][1][w.first + i] * p.c + table.waves[k][0][w.first + i] * p.s;
  }
  const double step = 2. * std::numbers::pi / n_arc_points;
  const auto& f = data_.bending->arc.factors();
  const ArcLaw law{data_.bending->arc.exponent(), step * f[0], step * f[1], step * f[2], step * f[3],
                   1.5 * data_.contact.lambda};
  ArcSums sums;
  press(law, cosine, sine, w.n, arc, sums);
  c.penetration = sums.deepest;
  c.elastic = sums.elastic;
  c.normal = sums.normal;
  c.damping = sums.damping;
  if (c.normal == 0.) return c;
  for (std::size_t k = 0; k < forces.size(); ++k)
    forces[k] += share * product(arc.normal.data(), table.shapes[k].data() + w.first, w.n);
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
    const BoreWave& wave = data_.bore_waves[k];
    const Turned p = turned(wave);
    double sum = 0.;
    for (std::size_t i = 0; i < w.n; ++i)
      sum += arc.elastic[i] * (table.waves[k][0][w.first + i] * p.c - table.waves[k][1][w.first + i] * p.s);
    c.wave_power -= sum * wave.order * y[ring_spin];
  }
  // The mean normal by force: shorter than one, as forces that spread over an arc hold each other in part.
  c.n_y = sums.y / sums.normal;
  c.n_z = sums.z / sums.normal;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.slip_speed = surfaces + c.tangential_speed;
  c.slip_x = at.vx + at.rolling_y * c.n_z - at.rolling_z * c.n_y;
  if (data_.sticking) return c;
  const double slip_squared = c.slip_speed * c.slip_speed + c.slip_x * c.slip_x;
  const double per_slip = data_.friction.per_speed(slip_squared, in.ring_temperature) * c.normal;
  c.friction = per_slip * c.slip_speed;
  c.friction_x = per_slip * c.slip_x;
  return c;
}

double TouchdownBearing::arc_energy(const SupportInput& /*in*/, const Expansion& growth, std::span<const double> y,
                                    const Bodies& at) const {
  const double gap = data_.air_gap + growth.bore - growth.shaft, distance = std::sqrt(at.y * at.y + at.z * at.z);
  const auto shape = inner_shape(y);
  double bound = bound_of(shape);
  for (const auto& w : data_.bore_waves) bound += std::fabs(w.amplitude);
  if (distance + bound - gap <= 0.) return 0.;
  const ArcTable& table = *arc_table_;
  double sum = 0.;
  for (std::size_t i = 0; i < n_arc_points; ++i) {
    double delta = at.y * table.cosine[i] + at.z * table.sine[i] - gap;
    for (std::size_t k = 0; k < shape.size(); ++k) delta -= shape[k] * table.shapes[k][i];
    for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
      const BoreWave& wave = data_.bore_waves[k];
      const double argument = wave.phase - wave.order * y[ring_angle];
      delta += wave.amplitude * (table.waves[k][1][i] * std::cos(argument) + table.waves[k][0][i] * std::sin(argument));
    }
    sum += data_.bending->arc.energy(delta);
  }
  return sum * 2. * std::numbers::pi / n_arc_points;
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

double TouchdownBearing::bend(std::span<const double> y, ShapeForces& f, std::span<double> dydt) const {
  const BentRings& bent = *data_.bending;
  const std::size_t at = shapes_at(), n = bent.n_inner(), all = n_shapes();
  double loss = 0.;
  for (std::size_t k = 0; k < all; ++k) {
    const bool is_inner = k < n;
    const RingHarmonic& h = is_inner ? bent.inner[k / 2] : bent.outer[(k - n) / 2];
    const double force = is_inner ? f.by_rotor[k] + f.by_balls[k] : -f.by_balls[k - n];
    const double mass = bent.dynamic_mass(h), rate = y[at + all + k];
    const double damper = 2. * bent.damping_ratio * std::sqrt(h.stiffness * mass) * rate;
    dydt[at + k] = rate;
    dydt[at + all + k] = (force - h.stiffness * y[at + k] - damper) / mass;
    loss += damper * rate;
  }
  return loss;
}

double TouchdownBearing::bending_energy(std::span<const double> y) const {
  const BentRings& bent = *data_.bending;
  const std::size_t at = shapes_at(), n = bent.n_inner(), all = n_shapes();
  double U = 0.;
  for (std::size_t k = 0; k < all; ++k) {
    const RingHarmonic& h = k < n ? bent.inner[k / 2] : bent.outer[(k - n) / 2];
    const double a = y[at + k], rate = y[at + all + k];
    U += 0.5 * (h.stiffness * a * a + bent.dynamic_mass(h) * rate * rate);
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
                             is_rate ? "m/s" : "m", is_rate ? 0.1 : 1e-5});
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
