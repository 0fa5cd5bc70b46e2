#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "io/hdf5/recorder.h"
#include "model/heat_conduction.h"
#include "model/thermo_elasticity.h"
#include "thermal/heating/heat_parameters.h"

namespace rotordrop {

/// Displacements and fits of plain sections under the temperatures of `rotordrop heat`, by elasticity on conduction's mesh.
class HeatDisplacements {
 public:
  /// @throws SolverError if no state of the fits is found
  HeatDisplacements(const HeatElasticStudy& study, const HeatConductionSolver& conduction);
  /// Solves under the present field, and appends what stands in a row of results.h5.
  void observe(const HeatConductionSolver& conduction, std::vector<double>& row);
  /// Adds `displacements` and `fits`.
  /// @param times  of the rows so far [s]
  void report(const std::vector<double>& times, nlohmann::ordered_json& to) const;

 private:
  const HeatElasticStudy& study_;
  std::unique_ptr<ElasticSolver> solver_;
  std::vector<std::vector<AxialRadial>> displacements_;  ///< [n_displacements][n_rows]
  std::vector<std::vector<FitState>> fits_;              ///< [n_fits][n_rows], without points
};

void append_displacement_channels(const HeatElasticStudy& study, std::vector<Channel>& channels);

}  // namespace rotordrop
