#include "bearing/row/race_waves.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

/// @param sine, cosine, added, rate  [n], whole vectors
ROTORDROP_KERNEL void add_wave(const PassedWaveOf<double>& passed, const double* sine, const double* cosine,
                               std::size_t n, double* added, double* rate) {
  const PassedWaveOf<double> p = passed;  // what is written below cannot change it
  for (std::size_t first = 0; first < n; first += vector_length)
#pragma omp simd
    for (std::size_t i = first; i < first + vector_length; ++i) {
      added[i] += p.wave.height(sine[i], cosine[i]);
      rate[i] += p.speed * p.wave.slope(sine[i], cosine[i]);
    }
}

}  // namespace

RaceWaves::RaceWaves(const std::vector<RaceWave>& waves, std::span<const double> azimuths) {
  for (const RaceWave& form : waves) {
    Wave wave{form, {}, {}};
    for (const double azimuth : azimuths) {
      wave.sine.push_back(std::sin(form.order * azimuth));
      wave.cosine.push_back(std::cos(form.order * azimuth));
    }
    wave.sine.resize(filled_up(azimuths.size()), 0.);
    wave.cosine.resize(wave.sine.size(), 0.);
    waves_.push_back(std::move(wave));
  }
}

void RaceWaves::at_balls(const BallRowInput& in, WavesAtBalls& at) const {
  const std::size_t n = waves_.front().sine.size();
  for (auto* list : {&at.inner, &at.outer, &at.inner_rate, &at.outer_rate}) std::fill_n(list->begin(), n, 0.);
  for (const Wave& w : waves_) {
    const PassedWaveOf<double> passed(w.form, w.form.amplitude, w.form.phase, in);
    auto& added = w.form.on_inner_race ? at.inner : at.outer;
    auto& rate = w.form.on_inner_race ? at.inner_rate : at.outer_rate;
    wide<add_wave>(passed, w.sine.data(), w.cosine.data(), n, added.data(), rate.data());
  }
}

}  // namespace rotordrop
