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
  // The root is met to 4e-4 as a sum of exponentials.
  for (const double t : {3. * step, 10. * step, 200. * step})
    EXPECT_NEAR(risen(t), rise(t, 0., step), 5e-4 * rise(t, 0., step));
  const double t = 20. * step, before = risen(t);
  heat_all_round(10. * step, 11. * step);
  const double more = rise(t, 10. * step, 11. * step);
  EXPECT_NEAR(risen(t) - before, more, 5e-4 * (before + more));
}

// Cells that were heated at times of their own, the last two at once, no whole numbers of intervals apart, looked at and heated again all at once: after
// some intervals, and after more than those whose decays are kept.
TEST(TrackMemory, EachCellDecaysByItsOwnLag) {
  const std::size_t n_cells = 90, n_heated = 13;
  const double cell = 2. * pi / n_cells, joules = 0.5, both = 2. * joules;
  const auto rise = [&](double t, double to) {
    return 2. * joules / (step * cell * steel.radius * width * steel.effusivity() * std::sqrt(pi)) *
           (std::sqrt(t - (to - step)) - std::sqrt(t - to));
  };
  for (const double later : {30.25, 300., 700.}) {
    TrackMemory track(steel, n_cells, 1, width, step, 0.1);
    std::vector<double> end;
    for (std::size_t k = 0; k + 2 < n_heated; ++k) {
      const double middle = (static_cast<double>(k) + 0.5) * cell;
      end.push_back((1. + static_cast<double>(k) * (k % 2 == 0 ? 1. : 1.37)) * step);
      track.add({middle, middle, 0.4999 * cell}, {&joules, 1, 1}, end.back(), step);
    }
    end.insert(end.end(), 2, 17.6 * step);
    const double between = static_cast<double>(n_heated - 1) * cell;
    track.add({between, between, 0.9999 * cell}, {&both, 1, 1}, end.back(), step);
    std::vector<double> found(n_heated + 1);
    const auto look = [&](double t) { track.rises({0.5 * cell, cell, n_heated + 1}, t, found.data(), n_heated + 1); };
    const double t = later * step;
    look(t);
    for (std::size_t k = 0; k < n_heated; ++k)
      EXPECT_NEAR(found[k], rise(t, end[k]), 1e-3 * rise(t, end[k])) << later << " " << k;
    EXPECT_EQ(found[n_heated], 0.);  // never heated
    const double all_round = n_cells * joules, now = t + 9.5 * step;
    track.add({0., 0., pi}, {&all_round, 1, 1}, t, step);
    look(now);
    for (std::size_t k = 0; k <= n_heated; ++k) {
      const double both_times = rise(now, t) + (k < n_heated ? rise(now, end[k]) : 0.);
      EXPECT_NEAR(found[k], both_times, 1e-3 * both_times) << later << " " << k;
    }
  }
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
