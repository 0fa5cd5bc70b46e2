#include "bearing/statics/ring_statics.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace rotordrop {

// The plane of a ball: centre of the inner groove from that of the outer one, and how it moves with the unknowns. As BallRow has it.
struct RingStatics::Plane {
  Eigen::Vector2d B;  // (B_x, B_r) [m]
  BallMotion by_place;
};

namespace {

BallContacts contacts_of(const BallRowGeometry& g, const RingSurroundings& around) {
  const RowStrains strains = row_strains(g);
  return {g.inner.stiffness,
          g.outer.stiffness,
          (g.inner_conformity - 0.5) * g.ball_diameter + around.inner_strain * strains.inner.groove,
          (g.outer_conformity - 0.5) * g.ball_diameter + around.outer_strain * strains.outer.groove,
          g.ball_mass,
          g.ball_diameter / g.pitch_diameter,
          g.pitch_diameter,
          g.inner_gyroscopic_share};
}

/// Centre of the inner groove from that of the outer one in the mounted place, of every ball [m].
Eigen::Vector2d rest_of(const BallRowGeometry& g, const RingSurroundings& around) {
  const GroovesOf<double> grooves = grown(groove_centres(g), row_strains(g), g.difference_share, around);
  return {grooves.axial, grooves.radial};
}

}  // namespace

double mounted_axial_force(const BallRowGeometry& g) {
  const RingSurroundings cold;
  const Eigen::Vector2d B = rest_of(g, cold);
  const BallBalance ball = ball_balance(contacts_of(g, cold), B[0], B[1], 0., 0., 1.);
  return g.n_balls * std::fabs(ball.load_i * ball.sin_i);
}

RingStatics::RingStatics(std::vector<BallRowGeometry> rows, const RingSurroundings& surroundings,
                         std::optional<PreloadSpring> spring)
    : rows_(std::move(rows)), surroundings_(surroundings), spring_(spring) {
  for (const auto& g : rows_) {
    contacts_.push_back(contacts_of(g, surroundings_));
    places_.push_back(row_of(g, spring_ && &g == &rows_.back()));
  }
}

RingStatics::Row RingStatics::row_of(const BallRowGeometry& g, bool is_pressed_by_spring) const {
  Row row;
  row.rest = rest_of(g, surroundings_);
  row.arm = groove_centres(g).arm;
  row.position = row_strains(g).inner.axial;
  row.travel = is_pressed_by_spring ? g.direction : 0.;
  for (int ball = 0; ball < g.n_balls; ++ball) {
    const double azimuth = g.phase + 2. * std::numbers::pi * ball / g.n_balls + surroundings_.cage_angle;
    row.azimuth.push_back(azimuth);
    row.cosine.push_back(std::cos(azimuth));
    row.sine.push_back(std::sin(azimuth));
  }
  return row;
}

RingStatics::BallMotion RingStatics::motion(std::size_t row, int ball) const {
  const Row& r = places_[row];
  const double c = r.cosine[static_cast<std::size_t>(ball)], s = r.sine[static_cast<std::size_t>(ball)];
  BallMotion by_place;
  by_place << 1., 0., 0., r.arm * s, -r.arm * c, r.travel,  //
      0., c, s, -r.position * s, r.position * c, 0.;
  return by_place;
}

RingStatics::Plane RingStatics::plane(std::size_t row, int ball, const RingVector& q) const {
  const BallMotion by_place = motion(row, ball);
  return {places_[row].rest + by_place * q, by_place};
}

BallBalance RingStatics::balance(std::size_t row, const Plane& plane, double share) const {
  const double speed = surroundings_.has_inertia ? surroundings_.speed : 0.;
  return ball_balance(contacts_[row], plane.B[0], plane.B[1], surroundings_.ball_growth, speed, share);
}

BallReaction RingStatics::ball_reaction(std::size_t row, int ball, const RingVector& q, double widening,
                                        double share) const {
  Plane p = plane(row, ball, q);
  p.B[1] += widening;
  BallReaction r{balance(row, p, share), {}, {}, p.by_place};
  r.pull = {r.balance.pull_x(), r.balance.pull_r()};
  r.stiffness << r.balance.stiffness[0], r.balance.stiffness[1], r.balance.stiffness[2], r.balance.stiffness[3];
  return r;
}

RingReaction RingStatics::spring_reaction(const RingVector& q) const {
  RingReaction r;
  if (!spring_) return r;
  const double w = q[5];
  r.force[5] = spring_->force - spring_->stiffness * w;
  r.stiffness(5, 5) = spring_->stiffness;
  r.energy = 0.5 * spring_->stiffness * w * w - spring_->force * w;
  return r;
}

RingReaction RingStatics::reaction(const RingVector& q, double share) const {
  RingReaction sum = spring_reaction(q);
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int ball = 0; ball < rows_[row].n_balls; ++ball) {
      const BallReaction r = ball_reaction(row, ball, q, 0., share);
      sum.force -= r.by_place.transpose() * r.pull;
      sum.stiffness += r.by_place.transpose() * r.stiffness * r.by_place;
      sum.energy += r.balance.energy;
    }
  return sum;
}

std::vector<std::vector<BallInPlace>> RingStatics::balls(const RingVector& q) const {
  std::vector<std::vector<BallInPlace>> all(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int ball = 0; ball < rows_[row].n_balls; ++ball) {
      const Plane p = plane(row, ball, q);
      all[row].push_back({azimuth(row, ball), balance(row, p, 1.)});
    }
  return all;
}

Eigen::Matrix<double, 5, 5> RingStatics::stiffness(const std::vector<std::vector<BallInPlace>>& balls) const {
  RingMatrix K = spring_reaction(RingVector::Zero()).stiffness;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int ball = 0; ball < rows_[row].n_balls; ++ball) {
      const auto& k = balls[row][static_cast<std::size_t>(ball)].balance.stiffness;
      const auto by_place = motion(row, ball);
      K += by_place.transpose() * Eigen::Matrix2d{{k[0], k[1]}, {k[2], k[3]}} * by_place;
    }
  Eigen::Matrix<double, 5, 5> ring = K.topLeftCorner<5, 5>();
  // An outer ring that is pressed by a force alone and touches no ball follows nothing.
  if (spring_ && K(5, 5) > 0.) ring -= K.topRightCorner<5, 1>() * K.bottomLeftCorner<1, 5>() / K(5, 5);
  return ring;
}

RingVector RingStatics::scales() const {
  const double length = 1e-6, arm = 0.5 * rows_.front().pitch_diameter;
  RingVector s;
  s << length, length, length, length / arm, length / arm, length;
  return s;
}

}  // namespace rotordrop
