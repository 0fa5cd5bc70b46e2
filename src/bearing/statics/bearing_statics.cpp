#include "bearing/statics/bearing_statics.h"

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
  row.ball_stiffness = g.stiffness;
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
  row.static_safety = static_safety(row.largest_pressure);
  return row;
}

/// Both contacts in line, for balls without inertia.
void add_centrifugal(RowReport& row, const BallRowGeometry& g, const RingSurroundings& around) {
  const double orbit = cage_speed_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle) * around.speed;
  const double force = centrifugal_force(g.ball_mass, g.pitch_diameter, orbit);
  if (force == 0. || row.largest_load == 0.) return;
  row.centrifugal_over_load = force / row.largest_load;
  row.neglects_centrifugal = !around.has_inertia && row.centrifugal_over_load > relevant_centrifugal_share;
}

/// Axial force of the most pressed row in the mounted place, or of the spring [N].
double mounted_preload(const RingStatics& ring) {
  double largest = ring.spring() ? ring.spring()->force : 0.;
  for (const auto& row : ring.rows()) largest = std::max(largest, mounted_axial_force(row));
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

BearingEquilibrium::BearingEquilibrium(BentRingStatics ring, const Force& load, const BoreJournal& journal)
    : ring_(std::move(ring)), journal_(journal) {
  const auto& bending = ring_.bending();
  const double radial = std::hypot(load.y, load.z);
  has_journal_ = bending && bending->model == RingBendingModel::arc && radial > 0.;
  const Eigen::Index n = ring_.size();
  scales_ = Eigen::VectorXd::Constant(n + (has_journal_ ? 2 : 0), 1e-6);
  scales_.head(n) = ring_.scales();
  load_ = Eigen::VectorXd::Zero(scales_.size());
  load_.head(5) << load.x, load.y, load.z, load.moment_y, load.moment_z;
  if (has_journal_) {
    load_.segment(1, 2).setZero();
    load_.tail(2) << load.y, load.z;
  } else if (bending) {
    load_.segment(ring_.n_place(), ring_.n_inner()) =
        radial * shape_values(ring_.n_inner(), std::atan2(load.z, load.y));
  }
  const double arm = scales_[0] / scales_[3];
  // Loads from outside and the preload, as mounted and cold; a newton where there is neither.
  const double moment = std::hypot(load.moment_y, load.moment_z) / arm;
  force_scale_ = std::max({1., std::hypot(load.x, load.y, load.z), moment, mounted_preload(ring_.ring())});
}

std::vector<double> BearingEquilibrium::start() const {
  std::vector<double> x(size(), 0.);
  if (!has_journal_) return x;
  const Eigen::Vector2d load = load_.tail(2);
  const double approach = std::pow(load.norm() / journal_.contact.K, 1. / journal_.contact.n);
  const Eigen::Vector2d place = (journal_.gap + approach) * load.normalized();
  std::copy_n(place.data(), 2, x.end() - 2);
  return x;
}

Eigen::VectorXd BearingEquilibrium::ring_unknowns(std::span<const double> x) const {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), ring_.size());
}

RingVector BearingEquilibrium::place(std::span<const double> x) const { return ring_.place(ring_unknowns(x)); }

BearingEquilibrium::Sum BearingEquilibrium::sum(std::span<const double> x, double share) const {
  const Eigen::Map<const Eigen::VectorXd> all(x.data(), scales_.size());
  const Eigen::Index n = ring_.size();
  const BentReaction r = ring_.reaction(all.head(n), share);
  if (!has_journal_) return {load_ + r.force, r.stiffness, r.energy - load_.dot(all)};
  Sum s{load_, Eigen::MatrixXd::Zero(all.size(), all.size()), r.energy - load_.dot(all)};
  s.force.head(n) += r.force;
  s.stiffness.topLeftCorner(n, n) = r.stiffness;
  const Eigen::Index shapes = ring_.n_place(), m = ring_.n_inner();
  const BoreReaction bore = bore_reaction(journal_.contact, ring_.bending(), journal_.gap,
                                          all.tail(2) - all.segment(1, 2), all.segment(shapes, m));
  // Rotor's centre less the ring's, then the shapes.
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(2 + m, all.size());
  by.topLeftCorner(2, 3).rightCols(2) = -Eigen::Matrix2d::Identity();
  by.topRightCorner(2, 2).setIdentity();
  by.block(2, shapes, m, m).setIdentity();
  s.force -= by.transpose() * bore.gradient;
  s.stiffness += by.transpose() * bore.hessian * by;
  s.potential += bore.energy;
  return s;
}

const BearingEquilibrium::Sum& BearingEquilibrium::sum_at(std::span<const double> x) const {
  if (!std::equal(x.begin(), x.end(), last_x_.begin(), last_x_.end())) {
    last_ = sum(x, share_);
    last_x_.assign(x.begin(), x.end());
  }
  return last_;
}

void BearingEquilibrium::forces(std::span<const double> x, std::span<double> f) const {
  std::copy_n(sum_at(x).force.data(), size(), f.begin());
}

void BearingEquilibrium::stiffness(std::span<const double> x, std::span<double> K) const {
  std::copy_n(sum_at(x).stiffness.data(), size() * size(), K.begin());
}

double BearingEquilibrium::potential(std::span<const double> x) const { return sum(x, 0.).potential; }

namespace {

BendingReport report_bending(const BentRingStatics& ring, const Eigen::VectorXd& x) {
  const BentRings& b = *ring.bending();
  const Eigen::VectorXd inner = x.segment(ring.n_place(), ring.n_inner());
  const Eigen::VectorXd outer = x.tail(ring.n_shapes() - ring.n_inner());
  BendingReport report{b.inner, b.outer, {inner.begin(), inner.end()}, {outer.begin(), outer.end()}};
  for (int degree = 0; degree < 360; ++degree) {
    const double u = shape_values(ring.n_inner(), degree * std::numbers::pi / 180.).dot(inner);
    report.largest_outwards = std::max(report.largest_outwards, u);
    report.largest_inwards = std::max(report.largest_inwards, -u);
  }
  const auto add = [&](const std::vector<RingHarmonic>& harmonics, const Eigen::VectorXd& shape) {
    for (Eigen::Index k = 0; k < shape.size(); ++k)
      report.energy += 0.5 * harmonics[static_cast<std::size_t>(k / 2)].stiffness * shape[k] * shape[k];
  };
  add(b.inner, inner);
  add(b.outer, outer);
  return report;
}

}  // namespace

RingReport report_ring(const RingStatics& ring, const RingVector& place, double negligible) {
  const BentRingStatics rigid(ring);
  return report_ring(rigid, place.head(rigid.n_place()), negligible);
}

RingReport report_ring(const BentRingStatics& bent, const Eigen::VectorXd& x, double negligible) {
  const RingStatics& ring = bent.ring();
  RingReport report;
  std::copy_n(x.data(), 5, report.place.begin());
  report.spring_travel = ring.has_spring() ? x[5] : 0.;
  const auto balls = bent.balls(x);
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
  if (bent.bending()) report.bending = report_bending(bent, x);
  const auto K = bent.n_shapes() > 0 ? bent.stiffness(x) : ring.stiffness(balls);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) report.stiffness[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = K(i, j);
  report.is_floating = n_loaded == 0;
  report.n_free = report.is_floating ? 5 : count_free(K, 0.5 * ring.rows().front().pitch_diameter);
  return report;
}

}  // namespace rotordrop
