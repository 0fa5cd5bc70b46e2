#include "bearing/cage_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "base/parameters/section.h"

namespace rotordrop {
namespace {

/// A cage's mass over that of its balls, if the case does not give its inertia: an estimate for machined cages.
constexpr double standard_cage_share = 0.2;

std::optional<FreeCage> free_cage(const TouchdownParameters& b, const TouchdownBearingData& d) {
  if (b.cage != CageModel::free) return {};
  const auto& row = d.rows.front();
  FreeCage cage;
  cage.n_balls = static_cast<double>(row.n_balls) * static_cast<double>(d.rows.size());
  cage.ball_mass = row.ball_mass;
  cage.ball_diameter = row.ball_diameter;
  cage.pitch_radius = 0.5 * row.pitch_diameter;
  cage.gamma = row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter;
  cage.inertia = b.cage_inertia.value_or(standard_cage_share * cage.n_balls * cage.ball_mass * cage.pitch_radius *
                                         cage.pitch_radius);
  cage.traction = b.race_traction;
  cage.slip = b.race_traction_slip;
  cage.pocket_friction = b.pocket_friction;
  return cage;
}

}  // namespace

void add_cage_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.choice("cage", &P::cage, {{"rolling", CageModel::rolling}, {"free", CageModel::free}},
           {.fallback = "rolling",
            .help = "rolling: balls roll, the cage turns with (1 - gamma)/2 of the inner ring's speed. free: cage and "
                    "balls have speeds of their own, driven by "
                    "the races' traction on balls that slip, so that they lag behind an inner ring that spins up; the "
                    "slip's heat enters both races. For "
                    "ball_model = \"quasi-static\"."});
  s.quantity("cage_inertia", &P::cage_inertia,
             {.unit = "kg m2",
              .range = at_least(0),
              .help = "Moment of inertia of a free cage (all rows) about the axis; that of a fifth of the balls' mass "
                      "on the pitch circle if not given, an estimate."});
  s.quantity("race_traction", &P::race_traction,
             {.range = positive(),
              .usual = between(0.01, 0.3),
              .fallback = "0.07",
              .source = "estimate, lubricated steel (Gupta 1984: 0.03 to 0.1); dry 0.1 to 0.3",
              .help = "Largest traction of races on slipping balls over their load, for a free cage."});
  s.quantity("race_traction_slip", &P::race_traction_slip,
             {.unit = "m/s",
              .range = positive(),
              .usual = between(0.01, 5),
              .fallback = "0.5 m/s",
              .source = "estimate: 2 to 3 % of a rolling speed of 20 m/s",
              .help = "Slip of balls and races at which traction has reached 76 % (tanh 1) of its largest value. Small "
                      "values shorten the integration's steps."});
  s.quantity("pocket_friction", &P::pocket_friction,
             {.range = at_least(0),
              .usual = or_zero(between(5e-3, 0.5)),
              .fallback = "0.1",
              .source = "estimate",
              .help = "Friction coefficient of balls in the pockets of a free cage."});
}

void set_free_cage(const TouchdownParameters& b, TouchdownBearingData& d) {
  d.free_cage = free_cage(b, d);
  if (!d.free_cage) return;
  const double rolling = d.free_cage->rolling_inertia();
  if (rolling >= d.ring_spin_inertia)
    throw InputError({},
                     fmt::format("bearings.{}: the ring_spin_inertia of {:.3g} kg m2 includes balls and cage, but "
                                 "these have {:.3g} kg m2 already.",
                                 d.name, d.ring_spin_inertia, rolling),
                     "Check ring_spin_inertia, ball_diameter, the balls' density and cage_inertia.");
  d.ring_spin_inertia -= rolling;
}

}  // namespace rotordrop
