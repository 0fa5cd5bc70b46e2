#pragma once
// From a case's parameters to the loop of one of its bearings.
#include <memory>
#include <string>

#include "analysis/preload/preload_criterion.h"

namespace rotordrop {

/// Changes to a case's bearing, all as factors.
struct PreloadVariation {
  double speed = 1;    ///< of preload.speed
  double preload = 1;  ///< of the mounted preload
  double cooling = 1;  ///< of every way to ambient
};

/// A touchdown bearing of a checked case on its lumped circuit, what a user added included.
/// @param section  instead of the circuit: a thermal model of this bearing alone; then the cooling cannot be changed
std::unique_ptr<PreloadLoop> build_preload_loop(const MachineParameters& parameters, const Node& case_node,
                                                const std::string& bearing, const FindRest& find,
                                                const PreloadVariation& variation = {},
                                                std::shared_ptr<const ThermalModel> section = nullptr);
/// The same bearing alone; `speed` [rad/s].
std::unique_ptr<TouchdownRunning> build_running_bearing(const MachineParameters& parameters, const std::string& bearing,
                                                        double speed, const FindRest& find, double preload_factor = 1);

PreloadLimits preload_limits(const PreloadParameters& preload);

}  // namespace rotordrop
