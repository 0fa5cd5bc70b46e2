#include "case/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/facts/material_slips.h"
#include "base/memory.h"
#include "base/rotation.h"
#include "bearing/support/linear_support_parameters.h"
#include "case/slips/slips.h"
#include "case/usual_values.h"
#include "thermal/field_parameters.h"

namespace rotordrop {
namespace {

constexpr double strongest_gravity = 30.;  // drops on ships and in vehicles, with a margin [m/s2]
constexpr double weakest_gravity = 1.;     // the moon has 1.62 [m/s2]
constexpr double shortest_run = 0.01;      // shorter ones are trials [s]

/// Modes of all nodes take some 1e-8 s times the cube of their number, measured with 1000.
constexpr double slowness_of_modes = 1e-8;  // [s]
constexpr std::size_t many_nodes = 500, most_nodes = 20'000, most_supports = 1000;

/// Steps of a drop take some 10 us of computing each.
constexpr double many_steps = 1e9, most_steps = 1e11;

double fewest_steps(const CaseParameters& p) { return p.run.latest_end() / step_or_bound(p.integration); }

/// The step if that is given, else the end.
SourcePosition position_of_step(const CaseParameters& p, const Node& tree) {
  return p.integration.step ? position_of_value(table_at(tree, "integration"), "step")
                            : position_of_value(table_at(tree, "run"), "end_time");
}

void look_at_materials(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  for (const auto& [name, m] : p.materials)
    for (const auto& slip : material_slips("the material " + name, {m.rho, m.E, m.k, m.c, m.nu, m.alpha}))
      warn(warnings, position_of_value(table_at(tree, "materials", name), slip.key), slip.message, slip.advice);
}

const Node& fe_table(const Node& tree) {
  const Node& thermal = table_at(tree, "thermal");
  const Node* fe = thermal.find(fe_name);
  return fe && fe->is_table() ? *fe : thermal;
}

/// Fields that are not written, since nothing has them or the run is over.
void look_at_fields(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const FeParameters& fe = p.thermal.fe;
  if (fe.field_times.empty() && !fe.field_interval) return;
  const Node& table = fe_table(tree);
  const bool runs_sections = p.thermal.runs_sections() || (p.heat && p.heat->models);
  if (!runs_sections) {
    warn(warnings, position_of_value(table, fe.field_times.empty() ? "field_interval" : "field_times"),
         fmt::format("thermal.fe.{} has no effect: no finite elements run (thermal.models).",
                     fe.field_times.empty() ? "field_interval" : "field_times"),
         "Add \"fe\" to thermal.models, or take the key out.");
    return;
  }
  const double end = latest_end_of_all(p);
  if (const auto n = std::count_if(fe.field_times.begin(), fe.field_times.end(), [&](double t) { return t > end; });
      n > 0)
    warn(warnings, position_of_value(table, "field_times"),
         fmt::format("{} of the {} thermal.fe.field_times lie beyond the end of the run, {:.6g} s: no field is written "
                     "there.",
                     n, fe.field_times.size(), end),
         "Bare numbers are in seconds. Check run.end_time.");
  if (fe.field_interval && *fe.field_interval > end)
    warn(warnings, position_of_value(table, "field_interval"),
         fmt::format(
             "thermal.fe.field_interval = {:.6g} s is longer than the run, {:.6g} s: only the field at the start "
             "is written.",
             *fe.field_interval, end),
         "A bare number is in seconds.");
}

/// What goes for the run as a whole.
void look_at_run(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& run = table_at(tree, "run");
  const auto& g = p.run.gravity;
  if (const double magnitude = std::hypot(g[0], g[1], g[2]);
      magnitude > strongest_gravity || (magnitude > 0. && magnitude < weakest_gravity))
    warn(warnings, position_of_value(run, "gravity"),
         fmt::format("run.gravity = {:.6g} m/s2 is {:.3g} times that of the earth.", magnitude,
                     magnitude / standard_gravity),
         "A bare number is in m/s2: 981 cm/s2 are 9.81. Without gravity all three are 0.");
  bool has_magnets = false, is_released = false;
  const SupportEntry* holding = nullptr;
  for (const auto& entry : p.bearings)
    if (const auto* magnet = entry.magnet()) {
      has_magnets = true;
      const auto [first, last] = std::minmax(magnet->release_time[0], magnet->release_time[1]);
      is_released = is_released || first < p.run.latest_end();
      if (last >= p.run.latest_end()) holding = &entry;
    }
  if (is_released && holding)
    warn(warnings, position_of_value(table_at(tree, "bearings", holding->name), "release_time"),
         fmt::format("bearings.{} holds the rotor until the end of the run, {:.6g} s, where other magnets let go.",
                     holding->name, p.run.latest_end()),
         "Check its release_time and run.end_time; bare numbers are in seconds. The loss of one magnet may be meant.");
  if (has_magnets && !is_released)
    warn(warnings, position_of_value(run, "end_time"),
         fmt::format("no magnet lets go before the end of the run, {:.6g} s: nothing falls.", p.run.latest_end()),
         "Check release_time of the magnets and run.end_time; bare numbers are in seconds.");
  if (const double steps = fewest_steps(p); steps > many_steps)
    warn(warnings, position_of_step(p, tree),
         fmt::format("run.end_time = {:.6g} s takes {:.2g} steps of at most {:.3g} s: hours or days.",
                     p.run.latest_end(), steps, step_or_bound(p.integration)),
         "A bare number is in seconds. Check run.end_time and integration.step; run.until ends a run by a condition.");
  if (const std::size_t n = p.rotor.geometry.node_x.size(); n > many_nodes)
    warn(warnings, position_of(table_at(tree, "rotor"), "geometry"),
         fmt::format("the rotor has {} nodes: its modes take about {:.2g} s.", n,
                     slowness_of_modes * std::pow(static_cast<double>(n), 3.)),
         "Join elements of one diameter: 50 to 200 nodes are usual.");
  const Node& output = table_at(tree, "output");
  for (const auto& [key, interval] :
       {std::pair{"interval", p.output.interval}, {"detail_interval", p.output.detail_interval}})
    if (interval > std::max(p.run.latest_end(), shortest_run))
      warn(warnings, position_of_value(output, key),
           fmt::format("output.{} = {:.6g} s is longer than the run, {:.6g} s: its series have the first and the last "
                       "row alone.",
                       key, interval, p.run.latest_end()),
           "A bare number is in seconds: \"50 us\" is usual.");
}

}  // namespace

double latest_end_of_all(const CaseParameters& p) {
  double end = p.run.latest_end();
  if (!p.heat) return end;
  if (p.heat->end_time) end = std::max(end, *p.heat->end_time);
  if (!p.heat->output_times.empty()) end = std::max(end, p.heat->output_times.back());
  return end;
}

void warn(std::vector<Fault>& warnings, const SourcePosition& where, std::string message, std::string advice) {
  Fault warning{where, std::move(message), std::move(advice)};
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(std::move(warning));
}

const Node& table_at(const Node& tree, std::string_view a, std::string_view b) {
  const Node* first = tree.find(a);
  if (!first || !first->is_table()) return tree;
  const Node* second = b.empty() ? nullptr : first->find(b);
  return second && second->is_table() ? *second : *first;
}

std::vector<Fault> look_for_slips(const SectionDeclaration& section, const CaseParameters& p, const Node& tree) {
  std::vector<Fault> warnings;
  look_for_unusual_values(section, tree, warnings);
  look_at_rotor(p, tree, warnings);
  look_at_motion(p, tree, warnings);
  look_at_run(p, tree, warnings);
  look_at_fields(p, tree, warnings);
  look_for_common_keys_without_effect(tree, warnings);
  look_at_bearings(p, tree, warnings);
  look_at_fits(p, tree, warnings);
  look_at_supports(p, tree, warnings);
  look_at_materials(p, tree, warnings);
  look_at_limits(p.limits, warnings);
  return warnings;
}

std::vector<Fault> look_at_speed(const CaseParameters& p, const std::string& option, double speed) {
  const double thickest = largest_diameter(p.rotor.geometry), surface = 0.5 * thickest * std::fabs(speed);
  std::vector<Fault> warnings;
  if (surface > fastest_surface)
    warn(
        warnings, {option, 0, 0},
        fmt::format("at {:.0f} rpm the rotor's surface runs at {:.0f} m/s (diameter {:.4g} mm); most often it is below "
                    "{:.0f} m/s.",
                    std::fabs(speed) * to_rpm, surface, mm(thickest), fastest_surface),
        "A bare speed is in rad/s: if rpm is meant, write for example \"15200 rpm\".");
  return warnings;
}

std::vector<Fault> look_at_stiffness(const std::string& option, double stiffness) {
  std::vector<Fault> warnings;
  if (stiffness > stiffest_support)
    warn(warnings, {option, 0, 0},
         fmt::format("a stiffness of {:.4g} N/m is unusual: it is most often <= {:.4g} N/m.", stiffness,
                     stiffest_support),
         "Check the number and its unit.");
  return warnings;
}

void check_size(const CaseParameters& p, const Node& tree, Faults& faults) {
  if (p.bearings.size() > most_supports)
    faults.add(
        position_of(tree, "bearings"),
        fmt::format("there are {} bearings and supports; at most {} are taken.", p.bearings.size(), most_supports),
        "Each has some eight series in the results, and closing them takes the square of their number: 4 s of "
        "1000, 40 s of 3000.");
  constexpr double n_matrices = 4.;  // measured with 1000 nodes
  const std::size_t n_nodes = p.rotor.geometry.node_x.size();
  const double n_unknowns = 2. * static_cast<double>(n_nodes), bytes = n_matrices * 8. * n_unknowns * n_unknowns;
  const auto most = static_cast<double>(most_memory());
  if (bytes < most && n_nodes <= most_nodes) return;
  faults.add(position_of(table_at(tree, "rotor"), "geometry"),
             fmt::format("the rotor has {} nodes: its modes have {:.0f} unknowns a plane, which take {}{}.", n_nodes,
                         n_unknowns, bytes_in_words(bytes),
                         bytes < most ? " and days" : fmt::format(", and there are {}", bytes_in_words(most))),
             "Join elements of one diameter: 50 to 200 nodes are usual.");
}

void check_length(const CaseParameters& p, const Node& tree, Faults& faults) {
  if (const double steps = fewest_steps(p); steps > most_steps)
    faults.add(position_of_step(p, tree),
               fmt::format("run.end_time = {:.6g} s in steps of at most {:.3g} s are {:.2g} steps; at most {:.0e} are "
                           "taken, which is more than ten days.",
                           p.run.latest_end(), step_or_bound(p.integration), steps, most_steps),
               "Make the step longer or the run shorter.");
}

void check_output(const CaseParameters& p, const Node& tree, Faults& faults) {
  // Rows of some hundred numbers each: 100 GB if all are written. Where rows become coarse while nothing changes, most are not.
  const auto& longest = p.output.longest_interval;
  const double most_rows = longest && *longest <= p.output.interval ? 1e8 : 1e10;
  const Node& table = table_at(tree, "output");
  for (const auto& [key, interval] :
       {std::pair{"interval", p.output.interval}, std::pair{"detail_interval", p.output.detail_interval}})
    if (p.run.latest_end() / interval > most_rows)
      faults.add(
          position_of_value(table, key),
          fmt::format("output.{} = {:.4g} s and run.end_time = {:.6g} s make {:.3g} rows of results; at most {:.0e} "
                      "are written.",
                      key, interval, p.run.latest_end(), p.run.latest_end() / interval, most_rows),
          "Make the interval longer or the run shorter.");
  if (p.thermal.runs_sections())
    check_number_of_fields("thermal.fe.field_interval", p.thermal.fe.field_interval.value_or(0.), p.run.latest_end(),
                           position_of_value(fe_table(tree), "field_interval"), faults);
}

}  // namespace rotordrop
