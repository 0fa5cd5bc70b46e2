#pragma once
// Temperatures of two surfaces that rub: one temperature wherever they touch, and the share of the heat that follows from it.
#include <cstddef>
#include <vector>

#include "base/aligned_numbers.h"

namespace rotordrop {

/// A body as its rubbed surface sees it.
struct RubbedBody {
  double radius = 0;        ///< of the rubbed circle [m], > 0
  double conductivity = 0;  ///< [W/(m K)], > 0
  double capacity = 0;      ///< rho c [J/(m3 K)], > 0
  /// e = sqrt(k rho c) [W s^(1/2)/(m2 K)]
  [[nodiscard]] double effusivity() const;
};

/// Surface rise around a circle from heat that passed over it earlier: cells that turn with the body, each a half space,
///   T(t) = (pi k rho c)^(-1/2) integral q(s) (t - s)^(-1/2) ds,
/// the root as a sum of exponentials (see SweptArcHistory), met to 5e-4 for heat that ended at least one shortest interval ago.
/// A cell costs something only while it is heated or looked at.
class TrackMemory {
 public:
  /// @param shortest_interval, duration  [s]
  TrackMemory(const RubbedBody& body, std::size_t n_cells, double axial_width, double shortest_interval,
              double duration);

  /// Rise [K] at the time t [s] of the cell at this angle [rad], which was last heated before it.
  [[nodiscard]] double rise(double angle, double t) const;
  /// Adds heat [J] that a band gives off evenly while its middle goes from one angle to the other; takes effect with commit().
  void add(double from, double to, double half_angle, double heat);
  /// All that was added since the last commit entered evenly from t - step to t.
  void commit(double t, double step);

  [[nodiscard]] std::size_t n_cells() const { return heat_.size(); }
  /// Heat of every cell so far [J] [n_cells].
  [[nodiscard]] const std::vector<double>& heat() const { return heat_; }

 private:
  [[nodiscard]] std::size_t cell_at(double angle) const;
  /// Decays of the terms over a lag [n_terms].
  [[nodiscard]] const double* decay_over(double lag) const;
  [[nodiscard]] std::size_t place_of_decay(double lag) const;

  double scale_ = 0, cell_area_ = 0;
  AlignedNumbers rate_, weight_;      ///< of the terms [1/s], [s^-1/2] [n_terms], whole vectors of them
  AlignedNumbers memory_;             ///< [n_cells][n_terms]
  std::vector<double> heated_at_;     ///< time of a cell's memory [s] [n_cells]
  std::vector<double> heat_, fresh_;  ///< [J] [n_cells]
  std::vector<std::size_t> fresh_cells_;
  AlignedNumbers gain_;  ///< of the terms over the interval of gain_step_
  double gain_step_ = -1;
  // Lags are mostly whole numbers of intervals: their decays are kept, and behind them that of one other lag.
  static constexpr std::size_t n_kept = 512;
  double interval_ = 0, per_interval_ = 0;
  mutable AlignedNumbers decay_;      ///< [n_kept + 1][n_terms]
  mutable std::size_t n_filled_ = 0;  ///< of kept decays, each the one before times that of one interval
  mutable double other_lag_ = -1;     ///< of the one behind them
  mutable double found_lag_ = -1;     ///< that was asked for last
  mutable std::size_t found_ = 0;     ///< place of its decays
  // The rise that was asked for last.
  mutable std::size_t risen_cell_ = static_cast<std::size_t>(-1);  ///< none
  mutable double risen_at_ = 0, risen_ = 0;
};

/// How the heat divides between the bore and the rotor.
enum class RubDivision {
  one_temperature,  ///< so that both surfaces have the same temperature everywhere under the band
  given             ///< by a share that the caller gives
};

/// The band in one interval of time.
struct RubbingBand {
  double heat = 0;           ///< of both bodies together, in this interval [J]
  double half_width = 0;     ///< b, along the surfaces [m], > 0
  double contact_angle = 0;  ///< of the band's middle, at the interval's end [rad]; whole turns do not matter
  double ring_angle = 0;     ///< of the ring, at the interval's end; not wrapped [rad]
  double rotor_angle = 0;    ///< of the rotor, likewise
  double share_to_ring = 0;  ///< for RubDivision::given
};

/// Bore and rotor under one rubbing band, from interval to interval.
///
/// The heat is even over the band, q = H/(2 b w). The band is cut into n_nodes pieces across its length. The ring, slow against the rotor, keeps what each
/// piece of its surface got (TrackMemory), and takes up the present interval's flux like a half space for as long as it has been under the band. The
/// rotor passes fast: its material enters at the edge that it meets first, with the rise that is left from earlier turns, and at the age tau under the band has
///   T = T_before + (1/(e sqrt(pi))) integral_0^tau q_rotor tau'^(-1/2) dtau'.
/// From that edge on, piece by piece, q_ring follows from T_ring = T_rotor, so the condition holds in each piece and q_ring + q_rotor = q. Where a surface
/// that was heated before meets a colder one, heat goes from one to the other, and q_ring may be below 0 or above q.
///
/// Sources: Blok, Proc. Gen. Disc. Lubrication 2 (1937) 222-235; Jaeger, J. Proc. Roy. Soc. NSW 76 (1942) 203-224; Carslaw & Jaeger, 2nd ed. (1959), 2.7 and 10.7.
/// Valid: rotor's Peclet number v b/(2 kappa) above about 5, thin heated layers, as in SweptArcHistory; a perfect thermal contact over the whole band.
class RubbingPair {
 public:
  struct Options {
    RubDivision division = RubDivision::one_temperature;
    std::size_t n_nodes = 12;
    double axial_width = 0;           ///< w [m], > 0
    double shortest_interval = 5e-5;  ///< [s]
    double duration = 1;              ///< [s]
    std::size_t ring_cells = 720, rotor_cells = 180;
  };
  RubbingPair(const RubbedBody& ring, const RubbedBody& rotor, const Options& options, double start_time);

  /// Goes on to the time [s] with a band. The line of centres has turned the shorter way since the last interval; in the first one of a contact it is
  /// taken as at rest.
  void advance(double time, const RubbingBand& band);
  /// The same without contact; the angles [rad] as those of a band.
  void advance(double time, double ring_angle, double rotor_angle);

  struct State {
    double time = 0;
    double ring_rise = 0, rotor_rise = 0;  ///< largest under the band [K]; 0 without contact
    double largest_difference = 0;         ///< |T_ring - T_rotor| in a piece, largest of this interval [K]
    double share_to_ring = 0;              ///< part of this interval's heat that entered the ring
  };
  [[nodiscard]] const State& state() const { return state_; }
  /// Heat since the start [J].
  [[nodiscard]] double heat_into_ring() const { return into_ring_; }
  [[nodiscard]] double heat_into_rotor() const { return into_rotor_; }
  [[nodiscard]] const TrackMemory& ring() const { return ring_memory_; }

 private:
  RubbedBody ring_, rotor_;
  Options options_;
  TrackMemory ring_memory_, rotor_memory_;
  double touched_at_ = 0, last_contact_angle_ = 0, last_ring_angle_ = 0, last_rotor_angle_ = 0;
  bool was_in_contact_ = false;
  double into_ring_ = 0, into_rotor_ = 0;
  std::vector<double> q_ring_, middle_, kernel_;
  State state_;
};

}  // namespace rotordrop
