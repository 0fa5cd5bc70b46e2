#include "bearing/statics/bent_ring_statics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rotordrop {

double BentRings::dynamic_mass(const RingHarmonic& h) const {
  const double omega = 2. * std::numbers::pi * frequency_limit;
  return std::max(h.mass, h.stiffness / (omega * omega));
}

Eigen::VectorXd shape_values(Eigen::Index n_shapes, double theta) {
  Eigen::VectorXd v(n_shapes);
  for (Eigen::Index k = 0; k < n_shapes; k += 2) {
    const double argument = (2. + 0.5 * static_cast<double>(k)) * theta;
    v[k] = std::cos(argument);
    v[k + 1] = std::sin(argument);
  }
  return v;
}

Eigen::VectorXd shape_slopes(Eigen::Index n_shapes, double theta) {
  Eigen::VectorXd v(n_shapes);
  for (Eigen::Index k = 0; k < n_shapes; k += 2) {
    const double n = 2. + 0.5 * static_cast<double>(k);
    v[k] = -n * std::sin(n * theta);
    v[k + 1] = n * std::cos(n * theta);
  }
  return v;
}

BentRingStatics::BentRingStatics(RingStatics ring, std::optional<BentRings> bending)
    : ring_(std::move(ring)), bending_(std::move(bending)) {}

Eigen::VectorXd BentRingStatics::scales() const {
  Eigen::VectorXd s = Eigen::VectorXd::Constant(size(), 1e-6);
  s.head(n_place()) = ring_.scales().head(n_place());
  return s;
}

RingVector BentRingStatics::place(const Eigen::VectorXd& x) const {
  RingVector q = RingVector::Zero();
  q.head(n_place()) = x.head(n_place());
  return q;
}

// What a unit of each coefficient adds to B_r at an azimuth: the inner ring's shapes widen it, the outer ring's narrow it.
Eigen::VectorXd BentRingStatics::shapes_at(double azimuth) const {
  Eigen::VectorXd v(n_shapes());
  v.head(n_inner()) = shape_values(n_inner(), azimuth);
  v.tail(n_shapes() - n_inner()) = -shape_values(n_shapes() - n_inner(), azimuth);
  return v;
}

BentReaction BentRingStatics::reaction(const Eigen::VectorXd& x, double share) const {
  const Eigen::Index n = size(), p = n_place(), m = n_shapes();
  BentReaction sum{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), 0.};
  const RingVector q = place(x);
  if (m == 0) {
    const RingReaction r = ring_.reaction(q, share);
    return {r.force.head(p), r.stiffness.topLeftCorner(p, p), r.energy};
  }
  Eigen::MatrixXd by(2, n);
  for (std::size_t row = 0; row < ring_.rows().size(); ++row)
    for (int ball = 0; ball < ring_.rows()[row].n_balls; ++ball) {
      const Eigen::VectorXd shapes = shapes_at(ring_.azimuth(row, ball));
      const auto r = ring_.ball_reaction(row, ball, q, shapes.dot(x.tail(m)), share);
      if (r.balance.energy == 0. && r.pull.isZero() && r.stiffness.isZero()) continue;
      by.leftCols(p) = r.by_place.leftCols(p);
      by.row(0).tail(m).setZero();
      by.row(1).tail(m) = shapes;
      sum.force -= by.transpose() * r.pull;
      sum.stiffness += by.transpose() * r.stiffness * by;
      sum.energy += r.balance.energy;
    }
  const RingReaction spring = ring_.spring_reaction(q);
  sum.force.head(p) += spring.force.head(p);
  sum.stiffness.topLeftCorner(p, p) += spring.stiffness.topLeftCorner(p, p);
  sum.energy += spring.energy;
  Eigen::Index at = p;
  for (const auto* ring : {&bending_->inner, &bending_->outer})
    for (const auto& h : *ring)
      for (int part = 0; part < 2; ++part, ++at) {
        sum.force[at] -= h.stiffness * x[at];
        sum.stiffness(at, at) += h.stiffness;
        sum.energy += 0.5 * h.stiffness * x[at] * x[at];
      }
  return sum;
}

std::vector<std::vector<BallInPlace>> BentRingStatics::balls(const Eigen::VectorXd& x) const {
  const RingVector q = place(x);
  if (n_shapes() == 0) return ring_.balls(q);
  std::vector<std::vector<BallInPlace>> all(ring_.rows().size());
  for (std::size_t row = 0; row < all.size(); ++row)
    for (int ball = 0; ball < ring_.rows()[row].n_balls; ++ball) {
      const double azimuth = ring_.azimuth(row, ball);
      const double bend = shapes_at(azimuth).dot(x.tail(n_shapes()));
      all[row].push_back({azimuth, ring_.ball_reaction(row, ball, q, bend, 1.).balance});
    }
  return all;
}

