#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "study/time_series.h"

namespace rotordrop {

/// Amplitude spectra of overlapping segments of a signal, one after the other in time.
///
/// Each segment loses its mean, is weighted with a Hann window w and lengthened four-fold with zeros. With X its transform and W = sum of w:
///
///   one-sided (a force):            A(f) = 2 |X(f)| / W, f >= 0
///   two-sided (an orbit, y + i z):  A(f) = |X(f)| / W, f > 0 from +y towards +z
///
/// So a sine of amplitude a shows a at its frequency, and a circle of radius r shows r. Between two points of the spectrum a line is too low by at most
/// 1 - sinc(1/8) / (1 - 1/64) = 1.0 %. Two lines closer than two bins, 2 / (length of a segment), are not told apart.
/// Source: F.J. Harris (1978), On the use of windows for harmonic analysis with the discrete Fourier transform, Proc. IEEE 66.
///
/// Rows farther apart than 1 / (2 times the largest frequency that is wanted), or than the interval, cannot hold a vibration of that frequency: segments
/// with such rows are left out.
struct Waterfall {
  double segment = 0;               ///< length of a segment [s]
  double interval = 0;              ///< between samples [s]; the spectrum ends at the latest at 1 / (2 interval)
  double row_distance = 0;          ///< largest distance between rows in the segments [s]
  double longest_allowed = 0;       ///< distance between rows above which a segment is left out [s]
  std::vector<double> place_times;  ///< [n_places] middles of segments, those that are left out included [s]
  std::vector<std::size_t> places;  ///< [n_segments] which of them each segment is
  std::vector<std::array<double, 2>> uncovered;  ///< parts of the drop that are in no segment [s]
  std::vector<double> times;                     ///< [n_segments] middles of the segments [s]
  std::vector<double> frequencies;               ///< [n_frequencies] [Hz], rising, evenly spaced
  std::vector<std::vector<double>> amplitude;    ///< [n_segments][n_frequencies], unit of the signal, 0-peak

  [[nodiscard]] std::vector<double> largest() const;  ///< [n_frequencies] over all segments
  [[nodiscard]] std::vector<double> mean() const;     ///< [n_frequencies] root of the mean square over all segments
};

/// @param y, z        samples at the same times; without z the spectrum is one-sided. Rows that are not evenly spaced are interpolated linearly.
/// @param interval    [s] of the samples that are transformed, > 0
/// @param largest_frequency  [Hz] that is wanted
/// @returns without segments if the signal has fewer than 128 samples, or its rows are too far apart everywhere
[[nodiscard]] Waterfall waterfall(const TimeSeries& y, const TimeSeries* z, double interval, double largest_frequency);

}  // namespace rotordrop
