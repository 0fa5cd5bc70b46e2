// Rotor in a bent bore, in contact over an arc: the energy is the sum of ArcContact's over points around the bore, delta_i = e . n_i - gap - u_r(theta_i), each
// with Hunt and Crossley's damping; friction acts along each point's tangent with one slip speed, the mean of the points' by their normal forces. Energy is
// conserved for any number of points.
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

/// An arc of points, and what moves there.
struct ArcInput {
  double ey, ez, vy, vz, gap;       // rotor's centre from the ring's, their velocity
  const double *cosine, *sine;      // of the azimuths, from the arc's first point on
  const double* shapes;             // of the first shape there; the others follow at the distance `stride`
  std::size_t stride, n_shapes, n;  // n: points, a multiple of `lane`
  const double *shape, *shape_rate;
  const double* waves;                           // what waves of the bore add to the overlap; nullptr: none
  double exponent, f_0, f_1, f_2, f_3, damping;  // of ArcContact, for one point; 1.5 lambda
};

struct ArcOutput {
  double y, z, normal, elastic, damping, deepest;
  std::array<double, TouchdownBearing::max_shapes> on_shapes;
  alignas(64) std::array<double, n_arc_points> forces;  // elastic ones, for the waves
  ArcOutput() {}                                        // leaves the arrays unwritten
};

// Sums are kept by lane until the end; blocks of points without overlap are passed over.
ROTORDROP_KERNEL void press(const ArcInput& in, ArcOutput& out) {
  double y[lane] = {}, z[lane] = {}, normal[lane] = {}, elastic[lane] = {}, dissipated[lane] = {};
  double by_shape[TouchdownBearing::max_shapes * lane];
  for (std::size_t k = 0; k < in.n_shapes * lane; ++k) by_shape[k] = 0.;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < in.n; j += lane) {
    const double *cosine = in.cosine + j, *sine = in.sine + j;
    double delta[lane], rate[lane], N[lane];
#pragma omp simd
    for (std::size_t i = 0; i < lane; ++i) {
      delta[i] = in.ey * cosine[i] + in.ez * sine[i] - in.gap;
      rate[i] = in.vy * cosine[i] + in.vz * sine[i];
    }
    for (std::size_t k = 0; k < in.n_shapes; ++k) {
      const double *table = in.shapes + k * in.stride + j, a = in.shape[k], v = in.shape_rate[k];
#pragma omp simd
      for (std::size_t i = 0; i < lane; ++i) {
        delta[i] -= a * table[i];
        rate[i] -= v * table[i];
      }
    }
    if (in.waves)
      for (std::size_t i = 0; i < lane; ++i) delta[i] += in.waves[j + i];
    double highest = delta[0];
    for (std::size_t i = 1; i < lane; ++i) highest = std::max(highest, delta[i]);
    deepest = std::max(deepest, highest);
    if (highest <= 0.) {
      for (std::size_t i = 0; i < lane; ++i) out.forces[j + i] = 0.;
      continue;
    }
#pragma omp simd
    for (std::size_t i = 0; i < lane; ++i) {
      // Written so that an overlap that is not a number goes on.
      const double d = !(delta[i] <= 0.) ? delta[i] : 0.;
      const double polynomial = in.f_0 + d * (in.f_1 + d * (in.f_2 + d * in.f_3));
      const double E = vector_power(d + 1e-300, in.exponent) * polynomial * (d == 0. ? 0. : 1.);
      N[i] = std::max(E * (1. + in.damping * rate[i]), 0.);
      y[i] += N[i] * cosine[i];
      z[i] += N[i] * sine[i];
      normal[i] += N[i];
      elastic[i] += E;
      dissipated[i] += (N[i] - E) * rate[i];
      out.forces[j + i] = E;
    }
    for (std::size_t k = 0; k < in.n_shapes; ++k) {
      const double* table = in.shapes + k * in.stride + j;
      double* sum = by_shape + k * lane;
#pragma omp simd
      for (std::size_t i = 0; i < lane; ++i) sum[i] += N[i] * table[i];
    }
  }
  const auto total = [](const double* lanes) {
    double sum = 0.;
    for (std::size_t i = 0; i < lane; ++i) sum += lanes[i];
    return sum;
  };
  out.y = total(y);
  out.z = total(z);
  out.normal = total(normal);
  out.elastic = total(elastic);
  out.damping = total(dissipated);
  out.deepest = deepest;
  for (std::size_t k = 0; k < in.n_shapes; ++k) out.on_shapes[k] = total(by_shape + k * lane);
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
  const double begin = std::floor((middle - half) / step / lane) * lane;  // where vectors begin
  auto n = static_cast<std::size_t>(std::ceil((middle + half) / step - begin)) + 1;
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
  struct Turned {
    double c, s;
  };
  const auto turned = [&](const BoreWave& wave) {
    const double argument = wave.phase - wave.order * y[ring_angle];
    return Turned{wave.amplitude * std::cos(argument), wave.amplitude * std::sin(argument)};
  };
  std::array<double, n_arc_points> waves;
  if (!data_.bore_waves.empty()) {
    std::fill_n(waves.begin(), w.n, 0.);
    for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
      const Turned p = turned(data_.bore_waves[k]);
      for (std::size_t i = 0; i < w.n; ++i)
        waves[i] += table.waves[k][1][w.first + i] * p.c + table.waves[k][0][w.first + i] * p.s;
    }
  }
  const double step = 2. * std::numbers::pi / n_arc_points;
  const auto& f = data_.bending->arc.factors();
  const ArcInput arc{at.y,
                     at.z,
                     at.vy,
                     at.vz,
                     gap,
                     table.cosine.data() + w.first,
                     table.sine.data() + w.first,
                     table.shapes.front().data() + w.first,
                     ArcTable::n,
                     shape.size(),
                     w.n,
                     shape.data(),
                     rate.data(),
                     data_.bore_waves.empty() ? nullptr : waves.data(),
                     data_.bending->arc.exponent(),
                     step * f[0],
                     step * f[1],
                     step * f[2],
                     step * f[3],
                     1.5 * data_.contact.lambda};
  ArcOutput sums;
  wide<press>(arc, sums);
  c.penetration = sums.deepest;
  c.elastic = sums.elastic;
  c.normal = sums.normal;
  c.damping = sums.damping;
  if (c.normal == 0.) return c;
  for (std::size_t k = 0; k < forces.size(); ++k) forces[k] += share * sums.on_shapes[k];
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
    const BoreWave& wave = data_.bore_waves[k];
    const Turned p = turned(wave);
    double sum = 0.;
    for (std::size_t i = 0; i < w.n; ++i)
      sum += sums.forces[i] * (table.waves[k][0][w.first + i] * p.c - table.waves[k][1][w.first + i] * p.s);
    c.wave_power -= sum * wave.order * y[ring_spin];
  }
  // The mean normal by force: shorter than one, as forces that spread over an arc hold each other in part.
  c.n_y = sums.y / sums.normal;
  c.n_z = sums.z / sums.normal;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.slip_speed = surfaces + c.tangential_speed;
  slide(in, at, c);
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

}  // namespace rotordrop
