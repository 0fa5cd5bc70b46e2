#pragma once
// Where a running bearing can stay, and whether it does.
//
// A bearing's friction is one number, its heat Q. Steady temperatures T(Q) follow from the thermal model, growth and ball loads from them,
// and from these the heat that friction makes, Phi(Q). Operating points are Phi(Q) = Q. The loop gain of docs/how-to/preload.md,
// (dHeat/dPreload)(dPreload/du)(du/dT) R_thermal, with every surface, every port and the thermal model's own derivatives is
//   L = dPhi/dQ = - c^T J^-1 b,
// J = d rates / dT, b = d rates / dQ, c = dHeat/dT through growth. Perturbations follow dT/dt = (J + b c^T) T, and
// det(J + b c^T) = det(J) (1 - L): at L = 1 an eigenvalue passes zero. L < 1 is neither enough, where the inner ring warms before the outer
// one does, nor necessary, where T(Q) folds back and J has a positive eigenvalue itself (folded_rests.h); hence the eigenvalues themselves.
#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/preload/preload_loop.h"

namespace rotordrop {

struct PreloadLimits {
  double temperature = 0;  ///< [K]
  double pressure = 0;     ///< [Pa]
};
/// What a search ends at; no_state: the bearing has no steady state there, or none was found.
enum class LimitMet { none, temperature, pressure, no_state };
LimitMet limit_met(const PreloadLoop& loop, const PreloadLimits& limits, std::span<const double> T,
                   const RunningState& state);

/// How a loop responds near a state.
struct LoopResponse {
  double gain = 0;                                   ///< L
  double heat_per_preload = 0;                       ///< along the response [W/N]
  double preload_per_heat = 0;                       ///< [N/W]; with the former the gain, where there is a preload
  Expansion growth_per_heat;                         ///< steady [m/W]
  std::complex<double> eigenvalue = 0;               ///< of the largest real part [1/s]
  std::complex<double> eigenvalue_of_held_heat = 0;  ///< the same of J
  double largest_gain = 0;       ///< of perturbations that grow as exp(s t), over s >= 0; NaN if folded
  double largest_gain_time = 0;  ///< 1/s there [s]; 0: at s = 0
  [[nodiscard]] bool is_stable() const { return eigenvalue.real() < 0.; }
  /// Whether it would not hold if its heat were held: T(Q) folds back there.
  [[nodiscard]] bool is_folded() const { return eigenvalue_of_held_heat.real() >= 0.; }
};
LoopResponse response_at(const PreloadLoop& loop, std::span<const double> T);
/// Temperatures of the rest, Q = Phi(T), beside a start: Newton's method with J + b c^T. Nothing if there is none within a few hundredths of the rise.
std::optional<std::vector<double>> rest_near(const PreloadLoop& loop, std::span<const double> start);

struct OperatingPoint {
  double heat = 0;                 ///< Q = Phi(Q) [W]
  std::vector<double> T;           ///< of the thermal model's states
  double highest_temperature = 0;  ///< of any node [K]
  RunningState state;
  Expansion growth;  ///< by heat
  LoopResponse response;
};

/// Operating points within the limits on the way of steady states that begins cold, its folds included, in the order of that way; and what was looked at.
struct OperatingPoints {
  std::vector<OperatingPoint> points;
  std::vector<double> heat, made;  ///< Q and Phi(Q) of the search [W]
  LimitMet ended_by = LimitMet::none;
  int n_without_state = 0;  ///< heats before that end at which none was found, or none just beside
  [[nodiscard]] const OperatingPoint* first_stable() const;
};
enum class Wanted {
  all,
  up_to_stable  ///< no further than the first stable one
};
/// @throws SolverError if the bearing has no rest when cold
OperatingPoints find_operating_points(const PreloadLoop& loop, const PreloadLimits& limits,
                                      Wanted wanted = Wanted::all);

/// The operating point at which a transient has settled; added if it is not among them, as one that no way of steady states from cold leads to.
/// @param T  where it settled
/// @returns its index, or nothing if there is no rest beside T
std::optional<std::size_t> add_settled(const PreloadLoop& loop, std::span<const double> T, OperatingPoints& points);

/// How far a loop may change until no stable operating point is left.
struct CriticalFactor {
  double factor = 0;  ///< last one with a stable operating point
  double gain = 0;    ///< at that point
  /// What ends it: loop gain (or eigenvalue), a limit beyond which there still is one, or a heat at which there is no steady state.
  enum class By { loop, limit, no_state } by = By::loop;
};
/// @param loop_with  the loop with something `factor` times as large
/// @param towards    a factor in the direction in which it becomes worse: 2 or 0.5
/// @returns nothing if none was found within a factor of 64 both ways
std::optional<CriticalFactor> find_critical_factor(
    const std::function<std::unique_ptr<PreloadLoop>(double factor)>& loop_with, double towards,
    const PreloadLimits& limits);

}  // namespace rotordrop
