#include "thermal/heating/heat_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/material_keys.h"
#include "thermal/fe_parameters.h"

namespace rotordrop {
namespace {

Section<HeatRunParameters> run_section() {
  using P = HeatRunParameters;
  Section<P> s("run", "Surroundings, start and end.");
  s.quantity("ambient", &P::ambient,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .fallback = "293.15 K",
              .help = "Temperature of the surroundings."});
  s.quantity("initial_temperature", &P::initial_temperature,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .help = "Temperature of all bodies at the start; ambient if omitted."});
  s.quantity("end_time", &P::end_time,
             {.unit = "s", .range = positive(), .help = "End time; the last of output_times if omitted."});
  return s;
}

Section<HeatMaterialParameters> material_section() {
  Section<HeatMaterialParameters> s("material",
                                    "A material of bodies. Of k and k_table one is needed (k_table counts if both are "
                                    "there), and so for c. E, nu and "
                                    "alpha are for displacements.");
  add_material_keys(s, 1.);  // a gap of air may be a body
  s.custom("temperature_limit",
           {.unit = "K",
            .accepts = "temperature in K, > 0",
            .json_types = {"number", "string"},
            .help = "Temperature that the material stands, of drops with the same materials; heat conduction does not "
                    "use it."},
           [](const Node& node, HeatMaterialParameters&, Faults& faults) {
             read_quantity(node, {.unit = "K", .range = positive()}, "temperature_limit", faults);
           });
  return s;
}

void check_rising(const std::array<double, 2>& extent, const char* key, const Node& table, const std::string& path,
                  Faults& faults) {
  if (!(extent[1] > extent[0]))
    faults.add(position_of_value(table, key), path + "." + key + " must increase.", "Write [smaller, larger].");
}

Section<HeatRectangleParameters> rectangle_section() {
  using P = HeatRectangleParameters;
  Section<P> s("rectangle",
               "A ring of rectangular section. Its boundaries are called NAME.inner, NAME.outer (radius), NAME.left "
               "and NAME.right (x).");
  s.text("name", &P::name, {.help = "Name of the body."});
  s.quantities("x", &P::x, {.unit = "m", .help = "Start and end along the axis."});
  s.quantities("r", &P::r, {.unit = "m", .range = at_least(0), .help = "Inner and outer radius; 0 for a solid body."});
  s.text("material", &P::material, {.help = "Material, a name of [materials]."});
  s.quantity("temperature", &P::temperature,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .help = "Temperature at which the whole body is held from the start; computed if omitted."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    check_rising(p.x, "x", table, path, faults);
    check_rising(p.r, "r", table, path, faults);
    if (p.name.empty() || p.name.find('.') != std::string::npos)
      faults.add(position_of_value(table, "name"), path + ".name = \"" + p.name + "\" is empty or has a dot in it.",
                 "Boundaries are called NAME.inner and so on.");
  });
  return s;
}

}  // namespace

Section<HeatPulseParameters> pulse_section(const std::string& unit) {
  using P = HeatPulseParameters;
  Section<P> s("pulse", "Equal pulses at equal intervals.");
  s.quantity("height", &P::height,
             {.unit = unit, .help = unit == "W" ? "Heat during a pulse." : "Heat flux density during a pulse."});
  s.quantity("width", &P::width, {.unit = "s", .range = positive(), .help = "Duration of a pulse."});
  s.quantity("period", &P::period,
             {.unit = "s",
              .range = positive(),
              .help = "Time from the start of a pulse to the start of the next, for several pulses."});
  s.quantity("start", &P::start,
             {.unit = "s", .range = at_least(0), .fallback = "0 s", .help = "Start of the first pulse."});
  s.integer("count", &P::count, {.range = between(1, 100000), .fallback = 1, .help = "Number of pulses."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    if (p.count > 1 && !p.period)
      faults.add(position_of(table, "count"), path + ".count = " + std::to_string(p.count) + " needs a period.",
                 "Give period = ..., from one pulse's beginning to the next one's.");
    if (p.period && *p.period < p.width)
      faults.add(position_of_value(table, "period"), path + ".period is shorter than its width.",
                 "Pulses must not overlap; a second one at the same place adds to the first.");
  });
  return s;
}

PulseTrain pulse_train(const HeatPulseParameters& p) {
  return {p.height, p.width, p.period.value_or(p.width), p.start, p.count};
}

