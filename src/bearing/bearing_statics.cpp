#include "bearing/bearing_statics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bearing/touchdown_parameters.h"
#include "laws/ball_kinematics.h"

namespace rotordrop {
namespace {

EllipseReport ellipse(const RaceContact& race, double load, double sine, double cosine) {
  EllipseReport e;
  e.load = load;
  e.angle = std::atan2(sine, cosine);
  e.semi_major = race.axis_factor * std::cbrt(load);
  e.semi_minor = e.semi_major / race.ellipticity;
  e.pressure = race.largest_pressure(load);
  e.edge_margin = race.edge_distance(sine, cosine) - e.semi_major;
  e.truncation = race.truncation(load, sine, cosine);
  return e;
}

RowReport report_row(const BallRowGeometry& g, const std::vector<BallInPlace>& balls, double negligible) {
  RowReport row;
  row.edge_margin = std::numeric_limits<double>::infinity();
  for (const auto& [azimuth, b] : balls) {
    BallReport ball{azimuth,
                    ellipse(g.inner, b.load_i, b.sin_i, b.cos_i),
                    ellipse(g.outer, b.load_o, b.sin_o, b.cos_o),
                    b.centrifugal_force,
                    b.gyroscopic_moment,
                    b.inner_traction,
                    b.residual};
    row.axial_force -= b.pull_x();
    row.largest_load = std::max({row.largest_load, b.load_i, b.load_o});
    row.largest_pressure = std::max({row.largest_pressure, ball.inner.pressure, ball.outer.pressure});
    row.n_loaded += b.load_i > negligible;
    row.truncation = std::max({row.truncation, ball.inner.truncation, ball.outer.truncation});
    for (const auto* e : {&ball.inner, &ball.outer})
      if (e->load > negligible) row.edge_margin = std::min(row.edge_margin, e->edge_margin);
    row.balls.push_back(ball);
  }
  row.static_safety = std::pow(static_pressure_limit / row.largest_pressure, 3);
  return row;
}

/// Both contacts in line, for balls without inertia.
void add_centrifugal(RowReport& row, const BallRowGeometry& g, const RingSurroundings& around) {
  const double orbit = cage_speed_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle) * around.speed;
  const double force = 0.5 * g.ball_mass * g.pitch_diameter * orbit * orbit;
  if (force == 0. || row.largest_load == 0.) return;
  row.centrifugal_over_load = force / row.largest_load;
  row.neglects_centrifugal = !around.has_inertia && row.centrifugal_over_load > relevant_centrifugal_share;
}

/// Axial force of the most pressed row in the mounted place, or of the spring [N].
double mounted_preload(const RingStatics& ring) {
  double largest = ring.spring() ? ring.spring()->force : 0.;
  const RingStatics cold(ring.rows(), {});
  for (const auto& balls : cold.balls(RingVector::Zero())) {
    double axial = 0.;
    for (const auto& ball : balls) axial += ball.balance.load_i * ball.balance.sin_i;
    largest = std::max(largest, std::fabs(axial));
  }
  return largest;
}

/// Directions without stiffness, tilts counted by what they move at the balls.
int count_free(Eigen::Matrix<double, 5, 5> K, double arm) {
  for (int i = 3; i < 5; ++i) {
    K.row(i) /= arm;
    K.col(i) /= arm;
  }
  const auto values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>>(0.5 * (K + K.transpose())).eigenvalues();
  // Balls in contact resist with some 1e6..1e9 N/m; below this only the bending of nearly free contacts is left.
  const double least = std::max(1e-9 * values.cwiseAbs().maxCoeff(), 1.);
  return static_cast<int>((values.array() < least).count());
}

}  // namespace

BearingEquilibrium::BearingEquilibrium(RingStatics ring, const Force& load)
    : ring_(std::move(ring)), scales_(ring_.scales()) {
  load_ << load.x, load.y, load.z, load.moment_y, load.moment_z, 0.;
  const double arm = scales_[0] / scales_[3];
  // Loads from outside and the preload, as mounted and cold; a newton where there is neither.
  const double moment = std::hypot(load.moment_y, load.moment_z) / arm;
  force_scale_ = std::max({1., std::hypot(load.x, load.y, load.z), moment, mounted_preload(ring_)});
}

RingVector BearingEquilibrium::place(std::span<const double> x) const {
  RingVector q = RingVector::Zero();
  std::copy(x.begin(), x.end(), q.data());
  return q;
}

void BearingEquilibrium::forces(std::span<const double> x, std::span<double> f) const {
  const RingVector sum = load_ + ring_.reaction(place(x), share_).force;
  std::copy_n(sum.data(), size(), f.begin());
}

void BearingEquilibrium::stiffness(std::span<const double> x, std::span<double> K) const {
  const RingMatrix whole = ring_.reaction(place(x), share_).stiffness;
  const auto n = static_cast<Eigen::Index>(size());
  Eigen::Map<Eigen::MatrixXd>(K.data(), n, n) = whole.topLeftCorner(n, n);
}

double BearingEquilibrium::potential(std::span<const double> x) const {
  const RingVector q = place(x);
  return ring_.energy(q) - load_.dot(q);
}

RingReport report_ring(const RingStatics& ring, const RingVector& q, double negligible) {
  RingReport report;
  std::copy_n(q.data(), 5, report.place.begin());
  report.spring_travel = ring.has_spring() ? q[5] : 0.;
  const auto balls = ring.balls(q);
  double positive = 0., negative = 0.;
  bool leans_both_ways[2] = {false, false};
  int n_loaded = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    report.rows.push_back(report_row(ring.rows()[i], balls[i], negligible));
    add_centrifugal(report.rows.back(), ring.rows()[i], ring.surroundings());
    const double axial = report.rows.back().axial_force;
    (axial > 0. ? positive : negative) += std::fabs(axial);
    leans_both_ways[ring.rows()[i].direction > 0.] = true;
    n_loaded += report.rows.back().n_loaded;
    for (const auto& ball : balls[i]) report.energy += ball.balance.energy;
  }
  if (leans_both_ways[0] && leans_both_ways[1]) report.preload = std::min(positive, negative);
  const auto K = ring.stiffness(q);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) report.stiffness[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = K(i, j);
  report.is_floating = n_loaded == 0;
  report.n_free = report.is_floating ? 5 : count_free(K, 0.5 * ring.rows().front().pitch_diameter);
  return report;
}

}  // namespace rotordrop
