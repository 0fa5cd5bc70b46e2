#pragma once
// Windage of the rotor: the table [rotor.windage], and the torque that it gives.
#include <optional>
#include <vector>

#include "base/parameters/section.h"
#include "rotor/geometry.h"

namespace rotordrop {

/// Where the windage torque comes from.
enum class WindageLaw {
  power,    ///< torque at one speed, times a power of the speed
  geometry  ///< smooth cylinders and faces of the rotor's geometry in a gas
};

/// [rotor.windage].
struct WindageParameters {
  WindageLaw law = WindageLaw::power;
  std::optional<double> torque, speed;  ///< [N m], [rad/s]; of `power`
  double exponent = 2;
  double density = 0, viscosity = 0;  ///< of the gas [kg/m^3], kinematic [m^2/s]; of `geometry`
  std::optional<double> gap;          ///< radial, around the cylinders [m]; none: free gas
  double factor = 1;
};
[[nodiscard]] Section<WindageParameters> windage_section();

/// Torque of the gas against the rotor's spin. Odd in the speed and without jumps.
class Windage {
 public:
  /// T = torque |w / speed|^exponent, against w. @param torque >= 0 [N m]; @param speed > 0 [rad/s]
  Windage(double torque, double speed, double exponent);
  /// Through points: powers of the speed between them, in proportion to the speed below the first, the last power beyond the last.
  /// @param speed   rising, > 0 [rad/s]; at least two
  /// @param torque  > 0 [N m]
  Windage(std::vector<double> speed, std::vector<double> torque);
  [[nodiscard]] double operator()(double speed) const;

 private:
  std::vector<double> log_speed_, log_torque_, slope_;
  double torque_ = 0, speed_ = 1, exponent_ = 2;
};

/// Torque of all cylinders and faces at one speed [N m], >= 0: each span between nodes by its largest diameter, each step of the outline and
/// both ends as faces. Mass points have no outline and are left out.
[[nodiscard]] double windage_torque(const RotorGeometry& geometry, const WindageParameters& parameters, double speed);
[[nodiscard]] Windage windage_of(const RotorGeometry& geometry, const WindageParameters& parameters);

}  // namespace rotordrop
