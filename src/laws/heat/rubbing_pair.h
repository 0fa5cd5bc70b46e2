#pragma once
// Temperatures of two surfaces that rub: one temperature wherever they touch, and the share of the heat that follows from it.
#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "laws/heat/track_memory.h"

namespace rotordrop {

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

/// How the band lies over both bodies in an interval.
struct BandPassage;

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
/// The heat is even over the band, q = H/(2 b w). The band is cut into n_pieces pieces across its length. The ring, slow against the rotor, keeps what each
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
    std::size_t n_pieces = 12;        ///< of the band: 12 or 1
    double axial_width = 0;           ///< w [m], > 0
    double shortest_interval = 5e-5;  ///< [s]
    double duration = 1;              ///< [s]
    std::size_t ring_cells = 720, rotor_cells = 180;
  };
  /// @throws std::invalid_argument for another number of pieces
  RubbingPair(const RubbedBody& ring, const RubbedBody& rotor, const Options& options, double start_time);

  /// Goes on to the time [s] with a band. The line of centres has turned the shorter way since the last interval; in the first one of a contact it is
  /// taken as at rest.
  /// @param shares_to_ring  [divisions], of those whose share is given; if none is, it may be left out
  void advance(double time, const RubbingBand& band, std::span<const double> shares_to_ring = {});
  /// The same without contact; the angles [rad] as those of a band.
  void advance(double time, double ring_angle, double rotor_angle);

  struct State {
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
  [[nodiscard]] BandPassage passage(double time, const RubbingBand& band);
  /// What earlier intervals left on both bodies under the band's pieces.
  void look_at_tracks(const BandPassage& p);
  [[nodiscard]] PieceResponses piece_responses() {
    return {direct_.data(), rotor_rise_.data(), kernel_.data(), inverse_.data()};
  }
  void divide(const BandPassage& p, std::size_t division, double share_to_ring);

  RubbedBody ring_, rotor_;
  Options options_;
  TrackMemory ring_memory_, rotor_memory_;
  double time_ = 0, touched_at_ = 0, last_contact_angle_ = 0, last_ring_angle_ = 0, last_rotor_angle_ = 0;
  bool was_in_contact_ = false;
  std::vector<double> into_ring_, into_rotor_;  // [divisions]
  std::vector<double> before_;                  // on the rotor, just ahead of the band [K] [divisions]
  AlignedNumbers kept_;                         // on the ring [K] [divisions][n_pieces, filled up]
  // Of the band's pieces [n_pieces, filled up]
  AlignedNumbers direct_, rotor_rise_, kernel_, inverse_;  // how fluxes warm them
  AlignedNumbers q_ring_, on_rotor_;                       // [W/m2], [K]
  AlignedNumbers ring_joules_, rotor_joules_;              // [divisions][pieces that are told apart]
  std::vector<State> states_;
};

}  // namespace rotordrop
