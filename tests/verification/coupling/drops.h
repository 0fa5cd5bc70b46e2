#pragma once
// Drops of the reference case with finite elements, run in a folder of their own.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "case/case.h"
#include "case/modules/fe_module.h"
#include "io/hdf5/recorded_series.h"
#include "machine/build_machine.h"
#include "study/drop/drop_run.h"

namespace rotordrop::testing {

struct Drop {
  Case settings;
  FiniteElements elements;
  std::unique_ptr<Machine> machine;
};

inline std::unique_ptr<Drop> settling_drop(const std::vector<std::string>& overrides) {
  auto drop = std::make_unique<Drop>(
      Drop{read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019-settling.toml", overrides), {}, nullptr});
  drop->elements = finite_elements_of(drop->settings);
  drop->machine = build_machine(drop->settings.parameters, drop->settings.tree, &drop->elements);
  return drop;
}

/// A mesh so small that all of its modes fit into the state vector.
inline std::vector<std::string> small_mesh(std::vector<std::string> overrides) {
  for (const char* set : {"thermal.models=[\"fe\"]", "thermal.fe.section=plain", "thermal.fe.degree=1",
                          "thermal.fe.refinement=0.25", "run.end_time=20 ms"})
    overrides.emplace_back(set);
  return overrides;
}

struct Finished {
  DropResult result;
  std::vector<std::vector<double>> growth;  ///< of each bearing [n_times * 5]
  std::vector<double> bore_times, bore;     ///< [s] and mean temperature [K] of TB1's bore, as recorded
};

inline Finished run(const std::vector<std::string>& overrides, const std::string& name) {
  auto drop = settling_drop(overrides);
  RunOptions options;
  options.directory = std::filesystem::path(::testing::TempDir()) / ("rotordrop-" + name + std::to_string(getpid()));
  options.force = true;
  options.elements = &drop->elements;
  Finished finished{run_drop(drop->settings, *drop->machine, options), {}, {}, {}};
  for (const char* bearing : {"TB1", "TB2"})
    finished.growth.push_back(
        read_series(options.directory / "results.h5", std::string("/bearings/") + bearing + "/expansion").values);
  const auto results = options.directory / "results.h5";
  const bool is_windowed = drop->elements.coupling == FeCoupling::windowed;
  finished.bore_times = read_series(results, is_windowed ? "/windows/time" : "/time").values;
  const auto surface = read_series(results, is_windowed ? "/windows/TB1/bore" : "/fe/TB1/bore").values;
  for (std::size_t i = 0; i < surface.size(); i += 3) finished.bore.push_back(surface[i]);
  std::filesystem::remove_all(options.directory);
  return finished;
}

/// Largest difference of growth over the largest growth.
inline double difference(const Finished& a, const Finished& b) {
  double largest = 0., different = 0.;
  for (std::size_t k = 0; k < a.growth.size(); ++k)
    for (std::size_t i = 0; i < std::min(a.growth[k].size(), b.growth[k].size()); ++i) {
      largest = std::max(largest, std::fabs(a.growth[k][i]));
      different = std::max(different, std::fabs(a.growth[k][i] - b.growth[k][i]));
    }
  return different / largest;
}

}  // namespace rotordrop::testing
