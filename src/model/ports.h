#pragma once
// What parts of a machine hand to each other, of one drop or of eight in lanes. Plain data; every number SI.
// Frame: x along the rotor axis, y up, z horizontal, right-handed; angles and spin from +y towards +z.
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "base/real.h"

namespace rotordrop {

/// Motion of one station on the rotor (or of a ring). Tilts are small rotations about y and z.
template <class Real>
struct MotionOf {
  Real x = 0, y = 0, z = 0;                             ///< displacement [m]
  Real theta_y = 0, theta_z = 0;                        ///< tilt [rad]
  Real velocity_x = 0, velocity_y = 0, velocity_z = 0;  ///< [m/s]
  Real tilt_rate_y = 0, tilt_rate_z = 0;                ///< [rad/s]
};
using Motion = MotionOf<double>;

/// Rotation about +x.
template <class Real>
struct SpinOf {
  Real angle = 0;  ///< [rad]
  Real speed = 0;  ///< [rad/s]
};
using Spin = SpinOf<double>;

/// Force and moments on the part named where it is used.
template <class Real>
struct ForceOf {
  Real x = 0, y = 0, z = 0;         ///< [N]
  Real moment_y = 0, moment_z = 0;  ///< [N m]
  Real torque = 0;                  ///< about +x [N m]

  ForceOf& operator+=(const ForceOf& other) {
    x += other.x;
    y += other.y;
    z += other.z;
    moment_y += other.moment_y;
    moment_z += other.moment_z;
    torque += other.torque;
    return *this;
  }
};
using Force = ForceOf<double>;

/// Growth of the surfaces that clearances and preload see; positive outwards (every radius grows). [m]
/// A raceway's is the radial displacement of its contact points. Those at the axial position x from the bearing's middle move along the
/// axis by x / W times the growth of their ring's width W (all rows); docs/theory/growth.md.
template <class Real>
struct ExpansionOf {
  Real shaft = 0;        ///< rotor's contact surface
  Real bore = 0;         ///< inner ring's bore
  Real inner_race = 0;   ///< inner raceway
  Real outer_race = 0;   ///< outer raceway
  Real ball = 0;         ///< radius of a ball
  Real inner_width = 0;  ///< width of the inner ring(s)
  Real outer_width = 0;  ///< width of the outer ring(s)
  /// How much more the last row's inner raceway grows, less its outer one, than the first row's; inner_race and outer_race are means over
  /// the rows. Rows between them have their part of it by place.
  Real row_difference = 0;

  /// Sum of products; of a generalised force [N] with a growth rate [m/s] it is a power [W].
  [[nodiscard]] Real dot(const ExpansionOf& other) const {
    return shaft * other.shaft + bore * other.bore + inner_race * other.inner_race + outer_race * other.outer_race +
           ball * other.ball + inner_width * other.inner_width + outer_width * other.outer_width +
           row_difference * other.row_difference;
  }
};
using Expansion = ExpansionOf<double>;
/// Its surfaces, in the order in which results list them.
template <class Real>
inline constexpr std::array<Real ExpansionOf<Real>::*, 8> growth_surfaces_of = {
    &ExpansionOf<Real>::shaft,       &ExpansionOf<Real>::bore,          &ExpansionOf<Real>::inner_race,
    &ExpansionOf<Real>::outer_race,  &ExpansionOf<Real>::ball,          &ExpansionOf<Real>::inner_width,
    &ExpansionOf<Real>::outer_width, &ExpansionOf<Real>::row_difference};
inline constexpr auto growth_surfaces = growth_surfaces_of<double>;
inline constexpr std::array<const char*, growth_surfaces.size()> growth_surface_names = {
    "shaft", "bore", "inner race", "outer race", "ball radius", "inner width", "outer width", "row difference"};
/// The same as keys of reports.
inline constexpr std::array<const char*, growth_surfaces.size()> growth_surface_keys = {
    "shaft", "bore", "inner_race", "outer_race", "ball_radius", "inner_width", "outer_width", "row_difference"};
template <class Real>
std::array<Real, growth_surfaces.size()> growth_values(const ExpansionOf<Real>& e) {
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
inline Expansion expansion_of(const std::array<double, growth_surfaces.size()>& v) {
  return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}
/// f a + g b
template <class Real>
ExpansionOf<Real> combined(double f, const ExpansionOf<Real>& a, const std::type_identity_t<Real>& g,
                           const std::type_identity_t<ExpansionOf<Real>>& b) {
  ExpansionOf<Real> sum;
  for (const auto surface : growth_surfaces_of<Real>) sum.*surface = f * a.*surface + g * b.*surface;
  return sum;
}

/// Conductances that the balls of a bearing make as they roll, by their loads and speed [W/K].
template <class Real>
struct BallConductionOf {
  Real inner_to_ball = 0, outer_to_ball = 0;  ///< race to the balls' bulk
  Real inner_to_outer = 0;                    ///< race to race, without warming the balls
};
using BallConduction = BallConductionOf<double>;

/// What one row of balls releases by its friction, and conducts.
template <class Real>
struct RowHeatOf {
  Real inner = 0, outer = 0;  ///< at its races [W]
  BallConductionOf<Real> balls;
};
using RowHeat = RowHeatOf<double>;

/// Heat that a bearing releases, by port, and what a law for sharing it needs to know.
template <class Real>
struct HeatInputOf {
  Real rub = 0;            ///< H_r: rotor surface against bore [W] (eq. 19)
  Real rub_into_ring = 0;  ///< part of H_r that enters the ring, the rest enters the rotor [W]; the machine divides it
  Real inner = 0;          ///< H_i: balls against inner race [W] (eq. 24, energy-consistent form)
  Real outer = 0;          ///< H_o: balls against outer race [W]
  Real rotor_surface_speed = 0;        ///< speed of the rotor's surface relative to the rubbing spot [m/s]
  Real ring_surface_speed = 0;         ///< speed of the bore's surface relative to the rubbing spot [m/s]
  MaskOf<Real> is_in_contact = false;  ///< rotor and bore touch
  BallConductionOf<Real> balls;        ///< no heat, but a way for it; zeros unless balls conduct as they roll
  /// The same by row, for models that heat rows apart; they add up to inner, outer and balls. Else none.
  std::vector<RowHeatOf<Real>> rows = {};
};
using HeatInput = HeatInputOf<double>;

}  // namespace rotordrop
