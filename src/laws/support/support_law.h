#pragma once
// What carries the outer ring of a touchdown bearing: force over travel and speed in the plane across the axis.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rotordrop {

/// Travel of the outer ring in its housing, and its speed.
struct SupportMotion {
  double y = 0, z = 0;    ///< from where no force acts [m]
  double vy = 0, vz = 0;  ///< [m/s]
};

/// What a law answers. Power into the law is -(force . velocity) = rate of stored energy + loss.
template <class Real>
struct SupportAnswerOf {
  Real y = 0, z = 0;  ///< force on the outer ring [N]
  Real loss = 0;      ///< dissipated, >= 0 [W]
};
using SupportAnswer = SupportAnswerOf<double>;

/// Linearised or conservative part for a slow push from the unloaded place, as statics asks for it.
struct SupportRest {
  double force_y = 0, force_z = 0;                ///< on the outer ring [N]
  double k_yy = 0, k_yz = 0, k_zy = 0, k_zz = 0;  ///< -d force / d place [N/m]
  double energy = 0;                              ///< whose gradient that force is, negative [J]
};

/// A law with inner states, which the integrator owns. Pure: no copy of a state, any thread.
class SupportLaw {
 public:
  SupportLaw() = default;
  SupportLaw(const SupportLaw&) = delete;
  SupportLaw& operator=(const SupportLaw&) = delete;
  virtual ~SupportLaw() = default;

  struct State {
    std::string name;  ///< such as "slider 2 y"
    std::string unit;
    double scale = 1;  ///< typical size
  };
  [[nodiscard]] virtual std::vector<State> states() const { return {}; }
  [[nodiscard]] std::size_t n_states() const { return states().size(); }
  /// Inner states after a slow push from the unloaded place to (y, z).
  virtual void settle(double y, double z, std::span<double> inner) const = 0;
  /// @param inner, rates [n_states()]
  virtual SupportAnswer evaluate(const SupportMotion& motion, std::span<const double> inner,
                                 std::span<double> rates) const = 0;
  /// Stored in springs [J].
  [[nodiscard]] virtual double energy(const SupportMotion& motion, std::span<const double> inner) const = 0;
  /// A slow push from the unloaded place: a convex energy.
  [[nodiscard]] virtual SupportRest rest(double y, double z) const = 0;
};

/// Place where a slow push by a force ends [m].
struct SupportPlace {
  double y = 0, z = 0;
};
[[nodiscard]] SupportPlace resting_place(const SupportLaw& law, double force_y, double force_z);

}  // namespace rotordrop
