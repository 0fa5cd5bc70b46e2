#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "machine/finite_elements.h"
#include "model/circuit_factors.h"
#include "study/case.h"
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
CalibratedBearing calibrate(const BearingCircuitData& circuit, const ReducedHeat& section, double ambient,
                            const CalibrationSettings& settings);

/// All touchdown bearings of a case.
/// @throws InputError if the case has none
std::vector<CalibratedBearing> calibrate(const Case& c, const CalibrationSettings& settings);

/// A parameter file that builds on the case and holds the factors.
std::string calibration_file(const Case& c, const std::filesystem::path& file,
                             const std::vector<CalibratedBearing>& bearings, const CalibrationSettings& settings);
std::string calibration_text(const std::vector<CalibratedBearing>& bearings);

}  // namespace rotordrop
