#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "model/support.h"

namespace rotordrop {

/// bearings.NAME with type = "magnet".
struct MagnetParameters {
  using Matrix = std::array<std::array<double, 2>, 2>;
  int node = 0;                                        ///< numbered from 1
  Matrix stiffness{}, damping{};                       ///< [[yy, yz], [zy, zz]] [N/m], [N s/m]
  std::array<double, 2> release_time{};                ///< along y, z [s]
  double residual_time = 0;                            ///< tau [s]; 0: the force ends at once
  std::optional<std::array<double, 2>> holding_force;  ///< F_0 along y, z [N]; none: a share of the weight
  double axial_stiffness = 0, axial_damping = 0;       ///< [N/m], [N s/m]
  double axial_release_time = 0;                       ///< [s]
  std::optional<double> axial_holding_force;           ///< [N]; none: a share of the axial weight and force
};
Section<MagnetParameters> magnet_section();

/// What a magnet needs besides its parameters: of the rotor at the start.
struct MagnetStart {
  std::array<double, 3> centre{};         ///< x, y, z at which it holds the rotor [m]
  std::array<double, 3> holding_force{};  ///< along x, y, z, with the rotor there and at rest [N]
};

/// Magnetic bearing that holds the rotor until it lets go, each axis at its own time.
///
///   before t_r:  F = F_0 - K (x - x_0) - C v;   after:  F = F_0 exp(-(t - t_r) / tau), the rest of the force that held the weight
///
/// A magnet is driven: its force stores nothing. Books v . C v as dissipated while it holds, and F . v + v . C v as prescribed work. No heat, no
/// moments; growth is ignored. Control loops, saturation and the bias field's own negative stiffness after the release are not part of it.
class MagnetSupport final : public Support {
 public:
  MagnetSupport(std::string name, const MagnetParameters& parameters, const MagnetStart& start);

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  [[nodiscard]] std::vector<double> instants() const override;
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override;
  [[nodiscard]] double energy(const SupportInput&, std::span<const double>) const override { return 0.; }

 private:
  std::string name_;
  MagnetParameters p_;
  MagnetStart start_;
};

/// Shares of a weight that magnets at the positions x take without moments: linear in x, the least sum of squares. [n]
[[nodiscard]] std::vector<double> weight_shares(const std::vector<double>& positions, double centre_of_gravity);

}  // namespace rotordrop
