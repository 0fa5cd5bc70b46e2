#pragma once
// The two touchdown bearings of the reference case, and others, as plain numbers.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bearing/row/ball_row.h"
#include "bearing/touchdown_bearing.h"
#include "laws/hertz.h"

namespace rotordrop::testing {

using std::numbers::pi;
inline constexpr double deg = pi / 180., um = 1e-6;
inline const ElasticMaterial steel{2.0e11, 0.30}, silicon_nitride{3.15e11, 0.26};

/// A row with grooves of 0.52 d and the fits' Hertz stiffness.
inline BallRowGeometry row(int n_balls, double d, double d_m, double contact_angle, const ElasticMaterial& ball,
                           EllipticIntegrals method = EllipticIntegrals::brewe_hamrock) {
  BallRowGeometry g;
  g.n_balls = n_balls;
  g.ball_diameter = d;
  g.pitch_diameter = d_m;
  g.inner_conformity = g.outer_conformity = 0.52;
  g.contact_angle = contact_angle;
  const double modulus = effective_modulus(steel, ball), projected = 0.5 * d * std::cos(contact_angle);
  const auto race = [&](const ContactGeometry& c) {
    return RaceContact{hertz_stiffness(c, modulus, method), semi_major_axis_factor(c, modulus, method),
                       contact_ellipse(c, method).k};
  };
  g.inner = race(inner_race_contact(d, 0.5 * d_m - projected, 0.52));
  g.outer = race(outer_race_contact(d, 0.5 * d_m + projected, 0.52));
  g.stiffness = stiffness_in_series(g.inner.stiffness, g.outer.stiffness);
  g.ball_mass = (&ball == &silicon_nitride ? 3200. : 7800.) * pi / 6. * d * d * d;
  return g;
}

/// TB1: 6014 with ceramic balls, C3.
inline BallRowGeometry deep_groove_row() {
  auto g = row(14, 11.906e-3, 90e-3, 0., silicon_nitride);
  g.radial_clearance = 19 * um;
  return g;
}

enum class Pair { X, O, tandem };
/// Two rows of a preloaded set, `spacing` apart.
inline std::vector<BallRowGeometry> pair(BallRowGeometry one, double preload, Pair arrangement = Pair::X,
                                         double spacing = 16e-3) {
  one.preload_offset = BallRow::offset_for_axial_load(one, preload);
  std::vector<BallRowGeometry> rows(2, one);
  rows[0].position = -0.5 * spacing;
  rows[1].position = 0.5 * spacing;
  rows[0].difference_share = -0.5;
  rows[1].difference_share = 0.5;
  // X: face to face, the inner rings are pressed apart by their balls' reaction: the row at +x is loaded by motion towards +x.
  rows[0].direction = arrangement == Pair::X ? -1. : 1.;
  rows[1].direction = arrangement == Pair::O ? -1. : 1.;
  rows[1].phase = pi / one.n_balls;
  return rows;
}

/// TB2: two 71914, 25 deg, X, 290 N.
inline std::vector<BallRowGeometry> angular_contact_pair(double preload = 290., Pair arrangement = Pair::X) {
  return pair(row(23, 9.525e-3, 85e-3, 25 * deg, steel), preload, arrangement);
}

inline TouchdownBearingData touchdown(std::string name, std::vector<BallRowGeometry> rows) {
  TouchdownBearingData d;
  d.name = std::move(name);
  d.rows = std::move(rows);
  for (auto& r : d.rows) r.damping_beta = 2.5e-5;
  d.ring_mass = 0.21;
  d.ring_spin_inertia = 3.4e-4;
  d.bore_radius = 35e-3;
  d.rotor_radius = 34.75e-3;
  d.air_gap = 250 * um;
  d.contact = {1.144e9, 10. / 9., 0.08};
  d.friction = {0.1, 0.05, 0., 1., false};
  d.f1_z = 0.001;
  d.f1_y = 0.33;
  d.static_rating = 31e3;
  d.f2 = 0.25;
  d.width = 32e-3;
  d.drag_viscosity = 15e-6;
  d.drag_regularisation = 2.;
  d.race_friction_coefficient = 0.1;
  d.spin_axis_factor = 6e-5;
  d.spin_elliptic_integral = 1.02;
  d.support_mass = 50.;
  d.support_stiffness_y = 1.5e9;
  d.support_stiffness_z = 1.1e9;
  d.support_damping_y = 2.82e3;
  d.support_damping_z = 3.68e3;
  d.gravity_y = -9.81;
  return d;
}

/// Rings of 35 to 39 mm and 20 mm width; the outer one, if it bends, on a bedding.
inline BentRings bent(RingBendingModel model, int highest, bool has_outer, double gap) {
  RingSection s;
  s.inner_radius = 35e-3;
  s.outer_radius = 39e-3;
  s.width = 20e-3;
  s.E = 2e11;
  s.nu = 0.3;
  s.rho = 7800.;
  BentRings b;
  b.model = model;
  b.inner = ring_harmonics(s, highest);
  if (has_outer) {
    b.outer = b.inner;
    for (auto& h : b.outer) h.stiffness += 2e8;
  }
  b.damping_ratio = 0.02;
  b.frequency_limit = 20e3;
  b.arc = ArcContact(1.144e9, 10. / 9., gap);
  return b;
}

}  // namespace rotordrop::testing
