#include "bearing/touchdown_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace rotordrop {

void check_geometry(const TouchdownParameters& b, const Node& table, const std::string& path, Faults& faults) {
  const auto mm = [](double metres) { return fmt::format("{:.6g} mm", metres * 1e3); };
  const auto fault = [&](const char* key, const std::string& message, const std::string& advice = "") {
    faults.add(position_of_value(table, key), fmt::format("{}: {}.", path, message), advice);
  };
  const double circumference = b.balls_per_row * b.ball_diameter;
  if (circumference > std::numbers::pi * b.pitch_diameter)
    fault("balls_per_row",
          fmt::format("{} balls of {} do not fit on a pitch circle of {}", b.balls_per_row, mm(b.ball_diameter),
                      mm(b.pitch_diameter)),
          "Check balls_per_row, ball_diameter and pitch_diameter.");
  const auto rising = [&](const char* key, const std::array<double, 2>& pair) {
    if (!(pair[0] < pair[1]))
      fault(key, fmt::format("{} = [{}, {}]: the second must be larger than the first", key, mm(pair[0]), mm(pair[1])));
    return pair[0] < pair[1];
  };
  const bool inner_rises = rising("inner_ring_diameters", b.inner_ring_diameters);
  const bool outer_rises = rising("outer_ring_diameters", b.outer_ring_diameters);
  const bool housing_rises = rising("housing_diameters", b.housing_diameters);
  if (inner_rises && outer_rises && housing_rises) {
    if (!(b.inner_ring_diameters[1] < b.pitch_diameter))
      fault("inner_ring_diameters",
            fmt::format("the inner ring's outside diameter {} is not smaller than the pitch_diameter {}",
                        mm(b.inner_ring_diameters[1]), mm(b.pitch_diameter)),
            "The inner ring must lie inside the pitch circle of its balls; check that both dimensions come from the "
            "same drawing.");
    if (!(b.outer_ring_diameters[0] > b.pitch_diameter))
      fault("outer_ring_diameters",
            fmt::format("the outer ring's inside diameter {} is not larger than the pitch_diameter {}",
                        mm(b.outer_ring_diameters[0]), mm(b.pitch_diameter)),
            "The outer ring must lie outside the pitch circle of its balls; check that both dimensions come from the "
            "same drawing.");
    if (b.housing_diameters[1] <= b.outer_ring_diameters[1])
      fault(
          "housing_diameters",
          fmt::format("the housing's outside diameter {} is not larger than the outer ring's {}",
                      mm(b.housing_diameters[1]), mm(b.outer_ring_diameters[1])),
          fmt::format("Give the housing of this bearing: housing_diameters = [\"{}\", \"...\"], its bore and outside.",
                      mm(b.outer_ring_diameters[1])));
    else if (std::abs(b.housing_diameters[0] - b.outer_ring_diameters[1]) > 0.01 * b.outer_ring_diameters[1])
      fault("housing_diameters",
            fmt::format("the housing's bore {} does not fit the outer ring's outside diameter {}",
                        mm(b.housing_diameters[0]), mm(b.outer_ring_diameters[1])),
            "The ring sits in the housing; count a sleeve between them as part of the housing.");
    const double projected = b.ball_diameter * std::cos(b.contact_angle);
    if (b.pitch_diameter - projected <= b.inner_ring_diameters[0])
      fault("ball_diameter",
            fmt::format("balls of {} on a pitch circle of {} reach into the bore of {}", mm(b.ball_diameter),
                        mm(b.pitch_diameter), mm(b.inner_ring_diameters[0])),
            "Check ball_diameter, pitch_diameter and inner_ring_diameters.");
    if (b.pitch_diameter + projected >= b.outer_ring_diameters[1])
      fault("ball_diameter",
            fmt::format("balls of {} on a pitch circle of {} reach out of the outer ring of {}", mm(b.ball_diameter),
                        mm(b.pitch_diameter), mm(b.outer_ring_diameters[1])),
            "Check ball_diameter, pitch_diameter and outer_ring_diameters.");
  }
  if (const auto& radius = b.shoulders.radius;
      radius && !b.shoulders.stiffness &&
      !(2. * *radius > b.inner_ring_diameters[0] && 2. * *radius < b.inner_ring_diameters[1]))
    fault("shoulders",
          fmt::format("shoulders.radius = {} is not on the inner ring's face, which reaches from {} to {}", mm(*radius),
                      mm(0.5 * b.inner_ring_diameters[0]), mm(0.5 * b.inner_ring_diameters[1])),
          "Check the radius, or give shoulders.stiffness.");
  const double A = (b.conformity[0] + b.conformity[1] - 1.) * b.ball_diameter;
  if (b.radial_clearance >= A * std::cos(b.contact_angle))
    fault("radial_clearance",
          fmt::format("radial_clearance = {} is not smaller than the distance of the groove centres, {}",
                      mm(b.radial_clearance), mm(A)));
  if (b.preload > 0. && b.contact_angle == 0.)
    fault("preload", fmt::format("preload = {:.6g} N on a bearing with contact_angle = 0", b.preload),
          "Balls at a contact angle of zero take no axial load: give a contact_angle, or no preload.");
  else if (b.preload > 0. && b.radial_clearance > 0.)
    fault("radial_clearance",
          fmt::format("radial_clearance = {} on a bearing with preload = {:.6g} N, which closes it",
                      mm(b.radial_clearance), b.preload),
          "Leave out one of the two.");
  if (b.rows > 2 && b.arrangement != RowArrangement::tandem)
    fault("arrangement", fmt::format("{} rows can only be in tandem", b.rows),
          "Allowed: X, O with rows = 2; tandem with any.");
  const bool is_opposed = b.rows == 2 && b.arrangement != RowArrangement::tandem;
  if (b.ring_motion == RingMotion::free && b.contact_angle != 0. && !is_opposed)
    fault("ring_motion",
          "ring_motion = \"free\" with rows whose contact angles all point the same way: their balls push the ring off "
          "axially and nothing holds it",
          "Take two rows in X or O, a contact_angle of 0, or ring_motion = \"translations\".");
  if (b.ring_motion != RingMotion::free && b.shoulders.any())
    fault("shoulders", "shoulders beside a ring that cannot move along the axis", "Set ring_motion = \"free\".");
  // The ring's mass at half the pitch radius spins with a quarter of a hoop's inertia; balls and cage add less than the ring has.
  const double hoop = 0.25 * b.ring_mass * b.pitch_diameter * b.pitch_diameter;
  if (b.ring_spin_inertia > 20. * hoop || b.ring_spin_inertia < 0.05 * hoop)
    fault("ring_spin_inertia",
          fmt::format("the ring_spin_inertia of {:.6g} kg m2 is far from that of a hoop of the ring's mass on the "
                      "pitch circle, {:.3g} kg m2.",
                      b.ring_spin_inertia, hoop),
          "Allowed: 1/20 to 20 times that value. Check the unit: kg m2, not kg mm2.");
}

