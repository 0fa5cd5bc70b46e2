#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "machine/machine_parameters.h"
#include "rotor/modal_analysis.h"

namespace rotordrop {

/// Properties of a rotor without supports.
struct RotorReport {
  RigidBody body;
  std::vector<double>
      free_free_frequencies;  ///< of the flexible modes of one plane at rest that take part in the run [Hz]
};
RotorReport rotor_report(const RotorParameters& rotor);

/// The modes whose coordinates a run records (/rotor/modal_y, /rotor/modal_z): displacement of node i = sum over k of shape[k][i] coordinate k.
struct RotorShapes {
  std::vector<double> frequency;           ///< [n_modes] [Hz]; 0 for translation and tilt
  std::vector<std::vector<double>> shape;  ///< [n_modes][n_nodes] [-]
};
/// @param stations  nodes at which supports stand (from 1)
RotorShapes rotor_shapes(const RotorParameters& rotor, const std::vector<int>& stations);

/// Supports of kinds added by others: their stiffness is not known without a motion, so they take no part in modes and critical speeds.
std::vector<std::string> supports_without_stiffness(const MachineParameters& parameters);
/// A sentence and a line's end about supports that are left out; empty if there are none.
std::string left_out_text(const std::vector<std::string>& supports);

/// Natural modes at constant spin with the case's linear supports; free-free if it has none. Touchdown bearings do not hold the
/// levitated rotor and take no part.
/// @param spin_speeds [rad/s]
/// @param largest_frequency  [Hz] up to which modes are wanted; the supports' nodes keep their flexibility
std::vector<WhirlModes> machine_modes(const MachineParameters& parameters, const std::vector<double>& spin_speeds,
                                      double largest_frequency = std::numeric_limits<double>::infinity());

/// What critical speeds are asked for.
struct CriticalSpeedOptions {
  double up_to = 0;  ///< [rad/s], > 0
  /// [N/m] of isotropic springs without damping at all stations, instead of the case's linear supports
  std::optional<double> stiffness;
  std::vector<double> map;  ///< [N/m] stiffnesses of all stations for a critical-speed map
  int n_speeds = 0;         ///< places of the Campbell diagram from 0 to up_to; 0: none
  bool is_coarse = false;   ///< all from the diagram's few modes: for pictures
};

/// Critical speeds of the rotor on linear supports, and what surrounds them; the rotor spins in the sense of
/// run.initial_speed.
struct CriticalSpeedReport {
  std::vector<std::string> stations;  ///< names of the supports that hold the rotor; empty: free-free
  std::vector<std::string> left_out;  ///< supports of kinds added by others, unless --stiffness puts springs there
  bool is_on_given_stiffness = false;
  std::vector<CriticalSpeed> speeds;
  int n_overdamped = 0;        ///< motions that creep back without oscillation at the highest speed
  int n_diverging = 0;         ///< motions that move away without oscillation at the highest speed
  double divergence_rate = 0;  ///< of the fastest of these [1/s]
  int n_rigid_body_modes = 0;
  std::vector<double> map_stiffness;            ///< [N/m]
  std::vector<std::vector<double>> map_speeds;  ///< [n_stiffness][*] undamped critical speeds up to up_to [rad/s]
  std::vector<double> diagram_speeds;           ///< [rad/s]
  std::vector<WhirlModes> diagram_modes;        ///< [n_speeds] from a basis of modes up to five times up_to
};

/// Stations are the case's linear supports; of a case without any, and with a given stiffness, the nodes of all its
/// bearings.
CriticalSpeedReport critical_speeds(const MachineParameters& parameters, const CriticalSpeedOptions& options);

}  // namespace rotordrop
