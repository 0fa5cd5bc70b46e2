#pragma once
// Rest of bearings and of the rotor on its supports, as systems for the solver, and what they report.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bearing/statics/bearing_statics.h"
#include "machine/machine_parameters.h"
#include "machine/static_growth.h"
#include "model/equilibrium_system.h"
#include "rotor/static_rotor.h"

namespace rotordrop {

/// One touchdown bearing by itself: what its rings feel.
struct BearingState {
  Expansion growth;
  double speed = 0;  ///< of the inner ring [rad/s]
  Force load;        ///< on the inner ring, without preload
};
/// @param data  of the same bearing (touchdown_data_of)
BearingEquilibrium bearing_equilibrium(const StaticsParameters& statics, const TouchdownParameters& bearing,
                                       const TouchdownBearingData& data, const BearingState& state);
/// Under the load of [statics].
BearingEquilibrium bearing_equilibrium(const MachineParameters& parameters, const std::string& name,
                                       const TouchdownParameters& bearing);

/// Support on which the rotor rests.
struct SupportReaction {
  std::string name;
  int node = 0;
  std::array<double, 2> force_on_rotor{};  ///< y, z [N]
  /// About y, z, from the bore's middle: of a bearing with a free ring, which the journal's tilt presses unevenly along its width [N m].
  std::optional<std::array<double, 2>> moment_on_rotor;
  std::array<double, 2> journal{};  ///< deflection of the rotor's axis there, y, z [m]
  bool is_touchdown = false;
  double clearance = 0;                ///< left between rotor and bore, where it is smallest; negative: they press [m]
  std::array<double, 2> outer_ring{};  ///< displacement of outer ring and support, y, z [m]
  RingReport ring;                     ///< relative to the outer ring
};
struct ShaftReport {
  std::vector<SupportReaction> supports;
  std::vector<double> node_x;               ///< [m]
  std::array<std::vector<double>, 2> axis;  ///< deflection of every node along y, z [m]
  double sag =
      0;  ///< largest distance of the axis from the straight line through the outermost supports, between them [m]
  double sag_x = 0;   ///< where [m]
  double weight = 0;  ///< of the rotor [N]
};

/// The rotor at rest on its touchdown bearings and linear supports. Contact of rotor and bore without friction, bores and races without
/// waves; the touchdown bearing's inner ring has its five degrees of freedom, the outer ring its support's two springs. The rotor presses on a free ring
/// in the drop's slices along the bore, with the tilts of both, and on other rings at their middle.
class ShaftEquilibrium final : public EquilibriumSystem {
 public:
  /// @throws InputError for a rotor on fewer than two nodes
  explicit ShaftEquilibrium(const MachineParameters& parameters, const Node& case_node);
  ~ShaftEquilibrium() override;

  [[nodiscard]] std::size_t size() const override { return scales_.size(); }
  [[nodiscard]] std::span<const double> scales() const override { return scales_; }
  [[nodiscard]] double force_scale() const override { return force_scale_; }
  void forces(std::span<const double> x, std::span<double> f) const override;
  void stiffness(std::span<const double> x, std::span<double> K) const override;
  [[nodiscard]] double potential(std::span<const double> x) const override;
  [[nodiscard]] bool has_circulatory_forces() const override { return is_circulatory_; }
  void set_circulatory_share(double share) override { share_ = share; }
  [[nodiscard]] ShaftReport report(std::span<const double> x) const;

 private:
  struct Touchdown;
  struct Linear;
  struct Sum;
  struct Pressing;
  [[nodiscard]] std::vector<Pressing> pressings(const Touchdown& t, const Eigen::VectorXd& x) const;
  [[nodiscard]] Sum sum(std::span<const double> x, double share) const;

  std::unique_ptr<StaticRotor> rotor_;
  std::vector<Touchdown> touchdowns_;
  std::vector<Linear> linears_;
  std::vector<double> scales_, node_x_;
  std::vector<int> stations_;
  double weight_ = 0, force_scale_ = 1, share_ = 1;
  bool is_circulatory_ = false;
};

}  // namespace rotordrop
