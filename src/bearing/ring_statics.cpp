#include "bearing/ring_statics.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace rotordrop {

// The plane of a ball: centre of the inner groove from that of the outer one, and how it moves with the unknowns. As BallRow has it.
struct RingStatics::Plane {
  double azimuth = 0;
  Eigen::Vector2d B;                                   // (B_x, B_r) [m]
  Eigen::Matrix<double, 2, n_ring_unknowns> by_place;  // dB / d unknowns
};

RingStatics::RingStatics(std::vector<BallRowGeometry> rows, const RingSurroundings& surroundings,
                         std::optional<PreloadSpring> spring)
    : rows_(std::move(rows)), surroundings_(surroundings), spring_(spring) {
  for (const auto& g : rows_) {
    const auto [inner, outer] = row_strains(g);
    contacts_.push_back({g.inner.stiffness, g.outer.stiffness,
                         (g.inner_conformity - 0.5) * g.ball_diameter + surroundings_.inner_strain * inner.groove,
                         (g.outer_conformity - 0.5) * g.ball_diameter + surroundings_.outer_strain * outer.groove,
                         g.ball_mass, g.ball_diameter / g.pitch_diameter, g.pitch_diameter, g.inner_gyroscopic_share});
  }
}

RingStatics::Plane RingStatics::plane(std::size_t row, int ball, const RingVector& q) const {
  const auto& g = rows_[row];
  const double A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
  const double arm = 0.5 * g.pitch_diameter + (g.inner_conformity - 0.5) * g.ball_diameter * std::cos(g.contact_angle);
  Plane p;
  p.azimuth = g.phase + 2. * std::numbers::pi * ball / g.n_balls + surroundings_.cage_angle;
  const double c = std::cos(p.azimuth), s = std::sin(p.azimuth), at = g.position;
  const double travel = spring_ && row + 1 == rows_.size() ? g.direction : 0.;
  p.by_place << 1., 0., 0., arm * s, -arm * c, travel,  //
      0., c, s, -at * s, at * c, 0.;
  const auto [inner, outer] = row_strains(g);
  const auto strained = [&](double GrooveStrain::*part) {
    return surroundings_.inner_strain * inner.*part + surroundings_.outer_strain * outer.*part;
  };
  const Eigen::Vector2d rest(
      g.direction * (A * std::sin(g.contact_angle) + g.preload_offset) + strained(&GrooveStrain::axial),
      A * std::cos(g.contact_angle) - g.radial_clearance + surroundings_.radial_growth +
          strained(&GrooveStrain::radial));
  p.B = rest + p.by_place * q;
  return p;
}

BallBalance RingStatics::balance(std::size_t row, const Plane& plane, double share) const {
  const double speed = surroundings_.has_inertia ? surroundings_.speed : 0.;
  return ball_balance(contacts_[row], plane.B[0], plane.B[1], surroundings_.ball_growth, speed, share);
}

RingReaction RingStatics::reaction(const RingVector& q, double share) const {
  RingReaction sum;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int ball = 0; ball < rows_[row].n_balls; ++ball) {
      const Plane p = plane(row, ball, q);
      const BallBalance b = balance(row, p, share);
      const Eigen::Vector2d pull(b.pull_x(), b.pull_r());
      Eigen::Matrix2d K;
      K << b.stiffness[0], b.stiffness[1], b.stiffness[2], b.stiffness[3];
      sum.force -= p.by_place.transpose() * pull;
      sum.stiffness += p.by_place.transpose() * K * p.by_place;
      sum.energy += b.energy;
    }
  if (spring_) {
    const double w = q[5];
    sum.force[5] += spring_->force - spring_->stiffness * w;
    sum.stiffness(5, 5) += spring_->stiffness;
    sum.energy += 0.5 * spring_->stiffness * w * w - spring_->force * w;
  }
  return sum;
}

std::vector<std::vector<BallInPlace>> RingStatics::balls(const RingVector& q) const {
  std::vector<std::vector<BallInPlace>> all(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int ball = 0; ball < rows_[row].n_balls; ++ball) {
      const Plane p = plane(row, ball, q);
      all[row].push_back({p.azimuth, balance(row, p, 1.)});
    }
  return all;
}

Eigen::Matrix<double, 5, 5> RingStatics::stiffness(const RingVector& q) const {
  const RingMatrix K = reaction(q).stiffness;
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
