#pragma once
// Natural modes and unbalance response of the linear rotor on linear supports: by eigenvalues and by frequency, without
// time integration.
#include <array>
#include <complex>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "rotor/geometry.h"
#include "rotor/modal_rotor.h"

namespace rotordrop {

struct ModalBasis;

/// Spring and damper between a node and the ground: force on the rotor = -stiffness (v, w) - damping (v', w').
struct LinearSupportAtNode {
  int node = 0;                                      ///< numbered from 1
  std::array<std::array<double, 2>, 2> stiffness{};  ///< rows and columns y, z [N/m]
  std::array<std::array<double, 2>, 2> damping{};    ///< rows and columns y, z [N s/m]
};

enum class Whirl {
  forward,   ///< every point turns with the spin
  backward,  ///< every point turns against the spin
  planar,    ///< straight vibration, or one of a degenerate pair that may be combined to it
  mixed      ///< some points turn with the spin, others against it
};
/// "forward", "backward", "planar", "mixed".
[[nodiscard]] std::string_view to_string(Whirl whirl);

/// One oscillating mode: displacement = Re(shape exp(lambda t)), lambda with positive imaginary part.
struct WhirlMode {
  double frequency = 0;          ///< damped, Im(lambda) / 2 pi [Hz]
  double natural_frequency = 0;  ///< |lambda| / 2 pi [Hz]
  double damping_ratio = 0;      ///< -Re(lambda) / |lambda|; negative: unstable
  Whirl whirl = Whirl::planar;
  std::vector<std::complex<double>> v, w;  ///< [n_nodes] along y and z; the largest has amplitude 1

  [[nodiscard]] std::complex<double> eigenvalue() const;  ///< lambda [rad/s]
};

/// A motion whose frequency is less than this part of |lambda| (damping ratio above 0.995) is taken as not oscillating:
/// gyroscopic moments give motions that would only creep back a frequency far below their decay.
inline constexpr double barely_oscillating = 0.1;

struct WhirlModes {
  std::vector<WhirlMode> modes;  ///< by damped frequency, rising
  int n_rigid_body_modes = 0;    ///< motions without restoring force (slower than 0.01 Hz); not among the modes
  int n_overdamped = 0;          ///< motions that creep back without oscillating; not among the modes
  int n_diverging = 0;           ///< motions that move away without oscillating; not among the modes
  double divergence_rate = 0;    ///< Re(lambda) of the fastest of these [1/s]; 0 if there are none
};

/// A spin speed that equals the damped frequency of one of the rotor's own modes: unbalance meets a resonance there.
struct CriticalSpeed {
  double speed = 0;  ///< [rad/s], > 0
  Whirl whirl = Whirl::planar;
  double damping_ratio = 0;  ///< of the mode at this speed
};

struct ModalAnalysisOptions {
  double modal_damping = 0;            ///< ratio of every flexible free-free mode
  double mass_proportional_alpha = 0;  ///< [1/s] on every mode
  /// [Hz]; infinity: the full finite-element model
  double cut_off_frequency = std::numeric_limits<double>::infinity();
  std::vector<int> attachment_nodes = {};  ///< with a cut-off: nodes whose static flexibility is kept (modal_basis.h)
};

/// Linear analysis in the basis of free-free modes; exact for the finite-element model unless a cut-off is set.
class ModalAnalysis {
 public:
  explicit ModalAnalysis(const RotorGeometry& geometry, const ModalAnalysisOptions& options = {});
  ~ModalAnalysis();
  ModalAnalysis(ModalAnalysis&&) noexcept;
  ModalAnalysis& operator=(ModalAnalysis&&) noexcept;

  /// Eigenvalues of the rotor at constant spin with all gyroscopic and damping terms.
  /// @param spin_speed  [rad/s]
  /// @param supports    empty: free-free
  [[nodiscard]] WhirlModes whirl_modes(double spin_speed, const std::vector<LinearSupportAtNode>& supports = {}) const;
  /// Speeds at which an undamped rotor whirls with its own spin: K q = speed^2 (M - G) q, in one eigenvalue problem.
  ///
  /// Damping and the antisymmetric part of the supports' stiffness are left out. Rising; forward and backward together.
  /// @return [rad/s], those above 0.06 rad/s (0.01 Hz)
  [[nodiscard]] std::vector<double> undamped_critical_speeds(const std::vector<LinearSupportAtNode>& supports) const;
  /// Speeds up to a limit at which the damped frequency of a mode equals the spin speed, found as roots to 1e-10.
  ///
  /// A mode that is overdamped at every speed has no critical speed and is not among them. Where forward and backward
  /// whirl have one speed (no gyroscopic effect) it is listed once, as planar.
  /// @param up_to  [rad/s], > 0
  /// @param sense  of the spin: its sign; matters where stiffness or damping couple y and z
  [[nodiscard]] std::vector<CriticalSpeed> critical_speeds(double up_to,
                                                           const std::vector<LinearSupportAtNode>& supports,
                                                           double sense = 1.) const;

 private:
  /// One eigenvalue of every coordinate [rad/s], by falling frequency; 0 for those that do not oscillate.
  [[nodiscard]] std::vector<std::complex<double>> falling_eigenvalues(
      double spin_speed, const std::vector<LinearSupportAtNode>& supports) const;

  std::unique_ptr<const ModalBasis> basis_;
  ModalAnalysisOptions options_;
};

}  // namespace rotordrop
