#pragma once
#include <array>
#include <string>

#include "model/support.h"

namespace rotordrop {

/// Massless spring and damper between rotor and ground: force on the rotor = -K x - C v with x = (y, z) of the journal.
///
/// Books: energy x.K_s x / 2 with the symmetric part K_s of K, dissipation v.C v. A cross-coupled K that is not
/// symmetric (a seal, an oil film) does work that no potential stores; it comes from the rotation that such a K stands
/// for, so -v.K_a x with the antisymmetric part K_a is booked as prescribed work. No state, no heat, no axial force, no
/// moments; growth is ignored. Valid: small motion about a centred journal.
class LinearSupport final : public Support {
 public:
  using Matrix = std::array<std::array<double, 2>, 2>;  ///< rows and columns y, z

  /// @param stiffness  [N/m], any 2 x 2 matrix
  /// @param damping    [N s/m], any 2 x 2 matrix
  LinearSupport(std::string name, const Matrix& stiffness, const Matrix& damping);

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<Observable> observables() const override;
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override;
  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override;

 private:
  std::string name_;
  Matrix stiffness_, damping_;
};

}  // namespace rotordrop
