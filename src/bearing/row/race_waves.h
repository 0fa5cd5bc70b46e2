#pragma once
// Waves of a row's races, as its balls meet them.
#include <array>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "bearing/row/ball_row_ports.h"
#include "bearing/turned_wave.h"

namespace rotordrop {

/// A sinusoidal deviation of a race: A sin(order * argument + phase), positive means more penetration (Neisi 2019, eq. (11) and in eq. (12)).
struct RaceWave {
  bool on_inner_race = true;  ///< argument b_j - theta_i; on the outer race b_j
  int order = 1;              ///< m, >= 1
  double amplitude = 0;       ///< A [m]
  double phase = 0;           ///< [rad]
};

/// A race's wave as seen from the cage: its place, and m times the balls' speed past the race [rad/s].
template <class Real>
struct PassedWaveOf {
  TurnedWaveOf<Real> wave;
  Real speed;

  PassedWaveOf() = default;
  /// @param form  what is the same for all drops: surface and order
  PassedWaveOf(const RaceWave& form, const Real& amplitude, const Real& phase, const BallRowInputOf<Real>& in) {
    const double m = form.order;
    wave = {m, amplitude, phase, form.on_inner_race ? in.ring_angle - in.cage_angle : -in.cage_angle};
    speed = m * (form.on_inner_race ? in.cage_speed - in.ring_speed : in.cage_speed);
  }
};

/// What waves add to the deflections of a ball's contacts [m], and the rates of that by their travel [m/s].
template <class Real>
struct BallWavesOf {
  Real inner, outer, inner_rate, outer_rate;
  [[nodiscard]] Real added() const { return inner + outer; }
  [[nodiscard]] Real rate() const { return inner_rate + outer_rate; }
};

/// The same of all balls of a row.
struct WavesAtBalls {
  WavesAtBalls() {}  // leaves everything unwritten: only rows with waves use it
  /// A little longer than a row can be, lest all arrays fall on the same lines of the cache.
  using Array = std::array<double, most_balls + 8>;
  alignas(64) Array inner, outer, inner_rate, outer_rate;
};

/// All waves of a row's races.
class RaceWaves {
 public:
  struct Wave {
    RaceWave form;
    /// Of order * azimuth at cage angle zero [n_balls, filled up to whole vectors by zeros].
    AlignedNumbers sine, cosine;
  };

  RaceWaves() = default;
  /// @param azimuths  of the balls at cage angle zero [rad]
  RaceWaves(const std::vector<RaceWave>& waves, std::span<const double> azimuths);
  [[nodiscard]] bool empty() const { return waves_.empty(); }
  [[nodiscard]] std::span<const Wave> list() const { return waves_; }
  /// Of a row that has waves. Writes whole vectors of balls; what fills up the row has none.
  void at_balls(const BallRowInput& in, WavesAtBalls& at) const;

 private:
  std::vector<Wave> waves_;
};

}  // namespace rotordrop
