#pragma once
// An inner ring in its rows of balls, both rings bending: forces and stiffness for static equilibria.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bearing/bent_rings.h"
#include "bearing/statics/ring_statics.h"
#include "laws/contact.h"

namespace rotordrop {

/// Forces conjugate to the unknowns and their stiffness; sizes of BentRingStatics.
struct BentReaction {
  Eigen::VectorXd force;      ///< on the ring and its shapes [N, N m]
  Eigen::MatrixXd stiffness;  ///< -d force / d unknowns
  double energy = 0;          ///< of contacts, spring and bending [J]
};

/// Unknowns: those of RingStatics (five, six with a spring), then the coefficients of the inner and of the outer ring's shapes. Without bending it is
/// RingStatics with a vector of its own length. Convex like that: the distance of groove centres is convex in all unknowns.
class BentRingStatics {
 public:
  BentRingStatics(RingStatics ring, std::optional<BentRings> bending = {});

  [[nodiscard]] const RingStatics& ring() const { return ring_; }
  [[nodiscard]] const std::optional<BentRings>& bending() const { return bending_; }
  [[nodiscard]] Eigen::Index n_place() const { return ring_.has_spring() ? 6 : 5; }
  [[nodiscard]] Eigen::Index n_inner() const { return bending_ ? static_cast<Eigen::Index>(bending_->n_inner()) : 0; }
  [[nodiscard]] Eigen::Index n_shapes() const { return bending_ ? static_cast<Eigen::Index>(bending_->n_shapes()) : 0; }
  [[nodiscard]] Eigen::Index size() const { return n_place() + n_shapes(); }
  /// Lengths and angles by which the unknowns typically move [size].
  [[nodiscard]] Eigen::VectorXd scales() const;
  /// Place of the ring alone.
  [[nodiscard]] RingVector place(const Eigen::VectorXd& unknowns) const;

  /// @param inertia_share  part of the balls' inertia that acts, 0 to 1
  [[nodiscard]] BentReaction reaction(const Eigen::VectorXd& unknowns, double inertia_share = 1.) const;
  /// Balls row by row.
  [[nodiscard]] std::vector<std::vector<BallInPlace>> balls(const Eigen::VectorXd& unknowns) const;
  /// Stiffness of the five degrees of freedom; spring and shapes follow.
  [[nodiscard]] Eigen::Matrix<double, 5, 5> stiffness(const Eigen::VectorXd& unknowns) const;

 private:
  [[nodiscard]] Eigen::VectorXd shapes_at(double azimuth) const;

  RingStatics ring_;
  std::optional<BentRings> bending_;
};

/// Values cos(n theta), sin(n theta) of a ring's shapes, n = 2 ... [n_shapes], and their derivatives by theta.
Eigen::VectorXd shape_values(Eigen::Index n_shapes, double theta);
Eigen::VectorXd shape_slopes(Eigen::Index n_shapes, double theta);

/// Journal in a bore that may be bent, without friction: energy over the unknowns (e_y, e_z, shapes of the inner ring), e the rotor's centre from
/// the ring's.
struct BoreReaction {
  double energy = 0;         ///< [J]
  double force = 0;          ///< sum of the normal forces [N]
  Eigen::VectorXd gradient;  ///< [2 + n_inner] [N]
  Eigen::MatrixXd hessian;   ///< [N/m]
};
/// @param bending  none: a circular bore
/// @param shapes   of the inner ring [n_inner]
BoreReaction bore_reaction(const HuntCrossley& law, const std::optional<BentRings>& bending, double gap,
                           const Eigen::Vector2d& e, const Eigen::VectorXd& shapes);

}  // namespace rotordrop
