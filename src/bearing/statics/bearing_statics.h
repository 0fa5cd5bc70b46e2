#pragma once
// Equilibrium of one bearing alone: inner ring under a load, outer ring at rest.
#include <array>
#include <string>
#include <vector>

#include "bearing/statics/bent_ring_statics.h"
#include "model/equilibrium_system.h"
#include "model/ports.h"

namespace rotordrop {

/// The rotor in the bore, for loads that it passes on over an arc.
struct BoreJournal {
  HuntCrossley contact;
  double gap = 0;  ///< radial [m]
};

/// The inner ring under a load, for the solver. Unknowns as BentRingStatics has them. A radial load presses on a bent bore at a point in its
/// own direction; with the contact over an arc it acts on a rotor in the bore, whose centre's y and z are then the last unknowns.
class BearingEquilibrium final : public EquilibriumSystem {
 public:
  /// @param load  on the inner ring [N, N m]
  BearingEquilibrium(BentRingStatics ring, const Force& load, const BoreJournal& journal = {});

  [[nodiscard]] std::size_t size() const override { return static_cast<std::size_t>(scales_.size()); }
  [[nodiscard]] std::span<const double> scales() const override { return {scales_.data(), size()}; }
  [[nodiscard]] double force_scale() const override { return force_scale_; }
  void forces(std::span<const double> x, std::span<double> f) const override;
  void stiffness(std::span<const double> x, std::span<double> K) const override;
  [[nodiscard]] double potential(std::span<const double> x) const override;
  [[nodiscard]] bool has_circulatory_forces() const override {
    return ring().surroundings().has_inertia && ring().surroundings().speed != 0.;
  }
  void set_circulatory_share(double share) override {
    share_ = share;
    last_x_.clear();
  }
  /// Where the search begins: a rotor lies in the bore under its load [size()].
  [[nodiscard]] std::vector<double> start() const;

  [[nodiscard]] const RingStatics& ring() const { return ring_.ring(); }
  [[nodiscard]] const BentRingStatics& bent_ring() const { return ring_; }
  [[nodiscard]] RingVector place(std::span<const double> x) const;
  /// Ring and shapes without the rotor [bent_ring().size()].
  [[nodiscard]] Eigen::VectorXd ring_unknowns(std::span<const double> x) const;

 private:
  struct Sum {
    Eigen::VectorXd force;
    Eigen::MatrixXd stiffness;
    double potential = 0;
  };
  [[nodiscard]] Sum sum(std::span<const double> x, double share) const;
  /// At the unknowns and the share of the call before: kept, since a search asks for forces and stiffness of one place by turns.
  [[nodiscard]] const Sum& sum_at(std::span<const double> x) const;

  BentRingStatics ring_;
  BoreJournal journal_;
  Eigen::VectorXd load_, scales_;  // all unknowns
  bool has_journal_ = false;
  double force_scale_ = 1, share_ = 1;
  mutable Sum last_;
  mutable std::vector<double> last_x_;
};

/// Balls without inertia are misleading where centrifugal forces exceed this part of the contact loads.
inline constexpr double relevant_centrifugal_share = 0.1;

/// A contact ellipse.
struct EllipseReport {
  double load = 0, angle = 0;             ///< [N], [rad], signed as the row leans
  double semi_major = 0, semi_minor = 0;  ///< [m]
  double pressure = 0;                    ///< largest, 3 Q / (2 pi a b) [Pa]; void if the ellipse is truncated
  double edge_margin = 0;  ///< from the ellipse's end to the raceway's edge, along it [m]; infinite without an edge
  double truncation = 0;   ///< part of the ellipse's length beyond the edge
};
struct BallReport {
  double azimuth = 0;  ///< [rad]
  EllipseReport inner, outer;
  double centrifugal_force = 0, gyroscopic_moment = 0;  ///< [N], [N m]
  double inner_traction = 0;                            ///< gyroscopic friction of the inner race on the ball [N]
  double residual = 0;                                  ///< left-over force on the ball [N]
};
struct RowReport {
  std::vector<BallReport> balls;
  double axial_force = 0;       ///< of the balls on the ring, along x [N]
  double largest_load = 0;      ///< of a ball on either race [N]
  double ball_stiffness = 0;    ///< K of Q = K delta^1.5, both contacts of a ball in series [N/m^1.5]
  double largest_pressure = 0;  ///< on either race [Pa]
  /// s0 = (4.2 GPa / largest pressure)^3: by so much may the load of the most loaded ball grow; infinite without load
  double static_safety = 0;
  int n_loaded = 0;                  ///< balls that touch the inner race
  double truncation = 0;             ///< largest of the balls'; above 0 pressure and safety are void
  double edge_margin = 0;            ///< least of the loaded contacts' [m]; infinite without any
  double centrifugal_over_load = 0;  ///< centrifugal force of a ball over the largest load of the row; 0 at rest
  bool neglects_centrifugal =
      false;  ///< the balls have no inertia, though that is more than relevant_centrifugal_share
};

/// Shape of bent rings.
struct BendingReport {
  std::vector<RingHarmonic> inner, outer;
  std::vector<double> inner_shape, outer_shape;  ///< a_2, b_2, a_3, b_3, ... [m]
  double largest_outwards = 0,
         largest_inwards = 0;  ///< radial displacement of the inner ring by bending, both positive [m]
  double energy = 0;           ///< of bending [J]
};

/// A ring in its place.
struct RingReport {
  std::array<double, 5> place{};  ///< x, y, z [m], psi_y, psi_z [rad], from the mounted place
  double spring_travel = 0;       ///< of a spring-loaded outer ring [m]
  std::vector<RowReport> rows;
  std::array<std::array<double, 5>, 5> stiffness{};  ///< -d force / d place [N/m, N, N m]
  double preload =
      0;  ///< what opposed rows hold against each other: the smaller of their axial forces; 0 without opposed rows [N]
  double energy = 0;                     ///< of the contacts [J]
  int n_free = 0;                        ///< directions that no ball resists, of the five
  bool is_floating = false;              ///< no ball touches the inner ring
  std::optional<BendingReport> bending;  ///< none: rigid rings
};
/// @param negligible  load of a ball that counts as none [N]: what the search for the equilibrium may leave
RingReport report_ring(const BentRingStatics& ring, const Eigen::VectorXd& unknowns, double negligible = 0.);
RingReport report_ring(const RingStatics& ring, const RingVector& place, double negligible = 0.);

}  // namespace rotordrop
