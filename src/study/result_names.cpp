#include "study/result_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/rotation.h"

namespace rotordrop {
namespace {

struct Rule {
  const char* ending;  ///< of the name, after a dot or as a whole
  const char* unit;
  const char* long_name;
};

// The first ending that fits holds: longer ones come first. docs/reference/results.md says more about each.
constexpr std::array rules{
    Rule{"rotor.mass", "kg", "mass of the rotor"},
    Rule{"rotor.polar_inertia", "kg m2", "polar moment of inertia of the rotor"},
    Rule{"rotor.diametral_inertia", "kg m2", "diametral moment of inertia of the rotor"},
    Rule{"rotor.centre_of_gravity", "m", "position of the rotor's centre of gravity along its axis"},
    Rule{"free_free_frequencies[]", "Hz", "free-free natural frequency of the rotor at rest"},
    Rule{"rotor_speed_end", "rad/s", "spin speed of the rotor at the end"},
    Rule{"first_touch_time", "s", "instant of the first touch"},
    Rule{"first_contact_time", "s", "instant of the first contact in the bore"},
    Rule{"first_contact_end", "s", "end of the first contact in the bore"},
    Rule{"ends_in_first_contact", "1",
         "1 if the run ends in the first contact with the bearing, its force at the largest then, else 0"},
    Rule{"second_contact_time", "s", "instant of the second contact in the bore"},
    Rule{"first_shoulder_contact_time", "s", "instant of the first contact on a shoulder"},
    Rule{"mean_contact_force_end", "N", "mean contact force in the bore over the last 50 ms"},
    Rule{"contact.peak_contact_force", "N", "peak contact force at the probe"},
    Rule{"peak_contact_force", "N", "peak contact force in the bore"},
    Rule{"first_bounce_apex", "m", "highest position between first and second contact, if gravity is along -y"},
    Rule{"peak_friction_heat_rate", "W", "peak rub heat rate"},
    Rule{"friction_heat", "J", "rub heat"},
    Rule{"inner_heat", "J", "bearing friction heat at the inner raceway"},
    Rule{"outer_heat", "J", "bearing friction heat at the outer raceway"},
    Rule{"inner_heat_rate_max", "W", "largest bearing friction heat rate at the inner raceway"},
    Rule{"outer_heat_rate_max", "W", "largest bearing friction heat rate at the outer raceway"},
    Rule{"catch_up_time", "s", "instant at which the ring's spin-up is complete"},
    Rule{"elastic_end.ring_speed", "rad/s", "ring speed of the elastic state at the end"},
    Rule{"ring_speed_end", "rad/s", "spin speed of the inner ring at the end"},
    Rule{"load_torque_peak", "N m", "largest load-dependent friction torque"},
    Rule{"spin_torque_peak", "N m", "largest spin moment of a ball on the inner raceway"},
    Rule{"largest_ball_force", "N", "largest ball load, of balls with inertia at the inner raceway"},
    Rule{"largest_contact_pressure", "Pa", "largest contact pressure of balls and raceways"},
    Rule{"required_static_safety", "1", "static safety that a repeated drop needs"},
    Rule{"fatigue.share", "1", "share of the bearing's fatigue life L10 that one drop uses"},
    Rule{"fatigue.rows[]", "1", "share of the row's fatigue life L10 that one drop uses"},
    Rule{"fatigue.by_cycles", "1", "that share by load cycles of the balls alone"},
    Rule{"fatigue.by_rolling", "1", "that share by turns under the balls' loads alone"},
    Rule{"fatigue.rating", "N", "dynamic load rating of all rows"},
    Rule{"fatigue.largest_cycle", "N", "largest load cycle of a ball"},
    Rule{"fatigue.equivalent_cycles", "1", "largest load cycles that damage as much as all cycles of the worst ball"},
    Rule{"fatigue.load_over_rating", "1", "largest load cycle of a ball over its load under the dynamic rating"},
    Rule{"damage.assessed", "1",
         "1 if the rotor touched the bearing, in the bore or on a shoulder, to the end of its first impact, else 0: "
         "nothing "
         "is assessed"},
    Rule{"damage.pressure_is_void", "1",
         "whether contact ellipses reached over a raceway's edge, so that the static safety is lower"},
    Rule{"damage.rubs_on_shoulder", "1", "whether the rotor rubbed on a shoulder, whose wear is not computed"},
    Rule{"damage.fatigue", "1", "contact fatigue, not assessed without the rating C"},
    Rule{"damage.wear_share", "1", "share of the allowed wear depth that one drop uses"},
    Rule{"damage.allowed_drops", "1", "allowed number of such drops"},
    Rule{"static_safety", "1", "static safety: (4.2 GPa over the largest contact pressure) cubed"},
    Rule{"truncation", "1", "largest part of a contact ellipse beyond the raceway's edge"},
    Rule{"time_truncated", "s", "time with a contact ellipse beyond the raceway's edge"},
    Rule{"loaded_share", "1", "part of the time in which the row carries a load"},
    Rule{"centrifugal_over_load", "1", "centrifugal force of a ball over the row's largest ball load"},
    Rule{"centrifugal_force", "N", "largest centrifugal force of a ball"},
    Rule{"largest_demand", "1", "largest traction required over available friction"},
    Rule{"time_beyond", "s", "time with more traction required than available"},
    Rule{"longest_beyond", "s", "longest stretch with more traction required than available"},
    Rule{"speed_change_beyond", "rad/s", "changes of ring speed with more traction required than available"},
    Rule{"speed_change", "rad/s", "sum of the changes of ring speed"},
    Rule{"skid.row", "1", "row with most of those changes, counted from 1"},
    Rule{"spin_up.slip_energy", "J", "rub heat from the spin-up alone"},
    Rule{"spin_up.residual", "J", "rub heat less that from the spin-up alone"},
    Rule{"local.bore_rise_low", "K", "smallest local temperature rise of the bore of all replays"},
    Rule{"local.bore_rise_high", "K", "largest local temperature rise of the bore of all replays"},
    Rule{"bore_rise", "K", "largest local temperature rise of the bore"},
    Rule{"rotor_rise", "K", "largest local temperature rise of the rotor"},
    Rule{"surface_difference", "K", "largest difference of bore and rotor under the band"},
    Rule{"share_to_ring_then", "1", "share of the heat into the ring at that instant"},
    Rule{"share_to_ring", "1", "share of the rub heat into the ring"},
    Rule{"band_length_then", "m", "length of the rubbing band at that instant"},
    Rule{"half_space_valid", "1", "whether the half space holds at that instant"},
    Rule{"bore_depth", "m", "largest wear depth of the bore"},
    Rule{"rotor_depth", "m", "largest wear depth of the rotor"},
    Rule{"bore_mean_depth", "m", "mean wear depth of the bore"},
    Rule{"rotor_mean_depth", "m", "mean wear depth of the rotor"},
    Rule{"sliding_work", "J", "integral of contact force times slip speed"},
    Rule{"depth_limit", "m", "allowed wear depth"},
    Rule{"drops_until_limit", "1", "drops until the allowed wear depth"},
    Rule{"whirl.frequency", "Hz", "mean frequency of the longest whirl"},
    Rule{"whirl.start", "s", "start of the longest whirl"},
    Rule{"whirl.end", "s", "end of the longest whirl"},
    Rule{"whirl.turns", "1", "turns of the longest whirl"},
    Rule{"largest_backward_speed", "rad/s", "largest speed of sustained backward whirl"},
    Rule{"contact_time", "s", "recorded time in contact"},
    Rule{"forward_share", "1", "part of the contact time with forward motion"},
    Rule{"backward_share", "1", "part of the contact time with backward motion"},
    Rule{"backward_whirl_share", "1", "part of the contact time with sustained backward whirl"},
    Rule{"whirl.full_rub", "1", "whether there is a full backward rub"},
    Rule{"fastest_resolved", "rad/s", "fastest whirl that the recorded rows resolve"},
    Rule{"friction_coefficient", "1", "friction coefficient of rotor on ring"},
    Rule{"friction_from_rest", "1", "friction coefficient that starts a full backward rub from rest"},
    Rule{"speed_at_bottom", "rad/s", "whirl speed at the bottom that starts a full backward rub"},
    Rule{"support.largest_travel", "m", "largest displacement of the outer ring in its support"},
    Rule{"support.largest_travel_time", "s", "time of that displacement"},
    Rule{"support.travel_limit", "m", "displacement that the support allows"},
    Rule{"support.loss", "J", "energy that the support dissipates"},
    Rule{"support.largest_stored_energy", "J", "largest energy in the springs of the support"},
    Rule{"support.meets_stop", "1", "whether the outer ring meets its stop"},
    Rule{"support", "1", "support of the outer ring: there is none"},
    Rule{"spin_up", "1", "balance of the spin-up: there is none with a free cage"},
    Rule{"shoulder.stiffness", "N/m", "stiffness of the shoulders' contact"},
    Rule{"shoulder.rotor_stiffness", "N/m", "stiffness of the rotor's shoulder"},
    Rule{"shoulder.ring_stiffness", "N/m", "stiffness of the ring's wall behind its face"},
    Rule{"sides[].gap", "m", "axial gap to the shoulder"},
    Rule{"sides[].thrust", "N", "largest thrust towards the shoulder"},
    Rule{"sides[].approach_speed", "m/s", "speed at which the rotor reaches the shoulder, estimated"},
    Rule{"force_by_energy.half_stiffness", "N", "shoulder force by energy with half the stiffness"},
    Rule{"force_by_energy.stiffness", "N", "shoulder force by energy"},
    Rule{"force_by_energy.double_stiffness", "N", "shoulder force by energy with double the stiffness"},
    Rule{"node", "1", "node of the probe"},
    Rule{"smallest_clearance", "m", "smallest clearance left at the probe, negative beyond it"},
    Rule{"clearance", "m", "clearance at the probe"},
    Rule{"touches", "1", "whether the rotor used up the clearance"},
    Rule{"time_touching", "s", "time beyond the clearance"},
    Rule{"contact.damping", "J", "energy dissipated by the damping of the contact at the probe"},
    Rule{"fe.unknowns", "1", "unknowns of the finite elements"},
    Rule{"fe.cells", "1", "cells of the finite elements"},
    Rule{"fe.modes", "1", "modes of the reduced finite elements"},
    Rule{"largest_response_error", "1", "largest error of the modes' response"},
    Rule{"housing_fit.largest_open", "1", "largest open part of the fit in the housing"},
    Rule{"housing_fit.mean_pressure_end", "Pa", "mean pressure of the fit in the housing at the end"},
    Rule{"housing_fit.lowest_pressure", "Pa", "lowest pressure of the fit in the housing"},
    Rule{"windows.count", "1", "number of windows"},
    Rule{"windows.shortest", "s", "shortest window"},
    Rule{"windows.longest", "s", "longest window"},
    Rule{"windows.mean", "s", "mean length of the windows"},
    Rule{"windows.tolerance", "m", "growth error that a window may leave"},
    Rule{"windows.beyond_tolerance", "1", "windows that left a larger growth error"},
    Rule{"windows.largest_growth_error", "m", "largest growth error of a window"},
    Rule{"windows.largest_growth", "m", "largest growth in the windows"},
    Rule{"windows.cpu_time", "s", "computing time of the windows"},
    Rule{"windows.heat_input", "J", "heat input of the windows"},
    Rule{"windows.heat_stored", "J", "heat stored in the windows"},
    Rule{"windows.heat_lost", "J", "heat lost to ambient in the windows"},
    Rule{"windows.heat_residual", "J", "heat of the windows not accounted for"},
    Rule{"run.end_time", "s", "end of the simulated time"},
    Rule{"run.ambient", "K", "temperature of the surroundings"},
    Rule{"run.completed", "1", "whether the run came to its end"},
    Rule{"accepted", "1", "whether all limits of the case are met"},
    Rule{"run.warnings", "1", "number of warnings of the run"},
    Rule{"run.wall_time", "s", "time that the run took"},
    Rule{"run.cpu_time", "s", "computing time of the run"},
    Rule{"run.steps", "1", "steps of the time integration"},
    Rule{"run.rhs_evaluations", "1", "right-hand sides of the time integration"},
    Rule{"run.rejected_steps", "1", "rejected steps of the time integration"},
};

// Parts that end in start, smallest, largest, end or a time.
constexpr std::array ranges{
    Rule{"preload", "N", "preload between opposed rows"},
    Rule{"clearance", "m", "air gap"},
    Rule{"axial.force", "N", "axial force of rotor on ring"},
    Rule{"axial.rotor_position", "m", "axial position of the rotor"},
    Rule{"axial.shoulder_force", "N", "force of the shoulders on the ring along +x"},
    Rule{"growth.*", "m", "growth"},
};

// Results whose last parts are names of bodies, surfaces or ports: what stands before those, within a name.
constexpr std::array groups{
    Rule{".temperature_rise_end.", "K", "temperature rise at the end"},
    Rule{".surface_rise.", "K", "temperature rise"},
    Rule{".heat_capacity.", "J/K", "heat capacity"},
    Rule{".response_error.", "1", "error of the modes' response"},
    Rule{".mean_response_error.", "1", "error of the modes' response"},
    Rule{".hoop_stress.", "Pa", "hoop stress at the end"},
    Rule{".fit_pressure.open", "1", "open part of the fit in the housing at the end"},
    Rule{".fit_pressure.", "Pa", "pressure of the fit in the housing at the end"},
    Rule{".raceway_growth.", "m", "displacement of a raceway's strip at the end"},
};

constexpr double hertz = 0.5 / std::numbers::pi;

constexpr std::array shown{
    ShownResult{"/first_contact_time", "first contact in the bore", "ms", 1e3},
    ShownResult{"/axial/first_shoulder_contact_time", "first contact on a shoulder", "ms", 1e3},
    ShownResult{"/peak_contact_force", "peak contact force in the bore (0-peak)", "kN", 1e-3},
    ShownResult{"/peak_contact_force_time", "time of peak contact force in the bore", "ms", 1e3},
    ShownResult{"/mean_contact_force_end", "mean contact force in the bore, last 50 ms", "N", 1.},
    ShownResult{"/axial/shoulder_force/largest", "largest shoulder force towards +x", "kN", 1e-3},
    ShownResult{"/axial/shoulder_force/smallest", "largest shoulder force towards -x (negative)", "kN", 1e-3},
    ShownResult{"/axial/force/largest", "largest axial force of the rotor on the ring, towards +x", "kN", 1e-3},
    ShownResult{"/axial/force/smallest", "largest axial force of the rotor on the ring, towards -x (negative)", "kN",
                1e-3},
    ShownResult{"/axial/rotor_position/largest", "largest axial position of the rotor", "um", 1e6},
    ShownResult{"/axial/rotor_position/smallest", "smallest axial position of the rotor", "um", 1e6},
    ShownResult{"/largest_ball_force", "largest ball load", "N", 1.},
    ShownResult{"/first_bounce_apex", "apex of first bounce (y)", "um", 1e6},
    ShownResult{"/peak_friction_heat_rate", "peak rub heat rate", "kW", 1e-3},
    ShownResult{"/friction_heat", "rub heat", "J", 1.},
    ShownResult{"/inner_heat", "bearing friction heat, inner raceway", "J", 1.},
    ShownResult{"/outer_heat", "bearing friction heat, outer raceway", "J", 1.},
    ShownResult{"/catch_up_time", "end of spin-up (ring within 1 % of rotor surface speed)", "ms", 1e3},
    ShownResult{"/ring_speed_end", "ring speed at end", "rpm", to_rpm},
    ShownResult{"/temperature_rise_end/inner_ring", "inner-ring temperature rise at end, lumped", "K", 1.},
    ShownResult{"/fe/temperature_rise_end/inner_ring", "inner-ring temperature rise at end, FE mean", "K", 1.},
    ShownResult{"/fe/surface_rise/bore/highest", "largest bore temperature rise, FE (circumferential mean)", "K", 1.},
    ShownResult{"/local/bore_rise", "local temperature rise of the bore where it rubs", "K", 1.},
    ShownResult{"/local/bore_rise_low", "… lower bound", "K", 1.},
    ShownResult{"/local/bore_rise_high", "… upper bound", "K", 1.},
    ShownResult{"/local/bore_rise_time", "… reached at", "ms", 1e3},
    ShownResult{"/local/rotor_rise", "local temperature rise of the rotor where it rubs", "K", 1.},
    ShownResult{"/wear/bore_depth", "largest wear depth of the bore, estimated", "um", 1e6},
    ShownResult{"/wear/rotor_depth", "largest wear depth of the rotor, estimated", "um", 1e6},
    ShownResult{"/wear/drops_until_limit", "number of such drops until the permitted wear depth", "", 1.},
    ShownResult{"/whirl/frequency", "mean frequency of longest whirl", "Hz", 1.},
    ShownResult{"/whirl/largest_backward_speed", "fastest sustained backward whirl", "Hz", hertz},
    ShownResult{"/whirl/full_rub_condition/speed_at_bottom", "whirl speed at bottom required for full backward rub",
                "Hz", hertz},
};

std::string without_indices(const std::string& name) {
  std::string result;
  bool is_inside = false;
  for (const char c : name) {
    if (c == ']') is_inside = false;
    if (!is_inside) result += c;
    if (c == '[') is_inside = true;
  }
  return result;
}

bool ends_with(const std::string& name, const std::string& ending) {
  return name == ending ||
         (name.size() > ending.size() && name.ends_with(ending) && name[name.size() - ending.size() - 1] == '.');
}

/// "TB1" of "bearings.TB1.peak_contact_force", "P" of "probes.P.clearance".
std::string place_of(const std::string& name) {
  for (const std::string_view list : {"bearings.", "probes."})
    if (name.starts_with(list)) return name.substr(list.size(), name.find('.', list.size()) - list.size());
  return "";
}

/// "heat input" of "heat_input".
std::string spaced(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// "temperature rise (bore, highest mean)" of "bearings.TB1.fe.surface_rise.bore.highest_mean".
ResultMeaning group_meaning(const std::string& name) {
  for (const auto& group : groups) {
    const std::string_view part = group.ending;
    const auto at = name.find(part);
    if (at == std::string::npos) continue;
    if (part == ".surface_rise." && name.ends_with("_time")) return {};  // an instant, not a rise
    if (at + part.size() == name.size()) return {group.unit, group.long_name};
    std::string what = group.long_name + std::string(" (");
    for (const char c : spaced(name.substr(at + part.size()))) {
      if (c == '.')
        what += ", ";
      else if (c != '[' && c != ']')
        what += c;
    }
    return {group.unit, what + ")"};
  }
  return {};
}

ResultMeaning range_meaning(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  const std::string last = name.substr(dot + 1), path = name.substr(0, dot);
  const bool is_time = last == "smallest_time" || last == "largest_time";
  if (!is_time && last != "start" && last != "smallest" && last != "largest" && last != "end") return {};
  for (const auto& rule : ranges) {
    std::string ending = rule.ending;
    std::string what = rule.long_name;
    if (ending == "growth.*") {
      const auto before = path.rfind('.');
      if (before == std::string::npos || !ends_with(path.substr(0, before), "growth")) continue;
      what = "growth of " + path.substr(before + 1);
    } else if (!ends_with(path, ending)) {
      continue;
    }
    if (is_time) return {"s", "instant of the " + last.substr(0, last.size() - 5) + " " + what};
    return {rule.unit, (last == "start" || last == "end") ? what + " at the " + last : last + " " + what};
  }
  return {};
}

ResultMeaning plain_meaning(const std::string& name) {
  // Names of bodies may be like those of results.
  if (auto of_group = group_meaning(name); !of_group.unit.empty()) return of_group;
  for (const auto& rule : rules)
    if (ends_with(name, rule.ending)) return {rule.unit, rule.long_name};
  if (const auto range = range_meaning(name); !range.unit.empty()) return range;
  const auto dot = name.rfind('.');
  const std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
  if (last.ends_with("_time")) {
    const auto what = plain_meaning(name.substr(0, name.size() - 5));
    return {"s", what.long_name.empty() ? "" : "instant of: " + what.long_name};
  }
  if (name.starts_with("energy.")) {
    return {"J", "energy: " + spaced(last)};
  }
  return {};
}

}  // namespace

ResultMeaning meaning_of(const std::string& name) {
  ResultMeaning meaning = plain_meaning(without_indices(name));
  if (std::string where = place_of(name); !where.empty() && !meaning.long_name.empty()) {
    if (const auto rows = name.find(".rows["); rows != std::string::npos)
      where += ", row " + std::to_string(std::stoi(name.substr(rows + 6)) + 1);
    meaning.long_name = where + ": " + meaning.long_name;
  }
  return meaning;
}

std::span<const ShownResult> shown_results() { return shown; }

std::string in_words(double value, const std::string& unit) {
  struct Scale {
    const char *unit, *shown;
    double per_si, from;  ///< shown at that size [SI] and beyond
  };
  constexpr Scale scales[] = {{"m", "um", 1e6, 0.},   {"m", "mm", 1e3, 1e-3},   {"m", "m", 1., 1.},
                              {"s", "us", 1e6, 0.},   {"s", "ms", 1e3, 1e-3},   {"s", "s", 1., 1.},
                              {"N", "N", 1., 0.},     {"N", "kN", 1e-3, 1e3},   {"J", "J", 1., 0.},
                              {"J", "kJ", 1e-3, 1e4}, {"W", "W", 1., 0.},       {"W", "kW", 1e-3, 1e3},
                              {"Pa", "Pa", 1., 0.},   {"Pa", "MPa", 1e-6, 1e5}, {"Pa", "GPa", 1e-9, 1e9}};
  Scale chosen{unit.c_str(), unit == "1" ? "" : unit.c_str(), 1., 0.};
  for (const Scale& scale : scales)
    if (unit == scale.unit && value != 0. && std::fabs(value) >= scale.from) chosen = scale;
  return fmt::format("{:.4g}{}{}", value * chosen.per_si, *chosen.shown ? " " : "", chosen.shown);
}

}  // namespace rotordrop
