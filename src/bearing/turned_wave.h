#pragma once
#include "base/sine_cosine.h"

namespace rotordrop {

/// A wave A sin(m (azimuth - turned) + phase) of a surface that has turned by an angle, by its two parts around the bearing.
template <class Real>
struct TurnedWaveOf {
  Real of_sine, of_cosine;  ///< A cos(phase - m turned) and A sin(phase - m turned) [m]

  TurnedWaveOf() = default;
  /// @param order  m; @param amplitude  A [m]; @param phase, turned  [rad]
  TurnedWaveOf(double order, const Real& amplitude, const Real& phase, const Real& turned) {
    const SineCosineOf<Real> at_zero = sine_cosine(phase - order * turned);
    of_sine = amplitude * at_zero.cosine;
    of_cosine = amplitude * at_zero.sine;
  }
  /// At an azimuth, by sine and cosine of m times it [m].
  template <class Number>
  [[nodiscard, gnu::always_inline]] inline Real height(const Number& sine, const Number& cosine) const {
    return sine * of_sine + cosine * of_cosine;
  }
  /// Its derivative by the azimuth, over m [m].
  template <class Number>
  [[nodiscard, gnu::always_inline]] inline Real slope(const Number& sine, const Number& cosine) const {
    return cosine * of_sine - sine * of_cosine;
  }
};
using TurnedWave = TurnedWaveOf<double>;

/// Sine and cosine of a multiple of an angle: (cosine + i sine)^order by squares, to some order times 1e-16.
/// @param order  >= 1
template <class Real>
[[nodiscard]] SineCosineOf<Real> multiple_of(int order, const SineCosineOf<Real>& angle) {
  const auto product = [](const SineCosineOf<Real>& a, const SineCosineOf<Real>& b) {
    return SineCosineOf<Real>{a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
  };
  SineCosineOf<Real> multiple = angle, square = angle;
  for (int rest = order - 1; rest > 0; rest /= 2) {
    if (rest % 2 == 1) multiple = product(multiple, square);
    square = product(square, square);
  }
  return multiple;
}

}  // namespace rotordrop
