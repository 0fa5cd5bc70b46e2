#pragma once
// The table [rotor] of a case.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/node.h"
#include "base/parameters/section.h"
#include "rotor/geometry.h"
#include "rotor/geometry_parameters.h"
#include "rotor/modal_rotor.h"
#include "rotor/probe_parameters.h"
#include "rotor/windage.h"

namespace rotordrop {

/// Circular orbit of the centre of gravity at the start; the rotor keeps its direction.
struct InitialOrbit {
  double radius = 0;  ///< [m]
  double angle = 0;   ///< of the start, from +y towards +z [rad]
  double speed = 0;   ///< whirl speed, positive from +y towards +z [rad/s]
};

enum class AxialFreedom { locked, free };

struct RotorParameters {
  std::string geometry_file;         ///< as the user wrote it; empty: `geometry` was given inline
  SourcePosition geometry_position;  ///< of the value of the key `geometry`
  RotorGeometry geometry;            ///< empty as long as geometry_file has not been read
  RotorRepresentation model = RotorRepresentation::modal;
  double modal_damping = 0;
  double mass_proportional_alpha = 0;  ///< [1/s]
  double cut_off_frequency = 0;        ///< [Hz]
  bool residual_flexibility = false;
  std::vector<Unbalance> unbalance;        ///< given, or by the balance grade
  std::optional<double> balance_grade;     ///< e_per omega of ISO 21940-11 [m/s]
  std::optional<double> balance_speed;     ///< for which the grade is [rad/s]; the rotor's at the start
  std::vector<int> balance_planes;         ///< one or two nodes; none: those of the outermost bearings
  std::array<double, 2> balance_angles{};  ///< of the planes' unbalances at spin angle 0 [rad]
  TimeTable torque;                        ///< [N m]
  std::optional<WindageParameters> windage;
  AxialFreedom axial_motion = AxialFreedom::locked;
  TimeTable axial_force;  ///< along +x [N]
  // What the start adds to the rotor's straight line through both ring centres, at rest.
  std::array<double, 2> initial_offset{};     ///< y, z of the centre of gravity [m]
  std::array<double, 2> initial_tilt{};       ///< theta_y, theta_z [rad]
  std::array<double, 2> initial_velocity{};   ///< y, z of the centre of gravity [m/s]
  std::array<double, 2> initial_tilt_rate{};  ///< about y, z [rad/s]
  InitialOrbit initial_orbit;
  double initial_angle = 0;  ///< spin angle at the start, which says where unbalances are [rad]
  ProbeList probes;
};

[[nodiscard]] Section<RotorParameters> rotor_section();

/// Faults of [rotor] that only show once the geometry is known.
/// @param rotor_table  the node of [rotor], for positions
void check_against_geometry(const RotorParameters& parameters, const RotorGeometry& geometry, const Node& rotor_table,
                            Faults& faults);

/// @param gravity  along x, y, z [m/s^2]
[[nodiscard]] RotorSettings rotor_settings(const RotorParameters& parameters, const std::array<double, 3>& gravity);
/// Offset, tilt, velocities and orbit at the start, to be added to the straight line through the rings' centres.
[[nodiscard]] Motion initial_disturbance(const RotorParameters& parameters);

}  // namespace rotordrop
