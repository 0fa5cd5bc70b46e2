// Rotor in a bent bore, in contact over an arc: the energy is the sum of ArcContact's over points around the bore, delta_i = e . n_i - gap - u_r(theta_i), each
// with Hunt and Crossley's damping; friction acts along each point's tangent with one slip speed, the mean of the points' by their normal forces. Energy is
// conserved for any number of points.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/aligned_numbers.h"
#include "base/wide_vectors.h"
#include "bearing/arc_kernels.h"
#include "bearing/forces_on_shapes.h"
#include "bearing/touchdown_contact.h"

namespace rotordrop {

namespace {

/// A quantity at the points twice around, so that every arc is one run of them.
struct Row {
  static constexpr std::size_t n = 2 * n_arc_points;
  static constexpr std::size_t stride =
      n + vector_length;  // odd in lines of the cache: one place of all shapes would share a few lines else
  alignas(64) std::array<double, stride> at;
  [[nodiscard]] double operator[](std::size_t i) const { return at[i]; }
};

}  // namespace

struct TouchdownBearing::ArcTable {
  Row cosine, sine;
  std::vector<Row> shapes;                // as the coefficients
  std::size_t row = 0;                    // number of shapes, filled up to whole vectors
  AlignedNumbers by_point;                // shapes of each point [n][row], 0 beyond their number
  std::vector<std::array<Row, 2>> waves;  // cos, sin of a bore wave's order times the azimuth
};

namespace {

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
  const double begin = std::floor((middle - half) / step / vector_length) * vector_length;  // where vectors begin
  auto n = static_cast<std::size_t>(std::ceil((middle + half) / step - begin)) + 1;
  n = std::min(filled_up(n), n_arc_points);
  const double around = begin < 0. ? begin + static_cast<double>(n_arc_points) : begin;
  return {static_cast<std::size_t>(around) % n_arc_points, n};
}

/// The most that a bent bore leaves its circle.
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
    for (std::size_t i = 0; i < Row::n; ++i) {
      const double theta = 2. * std::numbers::pi * static_cast<double>(i % n_arc_points) / n_arc_points;
      cosine.at[i] = std::cos(order * theta);
      sine.at[i] = std::sin(order * theta);
    }
  };
  fill(1, table->cosine, table->sine);
  table->shapes.resize(data_.bending->n_inner());
  for (std::size_t k = 0; k < data_.bending->inner.size(); ++k)
    fill(data_.bending->inner[k].n, table->shapes[2 * k], table->shapes[2 * k + 1]);
  table->row = filled_up(table->shapes.size());
  table->by_point.assign(Row::n * table->row, 0.);
  for (std::size_t i = 0; i < Row::n; ++i)
    for (std::size_t k = 0; k < table->shapes.size(); ++k) table->by_point[i * table->row + k] = table->shapes[k][i];
  table->waves.resize(data_.bore_waves.size());
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k)
    fill(data_.bore_waves[k].order, table->waves[k][0], table->waves[k][1]);
  return table;
}

// Where rotor and bore may overlap, and what bends and moves there.
struct TouchdownBearing::Arc {
  Window window;
  ArcPlace place;
  std::array<double, n_arc_points> waves;
  Arc() {}  // leaves the waves unwritten
};

void TouchdownBearing::find_arc(std::span<const double> y, const Bodies& at, double distance, double gap, double bound,
                                Arc& arc) const {
  const ArcTable& table = *arc_table_;
  const Window w = window(at.y, at.z, distance, gap, bound);
  arc.window = w;
  if (!data_.bore_waves.empty()) {
    std::fill_n(arc.waves.begin(), w.n, 0.);
    for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
      const TurnedWave wave = data_.bore_waves[k].turned(y[ring_angle]);
      const auto& [cosine, sine] = table.waves[k];
      for (std::size_t i = 0; i < w.n; ++i) arc.waves[i] += wave.height(sine[w.first + i], cosine[w.first + i]);
    }
  }
  const auto shape = inner_shape(y), rate = inner_shape_rate(y);
  arc.place = {at.y,
               at.z,
               at.vy,
               at.vz,
               gap,
               table.cosine.at.data() + w.first,
               table.sine.at.data() + w.first,
               table.shapes.front().at.data() + w.first,
               Row::stride,
               shape.size(),
               w.n,
               shape.data(),
               rate.data(),
               data_.bore_waves.empty() ? nullptr : arc.waves.data()};
}

