#pragma once
// Laws of supports of outer rings: springs, corrugated ribbon, elastomer, squeeze film, round stop.
#include <array>
#include <memory>
#include <vector>

#include "laws/contact.h"
#include "laws/support/stop_operator.h"
#include "laws/support/support_law.h"

namespace rotordrop {

/// Springs and dampers along y and z.
class SpringSupport final : public SupportLaw {
 public:
  SpringSupport(std::array<double, 2> stiffness, std::array<double, 2> damping) : K_(stiffness), C_(damping) {}
  void settle(double, double, std::span<double>) const override {}
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double>, std::span<double>) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double>) const override;
  [[nodiscard]] SupportRest rest(double y, double z) const override;

 private:
  std::array<double, 2> K_, C_;  // [N/m], [N s/m]
};

/// Along a direction a spring, a damper and sliders (Iwan) in parallel.
struct RibbonAxis {
  double stiffness = 0;  ///< that remains when all sliders slip [N/m]
  double damping = 0;    ///< [N s/m]
  std::vector<StopOperator> elements;
};

/// Corrugated ribbon around the ring, the same in every direction: force = k_0 x + c v + sum k_j z_j, vectors across the axis. A slider has its reach in
/// every direction, and yields along its own deflection: e = z / |z|, z' = v - a max(v . e, 0) e (StopOperator along e); so a ring that whirls meets the slip force, not more.
class RibbonSupport final : public SupportLaw {
 public:
  using Axis = RibbonAxis;
  explicit RibbonSupport(Axis axis) : axis_(std::move(axis)) {}
  [[nodiscard]] std::vector<State> states() const override;
  void settle(double y, double z, std::span<double> inner) const override;
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double> inner, std::span<double> rates) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double> inner) const override;
  [[nodiscard]] SupportRest rest(double y, double z) const override;

 private:
  Axis axis_;
};

/// Springs and dampers in parallel and series.
struct MaxwellModel {
  double stiffness = 0;  ///< k_0, at rest [N/m]
  double damping = 0;    ///< c [N s/m]
  struct Element {
    double stiffness = 0, time = 0;  ///< k_j [N/m], tau_j [s]
  };
  std::vector<Element> elements;
  /// Storage and loss stiffness at an angular frequency [rad/s].
  [[nodiscard]] std::array<double, 2> dynamic_stiffness(double frequency) const;
};

/// Elastomer, along each axis: force = k_0 x + c v + sum k_j q_j, q_j' = v - q_j / tau_j. After a slow push the elements have relaxed.
class ElastomerSupport final : public SupportLaw {
 public:
  explicit ElastomerSupport(std::array<MaxwellModel, 2> axes) : axes_(std::move(axes)) {}
  [[nodiscard]] std::vector<State> states() const override;
  void settle(double y, double z, std::span<double> inner) const override;
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double> inner, std::span<double> rates) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double> inner) const override;
  [[nodiscard]] SupportRest rest(double y, double z) const override;

 private:
  std::array<MaxwellModel, 2> axes_;
};

/// Oil film around the outer ring, which does not turn: short bearing (Ocvirk), open ends, with the oil's own pressure at least zero if it cavitates.
///
/// h = c - e . n; the pressure's integral along the axis per length of circumference is -mu L^3 h' / h^3. Over a film that does not cavitate:
///   C_radial = mu R L^3 pi (1 + 2 s^2) / (c^3 (1 - s^2)^(5/2)),   C_tangential = mu R L^3 pi / (c^3 (1 - s^2)^(3/2)),   s = e / c.
/// Quadrature around the circumference by Gauss over the half where the film closes. Films thinner than 1/50 of the clearance stay at that: there
/// metal carries (StoppedSupport). Source: San Andres, Modern Lubrication Theory, notes 13. Valid: L < R, no inertia of the oil.
struct SqueezeFilm {
  double viscosity = 0;                          ///< mu [Pa s]
  double radius = 0, length = 0, clearance = 0;  ///< R, L, c [m]
  bool cavitates = true;
  static constexpr double thinnest = 0.02;  ///< of the clearance
  /// Force on the ring [N]: against its velocity in the mean; force . velocity <= 0.
  [[nodiscard]] std::array<double, 2> force(const SupportMotion& m) const;
};

/// A squeeze film beside another law, which centres it.
class SqueezeFilmSupport final : public SupportLaw {
 public:
  SqueezeFilmSupport(std::shared_ptr<const SupportLaw> carried, const SqueezeFilm& film)
      : carried_(std::move(carried)), film_(film) {}
  [[nodiscard]] std::vector<State> states() const override { return carried_->states(); }
  void settle(double y, double z, std::span<double> inner) const override { carried_->settle(y, z, inner); }
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double> inner, std::span<double> rates) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double> inner) const override {
    return carried_->energy(m, inner);
  }
  [[nodiscard]] SupportRest rest(double y, double z) const override { return carried_->rest(y, z); }

 private:
  std::shared_ptr<const SupportLaw> carried_;
  SqueezeFilm film_;
};

/// A round stop behind a gap beside another law: N = K delta (1 + 1.5 lambda delta'), delta = |travel| - gap, without friction.
class StoppedSupport final : public SupportLaw {
 public:
  StoppedSupport(std::shared_ptr<const SupportLaw> carried, double gap, const HuntCrossley& contact)
      : carried_(std::move(carried)), gap_(gap), contact_(contact) {}
  [[nodiscard]] std::vector<State> states() const override { return carried_->states(); }
  void settle(double y, double z, std::span<double> inner) const override { carried_->settle(y, z, inner); }
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double> inner, std::span<double> rates) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double> inner) const override;
  [[nodiscard]] SupportRest rest(double y, double z) const override;

 private:
  std::shared_ptr<const SupportLaw> carried_;
  double gap_;
  HuntCrossley contact_;
};

/// One law along y, another along z: each sees the motion along its own axis only. Not for what is round (film, stop): that stands around it.
class SplitSupport final : public SupportLaw {
 public:
  SplitSupport(std::shared_ptr<const SupportLaw> along_y, std::shared_ptr<const SupportLaw> along_z)
      : y_(std::move(along_y)), z_(std::move(along_z)), n_y_(y_->n_states()) {}
  [[nodiscard]] std::vector<State> states() const override;
  void settle(double y, double z, std::span<double> inner) const override;
  SupportAnswer evaluate(const SupportMotion& m, std::span<const double> inner, std::span<double> rates) const override;
  [[nodiscard]] double energy(const SupportMotion& m, std::span<const double> inner) const override;
  [[nodiscard]] SupportRest rest(double y, double z) const override;

 private:
  std::shared_ptr<const SupportLaw> y_, z_;
  std::size_t n_y_;
};

}  // namespace rotordrop
