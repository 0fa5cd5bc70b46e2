#include "bearing/touchdown_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

// What a touchdown bearing lists of itself: its states and ledgers, and the quantities that are recorded, with their values.
namespace rotordrop {

std::vector<StateEntry> TouchdownBearing::state_entries() const {
  std::vector<StateEntry> entries = {{"inner ring y", "m", 1e-4},
                                     {"inner ring z", "m", 1e-4},
                                     {"inner ring velocity y", "m/s", 0.1},
                                     {"inner ring velocity z", "m/s", 0.1},
                                     {"inner ring angle", "rad", 1.},
                                     {"inner ring spin", "rad/s", 100.},
                                     {"support y", "m", 1e-5},
                                     {"support z", "m", 1e-5},
                                     {"support velocity y", "m/s", 0.01},
                                     {"support velocity z", "m/s", 0.01},
                                     {"cage angle", "rad", 1.}};
  if (data_.free_ring)
    entries.insert(entries.end(), {{"inner ring x", "m", 1e-5},
                                   {"inner ring velocity x", "m/s", 0.01},
                                   {"inner ring tilt y", "rad", 1e-4},
                                   {"inner ring tilt z", "rad", 1e-4},
                                   {"inner ring tilt rate y", "rad/s", 1.},
                                   {"inner ring tilt rate z", "rad/s", 1.}});
  // A bristle of sticking friction gives way after about a micrometre.
  const std::size_t directions = data_.free_ring ? 2 : 1;
  for (std::size_t k = 0; k < n_bristles(); ++k)
    entries.push_back(
        {fmt::format("bristle {} {}", k / directions + 1, k % directions == 0 ? "around" : "along"), "m", 1e-6});
  if (data_.bending)
    for (auto& entry : shape_entries()) entries.push_back(std::move(entry));
  if (data_.support_law)
    for (const auto& state : data_.support_law->states())
      entries.push_back({"support " + state.name, state.unit, state.scale});
  if (data_.free_cage) entries.insert(entries.end(), {{"cage speed", "rad/s", 100.}, {"ball spin", "rad/s", 1000.}});
  return entries;
}

std::vector<StateEntry> TouchdownBearing::ledger_entries() const {
  std::vector<StateEntry> entries = {
      {"contact impulse", "N s", 100., "integral of the contact force"},
      {"contact damping", "J", 1., "energy dissipated by the damping of rotor and ring's contact"},
      {"ball damping", "J", 1., "energy dissipated by the damping of balls and races"},
      {"support damping", "J", 1., "energy dissipated by the support's damper"},
      {"waviness work", "J", 1., "work of the travelling waves on the machine"},
      {"cage work", "J", 1., "work of the prescribed cage motion on the machine"},
      {"ball inertia work", "J", 1., "work of centrifugal forces and gyroscopic moments on the balls as they move"},
      {"spin-up drive", "J", 100., "integral of omega_r (J omega_i' + M), for the balance of the spin-up"},
      {"spin-up centres", "J", 1., "integral of F_t v_t, friction force times the centres' tangential speed"}};
  if (data_.bending)
    entries.push_back({"ring bending damping", "J", 1., "energy dissipated by the damping of bent rings"});
  if (data_.free_cage)
    entries.push_back(
        {"ball slip heat", "J", 1., "heat of balls that slip on the races and in the pockets of a free cage"});
  return entries;
}

std::vector<Observable> TouchdownBearing::observables() const {
  const std::vector<std::string> yz = {"y", "z"};
  std::vector<std::string> row_names;
  for (std::size_t i = 0; i < rows_.size(); ++i) row_names.push_back("row " + std::to_string(i + 1));
  std::vector<Observable> list = {
      {"orbit", "m", "rotor centre at the bearing, from the unloaded outer ring's axis", 2, yz, Observed::orbit},
      {"rotor_velocity", "m/s", "velocity of the rotor centre at the bearing", 2, yz},
      {"ring_position", "m", "inner-ring centre", 2, yz},
      {"ring_velocity", "m/s", "velocity of the inner-ring centre", 2, yz},
      {"support_position", "m", "displacement of the support and outer ring", 2, yz},
      {"penetration",
       "m",
       "penetration of the rotor surface into the bore; negative: remaining gap",
       1,
       {},
       Observed::penetration},
      {"clearance", "m", "radial air gap after thermal growth of bore and shaft", 1, {}, Observed::clearance},
      {"contact_force", "N", "normal force between rotor and inner ring", 1, {}, Observed::contact_force},
      {"friction_force", "N", "friction force on the inner ring, positive about +x", 1, {}},
      {"slip_speed", "m/s", "slip speed of the rotor surface relative to the bore", 1, {}, Observed::slip_speed},
      {"spin_lag",
       "1",
       "speed deficit of the bore surface relative to the rotor surface, divided by the rotor's surface speed",
       1,
       {},
       Observed::spin_lag},
      {"bearing_force", "N", "resultant of the ball forces on the inner ring", 2, yz},
      {"ball_force", "N",
       "load of the most loaded ball of each row; with ball_model = \"inertial\" that of the inner race", rows_.size(),
       row_names, Observed::ball_force},
      {"contact_pressure", "Pa", "largest pressure of balls and races in each row", rows_.size(), row_names,
       Observed::contact_pressure},
      {"ring_speed", "rad/s", "inner-ring spin speed", 1, {}, Observed::ring_speed},
      {"cage_angle", "rad", "rotation of the cage", 1, {}},
      {"load_torque", "N m", "load-dependent friction torque of the bearing (eq. 21)", 1, {}, Observed::load_torque},
      {"drag_torque", "N m", "speed-dependent friction torque of the bearing (eq. 22)", 1, {}},
      {"spin_torque",
       "N m",
       "spin moment of the most loaded ball on the inner race (eq. 23)",
       1,
       {},
       Observed::spin_torque},
      {"spin_speed_inner", "rad/s", "spin of the balls on the inner race, outer-race control (eq. 13)", 1, {}},
      {"rub_heat_rate", "W", "friction heat between rotor and inner ring (eq. 19)", 1, {}, Observed::rub_heat_rate},
      {"inner_heat_rate", "W", "friction heat of balls and inner race", 1, {}, Observed::inner_heat_rate},
      {"outer_heat_rate", "W", "friction heat of balls and outer race", 1, {}, Observed::outer_heat_rate},
      growth_observable("expansion", "thermal and centrifugal growth"),
      {"row_axial_force", "N", "axial force of each row of balls on the inner ring", rows_.size(), row_names},
      {"preload", "N", "preload of opposed rows: the smaller of their axial forces", 1, {}, Observed::preload},
      {"centrifugal_force",
       "N",
       "centrifugal force of one ball at the cage's speed",
       1,
       {},
       Observed::centrifugal_force},
      {"ellipse_truncation", "1", "largest part of a contact ellipse's length beyond the edge of its raceway",
       rows_.size(), row_names, Observed::ellipse_truncation},
      {"skid_demand", "1",
       "traction that rolling and gyroscopic moments require of the row, divided by the available friction",
       rows_.size(), row_names, Observed::skid_demand},
      {"gyroscopic_demand", "1",
       "traction that a ball's gyroscopic moment requires, divided by the available friction, at the race where this "
       "is larger",
       rows_.size(), row_names, Observed::gyroscopic_demand}};
  if (data_.free_ring)
    list.insert(
        list.end(),
        {{"axial_position", "m", "rotor and inner ring along the axis", 2, {"rotor", "ring"}, Observed::axial_position},
         {"ring_tilt", "rad", "rotation of the inner ring about y and z", 2, yz},
         {"axial_force", "N", "rotor on inner ring along +x, shoulders and friction", 1, {}, Observed::axial_force},
         {"shoulder_force", "N", "shoulders of the rotor on the inner ring, along +x", 1, {}, Observed::shoulder_force},
         {"ring_moment", "N m", "rotor on inner ring about y and z", 2, yz}});
  if (data_.free_cage)
    list.insert(list.end(),
                {{"cage_speed", "rad/s", "speed of a free cage, and that of rolling balls", 2, {"cage", "rolling"}},
                 {"ball_spin", "rad/s", "spin of the balls about the axis of rolling", 1, {}}});
  if (data_.support_law)
    list.insert(list.end(), {{"support_force", "N", "force of the support on the outer ring", 2, yz},
                             {"support_energy", "J", "energy stored in the springs of the support", 1, {}}});
  return list;
}

std::vector<Observable> TouchdownBearing::detailed_observables() const {
  Observable loads{"ball_loads", "N", "load of every ball; with ball_model = \"inertial\" on the inner race", 0, {}};
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (int j = 0; j < rows_[i].geometry().n_balls; ++j)
      loads.columns.push_back("row " + std::to_string(i + 1) + " ball " + std::to_string(j + 1));
  loads.size = loads.columns.size();
  std::vector<Observable> list = {loads};
  if (data_.ball_model == BallModel::inertial)
    list.push_back({"outer_ball_loads", "N", "load of every ball on the outer race", loads.size, loads.columns});
  if (data_.bending)
    for (auto& shape : shape_observables()) list.push_back(std::move(shape));
  return list;
}

}  // namespace rotordrop