double TouchdownBearing::farthest_bend(std::span<const double> y) const {
  double bound = bound_of(inner_shape(y));
  for (const auto& w : data_.bore_waves) bound += std::fabs(w.amplitude);
  return bound;
}

TouchdownBearing::Contact TouchdownBearing::contact_over_arc(const SupportInput& in, const Expansion& growth,
                                                             std::span<const double> y, const Bodies& at, double share,
                                                             std::span<double> forces) const {
  Contact c;
  const double distance = std::sqrt(at.y * at.y + at.z * at.z);  // e_r, eq. (9)
  c.distance = distance;
  c.n_y = distance > 0. ? at.y / distance : -1.;
  c.n_z = distance > 0. ? at.z / distance : 0.;
  c.rate = at.vy * c.n_y + at.vz * c.n_z;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.centres_turning = distance > 0. ? c.tangential_speed / distance : 0.;
  const double surfaces = in.rotor_spin.speed * data_.rotor_radius - y[ring_spin] * data_.bore_radius;
  c.slip_speed = surfaces + c.tangential_speed;
  // eq. (8), corrected: a warm ring opens the gap
  const double gap = data_.air_gap + growth.bore - growth.shaft;
  const double bound = farthest_bend(y);
  c.penetration = distance + bound - gap;  // a bound for rotors that are clear of the bore
  if (c.penetration <= 0.) {
    const BendAtPoint bend = bend_at_point(y, c.n_y, c.n_z);
    c.penetration = distance - gap - bend.u;
    return c;
  }
  if (!std::isfinite(c.penetration)) {  // found by the solver as a force that is not a number
    c.normal = c.elastic = c.penetration;
    return c;
  }
  Arc arc;
  find_arc(y, at, distance, gap, bound, arc);
  ArcValues overlap, rate, normal, elastic;
  const ArcOverlap where = arc_overlaps(arc.place, overlap, rate);
  c.penetration = where.deepest;
  if (c.penetration <= 0.) return c;
  const double step = 2. * std::numbers::pi / n_arc_points;
  const auto& f = data_.bending->arc.factors();
  const ArcForce law{data_.bending->arc.exponent(), step * f[0], step * f[1], step * f[2], step * f[3],
                     1.5 * data_.contact.lambda};
  const ArcSums sums = arc_forces(law, arc.place, overlap, rate, where, normal, elastic);
  c.elastic = sums.elastic;
  c.normal = sums.normal;
  c.damping = sums.damping;
  if (c.normal == 0.) return c;
  const ArcTable& table = *arc_table_;
  const std::size_t at_first = arc.window.first + where.first;
  std::array<double, filled_up(max_shapes)> on_shapes;
  forces_on_shapes(normal.at.data() + where.first, table.by_point.data() + at_first * table.row,
                   where.last - where.first, table.row, on_shapes.data());
  for (std::size_t k = 0; k < forces.size(); ++k) forces[k] += share * on_shapes[k];
  for (std::size_t k = 0; k < data_.bore_waves.size(); ++k) {
    const TurnedWave wave = data_.bore_waves[k].turned(y[ring_angle]);
    const auto& [cosine, sine] = table.waves[k];
    double sum = 0.;
    for (std::size_t i = where.first; i < where.last; ++i)
      sum += elastic.at[i] * wave.slope(sine[arc.window.first + i], cosine[arc.window.first + i]);
    c.wave_power -= sum * data_.bore_waves[k].order * y[ring_spin];
  }
  // The mean normal by force: shorter than one, as forces that spread over an arc hold each other in part.
  c.n_y = sums.y / sums.normal;
  c.n_z = sums.z / sums.normal;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.slip_speed = surfaces + c.tangential_speed;
  slide<true>(numbers_, in, at, c);
  return c;
}

double TouchdownBearing::arc_energy(const Expansion& growth, std::span<const double> y, const Bodies& at) const {
  const double gap = data_.air_gap + growth.bore - growth.shaft, distance = std::sqrt(at.y * at.y + at.z * at.z);
  const double bound = farthest_bend(y);
  if (distance + bound - gap <= 0.) return 0.;
  Arc arc;
  find_arc(y, at, distance, gap, bound, arc);
  ArcValues overlap, rate;
  arc_overlaps(arc.place, overlap, rate);
  return arc_energies(data_.bending->arc.exponent() + 1., data_.bending->arc.energy_factors(), overlap, arc.place.n) *
         2. * std::numbers::pi / n_arc_points;
}

}  // namespace rotordrop
