#pragma once
// What parts of a machine hand to each other. Plain data; every number SI.
// Frame: x along the rotor axis, y up, z horizontal, right-handed; angles and spin from +y towards +z.
#include <array>
#include <span>
#include <vector>

namespace rotordrop {

/// Motion of one station on the rotor (or of a ring). Tilts are small rotations about y and z.
struct Motion {
  double x = 0, y = 0, z = 0;                             ///< displacement [m]
  double theta_y = 0, theta_z = 0;                        ///< tilt [rad]
  double velocity_x = 0, velocity_y = 0, velocity_z = 0;  ///< [m/s]
  double tilt_rate_y = 0, tilt_rate_z = 0;                ///< [rad/s]
};

/// Rotation about +x.
struct Spin {
  double angle = 0;  ///< [rad]
  double speed = 0;  ///< [rad/s]
};

/// Force and moments on the part named where it is used.
struct Force {
  double x = 0, y = 0, z = 0;         ///< [N]
  double moment_y = 0, moment_z = 0;  ///< [N m]
  double torque = 0;                  ///< about +x [N m]
};

/// Growth of the surfaces that clearances and preload see; positive outwards (every radius grows). [m]
/// A raceway's is the radial displacement of its contact points. Those at the axial position x from the bearing's middle move along the
/// axis by x / W times the growth of their ring's width W (all rows); docs/theory/growth.md.
struct Expansion {
  double shaft = 0;        ///< rotor's contact surface
  double bore = 0;         ///< inner ring's bore
  double inner_race = 0;   ///< inner raceway
  double outer_race = 0;   ///< outer raceway
  double ball = 0;         ///< radius of a ball
  double inner_width = 0;  ///< width of the inner ring(s)
  double outer_width = 0;  ///< width of the outer ring(s)
  /// How much more the last row's inner raceway grows, less its outer one, than the first row's; inner_race and outer_race are means over
  /// the rows. Rows between them have their part of it by place.
  double row_difference = 0;

  /// Sum of products; of a generalised force [N] with a growth rate [m/s] it is a power [W].
  [[nodiscard]] double dot(const Expansion& other) const {
    return shaft * other.shaft + bore * other.bore + inner_race * other.inner_race + outer_race * other.outer_race +
           ball * other.ball + inner_width * other.inner_width + outer_width * other.outer_width +
           row_difference * other.row_difference;
  }
};
/// Its surfaces, in the order in which results list them.
inline constexpr std::array<double Expansion::*, 8> growth_surfaces = {
    &Expansion::shaft, &Expansion::bore,        &Expansion::inner_race,  &Expansion::outer_race,
    &Expansion::ball,  &Expansion::inner_width, &Expansion::outer_width, &Expansion::row_difference};
inline constexpr std::array<const char*, growth_surfaces.size()> growth_surface_names = {
    "shaft", "bore", "inner race", "outer race", "ball radius", "inner width", "outer width", "row difference"};
/// The same as keys of reports.
inline constexpr std::array<const char*, growth_surfaces.size()> growth_surface_keys = {
    "shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference"};
inline std::array<double, growth_surfaces.size()> growth_values(const Expansion& e) {
  return {e.shaft, e.bore, e.inner_race, e.outer_race, e.ball, e.inner_width, e.outer_width, e.row_difference};
}
/// Whether results of this or an earlier version have so many surfaces: five while growth was radial only, seven while all rows grew alike.
constexpr bool is_number_of_surfaces(std::size_t n) { return n == 5 || n == 7 || n == growth_surfaces.size(); }
/// @param values  of growth_surfaces; those that an earlier version did not have may be missing, and are zero
inline Expansion expansion_of(std::span<const double> values) {
  Expansion e;
  for (std::size_t k = 0; k < values.size(); ++k) e.*growth_surfaces.at(k) = values[k];
  return e;
}
/// f a + g b
inline Expansion combined(double f, const Expansion& a, double g, const Expansion& b) {
  Expansion sum;
  for (const auto surface : growth_surfaces) sum.*surface = f * a.*surface + g * b.*surface;
  return sum;
}

/// Conductances that the balls of a bearing make as they roll, by their loads and speed [W/K].
struct BallConduction {
  double inner_to_ball = 0, outer_to_ball = 0;  ///< race to the balls' bulk
  double inner_to_outer = 0;                    ///< race to race, without warming the balls
};

/// What one row of balls releases by its friction, and conducts.
struct RowHeat {
  double inner = 0, outer = 0;  ///< at its races [W]
  BallConduction balls;
};

/// Heat that a bearing releases, by port, and what a law for sharing it needs to know.
struct HeatInput {
  double rub = 0;  ///< H_r: rotor surface against bore [W] (eq. 19)
  double rub_into_ring =
      0;             ///< part of H_r that enters the ring, the rest enters the rotor [W]; the machine divides it
  double inner = 0;  ///< H_i: balls against inner race [W] (eq. 24, energy-consistent form)
  double outer = 0;  ///< H_o: balls against outer race [W]
  double rotor_surface_speed = 0;  ///< speed of the rotor's surface relative to the rubbing spot [m/s]
  double ring_surface_speed = 0;   ///< speed of the bore's surface relative to the rubbing spot [m/s]
  bool is_in_contact = false;      ///< rotor and bore touch
  BallConduction balls;            ///< no heat, but a way for it; zeros unless balls conduct as they roll
  /// The same by row, for models that heat rows apart; they add up to inner, outer and balls. Else none.
  std::vector<RowHeat> rows = {};
};

}  // namespace rotordrop
