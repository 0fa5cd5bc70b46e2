// Heat that a track remembers, by closed forms.
#include "laws/heat/track_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace rotordrop;
using std::numbers::pi;

const RubbedBody steel = {0.035, 45., 3.7e6};
constexpr double width = 0.02, step = 50e-6;

// One cell, asked again: later, and at the same time after more heat. Under the flux q from t_1 to t_2 a half space rises by
// 2 q/(e sqrt(pi)) (sqrt(t - t_1) - sqrt(t - t_2)) (Carslaw & Jaeger 2.9).
TEST(TrackMemory, AnswersForTheTimeAndTheHeatOfEachQuestion) {
  TrackMemory track(steel, 90, 1, width, step, 0.1);
  const double joules = 40., area = 2. * pi * steel.radius * width;
  const auto rise = [&](double t, double from, double to) {
    return 2. * joules / ((to - from) * area * steel.effusivity() * std::sqrt(pi)) *
           (std::sqrt(t - from) - std::sqrt(t - to));
  };
  const auto risen = [&](double t) {
    double found = 0.;
    track.rises({1., 0., 1}, t, &found, 1);
    return found;
  };
  const auto heat_all_round = [&](double from, double to) { track.add({0., 0., pi}, {&joules, 1, 1}, to, to - from); };
  heat_all_round(0., step);
  for (const double t : {3. * step, 10. * step, 200. * step})
    EXPECT_NEAR(risen(t), rise(t, 0., step), 1e-3 * rise(t, 0., step));
  const double t = 20. * step, before = risen(t);
  heat_all_round(10. * step, 11. * step);
  const double more = rise(t, 10. * step, 11. * step);
  EXPECT_NEAR(risen(t) - before, more, 1e-3 * (before + more));
}

TEST(TrackMemory, KeepsWhatABandGivesOffInSeveralTurns) {
  const std::size_t n_cells = 90;
  for (const double way : {0.5, 6., 20.}) {
    TrackMemory track(steel, n_cells, 2, width, step, 0.1);
    const std::vector<double> joules = {40., 3.};
    track.add({0.3, 0.3 + way, 0.2}, {joules.data(), 1, 2}, step, step);
    std::vector<double> share(n_cells);
    spread_over_cells(n_cells, 0.3, 0.3 + way, 0.2, [&](std::size_t cell, double part) { share[cell] += part; });
    for (std::size_t flux = 0; flux < 2; ++flux)
      for (std::size_t cell = 0; cell < n_cells; ++cell)
        EXPECT_NEAR(track.heat(flux)[cell], joules[flux] * share[cell], 1e-12) << way << " " << cell;
  }
}

}  // namespace
