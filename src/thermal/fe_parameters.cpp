#include "thermal/fe_parameters.h"

#include <algorithm>
#include <functional>

namespace rotordrop {

Section<FeParameters> fe_section() {
  using P = FeParameters;
  Section<P> s(fe_name,
               "Finite elements of every touchdown bearing: the mesh of rings and housing (docs/how-to/mesh.md).");
  s.quantity("surface_cell", &P::surface_cell,
             {.unit = "m",
              .range = between(1e-7, 1e-2),
              .usual = between(1e-6, 5e-4),
              .fallback = "25 um",
              .source = "estimate: a sixth of the layer that an impact of 2 ms heats",
              .help = "Thickness of the cells on the bore and on the raceways' strips."});
  s.quantity("largest_cell", &P::largest_cell,
             {.unit = "m",
              .range = between(1e-6, 0.1),
              .usual = between(5e-5, 0.02),
              .fallback = "2 mm",
              .source = "estimate",
              .help = "Size of cells far from heated surfaces."});
  s.quantity(
      "refinement", &P::refinement,
      {.range = between(0.25, 16), .fallback = "1", .help = "All cell sizes are divided by this; 2 halves them."});
  s.quantity(
      "strip_half_width", &P::strip_half_width,
      {.unit = "m",
       .range = positive(),
       .usual = between(1e-5, 5e-3),
       .help = "Half width, along the groove, of the strips on the raceways that the balls heat: the semi-major axis "
               "of the contact ellipse. thermal.contact_half_width if not given."});
  s.quantity("relieved_shoulder", &P::relieved_shoulder,
             {.range = between(0, 1),
              .usual = or_zero(between(0.02, 1)),
              .fallback = "0.4",
              .source = "estimate from drawings of spindle bearings",
              .help = "Fraction of the groove depth kept by the outer ring's shoulder on the unloaded side, where "
                      "balls and cage are inserted. For bearings with a contact angle; 1: not relieved."});
  s.choice("shaft", &P::shaft, {{"lump", FeShaft::lump}, {"bearing", FeShaft::bearing}, {"beyond", FeShaft::beyond}},
           {.fallback = "lump",
            .help = "The shaft in the finite elements: a lump of shaft_lump_length, as in the circuit; bearing: meshed "
                    "over that length; beyond: meshed beside the bearing too, by the rotor's diameters, with "
                    "convection thermal.h_shaft along its surface, instead of the chain of nodes of thermal.shaft."});
  s.quantity(
      "shaft_reach", &P::shaft_reach,
      {.unit = "m",
       .range = positive(),
       .source = "estimate, if not given: four decay lengths of a fin, sqrt(k d/(4 h_shaft)) each, beyond which "
                 "less than 0.1 % of its heat is missing",
       .help = "How far a meshed shaft reaches beyond shaft_lump_length to each side; at most to the rotor's end "
               "or half-way to the next touchdown bearing. Of thermal.fe.shaft = \"beyond\"."});
  s.quantity("shaft_contact_resistance", &P::shaft_contact_resistance,
             {.unit = "K/W",
              .range = positive(),
              .usual = between(1e-4, 10),
              .source = "estimate, if not given: R2 of the circuit, 1/(4 pi k W)",
              .help = "Between the surfaces of a meshed shaft and of the bore: the contact's own, since the shaft and "
                      "the ring conduct by themselves. Of thermal.fe.shaft = \"bearing\" or \"beyond\"."});
  s.text("mesh", &P::mesh,
         {.help = "Your own mesh to use instead: a gmsh .msh file or .geo script, next to the case. NAME stands for "
                  "the bearing's name: \"meshes/NAME.msh\". Requirements: docs/how-to/mesh.md."});
  s.choice("section", &P::section, {{"grooved", FeSection::grooved}, {"plain", FeSection::plain}},
           {.fallback = "grooved",
            .help = "Shape of the rings' section. grooved: raceways with their grooves, meshed by gmsh. plain: "
                    "rectangles of the rings' diameters, heated over their whole width."});
  s.choice(
      "coupling", &P::coupling,
      {{"reduced", FeCoupling::reduced}, {"windowed", FeCoupling::windowed}, {"monolithic", FeCoupling::monolithic}},
      {.fallback = "reduced",
       .help = "How the finite elements are coupled to a drop. reduced: a few modes in the state vector. windowed: "
               "advanced implicitly alongside it with the energy of each time window. monolithic: all modes of a small "
               "mesh, for tests."});
  s.integer("degree", &P::degree,
            {.range = between(1, 4), .fallback = 2, .help = "Polynomial degree of the elements."});
  s.integer("modes", &P::modes,
            {.range = between(8, 200),
             .fallback = 200,
             .help = "Maximum number of modes per bearing section with the reduced coupling. It keeps as few as "
                     "response_tolerance permits; a case whose maximum is too small is refused."});
  s.quantity(
      "response_tolerance", &P::response_tolerance,
      {.range = between(1e-4, 10),
       .usual = at_most(0.05),
       .fallback = "0.005",
       .source = "a tenth of what rotordrop compare calls a difference",
       .help =
           "Largest relative error of the reduced coupling's response to heat, for every port and every mean "
           "temperature of a body, from 0.1 ms to 1000 s or the end of the run. It sets the number of modes kept."});
  s.quantity(
      "longest_step", &P::longest_step,
      {.unit = "s",
       .range = between(0, 1e-3),
       .usual = at_most(2e-4),
       .fallback = "100 us",
       .source = "the shortest time whose responses response_tolerance bounds",
       .help = "Steps of the motion are one step of reduced sections that follow it, as long as another one like "
               "the last would fit into this. 0: each step is one of theirs."});
  s.choice("solver", &P::solver, linear_solvers(), {.fallback = "automatic", .help = linear_solver_help});
  s.quantity("window_tolerance", &P::window_tolerance,
             {.unit = "m",
              .range = between(1e-13, 1e-6),
              .usual = between(1e-12, 1e-7),
              .fallback = "0.5 nm",
              .help = "Allowed error of a surface's growth per window. It sets the window length."});
  s.quantity(
      "longest_window", &P::longest_window,
      {.unit = "s",
       .range = between(1e-5, 0.1),
       .usual = between(1e-4, 0.05),
       .fallback = "2 ms",
       .help = "Longest window with the windowed coupling; shorter ones are a half, a quarter and so on of it."});
  s.quantities("field_times", &P::field_times,
               {.unit = "s",
                .range = at_least(0),
                .help = "Times at which the temperature field of every section is written for ParaView; the start is "
                        "always included. The windowed coupling writes at the next window end."});
  s.quantity("field_interval", &P::field_interval,
             {.unit = "s", .range = positive(), .help = "Also write the fields at multiples of this time."});
  s.check([](const P& p, const Node& table, Faults& faults) {
    if (!std::is_sorted(p.field_times.begin(), p.field_times.end(), std::less_equal<>()))
      faults.add(position_of_value(table, "field_times"), "thermal.fe.field_times must increase.");
    if (p.shaft_reach && p.shaft != FeShaft::beyond)
      faults.add(position_of_value(table, "shaft_reach"),
                 "thermal.fe.shaft_reach is that of a shaft meshed beside the bearing, and thermal.fe.shaft is not "
                 "\"beyond\".",
                 "Leave it out, or set thermal.fe.shaft = \"beyond\".");
    if (p.shaft_contact_resistance && p.shaft == FeShaft::lump)
      faults.add(position_of_value(table, "shaft_contact_resistance"),
                 "thermal.fe.shaft_contact_resistance is that of a meshed shaft, and thermal.fe.shaft is \"lump\".",
                 "Leave it out, or set thermal.fe.shaft = \"bearing\" or \"beyond\".");
    if (p.surface_cell > p.largest_cell)
      faults.add(position_of_value(table, "surface_cell"),
                 "thermal.fe.surface_cell is larger than thermal.fe.largest_cell.", "Cells grow away from surfaces.");
  });
  return s;
}

std::string own_mesh_file(const std::string& pattern, const std::string& bearing) {
  std::string file = pattern;
  for (std::size_t at = file.find("NAME"); at != std::string::npos; at = file.find("NAME", at + bearing.size()))
    file.replace(at, 4, bearing);
  return file;
}

}  // namespace rotordrop
