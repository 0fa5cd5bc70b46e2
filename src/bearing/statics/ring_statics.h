#pragma once
// An inner ring with five degrees of freedom in its rows of balls, at rest or turning steadily.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bearing/row/ball_row.h"
#include "laws/ball_balance.h"

namespace rotordrop {

/// What the balls feel besides the ring's place.
struct RingSurroundings {
  double radial_growth = 0;   ///< eps_in - eps_out of the contact points, thermal growth and fits [m]
  double ball_growth = 0;     ///< of a ball's radius [m]
  double speed = 0;           ///< of the inner ring [rad/s]; matters to the inertia of the balls alone
  bool has_inertia = false;   ///< balls with centrifugal force and gyroscopic moment (laws/ball_balance.h)
  double cage_angle = 0;      ///< turns all balls [rad]
  double inner_strain = 0;    ///< axial strain of the inner ring
  double outer_strain = 0;    ///< of the outer ring
  double row_difference = 0;  ///< of radial_growth, last row less first [m]
};

/// Outer ring of the last row free to slide along the axis, pressed on by a spring with the preload at the mounted place.
struct PreloadSpring {
  double force = 0;      ///< at the mounted place [N]
  double stiffness = 0;  ///< [N/m], >= 0; a yielding outer ring is pressed on less
};

/// Axial force that a row's balls hold in the mounted place, cold and at rest [N].
double mounted_axial_force(const BallRowGeometry& row);

/// One ball of a ring in its place.
struct BallInPlace {
  double azimuth = 0;  ///< [rad]
  BallBalance balance;
};

/// Unknowns: x, y, z, psi_y, psi_z of the ring; and the travel w of the last row's outer ring in the direction that loads it, with a spring.
inline constexpr int n_ring_unknowns = 6;
using RingVector = Eigen::Matrix<double, n_ring_unknowns, 1>;
using RingMatrix = Eigen::Matrix<double, n_ring_unknowns, n_ring_unknowns>;

/// Forces of all rows (and the spring) on the ring, conjugate to the unknowns, and their stiffness.
struct RingReaction {
  RingVector force = RingVector::Zero();      ///< [N, N m]
  RingMatrix stiffness = RingMatrix::Zero();  ///< -d force / d unknowns
  double energy = 0;                          ///< of contacts and spring [J]
};

/// One ball's pull on the inner ring in its plane (x, r).
struct BallReaction {
  BallBalance balance;
  Eigen::Vector2d pull;                                ///< [N]
  Eigen::Matrix2d stiffness;                           ///< d pull / dB [N/m]
  Eigen::Matrix<double, 2, n_ring_unknowns> by_place;  ///< dB / d unknowns
};

/// With balls without inertia the forces are the gradient of a convex energy: the distance of groove centres is a convex function of the
/// ring's place, and the energy of a contact rises ever faster with it.
class RingStatics {
 public:
  RingStatics(std::vector<BallRowGeometry> rows, const RingSurroundings& surroundings,
              std::optional<PreloadSpring> spring = {});

  /// @param inertia_share  part of the balls' inertia that acts, 0 to 1
  [[nodiscard]] RingReaction reaction(const RingVector& place, double inertia_share = 1.) const;
  [[nodiscard]] double energy(const RingVector& place) const { return reaction(place, 0.).energy; }
  /// Of the preload spring alone.
  [[nodiscard]] RingReaction spring_reaction(const RingVector& place) const;
  /// @param widening  adds to B_r at this ball, by bent rings [m]
  [[nodiscard]] BallReaction ball_reaction(std::size_t row, int ball, const RingVector& place, double widening,
                                           double inertia_share) const;
  [[nodiscard]] double azimuth(std::size_t row, int ball) const {
    return places_[row].azimuth[static_cast<std::size_t>(ball)];
  }
  /// Balls row by row.
  [[nodiscard]] std::vector<std::vector<BallInPlace>> balls(const RingVector& place) const;
  /// Stiffness of the five degrees of freedom, the spring's travel following without resistance of its own.
  [[nodiscard]] Eigen::Matrix<double, 5, 5> stiffness(const std::vector<std::vector<BallInPlace>>& balls) const;
  [[nodiscard]] Eigen::Matrix<double, 5, 5> stiffness(const RingVector& place) const { return stiffness(balls(place)); }

  [[nodiscard]] const std::vector<BallRowGeometry>& rows() const { return rows_; }
  [[nodiscard]] const RingSurroundings& surroundings() const { return surroundings_; }
  [[nodiscard]] const std::optional<PreloadSpring>& spring() const { return spring_; }
  [[nodiscard]] bool has_spring() const { return spring_.has_value(); }
  /// Lengths and angles by which the unknowns typically move.
  [[nodiscard]] RingVector scales() const;

 private:
  struct Plane;                                                  // of one ball
  using BallMotion = Eigen::Matrix<double, 2, n_ring_unknowns>;  // dB / d unknowns
  /// What does not depend on the ring's place.
  struct Row {
    Eigen::Vector2d rest;          ///< centre of the inner groove from that of the outer one, in the mounted place [m]
    double arm = 0, position = 0;  ///< of the inner groove's centre: R_c, and along the axis [m]
    double travel = 0;
    std::vector<double> azimuth, cosine, sine;  ///< of the balls
  };
  [[nodiscard]] Row row_of(const BallRowGeometry& g, bool is_pressed_by_spring) const;
  [[nodiscard]] BallMotion motion(std::size_t row, int ball) const;
  [[nodiscard]] Plane plane(std::size_t row, int ball, const RingVector& place) const;
  [[nodiscard]] BallBalance balance(std::size_t row, const Plane& plane, double share) const;

  std::vector<BallRowGeometry> rows_;
  std::vector<BallContacts> contacts_;
  std::vector<Row> places_;
  RingSurroundings surroundings_;
  std::optional<PreloadSpring> spring_;
};

}  // namespace rotordrop
