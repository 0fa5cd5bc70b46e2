#pragma once
// Temperatures of two surfaces that rub: one temperature wherever they touch, and the share of the heat that follows from it.
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
/// the root as a sum of exponentials (see SweptArcHistory), met to 4e-4 for heat that ended at least one shortest interval ago.
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

  [[nodiscard]] std::size_t n_cells() const { return heated_at_.size(); }
  /// Heat of every cell by a flux so far [J] [n_cells].
  [[nodiscard]] std::span<const double> heat(std::size_t flux) const {
    return std::span(heat_).subspan(flux * n_cells(), n_cells());
  }

 private:
  void set_gain(double step);
  /// Of neighbouring cells. @param heat  [n_fluxes][stride] [J]
  void take(std::size_t first_cell, std::size_t n, const double* heat, std::size_t stride, double t, double step);
  /// Decays of the terms over a lag [n_terms].
  [[nodiscard]] const double* decay_over(double lag) const;
  [[nodiscard]] std::size_t place_of_decay(double lag) const;

  double scale_ = 0, cell_angle_ = 0, cell_area_ = 0;
  std::size_t n_fluxes_ = 1;
  AlignedNumbers rate_, weight_;   ///< of the terms [1/s], [s^-1/2] [n_terms], whole vectors of them
  AlignedNumbers memory_;          ///< [n_cells][n_fluxes][n_terms]
  std::vector<double> heated_at_;  ///< time of a cell's memory [s] [n_cells]; below all times: never
  std::vector<double> heat_;       ///< [J] [n_fluxes][n_cells]
  AlignedNumbers fresh_;           ///< of the band that is being added [J] [n_fluxes][its cells, whole vectors]
  AlignedNumbers gain_;            ///< of the terms over the interval of gain_step_
  double gain_step_ = -1;
  // Lags are mostly whole numbers of intervals: their decays are kept, and behind them that of one other lag.
  static constexpr std::size_t n_kept = 512;
  double interval_ = 0, per_interval_ = 0;
  mutable AlignedNumbers decay_;              ///< [n_kept + 1][n_terms]
  mutable std::size_t n_filled_ = 0;          ///< of kept decays, each the one before times that of one interval
  mutable double other_lag_ = -1;             ///< of the one behind them
  mutable double found_lag_ = -1;             ///< that was asked for last
  mutable std::size_t found_ = 0;             ///< place of its decays
  mutable std::vector<std::uint32_t> cells_;  ///< that are looked at
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
};

/// How a flux that begins with the present contact warms a band's pieces [K m2/W] [n_pieces].
struct PieceResponses {
  double* direct;      ///< the ring's by its own flux
  double* rotor_rise;  ///< the rotor's by an even flux over all pieces up to this one
  double* kernel;      ///< the rotor's by the flux of the piece that lies so many ahead
  double* inverse;     ///< of the sum of direct and the first of kernel [W/(m2 K)]
};

/// Bore and rotor under one rubbing band, from interval to interval. The same rub is followed for several divisions of its heat at once, which know
/// nothing of each other.
///
/// The heat is even over the band, q = H/(2 b w). The band is cut into n_nodes pieces across its length. The ring, slow against the rotor, keeps what each
/// piece of its surface got (TrackMemory), and takes up the present interval's flux like a half space for as long as it has been under the band. The
/// rotor passes fast: its material enters at the edge that it meets first, with the rise that is left from earlier turns, and at the age tau under the band has
///   T = T_before + (1/(e sqrt(pi))) integral_0^tau q_rotor tau'^(-1/2) dtau'.
/// A surface that goes by in an interval is met by each piece at another time of it, so that all that came under the band counts.
/// From that edge on, piece by piece, q_ring follows from T_ring = T_rotor, so the condition holds in each piece and q_ring + q_rotor = q. Where a surface
/// that was heated before meets a colder one, heat goes from one to the other, and q_ring may be below 0 or above q.
///
/// Sources: Blok, Proc. Gen. Disc. Lubrication 2 (1937) 222-235; Jaeger, J. Proc. Roy. Soc. NSW 76 (1942) 203-224; Carslaw & Jaeger, 2nd ed. (1959), 2.7 and 10.7.
/// Valid: rotor's Peclet number v b/(2 kappa) above about 5, thin heated layers, as in SweptArcHistory; a perfect thermal contact over the whole band.
class RubbingPair {
 public:
  struct Options {
    std::vector<RubDivision> divisions = {RubDivision::one_temperature};
    std::size_t n_nodes = 12;
    double axial_width = 0;           ///< w [m], > 0
    double shortest_interval = 5e-5;  ///< [s]
    double duration = 1;              ///< [s]
    std::size_t ring_cells = 720, rotor_cells = 180;
  };
  RubbingPair(const RubbedBody& ring, const RubbedBody& rotor, const Options& options, double start_time);

  /// Goes on to the time [s] with a band. The line of centres has turned the shorter way since the last interval; in the first one of a contact it is
  /// taken as at rest.
  /// @param shares_to_ring  [divisions], of those whose share is given; if none is, it may be left out
  void advance(double time, const RubbingBand& band, std::span<const double> shares_to_ring = {});
  /// The same without contact; the angles [rad] as those of a band.
  void advance(double time, double ring_angle, double rotor_angle);

  struct State {
    double time = 0;
    double ring_rise = 0, rotor_rise = 0;  ///< largest under the band [K]; 0 without contact
    double largest_difference = 0;         ///< |T_ring - T_rotor| in a piece, largest of this interval [K]
    double share_to_ring = 0;              ///< part of this interval's heat that entered the ring
  };
  /// Of a division.
  [[nodiscard]] const State& state(std::size_t division = 0) const { return states_[division]; }
  /// Heat by a division since the start [J].
  [[nodiscard]] double heat_into_ring(std::size_t division = 0) const { return into_ring_[division]; }
  [[nodiscard]] double heat_into_rotor(std::size_t division = 0) const { return into_rotor_[division]; }
  [[nodiscard]] const TrackMemory& ring() const { return ring_memory_; }

 private:
  /// How the band lies over both bodies in an interval.
  struct Passage;
  [[nodiscard]] Passage passage(double time, const RubbingBand& band);
  /// What earlier intervals left on both bodies under the band's pieces.
  void look_at_tracks(const Passage& p);
  [[nodiscard]] PieceResponses piece_responses() {
    return {direct_.data(), rotor_rise_.data(), kernel_.data(), inverse_.data()};
  }
  void divide(const Passage& p, double q, std::size_t division, double share_to_ring);

  RubbedBody ring_, rotor_;
  Options options_;
  TrackMemory ring_memory_, rotor_memory_;
  double time_ = 0, touched_at_ = 0, last_contact_angle_ = 0, last_ring_angle_ = 0, last_rotor_angle_ = 0;
  bool was_in_contact_ = false;
  std::vector<double> into_ring_, into_rotor_;  // [divisions]
  std::vector<double> before_;                  // on the rotor, just ahead of the band [K] [divisions]
  AlignedNumbers kept_;                         // on the ring [K] [divisions][n_nodes, filled up]
  // Of the band's pieces [n_nodes, filled up]
  AlignedNumbers direct_, rotor_rise_, kernel_, inverse_;  // how fluxes warm them
  AlignedNumbers q_ring_, on_rotor_;                       // [W/m2], [K]
  AlignedNumbers ring_joules_, rotor_joules_;              // [divisions][pieces that are told apart]
  std::vector<State> states_;
};

}  // namespace rotordrop
