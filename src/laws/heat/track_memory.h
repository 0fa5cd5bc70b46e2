#pragma once
// What a surface remembers of the heat that passed over it.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "laws/arc_cells.h"

namespace rotordrop {

/// A body as its rubbed surface sees it.
struct RubbedBody {
  double radius = 0;        ///< of the rubbed circle [m], > 0
  double conductivity = 0;  ///< [W/(m K)], > 0
  double capacity = 0;      ///< rho c [J/(m3 K)], > 0
  /// e = sqrt(k rho c) [W s^(1/2)/(m2 K)]
  [[nodiscard]] double effusivity() const;
};

/// Angles around a circle [rad], first + k step.
struct EvenAngles {
  double first, step;
  std::size_t n;
};

/// Surface rise around a circle from heat that passed over it earlier: cells that turn with the body, each a half space,
///   T(t) = (pi k rho c)^(-1/2) integral q(s) (t - s)^(-1/2) ds,
/// the root as a sum of exponentials (see SweptArcHistory), met to 4e-4 for heat that ended at least a fifth of the shortest interval ago.
/// A cell costs something only while it is heated or looked at. Several fluxes over the same places at the same times are kept side by side: each has
/// rises of its own, and what depends on places and times alone is done once.
class TrackMemory {
 public:
  /// @param shortest_interval, duration  [s]
  TrackMemory(const RubbedBody& body, std::size_t n_cells, std::size_t n_fluxes, double axial_width,
              double shortest_interval, double duration);

  /// Rises [K] by each flux at the time t [s] of the cells at these angles, which were last heated before it.
  /// @param out  [n_fluxes][stride], stride >= at.n
  void rises(const EvenAngles& at, double t, double* out, std::size_t stride) const;
  /// A band's heat that entered evenly from t - step to t.
  /// @param pieces  of the fluxes, one list for each
  void add(const SweptBand& band, const PiecesOfBand& pieces, double t, double step);

  [[nodiscard]] std::size_t n_cells() const { return n_cells_; }
  /// Heat of every cell by a flux so far [J] [n_cells].
  [[nodiscard]] std::span<const double> heat(std::size_t flux) const {
    return std::span(heat_).subspan(flux * n_cells(), n_cells());
  }

 private:
  void set_gain(double step);
  /// Of neighbouring cells. @param heat  [n_fluxes][stride] [J]
  void take(std::size_t first_cell, std::size_t n, const double* heat, std::size_t stride, double t, double step);
  /// Finds where the decays of some cells to the time t stand (lags_), and computes those that are missing.
  /// @param heated_at  [n, filled up] [s]
  void find_decays(const double* heated_at, std::size_t n, double t) const;
  void set_decay(std::size_t place, double lag) const;
  void keep_decays_to(std::size_t lag) const;

  double scale_ = 0, cell_angle_ = 0, cell_area_ = 0;
  std::size_t n_fluxes_ = 1, n_cells_;
  AlignedNumbers rate_, weight_;   ///< of the terms [1/s], [s^-1/2] [n_terms], whole vectors of them
  AlignedNumbers memory_;          ///< [n_cells][n_fluxes][n_terms]
  std::vector<double> heated_at_;  ///< time of a cell's memory [s] [n_cells, and a vector more]; below all times: never
  std::vector<double> heat_;       ///< [J] [n_fluxes][n_cells]
  AlignedNumbers fresh_;           ///< of the band that is being added [J] [n_fluxes][its cells, whole vectors]
  AlignedNumbers gain_;            ///< of the terms over the interval of gain_step_
  double gain_step_ = -1;
  // Lags are mostly whole numbers of intervals: their decays are kept, and behind them those of other lags that are needed at once.
  static constexpr std::uint32_t n_kept = 512;
  double interval_ = 0, per_interval_ = 0;
  mutable AlignedNumbers decay_;              ///< [n_kept, and others][n_terms]
  mutable std::size_t n_filled_ = 0;          ///< of kept decays, each the one before times that of one interval
  mutable std::vector<std::uint32_t> lags_;   ///< places of decays of what is looked at or added to
  mutable std::vector<std::uint32_t> cells_;  ///< that are looked at
  mutable std::vector<double> times_;         ///< at which these were heated [s]
};

}  // namespace rotordrop