void check_touchdown(const std::string& name, const TouchdownParameters& b, const ContactParameters& contact,
                     const Node& table, const Node& contact_table, Faults& faults) {
  const double bore = bore_radius(b, contact), gap = air_gap(b, contact);
  if (gap >= 0.2 * bore)
    faults.add(
        position_of_value(b.air_gap ? table : contact_table, "air_gap"),
        fmt::format("bearings.{}: the air gap of {:.6g} mm is more than a fifth of the bore radius of {:.6g} mm.", name,
                    gap * 1e3, bore * 1e3),
        "Air gaps are a few tenths of a millimetre; check the unit.");
  if (std::fabs(2. * bore - b.inner_ring_diameters[0]) > 0.01 * b.inner_ring_diameters[0])
    faults.add(b.bore_radius         ? position_of_value(table, "bore_radius")
               : contact.bore_radius ? position_of_value(contact_table, "bore_radius")
                                     : position_of_value(table, "inner_ring_diameters"),
               fmt::format(
                   "bearings.{}: the bore radius of {:.6g} mm is not half the inner ring's bore diameter of {:.6g} mm.",
                   name, bore * 1e3, b.inner_ring_diameters[0] * 1e3),
               "contact.bore_radius holds for all bearings; bearings.NAME.bore_radius for one.");
  if (b.cage == CageModel::free && b.ball_model == BallModel::inertial)
    faults.add(position_of_value(table, "cage"),
               fmt::format("bearings.{}: a free cage goes with ball_model = \"quasi-static\"; balls with inertia "
                           "follow the cage of rolling balls.",
                           name),
               "Leave cage or ball_model out.");
  if (b.preload > b.C0 / b.rows)
    faults.add(position_of_value(table, "preload"),
               fmt::format("bearings.{}: the preload of {:.6g} N is more than the static load rating of a row, {:.6g} "
                           "N (C0 = {:.6g} N).",
                           name, b.preload, b.C0 / b.rows, b.C0),
               "Preloads are typically a few percent of C0; check the unit.");
}

}  // namespace rotordrop