namespace {

/// Which of three ways says what flows, and whether it is said completely.
void check_flux_form(const HeatFluxParameters& p, const Node& table, const std::string& path, Faults& faults) {
  const bool has_steps = table.has("times") || table.has("values");
  const int n_ways = int{has_steps} + int{p.pulse.has_value()} + int{p.recorded.has_value()};
  if (!p.boundary && !table.has("between"))
    faults.add(table.where(), path + " does not say where the heat enters.",
               "Give boundary = \"BODY.side\", or between = [\"BODY.side\", \"BODY.side\"], an interface.");
  if (p.boundary && table.has("between"))
    faults.add(position_of(table, "between"), path + " has both boundary and between.",
               "One flux goes into a free boundary or into an interface; give a second [[flux]] for the other.");
  if (p.resistance_beyond && !table.has("between"))
    faults.add(position_of(table, "resistance_beyond"),
               path + ".resistance_beyond belongs to a flux into an interface.",
               "Name its two boundaries by between, or leave it out.");
  if (n_ways != 1)
    faults.add(table.where(),
               path + (n_ways == 0 ? " does not define a flux." : " defines the flux in more than one way."),
               "Give one of: times and values; pulse = { height, width, ... }; recorded, with bearing and heat.");
  if (has_steps && (p.times.empty() || p.values.empty()))
    faults.add(table.where(), path + " needs times and values, at least one of each.");
  for (const char* key : {"bearing", "heat", "share", "interval"})
    if (!p.recorded && table.has(key))
      faults.add(position_of(table, key), path + "." + key + " belongs to a recorded heat.",
                 "Name its file: recorded = \"out/CASE/results.h5\".");
  if (!p.recorded) return;
  for (const auto& [key, is_given] :
       {std::pair("bearing", p.bearing.has_value()), std::pair("heat", p.heat.has_value())})
    if (!is_given)
      faults.add(position_of(table, "recorded"), path + ".recorded needs " + key + " beside it.",
                 "Such as bearing = \"TB1\", heat = \"rub\".");
}

Section<HeatFluxParameters> flux_section() {
  using P = HeatFluxParameters;
  Section<P> s(
      "flux",
      "Heat into a boundary, where no interface covers it, or into an interface: as steps (times and values), as "
      "pulses, or as an earlier drop recorded it.");
  s.text("boundary", &P::boundary, {.help = "Boundary: BODY.inner, .outer, .left or .right."});
  s.custom(
      "between",
      {.accepts = "[\"BODY.side\", \"BODY.side\"]",
       .json_types = {"array"},
       .help = "The two boundaries of an [[interface]] in which the heat arises, instead of boundary: friction or a "
               "heater there. Conduction divides it between both bodies."},
      [](const Node& node, P& target, Faults& faults) { target.between = read_two_boundaries(node, "flux", faults); });
  s.quantity("resistance_beyond", &P::resistance_beyond,
             {.range = between(0, 1),
              .help = "For a flux into an interface: the part of its contact resistance that lies between the heat and "
                      "the second body. 0.5 if omitted: the heat arises in the middle of the contact. It has little "
                      "effect if the contact resistance is small compared with those of the bodies."});
  s.quantities("times", &P::times,
               {.unit = "s", .help = "Times in increasing order; values[i] applies from times[i] until the next one."});
  s.quantities("values", &P::values, {.unit = "W/m2", .help = "Heat flux density from each of the times."});
  s.table<HeatPulseParameters>("pulse", &P::pulse, pulse_section("W/m2"));
  s.text("recorded", &P::recorded,
         {.help = "results.h5 of an earlier drop; the flux brings its heat row by row. A path relative to this file."});
  s.text("bearing", &P::bearing, {.help = "Name of the bearing whose recorded heat is used."});
  s.choice(
      "heat", &P::heat, {"rub", "inner", "outer"},
      {.help =
           "Kind of recorded heat: rub heat between rotor and ring, or friction heat at the inner or outer raceway."});
  s.quantity("share", &P::share,
             {.range = between(0, 1), .help = "Share of the recorded heat that enters this boundary; 1 if omitted."});
  s.quantity("interval", &P::interval,
             {.unit = "s",
              .range = positive(),
              .help = "For recorded heat: shortest step; rows in between are skipped. The heat stays the same and is "
                      "spread over longer steps."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    check_flux_form(p, table, path, faults);
    if (p.times.size() != p.values.size())
      faults.add(position_of_value(table, "values"),
                 path + " has " + std::to_string(p.times.size()) + " times and " + std::to_string(p.values.size()) +
                     " values.",
                 "Give one value for every time.");
    if (!std::is_sorted(p.times.begin(), p.times.end(), std::less_equal<>()))
      faults.add(position_of_value(table, "times"), path + ".times must increase.");
  });
  return s;
}

Section<HeatConvectionParameters> convection_section() {
  using P = HeatConvectionParameters;
  Section<P> s("convection",
               "Heat lost from a boundary, where no interface covers it: coefficient * rise^(1 + exponent), the rise "
               "over `ambient`.");
  s.text("boundary", &P::boundary, {.help = "Boundary: BODY.inner, .outer, .left or .right."});
  s.quantity("coefficient", &P::coefficient,
             {.unit = "W/(m2 K^n)",
              .range = at_least(0),
              .usual = at_most(2e4),
              .help = "Heat flux in W/m2 at a temperature rise of 1 K."});
  s.quantity("exponent", &P::exponent,
             {.range = between(0, 3),
              .fallback = "0",
              .help = "Exponent of the rise in the heat transfer coefficient; 0: flux proportional to the rise. Above "
                      "0 no heat is exchanged below ambient."});
  s.quantity("ambient", &P::ambient,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .help = "Temperature of the surroundings there; run.ambient if omitted."});
  return s;
}