Eigen::Matrix<double, 5, 5> BentRingStatics::stiffness(const Eigen::VectorXd& x) const {
  if (n_shapes() == 0) return ring_.stiffness(place(x));
  const Eigen::MatrixXd K = reaction(x).stiffness;
  // A spring without stiffness that touches no ball follows nothing.
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 5; i < size(); ++i)
    if (K(i, i) > 0.) kept.push_back(i);
  const auto own = Eigen::seqN(0, 5);
  const Eigen::MatrixXd follow = K(kept, kept), couple = K(kept, own);
  Eigen::Matrix<double, 5, 5> ring = K.topLeftCorner<5, 5>();
  ring -= Eigen::MatrixXd(K(own, kept)) * follow.partialPivLu().solve(couple);
  return ring;
}

namespace {

BoreReaction over_arc(const ArcContact& law, double gap, const Eigen::Vector2d& e, const Eigen::VectorXd& shapes) {
  const Eigen::Index m = shapes.size();
  BoreReaction r{0., 0., Eigen::VectorXd::Zero(2 + m), Eigen::MatrixXd::Zero(2 + m, 2 + m)};
  const double step = 2. * std::numbers::pi / n_arc_points;
  double bound = 0.;  // of |u_r|
  for (Eigen::Index k = 0; k < m; k += 2) bound += std::hypot(shapes[k], shapes[k + 1]);
  Eigen::VectorXd by(2 + m);
  for (std::size_t k = 0; k < n_arc_points; ++k) {
    const double theta = step * static_cast<double>(k), c = std::cos(theta), s = std::sin(theta);
    const double rigid = e[0] * c + e[1] * s - gap;
    if (rigid + bound <= 0.) continue;
    const Eigen::VectorXd values = shape_values(m, theta);
    const double delta = rigid - values.dot(shapes);
    if (!(delta > 0.)) continue;
    by << c, s, -values;
    const double f = step * law.force(delta);
    r.energy += step * law.energy(delta);
    r.force += f;
    r.gradient += f * by;
    r.hessian += step * law.stiffness(delta) * by * by.transpose();
  }
  return r;
}

BoreReaction at_point(const HuntCrossley& law, double gap, const Eigen::Vector2d& e, const Eigen::VectorXd& shapes) {
  const Eigen::Index m = shapes.size();
  BoreReaction r{0., 0., Eigen::VectorXd::Zero(2 + m), Eigen::MatrixXd::Zero(2 + m, 2 + m)};
  const double distance = e.norm();
  if (!(distance > 0.)) return r;
  const double theta = std::atan2(e[1], e[0]);
  const Eigen::VectorXd values = shape_values(m, theta), slopes = shape_slopes(m, theta);
  const double delta = distance - gap - values.dot(shapes);
  if (!(delta > 0.)) return r;
  const Eigen::Vector2d n = e / distance, t(-n[1], n[0]);
  const double slope = slopes.dot(shapes);
  double curvature = 0.;  // second derivative of u_r
  for (Eigen::Index k = 0; k < m; ++k) {
    const Eigen::Index harmonic = 2 + k / 2;
    const auto order = static_cast<double>(harmonic);
    curvature -= order * order * values[k] * shapes[k];
  }
  Eigen::VectorXd by(2 + m);
  by << n - slope / distance * t, -values;
  // Second derivatives of delta = |e| - gap - u_r(theta(e)).
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(2 + m, 2 + m);
  second.topLeftCorner<2, 2>() =
      t * t.transpose() / distance -
      (curvature * t * t.transpose() - slope * (n * t.transpose() + t * n.transpose())) / (distance * distance);
  second.topRightCorner(2, m) = -t * slopes.transpose() / distance;
  second.bottomLeftCorner(m, 2) = second.topRightCorner(2, m).transpose();
  r.force = law.elastic(delta);
  r.energy = law.energy(delta);
  r.gradient = r.force * by;
  r.hessian = law.n * r.force / delta * by * by.transpose() + r.force * second;
  return r;
}

}  // namespace

BoreReaction bore_reaction(const HuntCrossley& law, const std::optional<BentRings>& bending, double gap,
                           const Eigen::Vector2d& e, const Eigen::VectorXd& shapes) {
  if (bending && bending->model == RingBendingModel::arc) return over_arc(bending->arc, gap, e, shapes);
  return at_point(law, gap, e, shapes);
}

}  // namespace rotordrop
