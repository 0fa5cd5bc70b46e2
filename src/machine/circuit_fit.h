#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "model/circuit_factors.h"
#include "model/reduced_heat.h"
#include "thermal/bearing_circuit.h"

namespace rotordrop {

struct CalibrationSettings {
  double from = 1e-3, until = 10.;  ///< responses to a step of heat are compared between these times [s]
  int n_times = 33;                 ///< spread evenly over the logarithm
};

/// Differences of the circuit's mean temperatures from those of the finite elements, over the largest mean rise that the same heat causes at
/// the same time: root mean square over all heat ports, nodes and times, and the largest.
struct ResponseError {
  double rms = 0, largest = 0;
};

struct CalibratedBearing {
  std::string name;
  CircuitFactors factors;
  ResponseError before, after;
  std::vector<std::pair<std::string, std::array<ResponseError, 2>>> nodes;  ///< before, after
};

/// Fits the factors of a bearing's circuit to the section's response: a step of heat into each port (rub into ring, rub into shaft, inner and
/// outer race) with convection from the housing left out of both. Factors start at 1; a fit that gains nothing from one leaves it there.
/// @param circuit   factors in it are not looked at
/// @throws SolverError if the fit does not converge
CalibratedBearing fit_circuit(const BearingCircuitData& circuit, const ReducedHeat& section, double ambient,
                              const CalibrationSettings& settings);

}  // namespace rotordrop