Section<HeatFixedParameters> fixed_section() {
  using P = HeatFixedParameters;
  Section<P> s("fixed", "A boundary that is held at a temperature, where no interface covers it.");
  s.text("boundary", &P::boundary, {.help = "Boundary: BODY.inner, .outer, .left or .right."});
  s.quantity("temperature", &P::temperature,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .help = "Temperature held from the start."});
  return s;
}

Section<HeatInterfaceParameters> interface_section() {
  using P = HeatInterfaceParameters;
  Section<P> s(
      "interface",
      "Two boundaries that lie on each other and exchange heat where they do. Bodies that only touch exchange none.");
  s.custom("between",
           {.accepts = "[\"BODY.side\", \"BODY.side\"]",
            .json_types = {"array"},
            .required = true,
            .help = "The two boundaries."},
           [](const Node& node, P& target, Faults& faults) {
             target.between = read_two_boundaries(node, "interface", faults);
           });
  s.quantity("resistance", &P::resistance,
             {.unit = "m2 K/W", .range = positive(), .help = "Temperature jump divided by heat flux density."});
  return s;
}

Section<HeatProbeParameters> probe_section() {
  return heat_place_section("probe", "A temperature that is reported: at a point (x, r), or the mean of a boundary.");
}

Section<HeatNumericsParameters> numerics_section() {
  using P = HeatNumericsParameters;
  Section<P> s(fe_name, "Mesh and accuracy of the finite-element model.");
  s.integer("degree", &P::degree,
            {.range = between(1, 4), .fallback = 2, .help = "Polynomial degree of the elements; 2 is quadratic."});
  s.integer("cells", &P::cells,
            {.range = between(1, 1000),
             .fallback = 8,
             .help = "Cells across every body, in both directions, before grading."});
  s.quantity("grading", &P::grading,
             {.range = between(1, 1e5),
              .fallback = "30",
              .help = "Ratio by which the cells are thinner at boundaries with flux. The first one should be thinner "
                      "than sqrt(diffusivity * first output time)."});
  s.quantity("end_grading", &P::end_grading,
             {.range = between(1, 1e6),
              .fallback = "30",
              .help = "Ratio by which the cells are thinner at points where an interface ends inside a side, for the "
                      "corner's singularity there; 1: not at all."});
  s.quantity("growth", &P::growth,
             {.range = between(1.05, 5), .fallback = "1.5", .help = "Largest ratio of neighbouring cells."});
  s.quantity("time_tolerance", &P::time_tolerance,
             {.range = between(1e-12, 1e-1),
              .fallback = "1e-6",
              .help = "Error of one time step, relative to the largest temperature change."});
  s.choice("solver", &P::solver, linear_solvers(), {.fallback = "automatic", .help = linear_solver_help});
  return s;
}

}  // namespace

Section<HeatParameters> heat_section(const Node& default_materials) {
  using P = HeatParameters;
  Section<P> s("", "Heat conduction alone.");
  s.table<HeatRunParameters>("run", &P::run, run_section());
  s.tables<HeatMaterialParameters>(
      "materials", &P::materials, material_section(),
      {.fallback = default_materials,
       .help = "Materials by name. Those given here add to, or replace, the built-in ones."});
  s.table<HeatSectionParameters>("section", &P::section, [] {
    Section<HeatSectionParameters> section("section",
                                           "The section of all bodies in the plane of axis (x) and radius (r).");
    section.list("rectangle", &HeatSectionParameters::rectangles, rectangle_section(),
                 {.min_count = 1, .help = "Rings of rectangular section."});
    return section;
  }());
  s.list("flux", &P::fluxes, flux_section(), {.help = "Prescribed heat; boundaries without an entry are insulated."});
  s.list("convection", &P::convections, convection_section(), {.help = "Losses to the surroundings."});
  s.list("fixed", &P::fixed, fixed_section(), {.help = "Temperatures that are held."});
  s.list("interface", &P::interfaces, interface_section(), {.help = "Contact between bodies."});
  s.list("probe", &P::probes, probe_section(), {.help = "Temperatures to report."});
  s.table<HeatElasticParameters>("elastic", &P::elastic, heat_elastic_section());
  s.list("fit", &P::fits, heat_fit_section(), {.help = "Fits in which bodies press on each other, for displacements."});
  s.list("hold", &P::holds, heat_hold_section(), {.help = "Boundaries that do not move, for displacements."});
  s.list("displacement", &P::displacements, displacement_section(),
         {.help = "Displacements to report, by thermo-elasticity of all bodies."});
  s.quantities(
      "output_times", &P::output_times,
      {.unit = "s", .range = at_least(0), .help = "Times at which probes are reported; they are met exactly."});
  s.quantities(
      "field_times", &P::field_times,
      {.unit = "s",
       .range = at_least(0),
       .help = "Times at which the whole temperature field is written for ParaView; the start is always included."});
  s.quantity("field_interval", &P::field_interval,
             {.unit = "s", .range = positive(), .help = "Also write the fields at multiples of this time."});
  s.table<HeatNumericsParameters>(fe_name, &P::fe, numerics_section());
  return s;
}

}  // namespace rotordrop
