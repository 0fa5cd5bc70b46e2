#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/rotation.h"
#include "io/hdf5/recorded_series.h"
#include "study/drop/whirl.h"
#include "study/report/charts.h"
#include "study/report/directions.h"
#include "study/report/report.h"

// Figures of time series.
namespace rotordrop {

namespace {

using Json = nlohmann::ordered_json;

bool has_shoulders(const RecordedDrop& drop, const std::string& name) {
  const auto bearings = drop.bearings();
  return std::any_of(bearings.begin(), bearings.end(),
                     [&](const auto& bearing) { return bearing.first == name && bearing.second.shoulders.any(); });
}

void add_motion(Charts& c, const RecordedDrop& drop) {
  const std::string instantaneous =
      "Instantaneous displacement from the axis of the unloaded bearing. Peaks are 0-peak; top to bottom is "
      "peak-to-peak.";
  for (const std::size_t axis : {1u, 2u}) {
    const auto& gravity = drop.parameters().run.gravity;
    std::string title = displacement_along(gravity, axis) + " of the rotor";
    title.front() = static_cast<char>(std::toupper(title.front()));
    c.figure(axis == 1 ? "displacement-y" : "displacement-z", "Motion", title, axis_name(gravity, axis), "um",
             instantaneous);
    c.of_supports("orbit", "", 1e6, 0, axis - 1);
  }
  c.figure("ring-position", "Motion", "Displacement of inner ring and support", "displacement", "um", instantaneous);
  c.of_supports("ring_position", "ring y", 1e6, 0, 0);
  c.of_supports("ring_position", "ring z", 1e6, 1, 1);
  c.of_supports("support_position", "support y", 1e6, 2, 0);
  c.figure("axial-position", "Motion", "Axial position of rotor and inner ring", "x", "um",
           "Of the rotor as a rigid body, and of each ring from its mounted position.");
  c.of_supports("axial_position", "rotor", 1e6, 0, 0);
  c.of_supports("axial_position", "ring", 1e6, 1, 1);
  c.figure("whirl", "Motion", "Whirl in contact", "whirl frequency", "Hz",
           "Mean over 5 ms of contact; positive from +y towards +z. Lines bridge phases without contact.");
  for (std::size_t i = 0; i < c.names().size(); ++i) {
    const std::string& name = c.names()[i];
    if (!drop.has("/bearings/" + name + "/ball_force")) continue;
    const ContactWhirl whirl = recorded_whirl(drop, name);
    const TimeSeries orbit = drop.series("/bearings/" + name + "/orbit");
    TimeSeries speed;
    for (std::size_t k = 0; k < std::min(whirl.speed.size(), orbit.times.size()); ++k)
      if (std::isfinite(whirl.speed[k])) {
        speed.times.push_back(orbit.times[k]);
        speed.values.push_back(whirl.speed[k]);
      }
    if (!speed.empty()) c.line(name, speed, 0.5 / std::numbers::pi, {i, 0});
  }
}

void add_probes(Charts& c, const RecordedDrop& drop) {
  const auto& probes = drop.parameters().rotor.probes;
  c.figure("probe-clearance", "Motion", "Clearance left at the probes", "radial clearance left", "um",
           "Below zero the rotor is beyond the clearance there.");
  for (std::size_t i = 0; i < probes.size(); ++i)
    c.recorded("/probes/" + probes[i].first + "/clearance", probes[i].first, 1e6, {i, 0});
  c.figure("probe-position", "Motion", "Displacement of the rotor at the probes", "displacement", "um");
  for (std::size_t i = 0; i < probes.size(); ++i) {
    c.recorded("/probes/" + probes[i].first + "/position", probes[i].first + " y", 1e6, {i, 0}, 0);
    c.recorded("/probes/" + probes[i].first + "/position", probes[i].first + " z", 1e6, {i, 1}, 1);
  }
  c.figure("probe-force", "Forces", "Normal force where the rotor touches at a probe", "contact force", "kN");
  for (std::size_t i = 0; i < probes.size(); ++i)
    c.recorded("/probes/" + probes[i].first + "/contact_force", probes[i].first, 1e-3, {i, 0});
}

/// Force over travel of a support with a law of its own: the area of its loops is what it dissipates.
void add_support_loop(Charts& c, const RecordedDrop& drop, const std::string& name) {
  const std::string force = "/bearings/" + name + "/support_force", place = "/bearings/" + name + "/support_position";
  if (!drop.has(force)) return;
  c.over_itself("support-loop-" + name, "Forces", name + ": force of the support on the outer ring over its travel",
                "Springs give lines, friction and damping loops; the area is what the support dissipates.");
  for (std::size_t axis = 0; axis < 2; ++axis)
    c.pairs(axis == 0 ? "y" : "z", drop.series(place, axis), drop.series(force, axis), {axis, 0});
}

void add_forces(Charts& c, const RecordedDrop& drop) {
  c.figure("contact-force", "Forces", "Normal force between rotor and bore", "contact force", "kN",
           "Instantaneous samples; peaks are 0-peak. The peaks in the table of main numbers are taken at every "
           "integration step.");
  c.of_supports("contact_force", "", 1e-3);
  c.figure("friction-force", "Forces", "Friction force on the inner ring", "friction force", "kN",
           "Positive about +x, the direction of positive spin.");
  c.of_supports("friction_force", "", 1e-3);
  c.figure("axial-force", "Forces", "Axial force of the rotor on the inner ring", "axial force", "kN",
           "Positive along +x. Shoulders and friction in the bore together, and the shoulders' part.");
  c.of_supports("axial_force", "", 1e-3);
  for (std::size_t i = 0; i < c.names().size(); ++i)
    if (has_shoulders(drop, c.names()[i]))
      c.recorded("/bearings/" + c.names()[i] + "/shoulder_force", c.names()[i] + " shoulders", 1e-3, {i, 1});
  c.figure("bearing-force", "Forces", "Resultant of the ball forces on the inner ring", "force", "kN");
  c.of_supports("bearing_force", "y", 1e-3, 0, 0);
  c.of_supports("bearing_force", "z", 1e-3, 1, 1);
  c.figure("support-force", "Forces", "Force of linear supports on the rotor, of other supports on the outer ring",
           "force", "kN");
  c.of_supports("support_force", "y", 1e-3, 0, 0);
  c.of_supports("support_force", "z", 1e-3, 1, 1);
  for (const auto& [name, parameters] : drop.bearings()) add_support_loop(c, drop, name);
  c.figure("magnet-force", "Forces", "Force of magnets on the rotor", "force", "kN");
  c.of_supports("magnet_force", "y", 1e-3, 0, 1);
  c.of_supports("magnet_force", "z", 1e-3, 1, 2);
  c.of_supports("magnet_force", "x", 1e-3, 2, 0);
}

void add_speeds(Charts& c) {
  c.figure("speeds", "Speeds and torques", "Spin speeds", "spin speed", "rpm");
  c.recorded("/rotor/spin_speed", "rotor", to_rpm, {7, 1});
  c.of_supports("ring_speed", "ring", to_rpm);
  c.figure("slip", "Speeds and torques", "Slip between rotor surface and bore", "slip speed", "m/s");
  c.of_supports("slip_speed", "", 1.);
  c.figure("torques", "Speeds and torques", "Friction torque inside the bearings", "torque", "N m",
           "Load: eq. 21 of the source paper; drag: eq. 22; spin: the most loaded ball's spin moment, eq. 23.");
  c.of_supports("load_torque", "load", 1., 0);
  c.of_supports("drag_torque", "drag", 1., 1);
  c.of_supports("spin_torque", "spin", 1., 2);
}

/// Ledgers of heat are kept of all supports; those that are no touchdown bearings have none.
void add_heat(Charts& c, const RecordedDrop& drop) {
  c.figure("rub-heat", "Heat", "Rub heat rate", "heat rate", "kW");
  c.of_supports("rub_heat_rate", "", 1e-3);
  c.figure("inner-heat", "Heat", "Bearing friction heat rate", "heat rate", "W");
  c.of_supports("inner_heat_rate", "inner raceway", 1., 0);
  c.of_supports("outer_heat_rate", "outer raceway", 1., 1);
  c.figure("heat-given", "Heat", "Cumulative heat", "heat", "J");
  for (std::size_t i = 0; i < c.names().size(); ++i) {
    if (!drop.has("/bearings/" + c.names()[i] + "/contact_force")) continue;
    const std::string ledger = "/ledger/" + c.names()[i] + "/";
    c.recorded(ledger + "rub_heat", c.names()[i] + " rub", 1., {i, 0});
    c.recorded(ledger + "rub_heat_into_ring", c.names()[i] + " rub, into ring", 1., {i, 1});
    c.recorded(ledger + "inner_heat", c.names()[i] + " inner raceway", 1., {i, 2});
    c.recorded(ledger + "outer_heat", c.names()[i] + " outer raceway", 1., {i, 3});
  }
}

using Models = std::vector<const ThermalKind*>;

/// " (FE)": what tells a model's lines from another's; none for a circuit by itself.
std::string mark_of(const Models& models, std::size_t m) {
  return models.size() == 1 && models[m]->is_unmarked ? "" : " (" + models[m]->mark + ")";
}

/// "Solid: lumped thermal circuit; dashed: finite elements."
std::string dashes_of(const Models& models) {
  if (models.size() < 2) return "";
  constexpr const char* dashes[] = {"Solid", "dashed", "dotted", "dash-dotted"};
  std::string text;
  for (std::size_t m = 0; m < models.size(); ++m)
    text += (m == 0 ? "" : "; ") + (m < std::size(dashes) ? std::string(dashes[m]) : "next") + ": " + models[m]->title;
  return text + ".";
}

void add_temperatures(Charts& c, const RecordedDrop& drop) {
  const double ambient = drop.parameters().run.ambient;
  const std::pair<const char*, const char*> nodes[] = {{"shaft", "shaft"},
                                                       {"inner_ring", "inner ring"},
                                                       {"ball", "balls"},
                                                       {"outer_ring", "outer ring"},
                                                       {"housing", "housing"}};
  const std::pair<const char*, const char*> surfaces[] = {{"bore", "bore"},
                                                          {"inner_raceway", "inner raceway"},
                                                          {"outer_raceway", "outer raceway"},
                                                          {"housing_surface", "housing surface"}};
  const std::string above =
      fmt::format("Temperature rise above ambient ({:.2f} K, {}). ", ambient, in_celsius(ambient));
  const auto models = drop.models();
  for (const auto& [name, parameters] : drop.bearings()) {
    c.figure("temperature-" + name, "Temperatures", name + ": bodies", "temperature rise", "K",
             above + dashes_of(models));
    for (std::size_t m = 0; m < models.size(); ++m)
      for (std::size_t k = 0; k < std::size(nodes); ++k)
        c.recorded(drop.node_path(*models[m], name, nodes[k].first), nodes[k].second + mark_of(models, m), 1., {k, m},
                   0, ambient);
    c.figure("surfaces-" + name, "Temperatures", name + ": surfaces, finite elements", "temperature rise", "K",
             above + "Lines: mean; bands: lowest to highest across the width. All values are circumferential means.");
    for (const ThermalKind* kind : models)
      for (std::size_t k = 0; k < std::size(surfaces) && kind->meshes_sections; ++k) {
        const std::string path = drop.node_path(*kind, name, surfaces[k].first);
        if (!drop.has(path)) continue;
        c.recorded(path, surfaces[k].second, 1., {k, 0}, 0, ambient);
        c.band(path, {k, 0}, 1., ambient);
      }
  }
}

void add_growth(Charts& c, const RecordedDrop& drop) {
  const char* const surfaces[] = {"shaft", "bore", "inner raceway", "outer raceway", "ball radius"};
  const auto models = drop.models();
  for (const auto& [name, parameters] : drop.bearings()) {
    c.figure("growth-" + name, "Growth and clearance", name + ": thermal growth", "radial growth", "um",
             dashes_of(models));
    for (std::size_t m = 0; m < models.size(); ++m)
      for (std::size_t k = 0; k < std::size(surfaces); ++k)
        c.recorded(drop.growth_path(*models[m], name), surfaces[k] + mark_of(models, m), 1e6, {k, m}, k);
  }
  c.figure("clearance", "Growth and clearance", "Air gap between rotor and bore", "radial clearance", "um",
           "With rotor and ring concentric, as used in the drop.");
  c.of_supports("clearance", "", 1e6);
}

/// A line for each column of a dataset.
/// @param only  what is behind the name if there is one column
/// @returns     the dash of the next line
std::size_t add_columns(Charts& c, const RecordedDrop& drop, const std::string& path, const std::string& name,
                        const std::string& only, double scale, LineStyle style) {
  const auto columns = drop.meaning(path).columns;
  for (std::size_t k = 0; k < drop.table(path).n_columns; ++k, ++style.dash)
    c.recorded(path, name + (columns.size() > 1 ? " " + columns[k] : only), scale, style, k);
  return style.dash;
}

void add_balls(Charts& c, const RecordedDrop& drop) {
  c.figure("ball-loads", "Balls", "Load of the most heavily loaded ball in each row", "ball load", "N");
  for (std::size_t i = 0; i < c.names().size(); ++i) {
    const std::string path = "/bearings/" + c.names()[i] + "/ball_force";
    if (drop.has(path)) add_columns(c, drop, path, c.names()[i], " row 1", 1., {i, 0});
  }
  c.figure("pressures", "Balls", "Contact pressures", "pressure", "GPa", "ISO 76 has 4.2 GPa as the static limit.");
  for (std::size_t i = 0; i < c.names().size(); ++i) {
    const std::string own = "/bearings/" + c.names()[i] + "/";
    std::size_t dash = 0;
    for (const auto& path : drop.pressure_paths(c.names()[i])) {
      const bool is_of_rows = path == own + "contact_pressure";
      const std::string name = c.names()[i] + (is_of_rows ? "" : " " + path.substr(own.size()));
      dash = add_columns(c, drop, path, name, is_of_rows ? " row 1" : "", 1e-9, {i, dash});
    }
  }
}

void add_energy(Charts& c) {
  c.figure("energy", "Energy", "Cumulative energy", "energy", "J");
  c.recorded("/energy/dissipated", "dissipated", 1., {1, 0});
  c.recorded("/energy/heat_deposited", "heat deposited", 1., {4, 1});
  c.recorded("/energy/heat_stored", "heat stored", 1., {0, 0});
  c.recorded("/energy/heat_lost", "heat lost", 1., {5, 2});
  c.recorded("/energy/growth_work", "work of thermal growth", 1., {2, 0});
  c.recorded("/energy/prescribed_work", "work of everything prescribed", 1., {3, 0});
  c.recorded("/energy/unbalance_work", "work of the unbalance", 1., {6, 1});
  c.recorded("/energy/drive_work", "work of the drive", 1., {7, 3});
  c.figure("residuals", "Energy", "Energy-balance residual", "residual", "uJ",
           "Error of the time integration, from independent balances.");
  c.recorded("/energy/residual", "mechanical", 1e6, {0, 0});
  c.recorded("/energy/heat_residual", "heat, lumped", 1e6, {1, 1});
  c.recorded("/energy/fe_heat_residual", "heat, finite elements", 1e6, {2, 2});
}

}  // namespace

Json report_charts(const RecordedDrop& drop, Json& axes) {
  Charts c(drop);
  add_motion(c, drop);
  add_probes(c, drop);
  add_forces(c, drop);
  add_speeds(c);
  add_heat(c, drop);
  add_temperatures(c, drop);
  add_growth(c, drop);
  add_balls(c, drop);
  add_energy(c);
  c.drop_empty();
  axes = c.axes();
  return c.take();
}

}  // namespace rotordrop
