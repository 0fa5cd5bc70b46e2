#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "model/circuit_factors.h"
#include "model/reduced_heat.h"
#include "thermal/circuit/bearing_circuit.h"

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

/// A factor that calibration may change: of a resistance that neither geometry nor material fixes.
struct UncertainResistance {
  const char* name;  ///< as in circuit_factors
  double CircuitFactors::*member;
  const char* words;  ///< what it stands on
  double lowest = 0, highest = 0;
};

/// The four resistances that a fit may change, within bounds. Capacities follow from volumes and materials and stay. R5, balls to races, and the convections
/// stay too: the finite elements have the very same ones, so that a fit to them would put another resistance's error there.
/// - R2 + R3 and R8 hold contacts (shaft and bore, ring and housing): by half to twice.
/// - R4 and R7 with their spreading are as good as its closed form, a fifth: 0.8 to 1.25; without spreading up to 1.25 times the one with it.
/// @param spreading  the same bearing with strips on its raceways
std::vector<UncertainResistance> uncertain_resistances(const BearingCircuitData& circuit,
                                                       const BearingCircuitData& spreading);

struct CalibratedBearing {
  std::string name;
  CircuitFactors factors;
  ResponseError before, after;
  std::vector<std::pair<std::string, std::array<ResponseError, 2>>> nodes;  ///< before, after
  struct Resistance {
    UncertainResistance uncertain;
    double rms_without = 0;  ///< of the responses with this factor back at 1, the others fitted
    bool is_at_lowest = false, is_at_highest = false;  ///< the fit would go on
  };
  std::vector<Resistance> resistances;
  double elements_error = 0;  ///< of the section's modes: largest error of their responses
  /// The resistance whose factor takes most of the error; none if no factor takes any.
  [[nodiscard]] const Resistance* carrier() const;
};

/// Fits the factors of a bearing's resistances to the section's response: a step of heat into each port (rub into ring, rub into shaft, inner and
/// outer race) with convection from the housing left out of both. Factors start at 1; a fit that gains nothing from one leaves it there.
/// @param circuit    of its factors those of capacities are kept, the others not looked at
/// @param uncertain  what may change; 1 lies within every factor's bounds
/// @throws SolverError if the fit does not converge
CalibratedBearing fit_circuit(const BearingCircuitData& circuit, const ReducedHeat& section, double ambient,
                              const CalibrationSettings& settings, const std::vector<UncertainResistance>& uncertain);

}  // namespace rotordrop
