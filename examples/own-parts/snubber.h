#pragma once
#include <string>

#include "base/parameters/section.h"
#include "laws/contact.h"
#include "model/support.h"

/// bearings.NAME with type = "snubber".
struct SnubberParameters {
  int node = 0;
  double mass = 0, stiffness = 0, damping = 0;  ///< of the bush in its mount [kg, N/m, N s/m]
  double gap = 0, radius = 0;                   ///< radial, cold; rotor's radius there [m]
  double contact_stiffness = 0, exponent = 0, lambda = 0;
  double friction_coefficient = 0, regularisation_speed = 0;
};
rotordrop::Section<SnubberParameters> snubber_section();

/// A plain bush in an elastic mount around the shaft, wider than the touchdown bearings' air gap: it catches a shaft that bends
/// or bounces too far. The bush moves radially and does not turn, so the rotor rubs in it as long as they touch.
///
///   delta = |x_rotor - x_bush| - gap,   F_n = K delta^n (1 + 1.5 lambda delta') >= 0,   F_t = mu(v_s) F_n,
///   v_s = omega r + (v_rotor - v_bush) . t,   m x_bush'' = F_n n + F_t t - k x_bush - c x_bush'
///
/// with n from the bush's centre to the rotor's and t = x cross n. Contact: Hunt & Crossley (1975). The bush's position counts from where
/// it rests under its own weight. Axial forces, tilts and thermal growth are left out; heat of the rub goes to no thermal model.
class Snubber final : public rotordrop::Support {
 public:
  enum State : std::size_t { bush_y, bush_z, bush_velocity_y, bush_velocity_z, n_state };

  Snubber(std::string name, const SnubberParameters& parameters);

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<rotordrop::StateEntry> state_entries() const override;
  [[nodiscard]] std::vector<rotordrop::StateEntry> ledger_entries() const override;
  [[nodiscard]] std::vector<rotordrop::Observable> observables() const override;
  void initial_state(std::span<double> y) const override;
  void evaluate(const rotordrop::SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, rotordrop::SupportOutput& out) const override;
  [[nodiscard]] double energy(const rotordrop::SupportInput& input, std::span<const double> y) const override;

 private:
  /// Where the rotor is in the bush.
  struct Place {
    double n_y = 0, n_z = 0;  // from the bush's centre to the rotor's
    double penetration = 0;   // [m]
  };
  [[nodiscard]] Place place(const rotordrop::Motion& journal, std::span<const double> y) const;

  std::string name_;
  SnubberParameters p_;
  rotordrop::HuntCrossley normal_;
  rotordrop::CoulombFriction friction_;
};
